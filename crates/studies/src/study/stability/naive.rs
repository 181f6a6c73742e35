//! The naive forms, each with the place where a graphics programmer meets it. Texts in WGSL are
//! evaluated as they stand, in f64 and in f32; `pi` is a parameter, for a literal would be an f32.

/// Walter et al. 2007, eq. 33, in the form of Karis 2013 (Unreal Engine 4) and most tutorials.
pub const PEAK: &str = "override pi: f32 = 3.1415927;
fn d(alpha: f32, z: f32) -> f32 {
    let a2 = alpha * alpha;
    let d = z * z * (a2 - 1.0) + 1.0;
    return a2 / (pi * d * d);
}";

/// Every LUT of E that a compensation reads (Kulla and Conty 2017; Turquin 2019).
pub const LOSS: &str = "fn loss(e: f32) -> f32 { return 1.0 - e; }";

/// Heitz 2014, eq. 72, as printed.
pub const LAMBDA: &str = "fn lambda(alpha: f32, mu: f32) -> f32 {
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - mu * mu) / (mu * mu)) - 1.0);
}";

/// The small number in the denominator of D F G/(4 n.v n.l) of many tutorials.
pub const GRAZING: &str = "fn lambda(alpha: f32, mu: f32) -> f32 {
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - mu * mu) / (mu * mu)) - 1.0);
}
fn visibility(alpha: f32, mu_v: f32, mu_l: f32) -> f32 {
    let g2 = 1.0 / (1.0 + lambda(alpha, mu_v) + lambda(alpha, mu_l));
    return g2 / (4.0 * mu_v * mu_l + 0.0001);
}";

/// Fresnel's equations as in textbooks and pbrt (`FrDielectric`).
pub const IOR: &str = "fn fresnel(ior: f32, c: f32) -> f32 {
    let t = sqrt(1.0 - (1.0 - c * c) / (ior * ior));
    let s = (c - ior * t) / (c + ior * t);
    let p = (ior * c - t) / (ior * c + t);
    return 0.5 * (s * s + p * p);
}";

/// Schlick's Fresnel by the cosine of the ray within the glass, with a branch for total reflection
/// ("Ray Tracing in One Weekend").
pub const CRITICAL: &str = "fn leaves(ior: f32, c: f32) -> f32 {
    let r = (1.0 - ior) / (1.0 + ior);
    let f0 = r * r;
    let x = 1.0 - c;
    return select(1.0 - (f0 + (1.0 - f0) * x * x * x * x * x), 0.0, ior * ior * (1.0 - c * c) > 1.0);
}";

/// Fresnel's equations from inside, the ior of the glass over that of the air, without a branch.
pub const TOTAL: &str = "fn reflected(ior: f32, c: f32) -> f32 {
    let t = sqrt(1.0 - ior * ior * (1.0 - c * c));
    let s = (ior * c - t) / (ior * c + t);
    let p = (c - ior * t) / (c + ior * t);
    return 0.5 * (s * s + p * p);
}";

/// Heitz 2014, eq. 80, with one square of the azimuth had from the other.
pub const ANISOTROPY: &str = "fn lambda(ax: f32, ay: f32, x: f32, y: f32, z: f32) -> f32 {
    let rest = x * x + y * y;
    let a2 = ax * ax + (ay * ay - ax * ax) * (y * y / rest);
    return 0.5 * (sqrt(1.0 + a2 * rest / (z * z)) - 1.0);
}";

/// An accumulation buffer of f32; it is [`running`].
pub const SUM: &str = "sum = sum + weight;";

/// The sum of all, in f32, one after the other.
pub fn running(weights: &[f64]) -> f32 {
    weights.iter().fold(0.0, |sum, &weight| sum + weight as f32)
}
