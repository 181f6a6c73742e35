/// Published: MaterialX 1.39, open_pbr_surface: 1 - K with K = 1 - (1 - F0)/ior^2 and F0 = ((ior - 1)/(ior + 1))^2,
/// whatever the roughness.
fn coat_escape_materialx(ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    return (1.0 - root * root) / (ior * ior);
}
