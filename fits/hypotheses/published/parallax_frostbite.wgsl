/// Width of a fetch from a probe: Lagarde and de Rousiers, Moving Frostbite to Physically Based Rendering, 2014, listing 25, which scales
/// the root of alpha.
fn parallax_frostbite(roughness: f32, rho: f32) -> f32 {
    let scaled = mix(clamp(rho * roughness, 0.0, roughness), roughness, roughness);
    return scaled * scaled;
}
