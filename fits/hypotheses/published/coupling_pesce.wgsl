/// Published: A. Pesce, "Misunderstanding Multiscattering", 2019, mix(1 - F(mu), 1 - f0, roughness). Takes roughness.
fn coupling_pesce(roughness: f32, mu: f32, f0: f32) -> f32 {
    let x = 1.0 - mu;
    let x2 = x * x;
    return (1.0 - f0) * (1.0 - (1.0 - roughness) * (x2 * x2 * x));
}
