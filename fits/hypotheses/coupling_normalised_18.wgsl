override a0: f32 = 16.225555;
override b0: f32 = 1.0143658;
override b1: f32 = -0.21605197;
override b2: f32 = 17.040142;
override b3: f32 = 18.199848;
override b4: f32 = -26.837181;
override b5: f32 = 643.67145;
override b6: f32 = 147.47351;
override b7: f32 = -433.17746;
override b8: f32 = 2164.583;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Eighteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_18(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let falloff = b3 + roughness * (b4 + b5 * alpha) + mu * (b6 + mu * (b7 + b8 * mu));
    let divisor = b0 + b1 * roughness + b2 * alpha + mu * falloff;
    return (1.0 - f0) * (1.0 - (1.0 - mu) * (1.0 + a0 * mu) / divisor);
}
