override c0: f32 = -0.0055563073;
override c1: f32 = -0.4128085;
override c2: f32 = 0.23585445;
override c3: f32 = -3.514061;
override d0: f32 = 0.0516986;
override d1: f32 = -0.94971377;
override d2: f32 = 6.240244;
override d3: f32 = 4.5119896;
override d4: f32 = -5.5824285;
override b0: f32 = 1.0415183;
override b1: f32 = -0.7711683;
override b2: f32 = 17.557283;
override b3: f32 = 2.6055813;
override b4: f32 = -145.66579;
override b5: f32 = 382.68994;
override b6: f32 = 55.426132;
override b7: f32 = -193.70937;
override b8: f32 = 590.0967;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Thirty-three operations: forms of E - 1 and of the share B/E.
fn coupling_compensated_33(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let cube = alpha * roughness;
    let loss = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha)));
    let divisor = cube + mu * (d0 + roughness * (d1 + d2 * cube) + mu * (d3 + d4 * roughness));
    let gain = loss / divisor;
    let falloff = b3 + alpha * (b4 + b5 * roughness) + mu * (b6 + mu * (b7 + b8 * mu));
    let share = 1.0 / (b0 + roughness * (b1 + b2 * roughness) + mu * falloff);
    let left = (1.0 - f0) * (1.0 - share);
    return left - (1.0 - f0) * gain * (1.0 - left);
}
