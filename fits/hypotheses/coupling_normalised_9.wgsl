override c0: f32 = -0.018432705;
override d0: f32 = 0.019856524;
override d1: f32 = 0.25286576;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Nine operations: -B/E is a quotient.
fn coupling_normalised_9(alpha: f32, mu: f32, f0: f32) -> f32 {
    let mu2 = mu * mu;
    let divisor = d0 + mu2 + d1 * alpha;
    return (1.0 + c0 / divisor) * (1.0 - f0);
}
