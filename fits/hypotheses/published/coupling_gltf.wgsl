/// Published: Khronos, glTF 2.0, appendix B, 1 - F(v.h) light by light: here its mean over the lights of a white environment. The mean of (1 - v.h)^5 is the
/// polynomial in mu within 6e-6, interpolated from the integral. The operations are those of a light.
fn coupling_gltf(mu: f32, f0: f32) -> f32 {
    let reflected = 0.028161314 + mu * (-0.0798019 + mu * (0.086255702 + mu * (-0.043384379 + 0.0088512832 * mu)));
    return (1.0 - f0) * (1.0 - reflected);
}
