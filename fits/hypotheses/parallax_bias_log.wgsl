override c: f32 = 0.6;
override k: f32 = 1.0;

/// Levels to add to that of a lobe alpha wide, in a chain whose level is 1.2 log2 of roughness plus a constant: the logarithm of the
/// adjusted width over alpha. At rho = 1 it is 0. The sum is to be clamped to the levels that there are.
fn parallax_bias_log(alpha: f32, rho: f32) -> f32 {
    let x = rho * alpha;
    return c * log2(max(rho, 0.000001) / max(1.0 + k * (alpha - x), x));
}
