override c0: f32 = -0.0013622693;
override c1: f32 = -0.020335196;
override c2: f32 = 0.029672956;
override d0: f32 = 0.0013642003;
override d1: f32 = -0.00024342872;
override d2: f32 = 0.023144713;
override d3: f32 = 0.02638056;
override d4: f32 = -0.03921041;
override d5: f32 = 0.86574525;
override d6: f32 = 0.12702073;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Sixteen operations: -B/E is a quotient.
fn coupling_normalised_16(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = c0 + mu * (c1 + c2 * mu);
    let mu2 = mu * mu;
    let divisor = d0 + roughness * (d1 + d2 * roughness) + mu * (d3 + roughness * (d4 + d5 * alpha) + mu * (d6
        + mu2));
    return (1.0 + dividend / divisor) * (1.0 - f0);
}
