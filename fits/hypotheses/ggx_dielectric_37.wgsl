override p0: f32 = 1.0128;
override p1: f32 = -0.8098;
override k: f32 = 0.5181;
override c0: f32 = 0.102;
override c1: f32 = -2.5317;
override c2: f32 = 4.2221;
override c3: f32 = 1.0618;
override c4: f32 = 0.5028;

/// Albedo of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Thirty-seven operations. Over the lobe the Fresnel term stands at one effective cosine c, which does not depend on ior: above mu by
/// alpha^2 (p0 + p1 roughness) over the width of the layer at grazing, mu + k alpha. The form of ggx_norm_i10 divides by what the lobe
/// loses. With alpha = 0 it is Fresnel's term.
fn ggx_dielectric_37(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c3 + c4 * inverse);
    let norm = 1.0 + alpha * (c0 + mu * (c1 + c2 * alpha + layer));
    let c = mu + alpha * inverse * alpha * (p0 + p1 * roughness);
    let g = sqrt(c * c + (ior * ior - 1.0));
    let sum = g + c;
    let difference = g - c;
    let y = c * difference + 1.0;
    let z = c * sum - 1.0;
    let d = sum * y;
    return 0.5 * difference * difference * (y * y + z * z) / (d * d * norm);
}
