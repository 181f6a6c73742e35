/// Published: no rule, in renderers that light with a point.
fn lit_width_none(roughness: f32) -> f32 {
    return roughness;
}
