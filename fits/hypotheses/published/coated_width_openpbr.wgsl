/// Published: OpenPBR 1.1, reference/open_pbr_surface.mtlx, for coat_weight 1: min(1, base^4 + 2 coat^4)^(1/4),
/// for any index and view.
fn coated_width_openpbr(roughness: f32, coat_roughness: f32) -> f32 {
    let base = roughness * roughness;
    let coat = coat_roughness * coat_roughness;
    return sqrt(sqrt(min(base * base + 2.0 * coat * coat, 1.0)));
}
