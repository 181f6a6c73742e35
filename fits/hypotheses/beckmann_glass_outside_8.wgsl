override c0: f32 = 0.23410377;
override c1: f32 = -0.15402101;
override c2: f32 = -0.20745721;
override c3: f32 = 0.26281148;
override c4: f32 = 1.1267183;
override c5: f32 = 0.30220914;
override c6: f32 = -4.060977;
override c7: f32 = 2.5498693;

/// Energy compensation of Beckmann's glass, for a view from outside: N = 1/(R + T).
/// Eight operations: a polynomial.
fn beckmann_glass_outside_8(roughness: f32, mu: f32, ior: f32) -> f32 {
    return 1.0 + roughness * (c0 + roughness * (c1 + c2 * ior + roughness * (c3 + mu * (c4 + c5
        * ior + mu * (c6 + c7 * mu)))));
}
