/// Published: no rule, in renderers that light with the point at the middle of the light.
/// Right for a radius of 0.
fn lit_width_none(roughness: f32) -> f32 {
    return roughness;
}
