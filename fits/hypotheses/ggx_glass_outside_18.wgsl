override c0: f32 = 0.18556803;
override c1: f32 = 0.03980999;
override c2: f32 = -0.8594149;
override c3: f32 = 0.39922863;
override c4: f32 = -0.06286698;
override c5: f32 = -0.069454275;
override c6: f32 = 1.2719343;
override c7: f32 = -0.12700029;
override c8: f32 = -0.03680049;
override c9: f32 = -1.2947353;
override c10: f32 = 0.5219614;
override c11: f32 = 0.1710152;
override k0: f32 = 0.28121775;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Eighteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_18(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    return 1.0 + alpha_inverse * (c0 + ior * (c1 + roughness * (c2 + ior * (c3 + ior * c4))) + alpha_inverse * (c5 + mu * (c6 + ior * (c7 + inverse * c8) + mu * (c9 + ior * c10)) + roughness * c11));
}
