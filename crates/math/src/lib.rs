//! Scalar operations, quadrature rules, deterministic sums, low-discrepancy points, the curve of sRGB,
//! vectors in space, masks of sub-voxels, correlations, lists by keys and numbers as people read them.

pub mod chebyshev;
pub mod correlation;
pub mod gauss;
pub mod lanes;
mod lists;
pub mod numbers;
pub mod ops;
pub mod panels;
pub mod piecewise;
pub mod recurrence;
pub mod sobol;
pub mod srgb;
pub mod subvoxel;
pub mod sum;
pub mod vector;

pub use lists::groups;
