//! The path tracer's layout of anisotropic reflection: 64 x 64 x 32, separable Smith, alpha =
//! roughness.

use crate::data::{Axis, Warp};

/// Columns, rows, slices.
pub const SIZE: [usize; 3] = [64, 64, 32];

/// Least mu, alpha, alpha_x and alpha_y of the path tracer's texels.
pub(super) const FLOOR: f64 = 1e-4;

/// What the axes do not tell of the nodes.
pub const NOTE: &str = "texels are exact at the nodes clamped as the path tracer clamps them: mu to [0.0001, 0.9999], alpha, alpha_x and alpha_y to 0.0001 or more";

/// The axes on which the texels lie: mu = x/64, alpha = y/64, aspect = sqrt(1 - 0.9 sqrt(z/32)), so
/// that z/32 is the square of the anisotropy. The last texel of each axis lies one step before 1.
pub fn axes() -> [Axis; 3] {
    let last = |n: usize| (n - 1) as f64 / n as f64;
    [
        Axis::ends("mu", SIZE[0], Warp::Linear, [0.0, last(SIZE[0])]),
        Axis::ends("roughness", SIZE[1], Warp::Linear, [0.0, last(SIZE[1])]),
        Axis::ends("anisotropy", SIZE[2], Warp::Square, [0.0, last(SIZE[2]).sqrt()]),
    ]
}

/// mu, alpha and aspect of the nodes, clamped as the path tracer clamps them.
pub(super) fn grid() -> [Vec<f64>; 3] {
    let at = |i: usize, n: usize| i as f64 / n as f64;
    let mu = (0..SIZE[0]).map(|x| at(x, SIZE[0]).clamp(FLOOR, 0.9999)).collect();
    let alpha = (0..SIZE[1]).map(|y| at(y, SIZE[1]).clamp(FLOOR, 1.0)).collect();
    let aspect = (0..SIZE[2]).map(|z| (1.0 - 0.9 * at(z, SIZE[2]).sqrt()).sqrt()).collect();
    [mu, alpha, aspect]
}
