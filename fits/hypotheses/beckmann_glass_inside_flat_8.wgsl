override c0: f32 = 0.37491637;
override c1: f32 = -1.4226648;
override c2: f32 = 1.2665788;
override c3: f32 = 2.7638063;
override c4: f32 = -4.269784;
override c5: f32 = -1.262999;
override c6: f32 = 3.2721097;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Eight operations: a polynomial.
fn beckmann_glass_inside_flat_8(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let t0 = roughness * mu;
    return 1.0 + roughness * (c0 + roughness * (c1 + c2 * roughness) + t0 * (c3 + mu * (c4 + c5
        * alpha + c6 * t0)));
}
