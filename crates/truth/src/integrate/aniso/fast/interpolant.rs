//! E over a box of mu, alpha and aspect: its mean over the azimuth of the view, or at any azimuth.
//!
//! Over the azimuth E is a series in cos(2 k b), tan(phi) = sqrt(alpha_x/alpha_y) tan(b). The swap
//! of the axes turns b into pi/2 - b and changes the sign of the anisotropy's variable, so a
//! coefficient is even or odd in it as k is: the odd ones are divided by it, and all are
//! interpolated in its square, over nodes that leave out 0. The mean is even.

use rayon::prelude::*;

use super::axes::{self, Cosine};
use super::azimuth;
use super::barycentric::Nodes;
use super::cells::Ranges;
use super::{Digits, dispatch, rules};
use crate::integrate::Path;
use crate::optics::Smith;
use lobefit_math::ops;

/// An interpolant of E, F = 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Interpolant {
    cosine: Cosine,
    mus: Nodes,
    /// Over ln(alpha), alpha = sqrt(alpha_x alpha_y).
    alphas: Nodes,
    /// Over the square of the anisotropy's variable.
    squares: Nodes,
    /// Coefficients in cos(2 k b), k fastest, then mu, alpha, anisotropy; the mean alone where that
    /// is what is asked for.
    coefficients: Vec<f64>,
    harmonics: usize,
}

/// alpha_x and alpha_y, mu, and the anisotropy's variable.
type Node = ([f64; 2], f64, f64);

/// [`Interpolant`] at one alpha_x and alpha_y: for many mu and phi.
pub(super) struct Pinned<'a> {
    whole: &'a Interpolant,
    /// Root of the ratio of the wide axis to the narrow one.
    root: f64,
    swapped: bool,
    /// Coefficients, k fastest, then mu.
    coefficients: Vec<f64>,
}

impl Interpolant {
    /// The nodes over a box, without values.
    pub(super) fn over(ranges: &Ranges, azimuth: bool, digits: f64) -> Interpolant {
        let cosine = Cosine::from(ranges.mu[0]);
        let most = ranges.square[1].sqrt();
        let squares =
            if azimuth { axes::leans_without_zero(most, digits) } else { axes::leans(ranges.square, digits) };
        let aspect = axes::aspect(most);
        let harmonics = if azimuth { rules::harmonics([aspect, 1.0 / aspect], digits) } else { 1 };
        Interpolant {
            cosine,
            mus: axes::cosines(cosine, ranges.mu, digits),
            alphas: axes::alphas(ranges.log_alpha, digits),
            squares,
            coefficients: Vec::new(),
            harmonics,
        }
    }

    /// Integrals over the light that its values take.
    pub(super) fn integrals(&self) -> usize {
        self.mus.at().len() * self.alphas.at().len() * self.squares.at().len() * self.harmonics
    }

    /// The interpolant with its values, and the evaluations that they took.
    pub(super) fn made(
        self,
        path: Path,
        smith: Smith,
        ranges: &Ranges,
        digits: Digits,
    ) -> (Interpolant, u64) {
        let [low, high] = ranges.mu;
        let mut places = Vec::new();
        for square in self.squares.at() {
            let lean = square.sqrt();
            let aspect = axes::aspect(-lean);
            for log in self.alphas.at() {
                let alpha = ops::exp(*log);
                // The ends are nodes; rounding must not carry them out of the range.
                let mus = self.mus.at().iter().map(|u| self.cosine.mu(*u).clamp(low, high));
                places.extend(mus.map(|mu| ([alpha / aspect, alpha * aspect], mu, lean)));
            }
        }
        let node = |(alpha, mu, lean): &Node| match digits.azimuth {
            true => self.series(path, smith, (*alpha, *mu, *lean), digits.integrals),
            false => {
                let mean = azimuth::mean(path, smith, *alpha, *mu, digits.integrals);
                (vec![mean.value], mean.evaluations)
            }
        };
        let all: Vec<(Vec<f64>, u64)> = places.par_iter().map(node).collect();
        let evaluations = all.iter().map(|(_, count)| count).sum();
        let coefficients = all.into_iter().flat_map(|(series, _)| series).collect();
        (Interpolant { coefficients, ..self }, evaluations)
    }

    /// The series over the azimuth, the odd coefficients divided by the anisotropy's variable.
    fn series(&self, path: Path, smith: Smith, (alpha, mu, lean): Node, digits: f64) -> (Vec<f64>, u64) {
        let (values, evaluations) = azimuth::values(path, smith, alpha, mu, digits, self.harmonics);
        let mut series = azimuth::coefficients(&values);
        series.iter_mut().skip(1).step_by(2).for_each(|odd| *odd /= lean);
        (series, evaluations)
    }

    /// The interpolant at one alpha_x and alpha_y of its box.
    pub(super) fn pinned(&self, [x, y]: [f64; 2]) -> Pinned<'_> {
        let aspect = (y / x).sqrt();
        let lean = axes::lean(aspect).abs();
        let mut weights = Vec::new();
        let over_alpha = self.alphas.weights(ops::log((x * y).sqrt()));
        for over_lean in self.squares.weights(lean * lean) {
            weights.extend(over_alpha.iter().map(|weight| over_lean * weight));
        }
        let mut coefficients = vec![0.0; self.harmonics * self.mus.at().len()];
        dispatch::combine(&weights, &self.coefficients, &mut coefficients);
        for line in coefficients.chunks_mut(self.harmonics) {
            line.iter_mut().skip(1).step_by(2).for_each(|odd| *odd *= lean);
        }
        let swapped = aspect > 1.0;
        Pinned { whole: self, swapped, root: if swapped { aspect } else { 1.0 / aspect }, coefficients }
    }
}

impl Pinned<'_> {
    /// E at a cosine and an azimuth; of a mean the azimuth is not looked at.
    pub(super) fn at(&self, mu: f64, phi: f64) -> f64 {
        let weights = self.whole.mus.weights(self.whole.cosine.of(mu));
        let mut cosines = vec![1.0; self.whole.harmonics];
        if self.whole.harmonics > 1 {
            let (mut y, mut x) = ops::sincos(phi);
            if self.swapped {
                (x, y) = (y, x);
            }
            let twice = 2.0 * azimuth::cos_2b(self.root, [x, y]);
            let (mut before, mut cosine) = (1.0, 0.5 * twice);
            for slot in cosines.iter_mut().skip(1) {
                *slot = cosine;
                (before, cosine) = (cosine, twice * cosine - before);
            }
        }
        let lines = self.coefficients.chunks(self.whole.harmonics);
        let line = |line: &[f64]| line.iter().zip(&cosines).map(|(a, b)| a * b).sum::<f64>();
        weights.iter().zip(lines).map(|(weight, coefficients)| weight * line(coefficients)).sum()
    }
}
