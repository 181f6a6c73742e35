/// Published: Kulla and Conty 2017: 1 - K = (1 - F_avg)/ior^2 of a smooth interface, with their F_avg of ior >= 1,
/// whatever the roughness.
fn coat_escape_kulla(ior: f32) -> f32 {
    return (1.0 - (ior - 1.0) / (4.08567 + 1.00071 * ior)) / (ior * ior);
}
