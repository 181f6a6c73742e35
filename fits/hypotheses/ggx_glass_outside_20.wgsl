override c0: f32 = 0.208431;
override c1: f32 = 0.03914312;
override c2: f32 = -1.0952876;
override c3: f32 = 0.54839003;
override c4: f32 = -0.09250859;
override c5: f32 = -0.079686455;
override c6: f32 = 1.5008392;
override c7: f32 = -0.12673599;
override c8: f32 = -0.038252335;
override c9: f32 = -1.5411708;
override c10: f32 = 0.54192597;
override c11: f32 = 0.21092284;
override c12: f32 = 0.24939185;
override c13: f32 = -0.20638745;
override k0: f32 = 0.28849787;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Twenty operations: a nested sum with a reciprocal.
fn ggx_glass_outside_20(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    let alpha_inverse = alpha * inverse;
    return 1.0 + alpha_inverse * (c0 + ior * (c1 + roughness * (c2 + ior * (c3 + ior * c4))) + alpha_inverse * (c5 + mu * (c6 + ior * (c7 + inverse * c8) + mu * (c9 + ior * c10 + alpha_inverse * (c12 + alpha_inverse * c13))) + roughness * c11));
}
