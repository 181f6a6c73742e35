override b0: f32 = 1.0018402;
override b1: f32 = 11.644375;
override b2: f32 = 13.23188;
override b3: f32 = 2.8944902;
override b4: f32 = -23.817339;
override b5: f32 = 12.470423;
override b6: f32 = 55.11664;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Fifteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_15(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b3 + b4 * roughness + mu * (b5 + b6 * roughness);
    let bias = rest * rest / (b0 + alpha * (b1 + b2 * roughness) + mu * falloff);
    return (1.0 - f0) * (1.0 - bias);
}
