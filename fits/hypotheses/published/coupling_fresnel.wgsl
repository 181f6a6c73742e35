/// Published: 1 - F(mu) with Schlick's Fresnel at the macroscopic normal. The mean over the lights of a white environment of the reciprocal product
/// 21/20 (1 - F_l)(1 - F_v)/(1 - f0) is the same, since the mean of 1 - F_l is 20/21 (1 - f0).
fn coupling_fresnel(mu: f32, f0: f32) -> f32 {
    let x = 1.0 - mu;
    let x2 = x * x;
    return (1.0 - f0) * (1.0 - x2 * x2 * x);
}
