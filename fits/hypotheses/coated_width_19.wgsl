override c0: f32 = 1.4421;
override c1: f32 = 0.188;

/// Roughness of the lobe that is as wide as a base's seen through a rough coat: base and coat add by the
/// fourth power, each with a weight linear in the coat's index.
fn coated_width_19(roughness: f32, coat_roughness: f32, ior: f32) -> f32 {
    let base = roughness * roughness;
    let coat = coat_roughness * coat_roughness;
    return sqrt(sqrt(clamp(base * base + (ior - 1.0) * (c0 * base * base + c1 * coat * coat), 1e-9, 1.0)));
}
