//! Gauss-Legendre rules on [-1, 1].

use std::sync::OnceLock;

use super::ops;

/// Most nodes that [`Gauss::new`] accepts: Newton on the three-term recurrence is exact to a few
/// ulp up to here (tested against the exactness degree of the rule).
pub const MOST_NODES: usize = 512;

/// A Gauss-Legendre rule: exact for polynomials up to degree 2n - 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauss {
    /// Nodes in (-1, 1), ascending.
    pub nodes: Vec<f64>,
    /// Weights, all positive; they sum to 2.
    pub weights: Vec<f64>,
}

impl Gauss {
    /// The rule of `n` nodes, solved for once in a run.
    ///
    /// # Panics
    /// If `n` is 0 or above [`MOST_NODES`], or Newton has not converged in 100 steps (neither
    /// depends on data).
    pub fn new(n: usize) -> Gauss {
        static RULES: [OnceLock<Gauss>; MOST_NODES + 1] = [const { OnceLock::new() }; MOST_NODES + 1];
        assert!((1..=MOST_NODES).contains(&n), "a Gauss rule has 1 to {MOST_NODES} nodes, not {n}");
        RULES[n].get_or_init(|| Gauss::solve(n)).clone()
    }

    fn solve(n: usize) -> Gauss {
        let (mut nodes, mut weights) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n.div_ceil(2) {
            let (x, w) = root(n, i);
            (nodes[i], nodes[n - 1 - i]) = (-x, x);
            (weights[i], weights[n - 1 - i]) = (w, w);
        }
        if n % 2 == 1 {
            nodes[n / 2] = 0.0;
        }
        Gauss { nodes, weights }
    }

    /// Integral of `f` over [a, b].
    pub fn integrate(&self, a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let (half, middle) = (0.5 * (b - a), 0.5 * (a + b));
        let terms = self.nodes.iter().zip(&self.weights);
        half * terms.map(|(x, w)| w * f(middle + half * x)).sum::<f64>()
    }
}

/// The i-th largest root of the Legendre polynomial P_n with its weight 2 / ((1-x^2) P_n'(x)^2), by
/// Newton from Tricomi's asymptotic guess.
fn root(n: usize, i: usize) -> (f64, f64) {
    let order = n as f64;
    let angle = std::f64::consts::PI * (i as f64 + 0.75) / (order + 0.5);
    let mut x = (1.0 - (1.0 - 1.0 / order) / (8.0 * order * order)) * ops::cos(angle);
    for _ in 0..100 {
        let (value, slope) = legendre(n, x);
        let step = value / slope;
        x -= step;
        if step.abs() <= 1e-15 {
            let (_, slope) = legendre(n, x);
            return (x, 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope));
        }
    }
    panic!("Legendre root {i} of {n} did not converge");
}

/// P_n and its derivative at x in (-1, 1), by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k;
        (previous, value) = (value, next);
    }
    (value, n as f64 * (x * value - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_exact_to_their_degree() {
        for n in [1, 2, 3, 8, 16, 33, 64, 128, 256, MOST_NODES] {
            let rule = Gauss::new(n);
            assert!((rule.weights.iter().sum::<f64>() - 2.0).abs() < 1e-13, "weights of {n}");
            // x^(2n-2) is the highest even power that the rule still integrates exactly.
            let degree = 2 * n - 2;
            let value = rule.integrate(-1.0, 1.0, |x| ops::pow(x.abs(), degree as f64));
            let exact = 2.0 / (degree as f64 + 1.0);
            assert!((value - exact).abs() < 1e-12 * exact.max(1e-2), "{n}: {value} against {exact}");
        }
    }

    #[test]
    fn one_node_more_would_be_needed() {
        let short = Gauss::new(3).integrate(-1.0, 1.0, |x| x * x * x * x * x * x);
        assert!((short - 2.0 / 7.0).abs() > 1e-3, "degree 6 must not be exact with 3 nodes");
    }
}
