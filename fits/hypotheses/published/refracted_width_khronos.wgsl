/// Published: Khronos glTF Sample Renderer, applyIorToRoughness, as in Bevy and three.js. Takes roughness (alpha =
/// roughness^2): the whole of it from an index of 1.5 on, none at 1.
fn refracted_width_khronos(roughness: f32, ior: f32) -> f32 {
    return roughness * clamp(2.0 * ior - 2.0, 0.0, 1.0);
}
