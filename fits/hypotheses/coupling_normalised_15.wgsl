override c0: f32 = -0.0012554596;
override c1: f32 = -0.020443523;
override c2: f32 = 0.029483592;
override d0: f32 = 0.0012432323;
override d1: f32 = 0.02080427;
override d2: f32 = 0.026566282;
override d3: f32 = -0.042498812;
override d4: f32 = 0.9245607;
override d5: f32 = 0.122603945;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Fifteen operations: -B/E is a quotient.
fn coupling_normalised_15(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = c0 + mu * (c1 + c2 * mu);
    let mu2 = mu * mu;
    let divisor = d0 + d1 * alpha + mu * (d2 + roughness * (d3 + d4 * alpha) + mu * (d5 + mu2));
    return (1.0 + dividend / divisor) * (1.0 - f0);
}
