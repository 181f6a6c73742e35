/// Published: B. Karis, "Physically Based Shading on Mobile", 2014, after D. Lazarov: A and B of the split sum.
/// Takes roughness (alpha = roughness^2). Unclamped, B reaches -0.0024.
/// Fitted to UE4's lobe with a Schlick-Smith visibility, not to height-correlated Smith.
fn ggx_blend_karis(roughness: f32, mu: f32, f0: f32) -> f32 {
    let x = 1.0 - roughness;
    let y = 0.0425 - 0.0275 * roughness;
    let z = 1.04 - 0.572 * roughness;
    let w = 0.022 * roughness - 0.04;
    let t = min(x * x, exp2(-9.28 * mu)) * x + y;
    return f0 * (z - 1.04 * t) + (1.04 * t + w);
}
