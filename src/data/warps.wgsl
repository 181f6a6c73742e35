// The texture coordinates of axes before they are scaled, from the physical variables. `x` is the axis' own variable.

/// u = x.
fn linear(x: f32) -> f32 {
    return x;
}

/// u = sqrt(x): texels dense at grazing angles.
fn root(x: f32) -> f32 {
    return sqrt(x);
}

/// u = sqrt(1 - x): the axis of linearly transformed cosines.
fn grazing(x: f32) -> f32 {
    return sqrt(max(1.0 - x, 0.0));
}

/// u = x^2: the path tracer's axis of anisotropy.
fn square(x: f32) -> f32 {
    return x * x;
}

/// The layer x ~ alpha, where the albedo of a smooth lobe depends on mu/alpha alone.
fn homogeneous(x: f32, alpha: f32) -> f32 {
    return sqrt(x * (1.0 + alpha) / (x + alpha));
}

/// The layer x ~ alpha of a rough interface together with the onset of total internal reflection.
fn homogeneous_ior(x: f32, alpha: f32, ior: f32) -> f32 {
    let r = sqrt(max(ior - 1.0, 0.0));
    let l = alpha + 3.0 * r;
    return sqrt(x * (1.0 + l) / (x + l));
}

/// The layer x ~ alpha_v, the alpha towards the view.
fn homogeneous_azimuth(x: f32, alpha: f32, anisotropy: f32, cos2_phi: f32) -> f32 {
    let q = 1.0 - 0.9 * anisotropy;
    let spread = cos2_phi / q + (1.0 - cos2_phi) * q;
    let l = alpha * sqrt(spread);
    return sqrt(x * (1.0 + l) / (x + l));
}

/// The axis of ior, from its minimum and the root of its extent.
fn layered(x: f32, alpha: f32, least: f32, whole: f32) -> f32 {
    let r = sqrt(max(x - least, 0.0));
    let c = 0.001 + 0.55 * sqrt(alpha);
    return sqrt(r * (whole + c) / (whole * (r + c)) + 0.01);
}

/// The axis of anisotropy, linear in the aspect alpha_y/alpha.
fn aspect(x: f32) -> f32 {
    let q = 1.0 - 0.9 * x;
    return sqrt(q);
}
