override c0: f32 = -0.22848424;
override c1: f32 = 0.22048737;
override c2: f32 = 0.56477;
override c3: f32 = -0.36648342;
override c4: f32 = 0.105350986;
override c5: f32 = -1.6516844;
override c6: f32 = 1.464413;
override d0: f32 = -0.46136644;
override d1: f32 = 0.4831649;
override d2: f32 = 1.7899268;
override d3: f32 = -2.3458896;
override d4: f32 = 0.56403214;
override d5: f32 = 1.7425665;
override d6: f32 = -1.9108077;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Nineteen operations: a quotient.
fn ggx_glass_inside_19(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let dividend = roughness * (c0 + c1 * ior + roughness * (c2 + c3 * ior + alpha * (c4 + mu * (c5 + c6 * ior))));
    let alpha2 = alpha * alpha;
    let divisor = d0 + d1 * ior + mu * (d2 + ior * (d3 + d4 * ior) + alpha2 + mu * (d5 + d6 * alpha));
    return 1.0 + dividend / divisor;
}
