//! E and B at millions of points: polynomials on patches of alpha and mu, each checked against integrals.
//!
//! Over x = ln(alpha) and y = ln(mu/(1.6 - mu)) both are analytic: the layer mu ~ alpha has its branch points at mu = +-i alpha, pi/2 from
//! the real axis in either variable, and 1.6 spreads the end at mu = 1, beyond which the square root of the sine lies. A patch that misses
//! one of its checked points is halved across the variable in which its series falls more slowly.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::effort::Effort;
use super::{albedo, split};
use crate::integrate::IntegrateError;
use crate::optics::Smith;
use lobefit_math::ops;

/// Chebyshev nodes of a patch along each variable.
const NODES: usize = 12;

/// Longest side of a patch: its poles are then at 2.6 half sides, and the series fall by 5.4 a term.
const LONGEST: f64 = 1.2;

/// Shortest side: a patch that misses its points at this size is a defect of the integrals.
const SHORTEST: f64 = 1e-3;

/// Largest difference from the integral at the points of a patch that are checked: half of [`Interpolant::ERROR`].
const CHECKED: f64 = 1e-9;

/// Places that are checked, in a square of side 2: the corners, and points between the nodes.
const CHECKS: [[f64; 2]; 12] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [-1.0, 1.0],
    [1.0, 1.0],
    [0.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.13, 0.13],
    [0.92, -0.51],
    [-0.92, 0.51],
    [-0.51, -0.92],
];

/// E and B over ranges of alpha and mu.
#[derive(Clone, Debug)]
pub struct Interpolant {
    low: [f64; 2],
    high: [f64; 2],
    tree: Tree,
}

#[derive(Clone, Debug)]
enum Tree {
    Patch(Box<Patch>),
    Cut { axis: usize, at: f64, halves: Box<[Tree; 2]> },
}

/// A rectangle of the variables.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    low: [f64; 2],
    high: [f64; 2],
}

/// Chebyshev coefficients by term of y, then of x.
type Series = [[f64; NODES]; NODES];

/// Series over a rectangle: of E, and of B where that is asked for.
#[derive(Clone, Debug)]
struct Patch {
    over: Rectangle,
    series: Vec<Series>,
}

/// The integrals that are interpolated.
struct Integrals {
    smith: Smith,
    effort: Effort,
    /// Whether B is among them.
    split: bool,
}

impl Interpolant {
    /// Smallest alpha and mu.
    pub const SMALLEST: f64 = 1e-4;

    /// Largest error of E and of B, measured at random points by `tests/integrate/interpolant.rs`.
    pub const ERROR: f64 = 2e-9;

    /// E and B for alpha and mu in ranges, low end first, both in [[`Interpolant::SMALLEST`], 1].
    ///
    /// # Errors
    /// A range outside the domain; integrals that no polynomial follows.
    pub fn new(smith: Smith, alpha: [f64; 2], mu: [f64; 2]) -> Result<Interpolant, IntegrateError> {
        Self::of(smith, alpha, mu, true)
    }

    /// The same of E alone, which takes a fiftieth of the time; B is then NaN.
    ///
    /// # Errors
    /// As [`Interpolant::new`].
    pub fn albedo(smith: Smith, alpha: [f64; 2], mu: [f64; 2]) -> Result<Interpolant, IntegrateError> {
        Self::of(smith, alpha, mu, false)
    }

    fn of(smith: Smith, alpha: [f64; 2], mu: [f64; 2], split: bool) -> Result<Interpolant, IntegrateError> {
        for (input, range) in [("alpha", alpha), ("mu", mu)] {
            if !(Self::SMALLEST <= range[0] && range[0] <= range[1] && range[1] <= 1.0) {
                let (quantity, domain) = ("ggx-reflection", "is outside [1e-4, 1] or not a range");
                return Err(IntegrateError::Domain { quantity, input, value: range[0], domain });
            }
        }
        let (low, high) = (variables(alpha[0], mu[0]), variables(alpha[1], mu[1]));
        // Both errors below 1e-11, so that the values are smooth: a jump between rules looks like a patch that is too long.
        let integrals = Integrals { smith, effort: Effort::new(16, 12.0), split };
        Ok(Interpolant { low, high, tree: grown(&integrals, Rectangle { low, high })? })
    }

    /// E and B; NaN outside the ranges.
    pub fn at(&self, alpha: f64, mu: f64) -> (f64, f64) {
        let place = variables(alpha, mu);
        let inside = |axis: usize| (self.low[axis]..=self.high[axis]).contains(&place[axis]);
        if !(inside(0) && inside(1)) {
            return (f64::NAN, f64::NAN);
        }
        let mut tree = &self.tree;
        loop {
            match tree {
                Tree::Patch(patch) => return patch.at(place),
                Tree::Cut { axis, at, halves } => tree = &halves[usize::from(place[*axis] > *at)],
            }
        }
    }
}

fn variables(alpha: f64, mu: f64) -> [f64; 2] {
    [ops::log(alpha), ops::log(mu / (1.6 - mu))]
}

/// alpha and mu of the variables; rounding does not carry them beyond 1.
fn physical([x, y]: [f64; 2]) -> [f64; 2] {
    let ratio = ops::exp(y);
    [ops::exp(x).min(1.0), (1.6 * ratio / (1.0 + ratio)).min(1.0)]
}

impl Integrals {
    /// How many.
    fn count(&self) -> usize {
        1 + usize::from(self.split)
    }

    /// E and B, or E and 0.
    fn at(&self, place: [f64; 2]) -> [f64; 2] {
        let [alpha, mu] = physical(place);
        if !self.split {
            return [albedo(self.smith, alpha, mu, &self.effort.outer), 0.0];
        }
        let (e, b) = split(self.smith, alpha, mu, &self.effort);
        [e, b]
    }
}

/// The patches of a rectangle.
fn grown(integrals: &Integrals, over: Rectangle) -> Result<Tree, IntegrateError> {
    let sides = [0, 1].map(|axis| over.high[axis] - over.low[axis]);
    let longer = usize::from(sides[1] > sides[0]);
    let axis = if sides[longer] > LONGEST {
        longer
    } else {
        let patch = Patch::new(integrals, over);
        let off = patch.checked(integrals);
        if off <= CHECKED {
            return Ok(Tree::Patch(Box::new(patch)));
        }
        let axis = patch.slower();
        if sides[axis].is_nan() || sides[axis] < SHORTEST || off.is_nan() {
            let [alpha, mu] = physical(over.low);
            return Err(IntegrateError::Tolerance {
                quantity: "ggx-reflection",
                place: format!("alpha = {alpha:?}, mu = {mu:?}"),
                reached: off,
                tolerance: CHECKED,
            });
        }
        axis
    };
    let at = 0.5 * (over.low[axis] + over.high[axis]);
    let (mut below, mut above) = (over, over);
    (below.high[axis], above.low[axis]) = (at, at);
    let (below, above) = rayon::join(|| grown(integrals, below), || grown(integrals, above));
    Ok(Tree::Cut { axis, at, halves: Box::new([below?, above?]) })
}

impl Rectangle {
    /// The place at coordinates in a square of side 2.
    fn place(&self, unit: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| {
            let (low, high) = (self.low[k], self.high[k]);
            (0.5 * (low + high) + 0.5 * (high - low) * unit[k]).clamp(low, high)
        })
    }
}

/// The i-th of the zeros of the Chebyshev polynomial of degree [`NODES`], as an angle.
fn angle(i: usize) -> f64 {
    PI * (i as f64 + 0.5) / NODES as f64
}

impl Patch {
    fn new(integrals: &Integrals, over: Rectangle) -> Patch {
        let node =
            |i: usize| integrals.at(over.place([ops::cos(angle(i % NODES)), ops::cos(angle(i / NODES))]));
        let values: Vec<[f64; 2]> = (0..NODES * NODES).into_par_iter().map(node).collect();
        let cosines: [[f64; NODES]; NODES] =
            std::array::from_fn(|term| std::array::from_fn(|node| ops::cos(term as f64 * angle(node))));
        let series = |k: usize| {
            let along_x: Series =
                std::array::from_fn(|row| transformed(&cosines, |column| values[row * NODES + column][k]));
            let mut out = [[0.0; NODES]; NODES];
            for term in 0..NODES {
                let column = transformed(&cosines, |row| along_x[row][term]);
                (0..NODES).for_each(|row| out[row][term] = column[row]);
            }
            out
        };
        Patch { over, series: (0..integrals.count()).map(series).collect() }
    }

    fn at(&self, place: [f64; 2]) -> (f64, f64) {
        let unit = [0, 1].map(|k| {
            let (low, high) = (self.over.low[k], self.over.high[k]);
            if high > low { (2.0 * place[k] - low - high) / (high - low) } else { 0.0 }
        });
        let [x, y] = unit.map(polynomials);
        let sum = |series: &Series| {
            let mut along_x = [0.0; NODES];
            for (row, weight) in series.iter().zip(&y) {
                for i in 0..NODES {
                    along_x[i] += weight * row[i];
                }
            }
            along_x.iter().zip(&x).map(|(term, t)| term * t).sum::<f64>()
        };
        (sum(&self.series[0]), self.series.get(1).map_or(f64::NAN, sum))
    }

    /// Largest difference from the integrals at the points that are checked.
    fn checked(&self, integrals: &Integrals) -> f64 {
        let off = |unit: &[f64; 2]| {
            let place = self.over.place(*unit);
            let ((e, b), [of_e, of_b]) = (self.at(place), integrals.at(place));
            let off_b = if integrals.split { (b - of_b).abs() } else { 0.0 };
            if of_e.is_finite() && of_b.is_finite() { (e - of_e).abs().max(off_b) } else { f64::NAN }
        };
        let all: Vec<f64> = CHECKS.par_iter().map(off).collect();
        all.into_iter().fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
    }

    /// The variable whose last two terms are larger.
    fn slower(&self) -> usize {
        let mut tails = [0.0; 2];
        for series in &self.series {
            for i in 0..NODES {
                for last in [NODES - 2, NODES - 1] {
                    tails[0] += series[i][last].abs();
                    tails[1] += series[last][i].abs();
                }
            }
        }
        usize::from(tails[1] > tails[0])
    }
}

/// Chebyshev coefficients from values at the nodes.
fn transformed(cosines: &[[f64; NODES]; NODES], value: impl Fn(usize) -> f64) -> [f64; NODES] {
    std::array::from_fn(|term| {
        let sum: f64 = (0..NODES).map(|node| value(node) * cosines[term][node]).sum();
        sum * if term == 0 { 1.0 } else { 2.0 } / NODES as f64
    })
}

/// The Chebyshev polynomials at t.
fn polynomials(t: f64) -> [f64; NODES] {
    let mut out = [1.0; NODES];
    out[1] = t;
    for i in 2..NODES {
        out[i] = 2.0 * t * out[i - 1] - out[i - 2];
    }
    out
}
