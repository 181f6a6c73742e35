override c0: f32 = -3.2700555e-5;
override c1: f32 = 0.0072188643;
override c2: f32 = 0.02309404;
override d0: f32 = -2.4421719e-5;
override d1: f32 = 0.0069267577;
override d2: f32 = 0.046083335;
override d3: f32 = 0.050863132;
override d4: f32 = 0.50174755;
override d5: f32 = -0.37279767;
override d6: f32 = -0.0005350415;
override d7: f32 = 0.03322505;
override d8: f32 = 0.13309897;
override d9: f32 = 0.32622096;
override d10: f32 = -0.20148043;

/// Directional albedo R of a rough dielectric interface of one index of refraction, with its exact Fresnel term.
/// Eighteen operations: a quotient.
fn ggx_dielectric_flat_18(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let dividend = c0 + c1 * mu + c2 * alpha;
    let divisor = d0 + mu * (d1 + mu * (d2 + mu * (d3 + mu * (d4 + d5 * mu)))) + roughness * (d6 + roughness
        * (d7 + roughness * (mu + roughness * (d8 + roughness * (d9 + d10 * alpha)))));
    return dividend / divisor;
}
