override b0: f32 = 1.0497421;
override b1: f32 = 18.831404;
override b2: f32 = -12.911845;
override b3: f32 = 0.5697083;
override b4: f32 = -9.684063;
override b5: f32 = 21.778946;
override c0: f32 = 0.7467864;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Seventeen operations: B/E is a quotient, and the loss 1 - E, which counts for little where f0 is small, linear in alpha.
fn coupling_compensated_17(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b3 + b4 * roughness + b5 * mu;
    let bias = rest * rest / (b0 + alpha * (b1 + b2 * roughness) + mu * falloff);
    let through = 1.0 - f0;
    let share = 1.0 - bias;
    return through * (share + c0 * alpha * (1.0 - through * share));
}
