//! Scalar operations, quadrature rules, deterministic sums, low-discrepancy points and vectors in
//! space.

pub mod chebyshev;
pub mod gauss;
pub mod lanes;
pub mod ops;
pub mod panels;
pub mod piecewise;
pub mod recurrence;
pub mod sobol;
pub mod sum;
pub mod vector;
