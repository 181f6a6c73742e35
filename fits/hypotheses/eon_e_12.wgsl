override c0: f32 = 0.31688443;
override c1: f32 = 0.17353316;
override c2: f32 = -0.39813486;
override c3: f32 = 0.7474657;
override c4: f32 = -1.2443839;
override c5: f32 = 1.0439942;
override c6: f32 = -0.3513592;
override d1: f32 = -0.2870595;
override d2: f32 = 0.07815776;
override d3: f32 = -0.014635462;

/// Directional albedo E of the single-scattering Oren-Nayar lobe in the form of Fujii and of EON, exactly 1 at grazing.
/// Twelve operations. A polynomial of mu of degree 7 times one of roughness, for both factors of the loss.
fn eon_e_12(roughness: f32, mu: f32) -> f32 {
    let lost = mu * roughness * (c0 + mu * (c1 + mu * (c2 + mu * (c3 + mu * (c4 + mu * (c5 + mu * c6))))));
    return 1.0 - lost * (1.0 + roughness * (d1 + roughness * (d2 + roughness * d3)));
}
