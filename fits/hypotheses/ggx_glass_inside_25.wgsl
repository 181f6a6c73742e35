override c0: f32 = 0.48951736;
override c1: f32 = -0.6305199;
override c2: f32 = -2.8254185;
override c3: f32 = 1.2752789;
override c4: f32 = 5.523711;
override c5: f32 = -5.246537;
override d0: f32 = -1.0893811;
override d1: f32 = 1.1402947;
override d2: f32 = 2.9852843;
override d3: f32 = -5.1897726;
override d4: f32 = 2.3366704;
override d5: f32 = 2.3542452;
override d6: f32 = 3.5888765;
override d7: f32 = -2.7899206;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Twenty-five operations: a quotient.
fn ggx_glass_inside_25(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let dividend = ior * roughness * (c0 + c1 * ior + roughness * (ior + roughness * (c2 + roughness * (c3 + mu * (c4 + c5 * ior)))));
    let alpha2 = alpha * alpha;
    let mu2 = mu * mu;
    let divisor = ior * (d0 + d1 * ior) + mu * (d2 + ior * (d3 + d4 * ior) + d5 * alpha2 + mu2 * (d6 + d7 * (ior * (mu * alpha2))));
    return 1.0 - dividend / divisor;
}
