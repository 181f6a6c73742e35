override b0: f32 = 1.075831;
override b1: f32 = -1.0886486;
override b2: f32 = 16.134933;
override b3: f32 = 1.4612972;
override b4: f32 = 24.6241;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Twelve operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_12(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let falloff = b3 + b4 * mu;
    let divisor = b0 + b1 * roughness + b2 * alpha + mu * falloff;
    return (1.0 - f0) * (1.0 - (1.0 - mu) / divisor);
}
