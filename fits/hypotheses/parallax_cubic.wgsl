override k: f32 = 1.1;
override c: f32 = -0.1;
override d: f32 = 0.1;

/// Width of a fetch from a probe: the flow of `parallax_1` with a factor that changes with both widths. At rho = 1 it is alpha, at rho = 0
/// it is 0, and it is never above 1.
fn parallax_cubic(alpha: f32, rho: f32) -> f32 {
    let x = rho * alpha;
    return x / max(1.0 + (alpha - x) * (k + c * (alpha + x) + d * alpha * x), x);
}
