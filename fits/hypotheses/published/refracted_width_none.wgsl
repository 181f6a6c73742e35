/// Published: no rule, in renderers that fetch what is refracted with the roughness of the surface.
/// Right for no index: at an index of 1 nothing is blurred.
fn refracted_width_none(roughness: f32) -> f32 {
    return roughness;
}
