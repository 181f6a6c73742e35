/// Published: D. Lazarov, "Getting More Physical in Call of Duty: Black Ops II", course notes, 2013: B and E.
/// Takes gloss, which engines feed with 1 - roughness. Fitted to a Blinn-Phong lobe, not to GGX.
fn ggx_blend_lazarov(roughness: f32, mu: f32, f0: f32) -> f32 {
    let gloss = 1.0 - roughness;
    let bias = gloss / 0.96 * min(0.475 * gloss, exp2(-9.28 * mu)) + (0.0175 * gloss - 0.015) / 0.96;
    let albedo = 0.25 * gloss + 0.75;
    return mix(bias, albedo, f0);
}
