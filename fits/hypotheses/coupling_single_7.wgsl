override b0: f32 = 1.0354835;
override b1: f32 = -1.1165352;
override b2: f32 = -1.0819583;

/// Coupling factor of a white diffuse base under a bare GGX lobe, 1 - (f0 A + B) (Schlick's Fresnel).
/// Seven operations: B is the square of a polynomial, and no light counted as lost between facets.
fn coupling_single_7(roughness: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 + b2 * mu;
    let root = (b0 + b1 * roughness) * (rest * rest);
    return (1.0 - f0) * (1.0 - root * root);
}
