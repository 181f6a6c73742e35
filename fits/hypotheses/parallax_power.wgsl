override k: f32 = 1.0;
override p: f32 = 1.13;
override q: f32 = 1.13;

/// Width of a fetch from a probe: two cones that hold a fixed share of energy, of tangent alpha/(1 + k alpha^p), scaled one into the
/// other, the power of the scaled width left free. At rho = 0 it is 0, and it is never above 1; at rho = 1 it is alpha within the
/// certificate, and exactly where p = q.
fn parallax_power(alpha: f32, rho: f32) -> f32 {
    let x = rho * alpha;
    return x / max(1.0 + k * (pow(alpha, p) - pow(x, q)), x);
}
