//! Interpolation in ln(alpha).

use super::kernel::Energies;
use lobefit_math::{chebyshev, ops};

/// Nodes in alpha and, for every row, their weights.
pub(super) struct Interpolation {
    pub nodes: Vec<f64>,
    weights: Vec<Vec<f64>>,
}

impl Interpolation {
    /// The rows themselves.
    pub fn none(alphas: &[f64]) -> Interpolation {
        let identity = |i: usize| (0..alphas.len()).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        Interpolation { nodes: alphas.to_vec(), weights: (0..alphas.len()).map(identity).collect() }
    }

    /// Chebyshev nodes for the tolerance, if these are fewer than the rows.
    pub fn chebyshev(alphas: &[f64], tolerance: f64) -> Option<Interpolation> {
        let low = alphas.iter().copied().fold(f64::INFINITY, f64::min);
        let high = alphas.iter().copied().fold(0.0, f64::max);
        if !(low > 0.0 && high.is_finite() && high > low) {
            return None;
        }
        let count = nodes_for(ops::log(high / low), tolerance);
        if count >= alphas.len() {
            return None;
        }
        let logs = chebyshev::nodes(ops::log(low), ops::log(high), count);
        let mut nodes: Vec<f64> = logs.iter().map(|x| ops::exp(*x)).collect();
        (nodes[0], nodes[count - 1]) = (low, high);
        let weights = alphas.iter().map(|alpha| chebyshev::weights(&logs, ops::log(*alpha))).collect();
        Some(Interpolation { nodes, weights })
    }

    /// E of every row and index of refraction, from those of every node: [row][index][side].
    pub fn apply(&self, nodes: &[(Vec<Energies>, u64)], iors: usize) -> Vec<f64> {
        let values: Vec<Vec<f64>> =
            nodes.iter().map(|(energies, _)| energies.iter().flat_map(Energies::e).collect()).collect();
        let mut out = vec![0.0; self.weights.len() * iors * 2];
        for (row, weights) in out.chunks_mut(iors * 2).zip(&self.weights) {
            for (values, weight) in values.iter().zip(weights) {
                for (sum, value) in row.iter_mut().zip(values) {
                    *sum += weight * value;
                }
            }
        }
        out
    }
}

/// Chebyshev nodes over a range of ln(alpha): with the singularities at distance pi/2 from the real
/// axis, n nodes on a range of half length h leave an error of about exp(-n asinh(pi/(2 h))); the
/// factor is measured on the path tracer's grid.
fn nodes_for(range: f64, tolerance: f64) -> usize {
    let rate = ops::asinh(std::f64::consts::PI / range);
    ((ops::log(1.5 / tolerance) / rate).ceil() as usize).max(2)
}
