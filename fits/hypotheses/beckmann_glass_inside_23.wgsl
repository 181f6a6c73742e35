override c0: f32 = 0.022083117;
override c1: f32 = -0.15817907;
override c2: f32 = -0.0051881177;
override c3: f32 = 0.141837;
override d0: f32 = 0.1722072;
override d1: f32 = 0.58168715;
override d2: f32 = -0.6918523;
override d3: f32 = 0.09339812;
override d4: f32 = -2.6698933;
override d5: f32 = 0.64351195;
override d6: f32 = -0.8008026;
override d7: f32 = 2.7168348;
override d8: f32 = -1.0676618;
override d9: f32 = 0.26639736;

/// Energy compensation of Beckmann's glass, for a view from inside: N = 1/(R + T). Below an index of 1.1
/// that of 1.1, for the divisor vanishes there.
/// Twenty-three operations: a quotient.
fn beckmann_glass_inside_23(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let index = max(ior, 1.1);
    let mu2 = mu * mu;
    let dividend = roughness * (c0 + c1 * mu2 + roughness * (c2 + c3 * (mu * index)));
    let t2 = index * alpha;
    let divisor = d0 + d1 * index + mu * (mu + index * (d2 + d3 * index)) + roughness * (d4 + mu
        * (d5 + d6 * mu2) + roughness * (d7 + t2 * (d8 + d9 * t2)));
    return 1.0 + dividend / divisor;
}
