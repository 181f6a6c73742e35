override c0: f32 = 0.002901954;
override c1: f32 = -0.17609046;
override c2: f32 = -4.6093373;
override c3: f32 = 11.414372;
override c4: f32 = -17.989162;
override c5: f32 = 20.52706;
override c6: f32 = -12.341368;
override c7: f32 = 1.0408533;
override c8: f32 = 2.314824;
override c9: f32 = -0.7749158;

/// Cosine-weighted mean over directions of the GGX reflection albedo, E_avg.
/// Ten operations: a polynomial in roughness without its linear term, good to some units of f32. Exactly 1 for a mirror.
fn ggx_eavg_10(roughness: f32, alpha: f32) -> f32 {
    let high = roughness * (c5 + roughness * (c6 + roughness * (c7 + roughness * (c8 + roughness * c9))));
    return 1.0 + alpha * (c0 + roughness * (c1 + roughness * (c2 + roughness * (c3 + roughness * (c4 + high)))));
}
