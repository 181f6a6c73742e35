/// Published: a path tracer in Mojo, beside its Chebyshev series of the loss: E_avg. Takes alpha.
/// Fitted to the mean of its own E, not to the lobe's.
fn ggx_eavg_chebyshev(alpha: f32) -> f32 {
    let high = -5.0972079 + alpha * (3.099162 - 0.8173428 * alpha);
    return 1.0003924 + alpha * (-0.0735147 + alpha * (-2.5279152 + alpha * (4.8253712 + alpha * high)));
}
