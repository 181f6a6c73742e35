/// Directional albedo E of the single-scattering lobe of EON, by its polynomial of degree 4 in 1 - mu.
/// Portsmouth, Kutz and Hill, "EON: A practical energy-preserving rough diffuse BRDF", 2024.
fn eon_e_portsmouth(roughness: f32, mu: f32) -> f32 {
    let m = 1.0 - mu;
    let g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
    return (1.0 + roughness * g) / (1.0 + 0.287793409 * roughness);
}
