override c0: f32 = 2.5472;
override c1: f32 = -0.4393;
override c2: f32 = -2.5643;
override c3: f32 = 0.2217;
override c4: f32 = -0.0129;
override c5: f32 = -0.1467;

/// Roughness of the lobe that is as wide as a base's seen through a rough coat: weights of base and coat
/// that fall with the cosine and with their own widths.
fn coated_width_21(roughness: f32, mu: f32, coat_roughness: f32, ior: f32) -> f32 {
    let base = roughness * roughness;
    let coat = coat_roughness * coat_roughness;
    let more = base * base * (c0 + c1 * mu + c2 * base) + coat * (c3 + c4 * mu + c5 * coat);
    return sqrt(sqrt(clamp(base * base + (ior - 1.0) * more, 1e-9, 1.0)));
}
