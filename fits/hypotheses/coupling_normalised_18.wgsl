override a0: f32 = 18.363207;
override b0: f32 = 0.9739654;
override b1: f32 = 18.150478;
override b2: f32 = -0.3469765;
override b3: f32 = 23.52545;
override b4: f32 = -25.753057;
override b5: f32 = 565.63586;
override b6: f32 = 26.976902;
override b7: f32 = 344.27457;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Eighteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_18(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b3 + roughness * (b4 + b5 * alpha) + mu * (b6 + b7 * mu);
    let divisor = b0 + b1 * alpha + b2 * roughness + mu * falloff;
    return (1.0 - f0) * (1.0 - rest * rest * (1.0 + a0 * mu) / divisor);
}
