override d0: f32 = 2.616812;
override d1: f32 = 23.327595;
override d2: f32 = -13.873275;
override d3: f32 = -20.390924;
override d4: f32 = 3.7220836;
override d5: f32 = 4.297813;
override d6: f32 = 14.029914;
override d7: f32 = -7.1604905;

/// Energy compensation of Beckmann's glass, for a view from inside: N = 1/(R + T). Below an index of 1.1
/// that of 1.1, for the divisor vanishes there.
/// Thirteen operations: a quotient.
fn beckmann_glass_inside_13(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let index = max(ior, 1.1);
    let divisor = d0 + d1 * mu + index * (d2 + mu * (d3 + d4 * mu) + d5 * alpha + index * (d6 + d7
        * roughness));
    return 1.0 + alpha / divisor;
}
