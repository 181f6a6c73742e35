/// Published: Dassault Enterprise PBR shading model, specification: E_avg.
/// Takes alpha.
fn ggx_eavg_dassault(alpha: f32) -> f32 {
    return 1.0 + alpha * (-0.113 + alpha * (-1.8695 + alpha * (2.2268 - 0.83397 * alpha)));
}
