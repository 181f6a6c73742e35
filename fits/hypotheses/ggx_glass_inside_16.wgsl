override c0: f32 = 0.34160486;
override c1: f32 = -0.58083445;
override c2: f32 = -1.0272312;
override c3: f32 = 1.4235071;
override d0: f32 = -0.9062272;
override d1: f32 = 1.2998726;
override d2: f32 = -0.5635748;
override d3: f32 = 0.16591378;
override d4: f32 = -1.5817788;
override d5: f32 = 6.26418;
override d6: f32 = -4.441823;

/// What multiplies the reflection and the transmission of rough glass seen from inside: N = 1/(R + T).
/// Sixteen operations: a quotient.
fn ggx_glass_inside_16(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let dividend = roughness * (c0 + mu * (c1 + roughness * (c2 + c3 * ior)));
    let divisor = d0 + ior * (d1 + roughness * (d2 + d3 * alpha)) + mu * (d4 + d5 * roughness + ior * (ior + d6
        * roughness));
    return 1.0 + dividend / divisor;
}
