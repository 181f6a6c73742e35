override c0: f32 = -0.28998342;
override c1: f32 = 0.03951974;
override c2: f32 = 0.14239521;
override c3: f32 = -3.4993603;
override c4: f32 = 3.6028872;
override c5: f32 = 2.4704032;
override k0: f32 = 0.4707944;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Twelve operations. A polynomial with a reciprocal, which is homogeneous in mu and alpha.
/// Exactly 1 for a mirror.
fn beckmann_norm_12(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let t1 = mu * alpha;
    return 1.0 + t1 * (c0 + inverse * (c1 + c2 * inverse) + t1 * (c3 + c4 * inverse + c5 * t1));
}
