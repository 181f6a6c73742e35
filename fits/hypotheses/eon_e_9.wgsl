override c0: f32 = 0.31585878;
override c1: f32 = 0.17180867;
override c2: f32 = -0.28667837;
override c3: f32 = 0.17956576;
override c4: f32 = -0.09224917;
override d1: f32 = -0.28117606;
override d2: f32 = 0.05859511;

/// Directional albedo E of the single-scattering Oren-Nayar lobe in the form of Fujii and of EON, exactly 1 at grazing.
/// Nine operations. A polynomial of mu of degree 5 times one of roughness, for both factors of the loss.
fn eon_e_9(roughness: f32, mu: f32) -> f32 {
    let lost = mu * roughness * (c0 + mu * (c1 + mu * (c2 + mu * (c3 + mu * c4))));
    return 1.0 - lost * (1.0 + roughness * (d1 + roughness * d2));
}
