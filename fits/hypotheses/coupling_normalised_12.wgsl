override c0: f32 = -0.006297163;
override d0: f32 = 0.006303467;
override d1: f32 = 0.08680039;
override d2: f32 = 0.030167827;
override d3: f32 = -1.0750084;
override d4: f32 = 3.1800454;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Twelve operations: -B/E is a quotient.
fn coupling_normalised_12(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let mu2 = mu * mu;
    let divisor = d0 + d1 * alpha + mu * (d2 + alpha * (d3 + d4 * roughness) + mu2);
    return (1.0 + c0 / divisor) * (1.0 - f0);
}
