/// Published: A. Pesce, "Misunderstanding Multiscattering", c0de517e blog, 12 August 2019. N = 1 + 2 alpha^2 mu.
/// Takes alpha = roughness^2. Meant for the height-correlated Smith form. The author says that 1 and 2 are not the best constants.
fn ggx_norm_pesce_n1(alpha: f32, mu: f32) -> f32 {
    return 1.0 + 2.0 * (alpha * alpha) * mu;
}
