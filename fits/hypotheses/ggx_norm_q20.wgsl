override c0: f32 = 0.122342;
override c1: f32 = 0.397918;
override c2: f32 = 1.41727;
override c3: f32 = 9.14208;
override c4: f32 = 13.9159;
override c5: f32 = -11.2763;
override d0: f32 = -0.600799;
override d1: f32 = 5.7868;
override d2: f32 = -1.10966;
override d3: f32 = 1.0204;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Twenty operations. Rational in alpha and mu. The divisor is homogeneous of degree 2 where both are small, so the layer
/// mu ~ alpha is resolved at every roughness. Exactly 1 at alpha = 0 and at mu = 0.
fn ggx_norm_q20(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let grazing = c0 + alpha * (c1 + c2 * alpha);
    let facing = mu * a2 * (c3 + mu * (c4 * alpha + c5));
    let divisor = a2 * (1.0 + d0 * alpha) + mu * (alpha * (d1 * alpha + d2) + d3 * mu);
    return 1.0 + alpha * mu * (grazing + facing) / divisor;
}
