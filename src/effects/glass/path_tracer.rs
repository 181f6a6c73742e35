//! The path tracer's layout of rough glass: 128 x 128 x 32, separable Smith, alpha = roughness.

use crate::data::{Axis, Warp};

/// Columns, rows, slices.
pub const SIZE: [usize; 3] = [128, 128, 32];

/// The axes on which the texels lie: mu = (x/127)^2, alpha = y/127, ior = 1 + z/31. The
/// path tracer clamps mu to [0.01, 0.9999], alpha to [0.01, 1] and ior to [1.0001, 2] where it
/// computes a texel.
pub fn axes() -> [Axis; 3] {
    [
        Axis::ends("mu", SIZE[0], Warp::Sqrt, [0.0, 1.0]),
        Axis::ends("roughness", SIZE[1], Warp::Linear, [0.0, 1.0]),
        Axis::ends("ior", SIZE[2], Warp::Linear, [1.0, 2.0]),
    ]
}

/// What the axes do not tell of the nodes.
pub const NOTE: &str = "texels are exact at the nodes clamped as the path tracer clamps them: mu to [0.01, 0.9999], alpha to [0.01, 1], ior to [1.0001, 2]";

/// mu, alpha and ior of the nodes, clamped as the path tracer clamps them.
pub fn grid() -> [Vec<f64>; 3] {
    let at = |i: usize, n: usize| i as f64 / (n - 1) as f64;
    let mu = (0..SIZE[0]).map(|x| (at(x, SIZE[0]) * at(x, SIZE[0])).clamp(0.01, 0.9999)).collect();
    let alpha = (0..SIZE[1]).map(|y| at(y, SIZE[1]).clamp(0.01, 1.0)).collect();
    let ior = (0..SIZE[2]).map(|z| 1.0 + at(z, SIZE[2]).clamp(1e-4, 1.0)).collect();
    [mu, alpha, ior]
}
