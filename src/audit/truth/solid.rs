//! Truths over three inputs, coarsely: linear interpolation between knots, for trying many conventions. What a verdict says is exact.

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
    /// How many, at least 2.
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

    /// Knot below an input and the share of the next.
    fn place(&self, x: f64) -> (usize, f64) {
        let [low, high] = self.range.map(self.coordinate);
        let u = (self.coordinate)(x.clamp(self.range[0], self.range[1]));
        let p = (u - low) / (high - low) * (self.count - 1) as f64;
        let base = (p.floor() as usize).min(self.count - 2);
        (base, p - base as f64)
    }
}

/// Values at all knots, for each lobe.
pub(super) struct Solid {
    pub(super) knots: [Knots; 3],
    pub(super) values: Vec<Values>,
}

impl Solid {
    /// Values at every combination of inputs, the first fastest.
    pub(super) fn at(&self, lobe: usize, at: &[&[f64]]) -> Values {
        let places: Vec<Vec<(usize, f64)>> =
            self.knots.iter().zip(at).map(|(k, xs)| xs.iter().map(|x| k.place(*x)).collect()).collect();
        let (values, [nx, ny, _]) = (&self.values[lobe], self.knots.map(|k| k.count));
        let mut out = Vec::with_capacity(at.iter().map(|xs| xs.len()).product());
        for (k, w) in &places[2] {
            for (j, v) in &places[1] {
                let corner = |dk: usize, dj: usize| (k + dk) * nx * ny + (j + dj) * nx;
                let lines = [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
                let shares = [(1.0 - w) * (1.0 - v), (1.0 - w) * v, w * (1.0 - v), w * v];
                for (i, u) in &places[0] {
                    let mut sum = [0.0; 2];
                    for (line, share) in lines.iter().zip(shares) {
                        let (a, b) = (values[line + i], values[line + i + 1]);
                        sum[0] += share * (a[0] + u * (b[0] - a[0]));
                        sum[1] += share * (a[1] + u * (b[1] - a[1]));
                    }
                    out.push(sum);
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trilinear_function_is_kept() {
        let knots = |count| Knots { coordinate: f64::sqrt, input: |u| u * u, range: [0.0, 1.0], count };
        let knots = [knots(3), knots(4), knots(5)];
        let f = |x: f64, y: f64, z: f64| [1.0 + x.sqrt() * y.sqrt(), z.sqrt() - x.sqrt()];
        let mut values = Vec::new();
        for z in knots[2].inputs() {
            for y in knots[1].inputs() {
                values.extend(knots[0].inputs().iter().map(|x| f(*x, y, z)));
            }
        }
        let solid = Solid { knots, values: vec![values] };
        let (x, y, z) = ([0.0, 0.3, 1.0], [0.2, 0.9], [0.7]);
        let got = solid.at(0, &[&x, &y, &z]);
        for (i, value) in got.iter().enumerate() {
            let wanted = f(x[i % 3], y[i / 3], z[0]);
            assert!((value[0] - wanted[0]).abs() + (value[1] - wanted[1]).abs() < 1e-14, "{i}");
        }
    }
}
