override c0: f32 = 0.61429924;
override c1: f32 = -0.53196186;
override c2: f32 = 0.10587581;
override c3: f32 = -1.0667558;
override c4: f32 = 3.5253177;
override c5: f32 = 0.15808216;
override c6: f32 = 0.39092287;
override c7: f32 = -3.1791422;
override c8: f32 = -0.57558405;
override k0: f32 = 0.23698626;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Fourteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_14(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    return 1.0 + alpha * (c0 + ior * (c1 + ior * c2) + mu * (c3 + inverse * (c4 + inverse * (c5 + mu * c7 + roughness * c8)) + ior * c6));
}
