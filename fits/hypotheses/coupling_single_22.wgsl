override c0: f32 = 0.39232305;
override c1: f32 = 0.10222593;
override c2: f32 = 0.69093716;
override c3: f32 = -2.5471244;
override c4: f32 = -0.29144338;
override k: f32 = 0.32726496;
override b0: f32 = 0.96615636;
override b1: f32 = 6.4579654;
override b2: f32 = -14.276025;
override b3: f32 = 175.9519;
override b4: f32 = 2.7135565;
override b5: f32 = 27.163403;

/// Coupling factor of a white diffuse base under a bare GGX lobe, 1 - (f0 A + B) (Schlick's Fresnel).
/// Twenty-two operations: forms of E = A + B and of the share B/E.
fn coupling_single_22(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c2 + c3 * roughness + c4 * inverse);
    let albedo = 1.0 + alpha * (c0 + mu * (c1 + layer));
    let share = 1.0 / (b0 + mu * (b1 + mu * (b2 + b3 * mu)) + alpha * (b4 + b5 * roughness));
    return 1.0 - albedo * (share + f0 * (1.0 - share));
}
