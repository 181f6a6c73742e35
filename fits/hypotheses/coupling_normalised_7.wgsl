override b0: f32 = 1.0463;
override b1: f32 = -1.0991;
override b2: f32 = -1.0807;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Seven operations: B/E is the square of a polynomial.
fn coupling_normalised_7(roughness: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 + b2 * mu;
    let root = (b0 + b1 * roughness) * (rest * rest);
    return (1.0 - f0) * (1.0 - root * root);
}
