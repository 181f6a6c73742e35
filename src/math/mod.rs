//! Floor 0: scalar operations, quadrature rules, deterministic sums and low-discrepancy points.

pub mod ops;
