/// Published: no rule, in renderers that light a base below a coat with its own roughness.
/// Right for a coat of index 1.
fn coated_width_none(roughness: f32) -> f32 {
    return roughness;
}
