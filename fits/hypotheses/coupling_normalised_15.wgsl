override c0: f32 = -0.0013873224;
override c1: f32 = -0.023976993;
override c2: f32 = 0.03537486;
override d0: f32 = 0.0013887112;
override d1: f32 = 0.023142776;
override d2: f32 = 0.029608855;
override d3: f32 = -0.04620782;
override d4: f32 = 1.0571222;
override d5: f32 = 0.1515121;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Fifteen operations: -B/E is a quotient.
fn coupling_normalised_15(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = c0 + mu * (c1 + c2 * mu);
    let mu2 = mu * mu;
    let divisor = d0 + d1 * alpha + mu * (d2 + roughness * (d3 + d4 * alpha) + mu * (d5 + mu2));
    return (1.0 + dividend / divisor) * (1.0 - f0);
}
