/// Width of a fetch from a probe: the footprint ratio times alpha, at most 1.
fn parallax_scaled(alpha: f32, rho: f32) -> f32 {
    return min(1.0, rho * alpha);
}
