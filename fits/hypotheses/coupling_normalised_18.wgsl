override c0: f32 = -0.00037076132;
override c1: f32 = -0.018272035;
override c2: f32 = 0.02473124;
override c3: f32 = -0.0015808312;
override d0: f32 = 0.0003794648;
override d1: f32 = 0.00093882537;
override d2: f32 = 0.013547998;
override d3: f32 = 0.026174858;
override d4: f32 = 0.019883461;
override d5: f32 = -0.0671319;
override d6: f32 = 0.8409934;
override d7: f32 = 0.08793973;

/// Coupling factor of a white diffuse base under a GGX lobe that is divided by its albedo, (1 - f0)(1 - B/E) (Schlick's Fresnel).
/// Eighteen operations: -B/E is a quotient.
fn coupling_normalised_18(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let dividend = c0 + mu * (c1 + c2 * mu) + c3 * roughness;
    let mu2 = mu * mu;
    let divisor = d0 + roughness * (d1 + roughness * (d2 + d3 * alpha)) + mu * (d4 + alpha * (d5 + d6
        * roughness) + mu * (d7 + mu2));
    return (1.0 + dividend / divisor) * (1.0 - f0);
}
