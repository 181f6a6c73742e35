/// Published: B. Karis, Real Shading in Unreal Engine 4, 2013. The factor on the lobe at the nearest point of a sphere
/// light is (alpha/alpha')^2, alpha' = alpha + radius/(3 distance), at most 1.
fn lit_energy_karis(roughness: f32, light_radius: f32) -> f32 {
    let alpha = roughness * roughness;
    let ratio = alpha / min(alpha + light_radius / 3.0, 1.0);
    return ratio * ratio;
}
