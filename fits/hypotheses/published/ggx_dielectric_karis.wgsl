/// Published: B. Karis, "Physically Based Shading on Mobile", 2014: f0 A + B of the split sum, f0 from
/// the index of refraction. Takes roughness (alpha = roughness^2). Fitted to UE4's lobe with Schlick's
/// Fresnel term.
fn ggx_dielectric_karis(roughness: f32, mu: f32, ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    let f0 = root * root;
    let x = 1.0 - roughness;
    let y = 0.0425 - 0.0275 * roughness;
    let z = 1.04 - 0.572 * roughness;
    let w = 0.022 * roughness - 0.04;
    let t = min(x * x, exp2(-9.28 * mu)) * x + y;
    return f0 * (z - 1.04 * t) + (1.04 * t + w);
}
