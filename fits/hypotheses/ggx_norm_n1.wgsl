override c: f32 = 2.0;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// The form of Pesce, "Misunderstanding Multiscattering" (2019), 1 + 2 alpha^2 mu, with its constant free.
/// Exactly 1 for a mirror and at grazing incidence.
fn ggx_norm_n1(alpha: f32, mu: f32) -> f32 {
    return 1.0 + c * (alpha * alpha) * mu;
}
