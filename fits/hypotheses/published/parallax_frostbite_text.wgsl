/// Width of a fetch from a probe: Lagarde and de Rousiers 2014, section 4.9, as its text derives it, scaling alpha with the clamp and the blend
/// of listing 25.
fn parallax_frostbite_text(alpha: f32, roughness: f32, rho: f32) -> f32 {
    return mix(clamp(rho * alpha, 0.0, alpha), alpha, roughness);
}
