override p0: f32 = 2.2006;
override p1: f32 = -1.5246;
override s: f32 = 0.465;
override k: f32 = 1.1786;
override c0: f32 = 0.1323;
override c1: f32 = 0.0034;
override c2: f32 = -0.2808;
override c3: f32 = 4.3356;
override c4: f32 = -3.63;
override c5: f32 = 2.285;
override c6: f32 = -3.8416;
override c7: f32 = 7.4919;

/// Albedo of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Forty-one operations. Over the lobe the Fresnel term stands at one effective cosine c, which does not depend on ior: above mu by
/// alpha^2 (p0 + p1 roughness) over the width of the layer at grazing, mu + k alpha. The form of ggx_norm_i13 divides by what the lobe
/// loses. With ior near 1 the term changes fast over the lobe: s alpha widens g. With alpha = 0 it is Fresnel's term.
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
