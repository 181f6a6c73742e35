override b0: f32 = 1.0372796;
override b1: f32 = 8.947005;
override b2: f32 = 18.710918;
override b3: f32 = 1.6704588;
override b4: f32 = -8.957912;
override b5: f32 = 31.920044;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Thirteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_13(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let falloff = b3 + b4 * roughness + b5 * mu;
    let divisor = b0 + alpha * (b1 + b2 * roughness) + mu * falloff;
    return (1.0 - f0) * (1.0 - (1.0 - mu) / divisor);
}
