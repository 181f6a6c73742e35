override c0: f32 = -0.015251186;
override c1: f32 = -0.15977979;
override c2: f32 = 1.7356496;
override c3: f32 = -6.440614;
override d0: f32 = 0.09210157;
override d1: f32 = -1.1859776;
override d2: f32 = 11.004479;
override d3: f32 = 4.185234;
override d4: f32 = -7.68738;
override b0: f32 = 1.032912;
override b1: f32 = -1.4376723;
override b2: f32 = 18.676313;
override b3: f32 = 3.851696;
override b4: f32 = -98.60411;
override b5: f32 = 320.0855;
override b6: f32 = 44.299114;
override b7: f32 = -184.50137;
override b8: f32 = 618.819;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Thirty-two operations: forms of E - 1 and of the share B/E.
fn coupling_compensated_32(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let cube = alpha * roughness;
    let loss = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha)));
    let divisor = cube + mu * (d0 + roughness * (d1 + d2 * cube) + mu * (d3 + d4 * roughness));
    let gain = loss / divisor;
    let falloff = b3 + alpha * (b4 + b5 * roughness) + mu * (b6 + mu * (b7 + b8 * mu));
    let share = 1.0 / (b0 + roughness * (b1 + b2 * roughness) + mu * falloff);
    let through = 1.0 - f0;
    let left = 1.0 - share;
    return through * (left - gain * (1.0 - through * left));
}
