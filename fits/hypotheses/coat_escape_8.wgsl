override c0: f32 = -0.147;
override c1: f32 = 1.136;
override c2: f32 = 0.0112;
override c3: f32 = 0.0151;

/// The share of diffuse light from inside a rough dielectric coat that leaves it: (1 - E_avg)/ior^2.
/// Eight operations: a polynomial in the reciprocal of the index, and another in roughness.
fn coat_escape_8(roughness: f32, ior: f32) -> f32 {
    let s = 1.0 / ior;
    return s * (c0 + c1 * s) + roughness * (c2 + c3 * roughness);
}
