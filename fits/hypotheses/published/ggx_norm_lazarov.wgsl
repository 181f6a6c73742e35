/// Published: D. Lazarov, "Getting More Physical in Call of Duty: Black Ops II", course notes, 2013: E, here as N = 1/E.
/// Takes gloss, which engines feed with 1 - roughness. Its E does not depend on the view direction.
/// Fitted to a Blinn-Phong lobe, not to GGX.
fn ggx_norm_lazarov(roughness: f32) -> f32 {
    let gloss = 1.0 - roughness;
    return 1.0 / (0.25 * gloss + 0.75);
}
