override c0: f32 = -0.41745397;
override c1: f32 = 0.23169978;
override c2: f32 = 1.8356794;
override c3: f32 = -0.091983795;
override c4: f32 = -3.022738;
override c5: f32 = 1.8091736;
override c6: f32 = -0.3596718;
override c7: f32 = 0.0015950603;
override c8: f32 = 1.2544543;
override c9: f32 = -0.009911705;
override c10: f32 = -2.4630098;
override c11: f32 = -0.7941329;
override c12: f32 = 1.1419268;
override c13: f32 = 2.0738459;
override c14: f32 = -0.7463087;
override k: f32 = 0.38911507;

/// What multiplies the reflection and the transmission of rough glass seen from outside: N = 1/(R + T).
/// Twenty operations: a nested sum with a reciprocal.
fn ggx_glass_outside_20(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + inverse * (c1 + alpha * (c2 + inverse * (c3 + mu * (c8 + roughness * (c10
        + inverse * (c11 + roughness * (c13 + ior * c14)) + ior * c12))) + ior * (c4 + ior * (c5 + ior * (c6
        + inverse * c7 + mu * c9))))));
}
