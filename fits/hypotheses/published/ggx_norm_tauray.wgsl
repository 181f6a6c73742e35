/// Published: vga-group/tauray, shader/ltc.glsl: E, here as N = 1/E. Takes alpha, named roughness there. Meant for the height-correlated Smith form.
fn ggx_norm_tauray(alpha: f32, mu: f32) -> f32 {
    let h = mu * alpha;
    let n3 = 0.356334 * (h * h * h) - 2.189899;
    let n2 = n3 * h + alpha * (alpha * (30.106651 * alpha - 72.778887) + 57.887217) - 11.910812;
    let n1 = n2 * mu + alpha * (alpha * (-34.517973 * alpha + 86.062015) - 69.862862) + 16.205007;
    let n0 = n1 * mu + alpha * (alpha * (7.556232 * alpha - 19.236401) + 16.191891) - 4.561471;
    return 1.0 / saturate(1.0 + n0 * (alpha * alpha));
}
