override c0: f32 = 0.6303964;
override c1: f32 = -2.292497;
override c2: f32 = 1.7801743;
override c3: f32 = -1.449517;
override c4: f32 = 6.2332172;
override c5: f32 = -5.556112;
override c6: f32 = 0.9613987;
override c7: f32 = -8.866633;
override c8: f32 = 9.396772;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Ten operations: a polynomial.
fn beckmann_glass_inside_flat_10(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let mu2 = mu * mu;
    return 1.0 + roughness * (c0 + mu * (c1 + c2 * mu2) + roughness * (c3 + mu * (c4 + c5 * mu2)
        + alpha * (c6 + mu2 * (c7 + c8 * mu))));
}
