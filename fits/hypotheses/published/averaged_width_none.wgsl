/// Published: no rule, in renderers that normalise the mean of normals and keep the roughness.
/// Right where all normals of a texel are one.
fn averaged_width_none(roughness: f32) -> f32 {
    return roughness;
}
