/// Published: vga-group/tauray, shader/ltc.glsl: E and B.
/// Takes alpha (named roughness there) and its square root, here roughness. Meant for the height-correlated Smith form.
fn ggx_blend_tauray(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let h = mu * roughness;
    let c2 = roughness * (roughness * (30.106651 * roughness - 72.778887) + 57.887217) - 11.910812;
    let c1 = roughness * (roughness * (-34.517973 * roughness + 86.062015) - 69.862862) + 16.205007;
    let c0 = roughness * (roughness * (7.556232 * roughness - 19.236401) + 16.191891) - 4.561471;
    let n = (0.356334 * (h * h * h) - 2.189899) * h + c2;
    let albedo = saturate(1.0 + ((n * mu + c1) * mu + c0) * alpha);
    let top = 1.0 - 0.398996 * roughness + mu * (-1.79907 + mu * (0.79907 + 0.398996 * roughness));
    let bottom = 1.0 + 16.436949 * alpha + mu * (25.826333 * mu - 15.469869 * roughness);
    return mix(saturate(top / bottom), albedo, f0);
}
