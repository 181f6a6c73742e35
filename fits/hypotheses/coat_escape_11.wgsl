override c0: f32 = 0.963;
override c1: f32 = 1.093;
override c2: f32 = 0.16;
override c3: f32 = -0.368;
override c4: f32 = -0.46;
override c5: f32 = 0.69;

/// The share of diffuse light from inside a rough dielectric coat that leaves it: (1 - E_avg)/ior^2.
/// Eleven operations: its reciprocal is 1 without an interface, and a polynomial beyond. The term in alpha is that of rough
/// facets, which reflect less of light that grazes.
fn coat_escape_11(roughness: f32, alpha: f32, ior: f32) -> f32 {
    let rough = c3 + c4 * ior + c5 * roughness;
    return 1.0 / (1.0 + (ior - 1.0) * (c0 + ior * (c1 + c2 * ior) + alpha * rough));
}
