/// Published: three.js, IBLSheenBRDF, since the end of 2025 (PR 32397): E of the sheen, clamped to 1.
/// Takes roughness (alpha = roughness^2).
fn charlie_e_threejs(roughness: f32, mu: f32) -> f32 {
    let r2 = roughness * roughness;
    let q = 1.0 / (roughness + 0.1);
    let a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * q;
    let b = -0.6014 + 0.5538 * roughness - 0.467 * r2 - 0.1255 * q;
    return saturate(exp(a * mu + b));
}
