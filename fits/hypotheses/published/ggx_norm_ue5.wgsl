/// Published: Unreal Engine 5, ShadingEnergyConservation.ush, mode 2 (its default is a table): E, here as N = 1/E.
/// Takes roughness (alpha = roughness^2). Meant for the height-correlated Smith form.
fn ggx_norm_ue5(roughness: f32, mu: f32) -> f32 {
    let loss = pow(roughness, mu / roughness) * (roughness * mu + 0.0266916) / (0.466495 + mu);
    return 1.0 / (1.0 - saturate(loss));
}
