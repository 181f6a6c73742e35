/// Published: in several WGSL engines as "Turquin 2019 analytical approximation": E, here as N = 1/E. Takes alpha.
/// Not in Turquin's report, which has no fit; its lobe is not stated.
fn ggx_norm_turquin_label(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let m2 = mu * mu;
    return 1.0 / (1.0 - 1.4594 * (alpha * mu) + 0.8868 * (a2 * m2) + 0.5716 * (alpha * mu) - 0.0159 * a2);
}
