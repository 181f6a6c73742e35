/// Published: A. Fresnel, of unpolarised light on a smooth dielectric, at the macroscopic normal: what
/// a renderer takes that leaves roughness out. g^2 = mu^2 + ior^2 - 1.
fn ggx_dielectric_fresnel(mu: f32, ior: f32) -> f32 {
    let g = sqrt(mu * mu + (ior * ior - 1.0));
    let sum = g + mu;
    let difference = g - mu;
    let ratio = difference / sum;
    let other = (mu * sum - 1.0) / (mu * difference + 1.0);
    return 0.5 * ratio * ratio * (1.0 + other * other);
}
