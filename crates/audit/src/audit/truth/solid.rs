//! Truths over three inputs, coarsely: cubic interpolation between knots, for trying many
//! conventions. What a verdict says is exact.

use super::Values;

/// Knots of one input: evenly spaced in a coordinate in which the truth bends evenly.
#[derive(Clone, Copy)]
pub(super) struct Knots {
    /// The coordinate of an input.
    pub coordinate: fn(f64) -> f64,
    /// The input at a coordinate.
    pub input: fn(f64) -> f64,
    /// Range of the input.
    pub range: [f64; 2],
    /// How many, at least 1.
    pub count: usize,
}

impl Knots {
    /// The inputs at the knots.
    pub(super) fn inputs(&self) -> Vec<f64> {
        let [low, high] = self.range.map(self.coordinate);
        let last = (self.count - 1) as f64;
        let at = |i: usize| (self.input)(low + (high - low) * i as f64 / last);
        (0..self.count).map(|i| at(i).clamp(self.range[0], self.range[1])).collect()
    }

    /// The first of the knots that an input's value is made of, and their weights: Lagrange's
    /// cubic, near an end that of the last four.
    fn place(&self, x: f64) -> (usize, [f64; 4]) {
        let [low, high] = self.range.map(self.coordinate);
        let u = (self.coordinate)(x.clamp(self.range[0], self.range[1]));
        let p = (u - low) / (high - low) * (self.count - 1) as f64;
        let taken = self.count.min(4);
        let first = (p.floor() as usize).saturating_sub(1).min(self.count - taken);
        let mut weights = [0.0; 4];
        for (i, weight) in weights.iter_mut().enumerate().take(taken) {
            let others = (0..taken).filter(|j| *j != i);
            *weight = others.map(|j| (p - (first + j) as f64) / (i as f64 - j as f64)).product();
        }
        (first, weights)
    }
}

/// Values at all knots, for each lobe.
pub(super) struct Solid {
    pub(super) knots: [Knots; 3],
    pub(super) values: Vec<&'static Values>,
}

impl Solid {
    /// Values at every combination of inputs, the first fastest: one input after the other, the
    /// slowest first.
    pub(super) fn at(&self, lobe: usize, at: &[&[f64]]) -> Values {
        let [nx, ny, _] = self.knots.map(|k| k.count);
        let slow = along(&self.knots[2], at[2], nx * ny, self.values[lobe]);
        let mid = along(&self.knots[1], at[1], nx, &slow);
        along(&self.knots[0], at[0], 1, &mid)
    }
}

/// Values with one axis, of knots `step` apart, taken at inputs instead of knots.
pub(super) fn along(knots: &Knots, at: &[f64], step: usize, values: &[[f64; 2]]) -> Values {
    let places: Vec<(usize, [f64; 4])> = at.iter().map(|x| knots.place(*x)).collect();
    let taken = knots.count.min(4);
    let mut out = Vec::with_capacity(values.len() / knots.count * at.len());
    for block in values.chunks(knots.count * step) {
        for (first, weights) in &places {
            let lines: [&[[f64; 2]]; 4] =
                std::array::from_fn(|k| &block[(first + k.min(taken - 1)) * step..][..step]);
            out.extend((0..step).map(|i| {
                let mut sum = [0.0; 2];
                for (line, weight) in lines.iter().zip(weights) {
                    sum[0] += weight * line[i][0];
                    sum[1] += weight * line[i][1];
                }
                sum
            }));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::{Once, once};
    use super::*;

    static KEPT: Once<Values> = Once::new();

    #[test]
    fn cubics_are_kept_where_there_are_knots_for_them() {
        let knots = |count| Knots { coordinate: f64::sqrt, input: |u| u * u, range: [0.0, 1.0], count };
        let knots = [knots(3), knots(4), knots(5)];
        let f = |x: f64, y: f64, z: f64| [1.0 + x * y.sqrt() * y, z * z.sqrt() - x.sqrt()];
        let mut values = Vec::new();
        for z in knots[2].inputs() {
            for y in knots[1].inputs() {
                values.extend(knots[0].inputs().iter().map(|x| f(*x, y, z)));
            }
        }
        let solid = Solid { knots, values: vec![once(&KEPT, || Ok(values)).unwrap()] };
        let (x, y, z) = ([0.0, 0.3, 1.0], [0.2, 0.9], [0.7]);
        let got = solid.at(0, &[&x, &y, &z]);
        for (i, value) in got.iter().enumerate() {
            let wanted = f(x[i % 3], y[i / 3], z[0]);
            assert!((value[0] - wanted[0]).abs() + (value[1] - wanted[1]).abs() < 1e-14, "{i}");
        }
    }
}
