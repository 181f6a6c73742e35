/// Published: Unreal Engine 5, ShadingEnergyConservation.ush, mode 2 (its default is a table): E and B.
/// Takes roughness (alpha = roughness^2). Meant for the height-correlated Smith form.
fn ggx_blend_ue5(roughness: f32, mu: f32, f0: f32) -> f32 {
    let loss = pow(roughness, mu / roughness) * (roughness * mu + 0.0266916) / (0.466495 + mu);
    let x = 1.0 - mu;
    let x2 = x * x;
    let bias = x2 * x2 * x * pow(2.36651 * pow(mu, 4.7703 * roughness) + 0.0387332, roughness);
    return mix(bias, 1.0 - saturate(loss), f0);
}
