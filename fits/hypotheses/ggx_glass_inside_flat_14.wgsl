override c0: f32 = 0.8229805;
override c1: f32 = -0.056169912;
override c2: f32 = -0.9746817;
override c3: f32 = 0.33318;
override c4: f32 = 1.9755545;
override c5: f32 = 3.4752328;
override c6: f32 = -5.009598;
override c7: f32 = -6.70922;
override c8: f32 = 7.9059563;
override k: f32 = 0.5233982;

/// Energy compensation of glass of one index of refraction, for a view from inside: N = 1/(R + T).
/// Fourteen operations: a nested sum with a reciprocal.
fn ggx_glass_inside_flat_14(alpha: f32, mu: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    return 1.0 + alpha * (c0 + inverse * (c1 + mu * (c2 + inverse * c3 + alpha * (c4 + mu * (c5 + mu * c6
        + alpha * (c7 + mu * c8))))));
}
