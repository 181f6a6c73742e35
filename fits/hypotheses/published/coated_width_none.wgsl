/// Published: no rule, in renderers that light the base with its own roughness.
fn coated_width_none(roughness: f32) -> f32 {
    return roughness;
}
