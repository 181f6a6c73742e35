override c0: f32 = 0.6191421;
override c1: f32 = 4.5426893;
override c2: f32 = -7.1187677;
override c3: f32 = -4.2436504;
override c4: f32 = -5.820675;
override c5: f32 = 27.075378;
override c6: f32 = 31.202215;
override c7: f32 = -144.37737;
override c8: f32 = 136.30695;
override k: f32 = 1.7616074;

/// Furnace normalisation of the Beckmann reflection lobe, N with E N = 1.
/// Sixteen operations. One reciprocal and a nested sum; mu and alpha times the reciprocal depend on mu/alpha alone.
/// Exactly 1 for a mirror.
fn beckmann_norm_16(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let ratio = alpha * inverse;
    let facing = mu * ratio;
    return 1.0 + facing * (c0 + facing * (c1 + inverse * (c2 + inverse * (c3 + ratio * c5)) + mu * (c4 + facing
        * (c6 + facing * (c7 + alpha * c8)))));
}
