override c0: f32 = -0.053625036;
override c1: f32 = 0.22299115;
override c2: f32 = 0.56464154;
override c3: f32 = -2.063955;
override c4: f32 = -0.34289363;
override k: f32 = 0.90229094;
override b0: f32 = 1.037233;
override b1: f32 = 3.609843;
override b2: f32 = 13.0514965;
override b3: f32 = 92.86271;
override b4: f32 = 6.7139354;
override b5: f32 = 25.39046;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Twenty-five operations: forms of E - 1 and of the share B/E.
fn coupling_compensated_25(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + c3 * roughness + c4 * inverse);
    let gain = alpha * (c0 + mu * (c1 + layer));
    let share = 1.0 / (b0 + mu * (b1 + mu * (b2 + b3 * mu)) + alpha * (b4 + b5 * roughness));
    let left = (1.0 - f0) * (1.0 - share);
    return left - (1.0 - f0) * gain * (1.0 - left);
}
