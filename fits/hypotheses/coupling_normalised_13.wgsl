override c0: f32 = -0.98049206;
override c1: f32 = 1.3341454;
override d0: f32 = 9.88265;
override d1: f32 = 16.761076;
override d2: f32 = 2.3166177;
override d3: f32 = -13.430852;
override d4: f32 = 21.884878;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Thirteen operations: -B/E is a quotient.
fn coupling_normalised_13(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = c0 + c1 * mu;
    let divisor = 1.0 + alpha * (d0 + d1 * roughness) + mu * (d2 + d3 * roughness + d4 * mu);
    return (1.0 + dividend / divisor) * (1.0 - f0);
}
