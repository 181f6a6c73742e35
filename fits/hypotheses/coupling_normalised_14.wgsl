override b0: f32 = 1.0172197;
override b1: f32 = 10.220702;
override b2: f32 = 16.232306;
override b3: f32 = 2.091294;
override b4: f32 = -15.50516;
override b5: f32 = 16.860905;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Fourteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_14(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b3 + b4 * roughness + b5 * mu;
    let bias = rest * rest / (b0 + alpha * (b1 + b2 * roughness) + mu * falloff);
    return (1.0 - f0) * (1.0 - bias);
}
