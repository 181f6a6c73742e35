//! Laws fitted to what the error is over the parameter.

use super::families::Family;
use crate::study::parallax::room::proxies::Law;
use lobefit_math::ops;

/// The logarithm of the error over the parameter, tabulated at a family's values for widths.
pub(super) struct Landscape {
    pub family: Family,
    pub alphas: Vec<f64>,
    /// A row for each width.
    pub logs: Vec<Vec<f64>>,
}

impl Landscape {
    /// At a parameter, by the cubic through the four nearest values; the ends beyond them.
    fn at(&self, row: usize, parameter: f64) -> f64 {
        let values: Vec<f64> = self.family.values().into_iter().map(|v| self.coordinate(v)).collect();
        let last = values.len() - 1;
        let x = self.coordinate(parameter).clamp(values[0], values[last]);
        let after = values.partition_point(|v| *v <= x).clamp(1, last);
        let first = after.saturating_sub(2).min(values.len() - 4);
        let nodes = &values[first..first + 4];
        let term = |i: usize| {
            let basis = |product: f64, j: usize| product * (x - nodes[j]) / (nodes[i] - nodes[j]);
            self.logs[row][first + i] * (0..4).filter(|j| *j != i).fold(1.0, basis)
        };
        (0..4).map(term).sum()
    }

    /// Where the cubic runs: values are about evenly spaced there.
    fn coordinate(&self, parameter: f64) -> f64 {
        match self.family {
            Family::Smooth | Family::Tied => ops::log(parameter),
            Family::Rounded | Family::Pushed | Family::Faded => ops::log(parameter + 0.1),
        }
    }

    /// The best parameter of a width.
    pub fn best(&self, row: usize) -> f64 {
        let values = self.family.values();
        let steps = |pair: &[f64]| -> Vec<f64> {
            (0..STEPS).map(|k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / f64::from(STEPS)).collect()
        };
        let tried = values.windows(2).flat_map(steps).chain(values.last().copied());
        let error = |x: &f64| self.at(row, *x);
        tried.min_by(|a, b| error(a).total_cmp(&error(b))).unwrap_or(values[0])
    }

    /// The mean logarithm of the error by a law.
    fn mean(&self, law: Law) -> f64 {
        let rows = self.alphas.iter().enumerate();
        rows.map(|(row, alpha)| self.at(row, law.at(*alpha))).sum::<f64>() / self.alphas.len() as f64
    }

    /// The law of the smallest mean: a search along both numbers with halving steps, from several
    /// starts.
    pub fn law(&self) -> Law {
        let (start, bounds) = self.family.search();
        let starts = [[0.3, 0.3], [0.3, 0.7], [0.7, 0.3], [0.7, 0.7]]
            .map(|share| [0, 1].map(|k| bounds[k][0] + share[k] * share[k] * (bounds[k][1] - bounds[k][0])));
        let starts: Vec<[f64; 2]> = std::iter::once(start).chain(starts).collect();
        let forms = 0..self.family.forms();
        let found = forms.flat_map(|form| starts.iter().map(move |s| (form, self.descend(form, *s, bounds))));
        let best =
            found.min_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or((0, start), |(form, (at, _))| (form, at));
        self.family.law(best.0, best.1.map(rounded))
    }

    fn descend(&self, form: usize, mut at: [f64; 2], bounds: [[f64; 2]; 2]) -> ([f64; 2], f64) {
        let value = |numbers: [f64; 2]| self.mean(self.family.law(form, numbers));
        let (mut least, mut step) = (value(at), 0.25);
        while step > 1e-4 {
            let moves = [
                [1.0, 0.0],
                [-1.0, 0.0],
                [0.0, 1.0],
                [0.0, -1.0],
                [1.0, 1.0],
                [-1.0, -1.0],
                [1.0, -1.0],
                [-1.0, 1.0],
            ];
            let tried = moves.map(|direction| {
                let moved = |k: usize| {
                    let [low, high] = bounds[k];
                    (at[k] + step * direction[k] * (high - low)).clamp(low, high)
                };
                let numbers = [moved(0), moved(1)];
                (numbers, value(numbers))
            });
            let better = tried.into_iter().filter(|(_, v)| *v < least).min_by(|a, b| a.1.total_cmp(&b.1));
            match better {
                Some((numbers, v)) => (at, least) = (numbers, v),
                None => step *= 0.5,
            }
        }
        (at, least)
    }
}

/// Parts of a step between values at which the best is looked for.
const STEPS: u32 = 32;

/// To two digits after the point: the error is flat about its least value.
fn rounded(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}
