override c0: f32 = 3.47;
override c1: f32 = -3.93;
override c2: f32 = 1.6;
override c3: f32 = -0.225;
override c4: f32 = 0.028;

/// The share of diffuse light from inside a rough dielectric coat that leaves it: (1 - E_avg)/ior^2.
/// Four operations: a cubic in the index, and a term in roughness.
fn coat_escape_4(roughness: f32, ior: f32) -> f32 {
    return c0 + ior * (c1 + ior * (c2 + c3 * ior)) + c4 * roughness;
}
