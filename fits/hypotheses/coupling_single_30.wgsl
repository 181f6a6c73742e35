override c0: f32 = -0.015933407;
override c1: f32 = 0.0036230744;
override c2: f32 = 1.454723;
override c3: f32 = -6.917962;
override d0: f32 = 0.104395516;
override d1: f32 = -1.2538874;
override d2: f32 = 13.803818;
override d3: f32 = 3.334954;
override d4: f32 = -7.186635;
override b0: f32 = 1.0324944;
override b1: f32 = -1.3634131;
override b2: f32 = 18.42096;
override b3: f32 = 3.7517862;
override b4: f32 = -91.45851;
override b5: f32 = 322.82117;
override b6: f32 = 46.060608;
override b7: f32 = -196.05295;
override b8: f32 = 639.98645;

/// Coupling factor of a white diffuse base under a bare GGX lobe, 1 - (f0 A + B) (Schlick's Fresnel).
/// Thirty operations: forms of E = A + B and of the share B/E.
fn coupling_single_30(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let cube = alpha * roughness;
    let loss = alpha * (c0 + mu * (c1 + alpha * (c2 + c3 * alpha)));
    let divisor = cube + mu * (d0 + roughness * (d1 + d2 * cube) + mu * (d3 + d4 * roughness));
    let albedo = 1.0 + loss / divisor;
    let falloff = b3 + alpha * (b4 + b5 * roughness) + mu * (b6 + mu * (b7 + b8 * mu));
    let share = 1.0 / (b0 + roughness * (b1 + b2 * roughness) + mu * falloff);
    return 1.0 - albedo * (share + f0 * (1.0 - share));
}
