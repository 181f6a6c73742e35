override c0: f32 = 0.43681955;
override c1: f32 = 0.10467997;
override c2: f32 = 0.66298497;
override c3: f32 = -2.5912056;
override c4: f32 = -0.2907374;
override k: f32 = 0.32145867;
override b0: f32 = 0.96638066;
override b1: f32 = 6.5095563;
override b2: f32 = -15.249765;
override b3: f32 = 179.70518;
override b4: f32 = 2.7393408;
override b5: f32 = 27.387514;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Twenty-four operations: forms of E - 1 and of the share B/E.
fn coupling_compensated_24(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + c3 * roughness + c4 * inverse);
    let gain = alpha * (c0 + mu * (c1 + layer));
    let share = 1.0 / (b0 + mu * (b1 + mu * (b2 + b3 * mu)) + alpha * (b4 + b5 * roughness));
    let through = 1.0 - f0;
    let left = 1.0 - share;
    return through * (left - gain * (1.0 - through * left));
}
