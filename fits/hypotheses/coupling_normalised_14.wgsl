override c0: f32 = -0.0041861692;
override d0: f32 = 0.0043388736;
override d1: f32 = -0.0037350485;
override d2: f32 = 0.07541854;
override d3: f32 = 0.016282797;
override d4: f32 = -0.58660346;
override d5: f32 = 1.4949967;
override d6: f32 = 0.10317644;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Fourteen operations: -B/E is a quotient.
fn coupling_normalised_14(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let mu2 = mu * mu;
    let divisor = d0 + roughness * (d1 + d2 * roughness) + mu * (d3 + alpha * (d4 + d5 * roughness) + mu * (d6
        + mu2));
    return (1.0 + c0 / divisor) * (1.0 - f0);
}
