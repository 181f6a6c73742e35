override c0: f32 = -0.005311869;
override c1: f32 = -0.28650126;
override c2: f32 = 0.23633656;
override c3: f32 = -3.8254185;
override c4: f32 = 1.6755178;
override d0: f32 = -0.000112443675;
override d1: f32 = 0.10060695;
override d2: f32 = -1.4764731;
override d3: f32 = 5.8777313;
override d4: f32 = 0.65263456;
override d5: f32 = 7.6195855;
override d6: f32 = -11.154219;
override a0: f32 = 0.22721463;
override b0: f32 = 0.23083429;
override b1: f32 = 2.8124094;
override b2: f32 = 1.6348797;
override b3: f32 = -1.7811056;
override b4: f32 = 48.995792;
override b5: f32 = 20.804846;
override b6: f32 = 215.63718;
override b7: f32 = -302.91315;

/// Coupling factor of a white diffuse base under a bare GGX lobe, 1 - (f0 A + B) (Schlick's Fresnel).
/// Thirty-four operations: forms of E = A + B and of the share B/E.
fn coupling_single_34(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let loss = alpha * (c0 + c1 * alpha + mu * (c2 + alpha * (c3 + c4 * roughness)));
    let slope = d1 + roughness * (d2 + d3 * alpha) + mu * (d4 + roughness * (d5 + d6 * roughness));
    let albedo = 1.0 + loss / (d0 + alpha * roughness + mu * slope);
    let rest = 1.0 - mu;
    let falloff = b2 + roughness * (b3 + b4 * alpha) + mu * (b5 + mu * (b6 + b7 * rest));
    let share = (a0 + mu * rest) / (b0 + b1 * alpha + mu * falloff);
    return 1.0 - albedo * (share + f0 * (1.0 - share));
}
