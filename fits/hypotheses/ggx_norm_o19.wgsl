override c0: f32 = 0.00038883774;
override c1: f32 = 0.0671236;
override c2: f32 = 0.0041961325;
override d0: f32 = 3.182287e-5;
override d1: f32 = -0.0007375228;
override d2: f32 = 0.14030704;
override d3: f32 = 0.17231974;
override d4: f32 = 0.001684929;
override d5: f32 = -1.5824567;
override d6: f32 = 4.466276;
override d7: f32 = -2.4480534;
override d8: f32 = 0.8235372;
override d9: f32 = -1.2344052;
override d10: f32 = 0.1319113;

/// Furnace normalisation of the GGX reflection lobe, N with E N = 1.
/// Nineteen operations. A quotient in roughness, alpha and mu.
/// Exactly 1 for a mirror.
fn ggx_norm_o19(roughness: f32, alpha: f32, mu: f32) -> f32 {
    let loss = alpha * (c0 + c1 * mu + alpha * (c2 + mu * alpha));
    let rough = d0 + roughness * (d1 + alpha * (d2 + d3 * roughness));
    let slope = d4 + alpha * (d5 + roughness * (d6 + d7 * roughness)) + mu * (d8 + d9 * roughness + d10 * mu);
    return 1.0 + loss / (rough + mu * slope);
}
