override b0: f32 = 0.9956;
override b1: f32 = -0.2697;
override b2: f32 = -0.7855;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Eight operations: B/E is the fourth power of a polynomial. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_8(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let root = (1.0 - mu) * (b0 + b1 * roughness + b2 * alpha);
    let square = root * root;
    return (1.0 - f0) * (1.0 - square * square);
}
