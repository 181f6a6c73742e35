override a0: f32 = 16.79;
override a1: f32 = -26.85;
override a2: f32 = 13.97;
override a3: f32 = -5.694;
override b0: f32 = -0.1601;
override b1: f32 = -1.507;
override b2: f32 = 0.8841;
override b3: f32 = 0.3176;

/// Directional albedo E of the Charlie sheen lobe, which exceeds 1 at grazing.
/// The form of three.js, an exponential of a line in mu, fitted and not clamped.
fn charlie_e_exp(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let q = 1.0 / (roughness + 0.1);
    let slope = a0 + a1 * roughness + a2 * alpha + a3 * q;
    let level = b0 + b1 * roughness + b2 * alpha + b3 * q;
    return exp(slope * mu + level);
}
