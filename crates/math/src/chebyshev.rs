//! Polynomial interpolation in Chebyshev points of the second kind, by the barycentric formula.

use super::ops;

/// An interpolant on [low, high], ends included among its nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chebyshev {
    nodes: Vec<f64>,
    values: Vec<f64>,
}

/// The `n` >= 2 nodes on [low, high], ascending: the extrema of the Chebyshev polynomial of degree
/// n - 1.
pub fn nodes(low: f64, high: f64, n: usize) -> Vec<f64> {
    let angle = |i: usize| std::f64::consts::PI * i as f64 / (n - 1) as f64;
    let unit = |i: usize| 0.5 * (1.0 - ops::cos(angle(i)));
    (0..n)
        .map(|i| match i {
            0 => low,
            _ if i == n - 1 => high,
            _ => low + (high - low) * unit(i),
        })
        .collect()
}

impl Chebyshev {
    /// The interpolant of values at the [`nodes`] of an interval.
    pub fn new(low: f64, high: f64, values: Vec<f64>) -> Chebyshev {
        Chebyshev { nodes: nodes(low, high, values.len()), values }
    }

    /// Its value at x in [low, high] (Berrut and Trefethen 2004, eq. 5.3).
    pub fn at(&self, x: f64) -> f64 {
        let last = self.nodes.len() - 1;
        let (mut above, mut below) = (0.0, 0.0);
        for (i, (node, value)) in self.nodes.iter().zip(&self.values).enumerate() {
            if x == *node {
                return *value;
            }
            let term = term(i, last, x - node);
            above += term * value;
            below += term;
        }
        above / below
    }
}

/// The term of a node, of which `last` is the last, at a distance from it.
fn term(i: usize, last: usize, distance: f64) -> f64 {
    let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    (if i == 0 || i == last { 0.5 * sign } else { sign }) / distance
}

/// [`Chebyshev::at`] of interpolants over the same nodes, to the bit, with one division for a node of all.
pub fn all_at(rows: &[Chebyshev], x: f64) -> Vec<f64> {
    let Some(Chebyshev { nodes, .. }) = rows.first() else { return Vec::new() };
    if let Some(hit) = nodes.iter().position(|node| *node == x) {
        return rows.iter().map(|row| row.values[hit]).collect();
    }
    let last = nodes.len() - 1;
    let terms: Vec<f64> = nodes.iter().enumerate().map(|(i, node)| term(i, last, x - node)).collect();
    let below = terms.iter().fold(0.0, |sum, term| sum + term);
    let above =
        |row: &Chebyshev| terms.iter().zip(&row.values).fold(0.0, |sum, (term, value)| sum + term * value);
    rows.iter().map(|row| above(row) / below).collect()
}

/// Weights of the values at Chebyshev nodes of the second kind, ascending, for the interpolant's
/// value at x: 1 at a node itself.
pub fn weights(nodes: &[f64], x: f64) -> Vec<f64> {
    if let Some(hit) = nodes.iter().position(|node| *node == x) {
        return (0..nodes.len()).map(|i| if i == hit { 1.0 } else { 0.0 }).collect();
    }
    let last = nodes.len() - 1;
    let mut terms: Vec<f64> = nodes.iter().enumerate().map(|(i, node)| term(i, last, x - node)).collect();
    let sum: f64 = terms.iter().sum();
    terms.iter_mut().for_each(|t| *t /= sum);
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_the_interpolant() {
        let at = nodes(-1.0, 2.0, 9);
        let values: Vec<f64> = at.iter().map(|x| ops::exp(*x)).collect();
        let interpolant = Chebyshev::new(-1.0, 2.0, values.clone());
        let other = Chebyshev::new(-1.0, 2.0, values.iter().map(|v| 1.0 / v).collect());
        let both = [interpolant.clone(), other.clone()];
        for x in [-1.0, -0.3, at[4], 1.99, 2.0] {
            let value: f64 = weights(&at, x).iter().zip(&values).map(|(w, v)| w * v).sum();
            assert!((value - interpolant.at(x)).abs() < 1e-14, "{x}");
            assert_eq!(all_at(&both, x), [interpolant.at(x), other.at(x)]);
        }
    }

    #[test]
    fn converges_geometrically() {
        let f = |x: f64| ops::exp(x) / (x + 3.0);
        let interpolant = |n| Chebyshev::new(-1.0, 2.0, nodes(-1.0, 2.0, n).into_iter().map(f).collect());
        let worst = |n| {
            let p = interpolant(n);
            (0..=300).map(|i| -1.0 + 0.01 * f64::from(i)).fold(0.0_f64, |w, x| w.max((p.at(x) - f(x)).abs()))
        };
        assert!(
            worst(8) > 1e-6 && worst(16) < 1e-9 && worst(40) < 1e-14,
            "{} {} {}",
            worst(8),
            worst(16),
            worst(40)
        );
    }
}
