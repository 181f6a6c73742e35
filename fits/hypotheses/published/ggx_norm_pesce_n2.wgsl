/// Published: A. Pesce, "Misunderstanding Multiscattering", c0de517e blog, 12 August 2019. N = 1 + alpha^2.
/// Takes alpha = roughness^2. Meant for the height-correlated Smith form.
fn ggx_norm_pesce_n2(alpha: f32) -> f32 {
    return 1.0 + alpha * alpha;
}
