override c0: f32 = 0.38909;
override c1: f32 = 2.92899;
override d0: f32 = 1.18097;
override d1: f32 = 1.61408;
override d2: f32 = -2.35779;

/// Multiscatter factor of the GGX reflection lobe (height-correlated Smith) that saturates with f0, after Turquin
/// 2019: 1 + f0 (1/E - 1), with the thirteen operations of ggx_norm_q13 for 1/E. Its furnace is white at f0 = 1.
/// Exactly 1 at f0 = 0, at alpha = 0 and at mu = 0; undefined only where both alpha and mu are 0.
fn ggx_norm_q13_f0(alpha: f32, mu: f32, f0: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (c0 + c1 * a2);
    let divisor = a2 + mu * (d0 * alpha + mu * (d1 + d2 * alpha));
    return 1.0 + f0 * loss / divisor;
}
