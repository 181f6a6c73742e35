override b0: f32 = 1.0340476;
override b1: f32 = -1.1117209;
override b2: f32 = -1.0784883;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Seven operations: B/E is the square of a polynomial, and no light counted as lost between facets.
fn coupling_compensated_7(roughness: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 + b2 * mu;
    let root = (b0 + b1 * roughness) * (rest * rest);
    return (1.0 - f0) * (1.0 - root * root);
}
