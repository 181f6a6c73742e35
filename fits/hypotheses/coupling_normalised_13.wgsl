override b0: f32 = 0.99551564;
override b1: f32 = 15.378321;
override b2: f32 = 1.5526711;
override b3: f32 = -15.442991;
override b4: f32 = 22.721205;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Thirteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_13(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b2 + b3 * roughness + b4 * mu;
    let bias = rest * rest / (b0 + b1 * alpha + mu * falloff);
    return (1.0 - f0) * (1.0 - bias);
}
