override p0: f32 = 2.1791286;
override p1: f32 = -1.5889815;
override s: f32 = 0.3999064;
override k: f32 = 1.1450605;
override c0: f32 = 1.8356162;
override c1: f32 = 0.03720143;
override c2: f32 = -2.204924;
override c3: f32 = 5.1862736;
override c4: f32 = -5.7804923;
override c5: f32 = 1.8593271;
override c6: f32 = -12.32126;
override c7: f32 = 17.018293;

/// Albedo R of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Forty-one operations. Over the lobe the Fresnel term stands at one effective cosine c, which does
/// not depend on ior. Here c exceeds mu by a multiple of alpha^2 over the width of the layer at
/// grazing. The whole is divided by ggx_norm_i13's form for the light that is lost between facets. A
/// line in alpha under the root follows that the term changes fast over the lobe where ior is near 1.
/// Fresnel's term itself for alpha = 0.
fn ggx_dielectric_41(roughness: f32, alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let norm = 1.0 + alpha * (c0 + inverse * (c1 + alpha * (c2 + mu * (c3 + inverse * (c4 + inverse * c5)
        + mu * (c6 + alpha * c7)))));
    let c = mu + alpha * inverse * alpha * (p0 + p1 * roughness);
    let g = sqrt(c * c + (ior * ior - 1.0) + s * alpha);
    let sum = g + c;
    let difference = g - c;
    let y = c * difference + 1.0;
    let z = c * sum - 1.0;
    let d = sum * y;
    return 0.5 * difference * difference * (y * y + z * z) / (d * d * norm);
}
