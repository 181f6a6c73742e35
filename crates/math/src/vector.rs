//! Directions and places in space.

/// A place, a displacement, or a direction of unit length.
pub type Vec3 = [f64; 3];

/// a . b
#[inline(always)]
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x b
#[inline(always)]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a times a number.
#[inline(always)]
pub fn scaled(a: Vec3, by: f64) -> Vec3 {
    a.map(|x| x * by)
}

/// a + b
#[inline(always)]
pub fn plus(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a - b
#[inline(always)]
pub fn minus(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Its length.
#[inline(always)]
pub fn length(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// Its direction; not a number where it has none.
#[inline(always)]
pub fn normalise(a: Vec3) -> Vec3 {
    scaled(a, 1.0 / length(a))
}

/// Two directions at right angles to `axis` and to one another (Duff et al. 2017, "Building an
/// Orthonormal Basis, Revisited").
#[inline(always)]
pub fn tangents(axis: Vec3) -> [Vec3; 2] {
    let [x, y, z] = axis;
    let sign = if z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}

/// The direction of coordinates about `axis`, its [`tangents`] first.
#[inline(always)]
pub fn turned(axis: Vec3, [a, b]: [Vec3; 2], local: Vec3) -> Vec3 {
    plus(plus(scaled(a, local[0]), scaled(b, local[1])), scaled(axis, local[2]))
}
