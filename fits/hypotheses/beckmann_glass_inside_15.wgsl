override d0: f32 = -6.8632216;
override d1: f32 = 8.962558;
override d2: f32 = -2.4208229;
override d3: f32 = 22.240488;
override d4: f32 = 14.2861185;
override d5: f32 = -45.44386;
override d6: f32 = 10.74671;
override d7: f32 = 48.47394;
override d8: f32 = -33.205162;
override d9: f32 = -9.018442;

/// Energy compensation of Beckmann's glass, for a view from inside: N = 1/(R + T). Below an index of 1.1
/// that of 1.1, for the divisor vanishes there.
/// Fifteen operations: a quotient.
fn beckmann_glass_inside_15(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let index = max(ior, 1.1);
    let divisor = d0 + index * (d1 + d2 * roughness) + mu * (d3 + d4 * alpha + index * (d5 + d6
        * index) + mu * (d7 + d8 * roughness + d9 * mu));
    return 1.0 + alpha / divisor;
}
