override p0: f32 = 4.6834;
override p1: f32 = 10.227;
override s: f32 = 0.3599;
override k: f32 = 0.5352;
override c0: f32 = -0.1159;
override c1: f32 = -1.1779;
override c2: f32 = 3.4567;
override c3: f32 = 0.5977;
override c4: f32 = 0.3128;

/// Albedo of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Forty-seven operations. Over the lobe the Fresnel term stands at one effective cosine c, c^2 = mu^2 + p0 alpha^2/(1 + p1 alpha), which
/// does not depend on ior; the form of ggx_norm_i10 divides by what the lobe loses. With ior near 1 the term changes fast over the
/// lobe: s alpha widens g. With alpha = 0 it is Fresnel's term.
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
