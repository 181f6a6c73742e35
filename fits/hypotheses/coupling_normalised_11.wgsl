override c0: f32 = -0.0064136195;
override d0: f32 = 0.006623658;
override d1: f32 = 0.027387975;
override d2: f32 = 0.04368397;
override d3: f32 = 0.1599598;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Eleven operations: -B/E is a quotient.
fn coupling_normalised_11(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let mu2 = mu * mu;
    let divisor = d0 + mu * (d1 + mu2) + alpha * (d2 + d3 * roughness);
    return (1.0 + c0 / divisor) * (1.0 - f0);
}
