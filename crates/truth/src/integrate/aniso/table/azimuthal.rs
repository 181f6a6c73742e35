//! E at any azimuth of the view, from an interpolant over mu, alpha, aspect and azimuth: for
//! millions of points.
//!
//! Over the azimuth E is a series in cos(2 k b), tan(phi) = sqrt(alpha_x/alpha_y) tan(b). The swap
//! of the axes turns b into pi/2 - b and changes the sign of the anisotropy's variable, so a
//! coefficient is even or odd in it as k is: the odd ones are divided by it, and all are
//! interpolated in its square, over nodes that leave out 0.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::axes::{self, Cosine};
use super::azimuth;
use super::barycentric::Nodes;
use super::dispatch;
use super::grid::{self, ASPECT, MU};
use super::rules;
use crate::integrate::Path;
use crate::integrate::{IntegrateError, aniso};
use crate::optics::Smith;
use lobefit_math::ops;

/// Digits beyond those asked for, tried in turn until the checked points keep the tolerance.
/// Without the mean over the azimuth, the interpolants err more than a table's.
const LADDER: [f64; 3] = [0.4, 0.8, 1.4];

/// Digits of the direct integration beyond the interpolant's.
const CHECK_DIGITS: f64 = 1.0;

/// Points drawn for the check.
pub const POINTS: usize = 2000;

/// Seed of the draw.
const SEED: u64 = 0x617a_696d_7574_6861;

/// An interpolant of E, F = 1.
#[derive(Clone, Debug)]
pub struct Azimuthal {
    cosine: Cosine,
    mus: Nodes,
    alphas: Nodes,
    squares: Nodes,
    /// Coefficients in cos(2 k b), k fastest, then mu, alpha, anisotropy.
    coefficients: Vec<f64>,
    harmonics: usize,
    /// Ranges of mu, alpha and aspect (with 1/aspect).
    ranges: [[f64; 2]; 3],
    evaluations: u64,
    worst: f64,
}

/// [`Azimuthal`] at one alpha and one aspect: for many mu and phi.
#[derive(Clone, Debug)]
pub struct Pinned<'a> {
    whole: &'a Azimuthal,
    swapped: bool,
    root: f64,
    /// Coefficients, k fastest, then mu.
    coefficients: Vec<f64>,
}

impl Azimuthal {
    /// The interpolant for alpha = sqrt(alpha_x alpha_y) and aspect = sqrt(alpha_y/alpha_x) in
    /// ranges, low end first; aspects and their inverses are both in it. alpha_x, alpha_y in [1e-4,
    /// 4], aspect in [0.1, 10], mu in [1e-4, 1].
    ///
    /// Errors: a range outside its domain; one of the points integrated directly, with more nodes,
    /// misses the `tolerance`, which lies in [1e-10, 1e-2]; it is made for 1e-5 and reaches 1e-6.
    pub fn new(
        smith: Smith,
        alpha_range: [f64; 2],
        aspect_range: [f64; 2],
        mu_range: [f64; 2],
        tolerance: f64,
    ) -> Result<Azimuthal, IntegrateError> {
        let digits = grid::digits(tolerance)?;
        let ranges = [mu_range, alpha_range, check(alpha_range, aspect_range, mu_range)?];
        let (mut evaluations, mut reached) = (0, f64::INFINITY);
        for more in LADDER {
            let mut tried = Azimuthal::build(smith, ranges, digits + more);
            let (worst, taken) = tried.check(smith, digits + more);
            evaluations += tried.evaluations + taken;
            reached = worst;
            if reached <= tolerance {
                (tried.evaluations, tried.worst) = (evaluations, reached);
                return Ok(tried);
            }
        }
        let place = format!("alpha in {alpha_range:?}, aspect in {aspect_range:?}, mu in {mu_range:?}");
        Err(IntegrateError::Tolerance { quantity: aniso::QUANTITY, place, reached, tolerance })
    }

    fn build(smith: Smith, ranges: [[f64; 2]; 3], digits: f64) -> Azimuthal {
        let [mu_range, alpha_range, [_, most]] = ranges;
        let cosine = Cosine::from(mu_range[0]);
        let mus = axes::cosines(cosine, mu_range, digits);
        let alphas = axes::alphas(alpha_range.map(ops::log), digits);
        let squares = axes::leans_without_zero(axes::lean(most), digits);
        let harmonics = rules::harmonics([most, 1.0 / most], digits);
        let mut places = Vec::new();
        for square in squares.at() {
            let lean = square.sqrt();
            let aspect = axes::aspect(-lean);
            for log in alphas.at() {
                let alpha = ops::exp(*log).clamp(alpha_range[0], alpha_range[1]);
                places.extend(mus.at().iter().map(|u| {
                    let mu = cosine.mu(*u).clamp(mu_range[0], mu_range[1]);
                    ([alpha / aspect, alpha * aspect], mu, lean)
                }));
            }
        }
        let series: Vec<(Vec<f64>, u64)> = places
            .par_iter()
            .map(|(alpha, mu, lean)| {
                let (values, evaluations) =
                    azimuth::values(Path::Best, smith, *alpha, *mu, digits, harmonics);
                let mut series = azimuth::coefficients(&values);
                for odd in series.iter_mut().skip(1).step_by(2) {
                    *odd /= lean;
                }
                (series, evaluations)
            })
            .collect();
        let evaluations = series.iter().map(|(_, count)| count).sum();
        let coefficients = series.into_iter().flat_map(|(series, _)| series).collect();
        let worst = f64::INFINITY;
        Azimuthal { cosine, mus, alphas, squares, coefficients, harmonics, ranges, evaluations, worst }
    }

    /// Worst difference from direct integration at the points checked: [`POINTS`] seeded random
    /// ones of the ranges, and the corners.
    pub fn worst(&self) -> f64 {
        self.worst
    }

    /// Integrand evaluations that the interpolant took, those of a first try that missed the
    /// tolerance and the checks included.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// E at a point of the ranges; phi from the alpha_x axis, radians. NaN outside the ranges.
    pub fn at(&self, mu: f64, phi: f64, alpha: f64, aspect: f64) -> f64 {
        self.pinned(alpha, aspect).at(mu, phi)
    }

    /// The interpolant at one alpha and one aspect.
    pub fn pinned(&self, alpha: f64, aspect: f64) -> Pinned<'_> {
        let lean = axes::lean(aspect).abs();
        let stride = self.harmonics * self.mus.at().len();
        let mut weights = Vec::new();
        let over_alpha = self.alphas.weights(ops::log(alpha));
        for over_lean in self.squares.weights(lean * lean) {
            weights.extend(over_alpha.iter().map(|weight| over_lean * weight));
        }
        let mut coefficients = vec![0.0; stride];
        dispatch::combine(&weights, &self.coefficients, &mut coefficients);
        for line in coefficients.chunks_mut(self.harmonics) {
            for odd in line.iter_mut().skip(1).step_by(2) {
                *odd *= lean;
            }
        }
        let inside = within(alpha, self.ranges[1]) && within(aspect, self.ranges[2]);
        if !inside {
            coefficients.fill(f64::NAN);
        }
        let swapped = aspect > 1.0;
        Pinned { whole: self, swapped, root: if swapped { aspect } else { 1.0 / aspect }, coefficients }
    }

    /// Worst difference at the points checked, and the evaluations that they took.
    fn check(&self, smith: Smith, digits: f64) -> (f64, u64) {
        let mut random = Pcg64::seed_from_u64(SEED);
        let mut places: Vec<[f64; 4]> = (0..POINTS).map(|_| [(); 4].map(|()| random.random())).collect();
        places.extend((0..16).map(|corner| [0, 1, 2, 3].map(|bit| f64::from(corner >> bit & 1))));
        let between = |[low, high]: [f64; 2], u: f64| {
            ops::exp(ops::log(low) + u * (ops::log(high) - ops::log(low))).clamp(low, high)
        };
        let differences: Vec<(f64, u64)> = places
            .par_iter()
            .map(|u| {
                let [mu, alpha, aspect] = [0, 1, 2].map(|k| between(self.ranges[k], u[k]));
                let phi = std::f64::consts::FRAC_PI_2 * u[3];
                let pair = [alpha / aspect, alpha * aspect];
                let direct = azimuth::at(Path::Best, smith, pair, mu, phi, digits + CHECK_DIGITS);
                ((self.at(mu, phi, alpha, aspect) - direct.value).abs(), direct.evaluations)
            })
            .collect();
        let evaluations = differences.iter().map(|(_, n)| n).sum();
        // A difference that is not a number is the worst, whatever follows it.
        let worse = |worst: f64, (x, _)| if x > worst || f64::is_nan(x) { x } else { worst };
        (differences.into_iter().fold(0.0, worse), evaluations)
    }
}

impl Pinned<'_> {
    /// E at a cosine and an azimuth; NaN outside the ranges.
    pub fn at(&self, mu: f64, phi: f64) -> f64 {
        if !within(mu, self.whole.ranges[0]) {
            return f64::NAN;
        }
        let (mut y, mut x) = ops::sincos(phi);
        if self.swapped {
            (x, y) = (y, x);
        }
        let twice = 2.0 * azimuth::cos_2b(self.root, [x, y]);
        let weights = self.whole.mus.weights(self.whole.cosine.of(mu));
        let mut cosines = vec![1.0; self.whole.harmonics];
        let (mut before, mut cosine) = (1.0, 0.5 * twice);
        for slot in cosines.iter_mut().skip(1) {
            *slot = cosine;
            (before, cosine) = (cosine, twice * cosine - before);
        }
        let lines = self.coefficients.chunks(self.whole.harmonics);
        let line = |line: &[f64]| line.iter().zip(&cosines).map(|(a, b)| a * b).sum::<f64>();
        weights.iter().zip(lines).map(|(weight, coefficients)| weight * line(coefficients)).sum()
    }
}

fn within(x: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&x)
}

/// Refuses ranges outside the kernel's domain; else the aspects and their inverses. The ends given
/// lie in that range as they are: the inverse of an inverse need not be the number it was made
/// from.
fn check(alpha: [f64; 2], aspect: [f64; 2], mu: [f64; 2]) -> Result<[f64; 2], IntegrateError> {
    for (input, range, whole, says) in [
        ("alpha", alpha, aniso::ALPHA, "is not in [1e-4, 4] or not a range"),
        ("aspect", aspect, ASPECT, "is not in [0.1, 10] or not a range"),
        ("mu", mu, MU, "is not in [1e-4, 1] or not a range"),
    ] {
        for value in range {
            if !(within(value, whole) && range[0] <= range[1]) {
                return Err(grid::domain(input, value, says));
            }
        }
    }
    let both = [aspect[0].min(1.0 / aspect[1]), aspect[1].max(1.0 / aspect[0])];
    grid::check_alpha("alpha_x", alpha[1] * both[1])?;
    grid::check_alpha("alpha_y", alpha[0] * both[0])?;
    Ok(both)
}
