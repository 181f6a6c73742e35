override c0: f32 = 1.16;
override c1: f32 = 0.86;
override c2: f32 = 0.22;
override c3: f32 = 0.02;
override c4: f32 = -0.71;
override c5: f32 = 0.157;
override c6: f32 = -0.19;
override c7: f32 = 0.37;

/// The share of diffuse light from inside a rough dielectric coat that leaves it: (1 - E_avg)/ior^2.
/// Thirteen operations: as with eleven, and of another form in roughness, whose square has a parabola in the index.
fn coat_escape_13(roughness: f32, ior: f32) -> f32 {
    let rough = c3 + roughness * (c4 + ior * (c5 + c6 * ior) + c7 * roughness);
    return 1.0 / (1.0 + (ior - 1.0) * (c0 + ior * (c1 + c2 * ior) + roughness * rough));
}
