/// Published: Dassault Systemes, Enterprise PBR Shading Model; dspbr-pt, coupled_diffuse, (1 - E(l))(1 - E(v))/(1 - E_avg): here its mean over the lights of
/// a white environment, 1 - f0 cancelled, so that f0 = 1 has a value. Takes alpha; the product alpha_x alpha_y in dspbr-pt is its square. The operations are
/// those of a light.
fn coupling_dassault(alpha: f32, mu: f32, f0: f32) -> f32 {
    let x = 1.0 - mu;
    let x2 = x * x;
    let smooth_part = f0 + (1.0 - f0) * (x2 * x2 * x);
    let y = 1.0 - alpha;
    let y2 = y * y;
    let facing = mix(smooth_part, 0.04762 + 0.95238 * f0, 1.0 - y2 * y2 * y);
    return (1.0 - facing) * 0.95238096 / (1.0 + (0.33263 * alpha + 0.072359) * f0);
}
