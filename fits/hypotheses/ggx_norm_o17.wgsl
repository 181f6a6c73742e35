override c0: f32 = 0.00050612405;
override c1: f32 = 0.108793125;
override c2: f32 = 0.0075468835;
override d0: f32 = 7.477831e-5;
override d1: f32 = -0.02770263;
override d2: f32 = 0.37403053;
override d3: f32 = -0.0006553722;
override d4: f32 = -1.8046582;
override d5: f32 = 4.277781;
override d6: f32 = -2.1492736;
override d7: f32 = 1.1723641;
override d8: f32 = -1.3528425;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Seventeen operations. A quotient in roughness, alpha and mu.
/// Exactly 1 for a mirror.
fn ggx_norm_o17(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let loss = alpha * (c0 + c1 * mu + alpha * (c2 + mu * alpha));
    let slope = d3 + alpha * (d4 + roughness * (d5 + d6 * roughness)) + mu * (d7 + d8 * roughness);
    let divisor = d0 + alpha * (d1 + d2 * roughness) + mu * slope;
    return 1.0 + loss / divisor;
}
