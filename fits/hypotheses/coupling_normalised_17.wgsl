override a0: f32 = 20.067636;
override b0: f32 = 1.0022446;
override b1: f32 = 16.542866;
override b2: f32 = 22.45088;
override b3: f32 = -31.506975;
override b4: f32 = 849.0226;
override b5: f32 = 164.00905;
override b6: f32 = -444.80646;
override b7: f32 = 2466.3142;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Seventeen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_17(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let falloff = b2 + roughness * (b3 + b4 * alpha) + mu * (b5 + mu * (b6 + b7 * mu));
    let divisor = b0 + b1 * alpha + mu * falloff;
    return (1.0 - f0) * (1.0 - (1.0 - mu) * (1.0 + a0 * mu) / divisor);
}
