override c0: f32 = -0.08653202;
override c1: f32 = 0.25067523;
override c2: f32 = -0.30765322;
override c3: f32 = 3.36852;
override c4: f32 = -8.594605;
override c5: f32 = 135.34938;
override c6: f32 = -270.89743;
override c7: f32 = 255.53102;
override c8: f32 = -110.34078;
override c9: f32 = 25.615253;
override c10: f32 = 1.4945158;
override c11: f32 = -18.819164;
override c12: f32 = -7.184847;
override c13: f32 = -20.077341;
override k0: f32 = 0.71874017;

/// Energy compensation of Beckmann's glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Nineteen operations: a nested sum with a reciprocal.
fn beckmann_glass_inside_flat_19(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k0 * alpha);
    return 1.0 + alpha * (c0 + alpha * (c1 + mu * (c2 + roughness * (c3 + mu * (c4 + roughness * (c5
        + inverse * (c6 + inverse * (c7 + inverse * (c8 + inverse * (c9 + inverse * (c10 + roughness
        * c12))))) + mu * c11 + alpha * c13))))));
}
