override c0: f32 = -0.016646309;
override c1: f32 = 0.13400605;
override c2: f32 = -3.1571023;
override c3: f32 = -9.683523;
override d0: f32 = 0.0993642;
override d1: f32 = -1.2291459;
override d2: f32 = 26.429853;
override d3: f32 = 3.0480688;
override d4: f32 = -6.0667515;
override b0: f32 = 1.0321858;
override b1: f32 = -1.3969275;
override b2: f32 = 18.495388;
override b3: f32 = 3.830728;
override b4: f32 = -63.62325;
override b5: f32 = 153.6008;
override b6: f32 = 45.34348;
override b7: f32 = -198.19077;
override b8: f32 = 649.01416;

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
