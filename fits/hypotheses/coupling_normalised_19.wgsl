override a0: f32 = 17.661594;
override b0: f32 = 1.014655;
override b1: f32 = 17.504719;
override b2: f32 = -0.31697935;
override b3: f32 = 19.219706;
override b4: f32 = -25.238585;
override b5: f32 = 589.5237;
override b6: f32 = 108.6964;
override b7: f32 = -235.58868;
override b8: f32 = 1023.78204;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Nineteen operations: B/E is a quotient. At mu = 1 the factor is 1 - f0.
fn coupling_normalised_19(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let rest = 1.0 - mu;
    let falloff = b3 + roughness * (b4 + b5 * alpha) + mu * (b6 + mu * (b7 + b8 * mu));
    let divisor = b0 + b1 * alpha + b2 * roughness + mu * falloff;
    return (1.0 - f0) * (1.0 - rest * rest * (1.0 + a0 * mu) / divisor);
}
