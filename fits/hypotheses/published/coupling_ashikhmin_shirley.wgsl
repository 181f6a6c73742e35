/// Published: Ashikhmin and Shirley, An Anisotropic Phong BRDF Model, 2000, 28/23 (1 - f0)(1 - (1 - l/2)^5)(1 - (1 - v/2)^5) with the cosines of light and
/// view: here its mean over the lights of a white environment, in which 28/23 cancels. The operations are those of a light.
fn coupling_ashikhmin_shirley(mu: f32, f0: f32) -> f32 {
    let x = 1.0 - 0.5 * mu;
    let x2 = x * x;
    return (1.0 - f0) * (1.0 - x2 * x2 * x);
}
