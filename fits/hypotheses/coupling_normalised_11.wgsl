override b0: f32 = 1.0253;
override b1: f32 = 4.5;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Eleven operations: B/E is the square of a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_11(alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let root = rest * rest / (b0 + b1 * alpha);
    return (1.0 - f0) * (1.0 - root * root);
}
