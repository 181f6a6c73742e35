override c0: f32 = 0.532812;
override c1: f32 = 0.23475416;
override c2: f32 = -0.30152956;
override a0: f32 = -0.019362243;
override b0: f32 = 0.020279154;
override b1: f32 = 0.29112887;

/// Coupling factor of a white diffuse base under a GGX lobe that is multiplied by 1 + f0 (1/E - 1): what that leaves (Schlick's Fresnel).
/// Fourteen operations: -B/E is a quotient, and the loss 1 - E a polynomial.
fn coupling_compensated_14(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {
    let loss = roughness * (c0 + c1 * mu + c2 * roughness);
    let mu2 = mu * mu;
    let whole = b0 + mu2 + b1 * alpha;
    let diffuse = 1.0 + a0 / whole;
    let through = 1.0 - f0;
    return through * (diffuse + loss * (1.0 - diffuse * through));
}
