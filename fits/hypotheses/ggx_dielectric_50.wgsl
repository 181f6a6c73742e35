override p0: f32 = 5.336558;
override p1: f32 = 10.809133;
override s: f32 = 0.5556323;
override k: f32 = 1.58064;
override c0: f32 = 0.27464202;
override c1: f32 = -0.0040307185;
override c2: f32 = -0.59679097;
override c3: f32 = 8.515329;
override c4: f32 = -3.166359;
override c5: f32 = 2.421384;
override c6: f32 = -5.673575;
override c7: f32 = 2.9030907;

/// Albedo R of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Fifty operations. Over the lobe the Fresnel term stands at one effective cosine c, which does not depend
/// on ior. Here c^2 exceeds mu^2 by a ratio of alpha^2 and a line in alpha.
/// The whole is divided by ggx_norm_i13's form for the light that is lost between facets. A line in alpha
/// under the root follows that the term changes fast over the lobe where ior is near 1. Fresnel's
/// term itself for alpha = 0.
fn ggx_dielectric_50(alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let norm = 1.0 + alpha * (c0 + inverse * (c1 + alpha * (c2 + mu * (c3 + inverse * (c4 + inverse * c5)
        + mu * (c6 + alpha * c7)))));
    let square = mu * mu + p0 * alpha * alpha / (1.0 + p1 * alpha);
    let c = sqrt(square);
    let g = sqrt(square + (ior * ior - 1.0) + s * alpha);
    let sum = g + c;
    let difference = g - c;
    let y = c * difference + 1.0;
    let z = c * sum - 1.0;
    let d = sum * y;
    return 0.5 * difference * difference * (y * y + z * z) / (d * d * norm);
}
