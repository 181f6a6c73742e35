/// Published: C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, at the
/// macroscopic normal, f0 from the index of refraction.
fn ggx_dielectric_schlick(mu: f32, ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    let f0 = root * root;
    let x = 1.0 - mu;
    let x2 = x * x;
    return f0 + (1.0 - f0) * (x2 * x2 * x);
}
