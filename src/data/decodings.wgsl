// What the channels of a texel stand for: E, or E, A and B.

fn albedo(texel: f32) -> f32 {
    return texel;
}

fn loss(texel: f32) -> f32 {
    return 1.0 - texel;
}

// A part of Fresnel's reflectance of a smooth surface; 0 where ior is 1.
fn deficit(texel: f32, mu: f32, ior: f32) -> f32 {
    let g = sqrt(max(ior * ior - 1.0 + mu * mu, 0.0));
    let near = g - mu;
    let far = g + mu;
    let a = near / max(far, 0.000001);
    let b = (mu * far - 1.0) / (mu * near + 1.0);
    return (1.0 - texel) * (0.5 * a * a * (1.0 + b * b));
}

fn split_sum(texel: vec2f) -> vec3f {
    return vec3f(texel.x + texel.y, texel.x, texel.y);
}

fn loss_bias(texel: vec2f, mu: f32) -> vec3f {
    let e = 1.0 - texel.x;
    let x = 1.0 - mu;
    let x2 = x * x;
    let b = e * (texel.y + x2 * x2 * x);
    return vec3f(e, e - b, b);
}

fn whole(texel: vec4f) -> vec4f {
    return texel;
}

// A cubic in t = log((alpha_v/alpha)^2)/-log(q) in [-1, 1]; t = 0 at anisotropy 0.
fn azimuth_cubic(texel: vec4f, anisotropy: f32, cos2_phi: f32) -> f32 {
    let q = 1.0 - 0.9 * anisotropy;
    let spread = cos2_phi / q + (1.0 - cos2_phi) * q;
    let t = log2(spread) / max(-log2(q), 1e-6);
    return 1.0 - (texel.x + t * (texel.y + t * (texel.z + t * texel.w)));
}
