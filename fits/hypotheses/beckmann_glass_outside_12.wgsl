override c0: f32 = 0.012793214;
override c1: f32 = 0.3360819;
override d0: f32 = 0.0046580746;
override d1: f32 = 0.9839567;
override d2: f32 = 9.484623;
override d3: f32 = -2.2492797;
override d4: f32 = -0.9432366;

/// Energy compensation of Beckmann's glass, for a view from outside: N = 1/(R + T).
/// Twelve operations: a quotient.
fn beckmann_glass_outside_12(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let dividend = roughness * (c0 + c1 * mu);
    let divisor = d0 + mu * (d1 + d2 * mu) + alpha * (ior + d3 * mu + d4 * roughness);
    return 1.0 + dividend / divisor;
}
