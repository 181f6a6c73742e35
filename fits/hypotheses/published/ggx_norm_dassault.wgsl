/// Published: Dassault Enterprise PBR shading model, specification; dspbr-pt: E, here as N = 1/E.
/// Takes alpha; the specification's alpha_u alpha_v is its square for an isotropic lobe and measures worse. Meant for the height-correlated Smith form.
fn ggx_norm_dassault(alpha: f32, mu: f32) -> f32 {
    let rough = -0.20277 + alpha * (2.772 + alpha * (-2.6175 + 0.73343 * alpha));
    let view = 3.09507 + mu * (-9.11369 + mu * (15.8884 + mu * (-13.70343 + 4.51786 * mu)));
    return 1.0 / (1.0 - 1.4594 * alpha * mu * rough * view);
}
