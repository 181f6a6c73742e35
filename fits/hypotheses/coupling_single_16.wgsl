override b0: f32 = 1.0509138;
override b1: f32 = 19.386864;
override b2: f32 = -9.260064;
override b3: f32 = 0.66229117;
override b4: f32 = -8.7771015;
override b5: f32 = 19.831427;
override c0: f32 = 1.4526194;

/// Coupling factor of a white diffuse base under a bare GGX lobe, 1 - (f0 A + B) (Schlick's Fresnel).
/// Sixteen operations: B is a quotient, and the loss 1 - E, which counts for little where f0 is small, linear in alpha.
fn coupling_single_16(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b3 + b4 * roughness + b5 * mu;
    let bias = rest * rest / (b0 + alpha * (b1 + b2 * roughness) + mu * falloff);
    return (1.0 - f0) * (1.0 - bias) + f0 * (c0 * alpha);
}
