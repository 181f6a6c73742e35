override p0: f32 = 5.2956;
override p1: f32 = 11.5548;
override s: f32 = 0.4206;
override k: f32 = 1.594;
override c0: f32 = -0.7838;
override c1: f32 = -0.0117;
override c2: f32 = 1.0996;
override c3: f32 = 4.9807;
override c4: f32 = 1.2531;
override c5: f32 = 2.572;
override c6: f32 = -3.4003;
override c7: f32 = 4.5052;

/// Albedo of the GGX reflection lobe of a dielectric with the exact Fresnel term, seen from outside.
/// Fifty operations. Over the lobe the Fresnel term stands at one effective cosine c, c^2 = mu^2 + p0 alpha^2/(1 + p1 alpha), which
/// does not depend on ior; the form of ggx_norm_i13 divides by what the lobe loses. With ior near 1 the term changes fast over the
/// lobe: s alpha widens g. With alpha = 0 it is Fresnel's term.
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
