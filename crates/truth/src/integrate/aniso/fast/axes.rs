//! The variables in which E is smooth, and how many nodes a tolerance takes in each.

use super::barycentric::Nodes;
use lobefit_math::ops;

/// The cosine's variable: ln((mu + low)/(1.6 - mu)), dense at grazing angles down to `low`; E has a
/// singularity not far beyond mu = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cosine {
    low: f64,
}

impl Cosine {
    /// For cosines from `from` up.
    pub fn from(from: f64) -> Cosine {
        Cosine { low: from.min(0.05) }
    }

    /// The variable.
    pub fn of(self, mu: f64) -> f64 {
        ops::log((mu + self.low) / (1.6 - mu))
    }

    /// mu of a value of the variable.
    pub fn mu(self, u: f64) -> f64 {
        let e = ops::exp(u);
        (1.6 * e - self.low) / (1.0 + e)
    }
}

/// The anisotropy's variable, tanh(0.8 ln(aspect)), aspect = sqrt(alpha_y/alpha_x): odd under the
/// swap of the axes; the mean over the azimuth is a function of its square.
pub(super) fn lean(aspect: f64) -> f64 {
    ops::tanh(0.8 * ops::log(aspect))
}

/// aspect of a value of [`lean`].
pub(super) fn aspect(lean: f64) -> f64 {
    ops::exp(0.5 * (ops::log1p(lean) - ops::log1p(-lean)) / 0.8)
}

/// Nodes over a range of a variable: `at_six` for 10^-6 on a range as long as `usual`, more in
/// proportion to range and digits (measured, 4 to 7 digits).
fn count([low, high]: [f64; 2], usual: f64, at_six: f64, digits: f64) -> usize {
    if low == high {
        return 1;
    }
    let share = (high - low) / usual;
    let nodes = at_six * (0.3 + 0.7 * share) * (0.1 + 0.15 * digits);
    (nodes.round() as usize).max(3)
}

/// Nodes over ln(alpha); the path tracer's rows 1/64..1 set the scale.
pub(super) fn alphas(range: [f64; 2], digits: f64) -> Nodes {
    Nodes::chebyshev(range[0], range[1], count(range, 4.16, 22.0, digits))
}

/// Nodes over the square of [`lean`]; the path tracer's slices sqrt(0.1)..1 set the scale.
pub(super) fn leans(range: [f64; 2], digits: f64) -> Nodes {
    Nodes::chebyshev(range[0], range[1], count(range, 0.526, 8.0, digits))
}

/// Nodes over the square of [`lean`] from 0 to that of `most`, 0 left out: the positive half of
/// Chebyshev nodes over [-most, most]. One node where the range is a point.
pub(super) fn leans_without_zero(most: f64, digits: f64) -> Nodes {
    if most == 0.0 {
        return Nodes::new(vec![SMALLEST_LEAN * SMALLEST_LEAN]);
    }
    let n = count([0.0, most * most], 0.526, 8.0, digits) + 1;
    let cosine = |i: usize| ops::cos(std::f64::consts::PI * i as f64 / (2 * n - 1) as f64);
    let square = |i: usize| (most * cosine(i)) * (most * cosine(i));
    Nodes::new((0..n).map(square).collect())
}

/// Stands for 0 where the isotropic lobe alone is asked for: coefficients odd in the variable are
/// divided by it.
const SMALLEST_LEAN: f64 = 1e-3;

/// Nodes over the variable of a cosine; the path tracer's columns 1/64..63/64 set the scale.
pub(super) fn cosines(cosine: Cosine, [low, high]: [f64; 2], digits: f64) -> Nodes {
    let range = [cosine.of(low), cosine.of(high)];
    Nodes::chebyshev(range[0], range[1], count(range, 3.7, 22.0, digits))
}
