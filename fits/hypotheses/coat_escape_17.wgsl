override c0: f32 = 1.16;
override c1: f32 = 0.86;
override c2: f32 = 0.22;
override c3: f32 = 0.02;
override c4: f32 = -0.71;
override c5: f32 = 0.157;
override c6: f32 = -0.19;
override c7: f32 = 0.3;
override c8: f32 = 0.1;
override c9: f32 = 0.02;
override c10: f32 = 0.05;
override c11: f32 = 0.02;

/// The share of diffuse light from inside a rough dielectric coat that leaves it: (1 - E_avg)/ior^2.
/// Seventeen operations: as with thirteen, with a cubic and a quartic in roughness that depend on the index.
fn coat_escape_17(roughness: f32, ior: f32) -> f32 {
    let cubic = c7 + ior * (c8 + c9 * ior) + roughness * (c10 + c11 * ior);
    let square = c4 + ior * (c5 + c6 * ior) + roughness * cubic;
    return 1.0 / (1.0 + (ior - 1.0) * (c0 + ior * (c1 + c2 * ior) + roughness * (c3 + roughness * square)));
}
