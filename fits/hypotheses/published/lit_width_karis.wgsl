/// Published: B. Karis, Real Shading in Unreal Engine 4, 2013. alpha' = alpha + radius/(3 distance), at most 1,
/// with the angular radius for the ratio.
fn lit_width_karis(roughness: f32, light_radius: f32) -> f32 {
    return sqrt(min(roughness * roughness + light_radius / 3.0, 1.0));
}
