//! Several functions of one variable at once, interpolated on panels in Chebyshev points.

use super::chebyshev;

/// Nodes per panel. On a panel [x, 3x] a function that is singular at 0 has its Bernstein ellipse
/// at 2 + sqrt 3, so that the interpolant is off by about (2 + sqrt 3)^-(n-1) of the function's
/// variation: 3e-9 for n = 16; 2e-7 on the longest that `panels::from_zero` makes, [x, 4.5x].
pub const NODES: usize = 16;

/// Interpolants of K functions on neighbouring panels.
#[derive(Clone, Debug, PartialEq)]
pub struct Piecewise<const K: usize> {
    cuts: Vec<f64>,
    unit: [f64; NODES],
    values: Vec<[[f64; K]; NODES]>,
}

/// The nodes of every panel between ascending cuts, in order; neighbours share their ends.
pub fn nodes(cuts: &[f64]) -> Vec<f64> {
    cuts.windows(2).flat_map(|cut| chebyshev::nodes(cut[0], cut[1], NODES)).collect()
}

impl<const K: usize> Piecewise<K> {
    /// The interpolant of values at [`nodes`].
    ///
    /// # Panics
    /// If there are fewer than two cuts, or not a value per node: neither depends on input.
    pub fn new(cuts: Vec<f64>, values: &[[f64; K]]) -> Piecewise<K> {
        assert!(cuts.len() > 1 && values.len() == (cuts.len() - 1) * NODES, "values at the nodes of panels");
        let mut unit = [0.0; NODES];
        unit.copy_from_slice(&chebyshev::nodes(-1.0, 1.0, NODES));
        Piecewise { cuts, unit, values: values.as_chunks::<NODES>().0.to_vec() }
    }

    /// The cuts.
    pub fn cuts(&self) -> &[f64] {
        &self.cuts
    }

    /// Values at x, which is taken into the range of the cuts (Berrut and Trefethen 2004, eq. 5.3).
    pub fn at(&self, x: f64) -> [f64; K] {
        let panel = self.cuts.partition_point(|cut| *cut <= x).clamp(1, self.values.len()) - 1;
        let (low, high) = (self.cuts[panel], self.cuts[panel + 1]);
        let t = ((x - low) / (high - low) * 2.0 - 1.0).clamp(-1.0, 1.0);
        let values = &self.values[panel];
        let (mut above, mut below) = ([0.0; K], 0.0);
        for i in 0..NODES {
            let distance = t - self.unit[i];
            if distance == 0.0 {
                return values[i];
            }
            let weight = if i % 2 == 0 { 1.0 } else { -1.0 };
            let weight = if i == 0 || i == NODES - 1 { 0.5 * weight } else { weight };
            let term = weight / distance;
            for k in 0..K {
                above[k] += term * values[i][k];
            }
            below += term;
        }
        above.map(|sum| sum / below)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ops, panels};

    #[test]
    fn a_singular_end_is_resolved() {
        let f = |x: f64| [if x > 0.0 { x * ops::log(x) } else { 0.0 }, 1.0 / (x + 0.01)];
        let cuts = panels::from_zero(1.0, 1e-6);
        let values: Vec<[f64; 2]> = nodes(&cuts).into_iter().map(f).collect();
        let piecewise = Piecewise::new(cuts, &values);
        for i in 0..=2000 {
            let x = f64::from(i) / 2000.0;
            let (got, want) = (piecewise.at(x), f(x));
            assert!((got[0] - want[0]).abs() < 2e-8, "{x}: {got:?} {want:?}");
            assert!((got[1] - want[1]).abs() < 2e-8 * want[1].max(1.0), "{x}: {got:?} {want:?}");
        }
    }
}
