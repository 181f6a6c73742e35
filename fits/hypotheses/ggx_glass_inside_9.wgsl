override c0: f32 = 11.136657;
override c1: f32 = -10.165251;
override c2: f32 = 2.3063076;
override c3: f32 = -28.575525;
override c4: f32 = 23.96849;
override c5: f32 = -4.29815;
override c6: f32 = 11.685676;
override c7: f32 = -6.966093;
override c8: f32 = 1.0532382;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Nine operations: a polynomial.
fn ggx_glass_inside_9(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + alpha * (c0 + ior * (c1 + c2 * ior) + mu * (c3 + ior * (c4 + c5 * ior) + mu * (c6 + ior * (c7 + c8 * roughness))));
}
