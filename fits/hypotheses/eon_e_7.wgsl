override c0: f32 = 0.31493354;
override c1: f32 = 0.15530711;
override c2: f32 = -0.18077086;
override d1: f32 = -0.28117606;
override d2: f32 = 0.05859511;

/// Directional albedo E of the single-scattering Oren-Nayar lobe in the form of Fujii and of EON, exactly 1 at grazing.
/// Seven operations. A polynomial of mu of degree 3 times one of roughness, for both factors of the loss.
fn eon_e_7(roughness: f32, mu: f32) -> f32 {
    let lost = mu * roughness * (c0 + mu * (c1 + mu * c2));
    return 1.0 - lost * (1.0 + roughness * (d1 + roughness * d2));
}
