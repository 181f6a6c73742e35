/// Published: Cycles up to 3.4, bsdf_microfacet_multi.h, mf_ggx_albedo. Takes alpha.
/// It is E at normal incidence rather than its mean over directions, off by 0.1 as E_avg.
fn ggx_eavg_cycles(alpha: f32) -> f32 {
    let high = -14.398 + alpha * (15.784 + alpha * (-8.43891 + 1.76741 * alpha));
    let low = 0.00568739 + alpha * (0.027803 + alpha * (-1.19722 + alpha * (6.45221 + alpha * high)));
    return 0.806495 * exp(-1.98712 * (alpha * alpha)) + 0.199531 - low;
}
