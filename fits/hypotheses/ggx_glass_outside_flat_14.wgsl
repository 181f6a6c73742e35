override c0: f32 = 0.055309597;
override c1: f32 = 0.027687853;
override c2: f32 = -4.101412;
override c3: f32 = 3.307038;
override c4: f32 = 1.8823887;
override c5: f32 = -1.8094639;
override c6: f32 = 2.8560672;
override c7: f32 = -2.7198532;
override k: f32 = 0.590365;

/// Energy compensation of glass of one index of refraction, for a view from outside: N = 1/(R + T).
/// Fourteen operations: a nested sum with a reciprocal.
fn ggx_glass_outside_flat_14(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = mu * inverse;
    return 1.0 + alpha * (c0 + ratio * (c1 + ratio * (c2 + ratio * (c3 + inverse * (c4 + ratio * c5)) + alpha
        * c7) + roughness * c6));
}
