override p0: f32 = 5.8576145;
override p1: f32 = 15.394095;
override s: f32 = 0.32714623;
override k: f32 = 0.54160404;
override c0: f32 = -0.09754775;
override c1: f32 = 0.10284574;
override c2: f32 = 1.2536427;
override c3: f32 = 0.48804393;
override c4: f32 = 0.2813384;

/// Albedo R of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Forty-seven operations. Over the lobe the Fresnel term stands at one effective cosine c, which does
/// not depend on ior. Here c^2 exceeds mu^2 by a ratio of alpha^2 and a line in alpha. The whole is
/// divided by ggx_norm_i10's form for the light that is lost between facets. A line in alpha under the
/// root follows that the term changes fast over the lobe where ior is near 1. Fresnel's term itself for
/// alpha = 0.
fn ggx_dielectric_47(alpha: f32, mu: f32, ior: f32) -> f32 {
    let inverse = 1.0 / (mu + k * alpha);
    let layer = inverse * (c3 + c4 * inverse);
    let norm = 1.0 + alpha * (c0 + mu * (c1 + c2 * alpha + layer));
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
