//! Weights that turn values at nodes into the interpolating polynomial's value at a point.

use lobefit_math::ops;

/// Nodes of a polynomial interpolant with the factors of the barycentric formula (Berrut and
/// Trefethen 2004, eq. 4.2).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nodes {
    at: Vec<f64>,
    factors: Vec<f64>,
}

impl Nodes {
    /// Interpolation in distinct nodes.
    pub fn new(at: Vec<f64>) -> Nodes {
        // Differences are scaled to the capacity of the interval, a quarter of its length, against
        // under- and overflow.
        let low = at.iter().fold(f64::INFINITY, |a, b| a.min(*b));
        let high = at.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
        let scale = if high > low { 4.0 / (high - low) } else { 1.0 };
        let factor = |i: usize| {
            let others = (0..at.len()).filter(|j| *j != i);
            1.0 / others.map(|j| scale * (at[i] - at[j])).product::<f64>()
        };
        let factors = (0..at.len()).map(factor).collect();
        Nodes { at, factors }
    }

    /// The `n` extrema of a Chebyshev polynomial on [low, high], both ends included; one node in
    /// the middle for n = 1.
    pub fn chebyshev(low: f64, high: f64, n: usize) -> Nodes {
        if n < 2 || low == high {
            return Nodes::new(vec![0.5 * (low + high)]);
        }
        let angle = |i: usize| std::f64::consts::PI * i as f64 / (n - 1) as f64;
        let middle = 0.5 * (low + high);
        let mut at: Vec<f64> = (0..n).map(|i| middle - (high - middle) * ops::cos(angle(i))).collect();
        (at[0], at[n - 1]) = (low, high);
        Nodes::new(at)
    }

    /// The nodes.
    pub fn at(&self) -> &[f64] {
        &self.at
    }

    /// The weight of each node's value at x.
    pub fn weights(&self, x: f64) -> Vec<f64> {
        if let Some(hit) = self.at.iter().position(|node| *node == x) {
            let mut out = vec![0.0; self.at.len()];
            out[hit] = 1.0;
            return out;
        }
        let mut out: Vec<f64> = self.at.iter().zip(&self.factors).map(|(node, f)| f / (x - node)).collect();
        let total: f64 = out.iter().sum();
        for w in &mut out {
            *w /= total;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_reproduced() {
        for nodes in [Nodes::chebyshev(-2.0, 3.0, 9), Nodes::new(vec![-2.0, -1.0, 0.3, 1.0, 2.0, 2.5, 3.0])] {
            let cubic = |x: f64| 1.0 + x * (0.5 + x * (2.0 - x));
            for x in [-2.0, -1.7, 0.3, 1.234, 3.0] {
                let value: f64 =
                    nodes.weights(x).iter().zip(nodes.at()).map(|(w, node)| w * cubic(*node)).sum();
                assert!((value - cubic(x)).abs() < 1e-13, "{x}: {value}");
            }
        }
        assert_eq!(Nodes::chebyshev(2.0, 2.0, 5).weights(2.0), [1.0]);
    }
}
