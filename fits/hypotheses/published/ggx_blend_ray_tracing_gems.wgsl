/// Published: Ray Tracing Gems, chapter 32, eq. 4 (also DLSS-RR, MathLib EnvironmentTerm_Rtg): A and B.
/// Takes alpha. Fitted to separable Smith.
fn ggx_blend_ray_tracing_gems(alpha: f32, mu: f32, f0: f32) -> f32 {
    let x = mu;
    let x2 = x * x;
    let x3 = x2 * x;
    let y = alpha;
    let y3 = y * y * y;
    let bias_top = 0.99044 - 1.28514 * x + (1.29678 - 0.755907 * x) * y;
    let bias_bottom = 1.0 + 2.92338 * x + 59.4188 * x3 + (20.3225 - 27.0302 * x + 222.592 * x3) * y
        + (121.563 + 626.13 * x + 316.627 * x3) * y3;
    let scale_top = 0.0365463 + 3.32707 * x + (9.0632 - 9.04756 * x) * y;
    let scale_bottom = 1.0 + 3.59685 * x2 - 1.36772 * x3 + (9.04401 - 16.3174 * x2 + 9.22949 * x3) * y
        + (5.56589 + 19.7886 * x2 - 20.2123 * x3) * y3;
    return f0 * (scale_top / scale_bottom) + bias_top / bias_bottom;
}
