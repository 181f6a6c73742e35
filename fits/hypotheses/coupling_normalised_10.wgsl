override c0: f32 = -0.017941138;
override d0: f32 = 0.019555306;
override d1: f32 = 0.062046953;
override d2: f32 = 0.64339936;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Ten operations: -B/E is a quotient.
fn coupling_normalised_10(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let mu2 = mu * mu;
    let divisor = d0 + mu2 + alpha * (d1 + d2 * roughness);
    return (1.0 + c0 / divisor) * (1.0 - f0);
}
