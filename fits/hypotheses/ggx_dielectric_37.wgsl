override p0: f32 = 1.2005583;
override p1: f32 = -0.96024716;
override k: f32 = 0.6102079;
override c0: f32 = 0.02278652;
override c1: f32 = -5.0227213;
override c2: f32 = 5.692883;
override c3: f32 = 3.1635377;
override c4: f32 = 0.4540241;

/// Albedo R of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Thirty-seven operations. Over the lobe the Fresnel term stands at one effective cosine c, which does
/// not depend on ior. Here c exceeds mu by a multiple of alpha^2 over the width of the layer at
/// grazing. The whole is divided by ggx_norm_i10's form for the light that is lost between facets.
/// Fresnel's term itself for alpha = 0.
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
