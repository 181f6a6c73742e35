override k: f32 = 1.0;

/// Width of a fetch from a probe, the lobe seen from the shading point being alpha wide, rho the ratio of the distances to the wall: two cones
/// that hold a fixed share of energy, F = alpha/(1 + k alpha), scaled one into the other. At rho = 1 it is alpha; it is never above 1.
fn parallax_1(alpha: f32, rho: f32) -> f32 {
    let x = rho * alpha;
    return x / max(1.0 + k * (alpha - x), x);
}
