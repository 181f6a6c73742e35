//! E of the anisotropic reflection lobe, F = 1, at hundreds of thousands of points: its mean over
//! the azimuth of the view, or at any azimuth.
//!
//! Points near each other share an interpolant (`cells`, `interpolant`), whose nodes are integrated
//! by a rule of their own (`kernel`), in microseconds where the truth takes milliseconds; a sample
//! of the points is integrated directly, with more nodes.

mod axes;
mod azimuth;
mod barycentric;
mod cells;
mod dispatch;
mod interpolant;
mod kernel;
mod rules;

use rayon::prelude::*;

use crate::integrate::{IntegrateError, Path, aniso};
use crate::optics::Smith;
pub use azimuth::Work;
use cells::{Cell, Ranges};
use interpolant::Interpolant;

/// Digits beyond those asked for, tried in turn until the checked points keep the tolerance: of the
/// mean, and at an azimuth. The last are for points at grazing mu whose alpha is about 1.
const LADDERS: [&[f64]; 2] = [&[0.0, 0.6, 1.2, 1.8, 2.4], &[0.4, 0.8, 1.4]];

/// Digits of a node's integral beyond the interpolant's, of the mean and at an azimuth.
const NODE_DIGITS: [f64; 2] = [0.5, 0.0];

/// Digits of the direct integration beyond the interpolant's.
const CHECK_DIGITS: f64 = 1.5;

/// Ranges of mu and of sqrt(alpha_y/alpha_x).
const MU: [f64; 2] = [1e-4, 1.0];
const ASPECT: [f64; 2] = [0.1, 10.0];

/// A point of the lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// alpha_x and alpha_y.
    pub alpha: [f64; 2],
    /// Cosine of the view.
    pub mu: f64,
    /// Azimuth of the view from the alpha_x axis, radians; `None` for the mean over it.
    pub phi: Option<f64>,
}

/// What is integrated, and how many digits it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Digits {
    azimuth: bool,
    nodes: f64,
    integrals: f64,
}

/// E at points.
#[derive(Clone, Debug, PartialEq)]
pub struct Many {
    /// E of each.
    pub e: Vec<f64>,
    /// Largest difference at the points that were integrated directly.
    pub worst: f64,
    /// How many those are.
    pub checked: usize,
    /// Integrand evaluations, those of the checks included.
    pub evaluations: u64,
    /// What the values were read off.
    pub interpolants: Interpolants,
}

/// The interpolants over the boxes of points, for other points of the same boxes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interpolants {
    boxes: Vec<(Ranges, Interpolant)>,
}

impl Interpolants {
    /// E at a place, at its azimuth or in the mean over it as at the points that the boxes are of;
    /// `None` outside the boxes. As good as at those points: a sample of them was checked.
    pub fn at(&self, place: &Place) -> Option<f64> {
        let (_, interpolant) = self.boxes.iter().find(|(ranges, _)| ranges.hold(place))?;
        Some(interpolant.pinned(place.alpha).at(place.mu, place.phi.unwrap_or(0.0)))
    }
}

impl Place {
    /// Whether [`many`] takes it: alpha_x and alpha_y in [1e-4, 4], no more than 1:100 apart, mu in
    /// [1e-4, 1].
    pub fn is_covered(&self) -> bool {
        let within = |x: f64, [low, high]: [f64; 2]| (low..=high).contains(&x);
        let [x, y] = self.alpha;
        within(x, aniso::ALPHA)
            && within(y, aniso::ALPHA)
            && within((y / x).sqrt(), ASPECT)
            && within(self.mu, MU)
            && self.phi.is_none_or(f64::is_finite)
    }

    /// E by one rule; its error is not bounded.
    fn direct(&self, path: Path, smith: Smith, digits: f64) -> Work {
        match self.phi {
            Some(phi) => azimuth::at(path, smith, self.alpha, self.mu, phi, digits),
            None => azimuth::mean(path, smith, self.alpha, self.mu, digits),
        }
    }
}

/// E at points that are covered, all with an azimuth or all without, to an absolute `tolerance` in
/// [1e-10, 1e-2]. The node counts are fitted down to 1e-7; where alpha and mu are both near 1e-4,
/// down to 1e-5 at an azimuth.
///
/// # Errors
/// A checked point that misses the tolerance even with more nodes.
pub fn many(path: Path, smith: Smith, places: &[Place], tolerance: f64) -> Result<Many, IntegrateError> {
    let azimuth = places.first().is_some_and(|place| place.phi.is_some());
    let which = usize::from(azimuth);
    let asked = digits_of(tolerance);
    let cells = cells::cells(places);
    let checked = cells::checked(places, &cells);
    let (mut evaluations, mut reached) = (0, f64::INFINITY);
    for more in LADDERS[which] {
        let nodes = asked + more;
        let digits = Digits { azimuth, nodes, integrals: nodes + NODE_DIGITS[which] };
        let (e, taken, interpolants) = values(path, smith, places, &cells, digits);
        let again = |i: &usize| places[*i].direct(path, smith, nodes + CHECK_DIGITS);
        let direct: Vec<Work> = checked.par_iter().map(again).collect();
        evaluations += taken + direct.iter().map(|work| work.evaluations).sum::<u64>();
        let off = checked.iter().zip(&direct).map(|(i, work)| (e[*i] - work.value).abs());
        // A difference that is not a number is the worst, whatever follows it.
        reached = off.fold(0.0, |worst, x| if x > worst || f64::is_nan(x) { x } else { worst });
        if reached <= tolerance {
            return Ok(Many { e, worst: reached, checked: checked.len(), evaluations, interpolants });
        }
    }
    let place = format!("{} points", places.len());
    Err(IntegrateError::Tolerance { quantity: aniso::QUANTITY, place, reached, tolerance })
}

/// E at all points, the evaluations that they took, and the interpolants of the cells that have one.
fn values(
    path: Path,
    smith: Smith,
    places: &[Place],
    cells: &[Cell],
    digits: Digits,
) -> (Vec<f64>, u64, Interpolants) {
    let (mut e, mut evaluations) = (vec![f64::NAN; places.len()], 0);
    let mut boxes = Vec::new();
    for cell in cells {
        let interpolant = Interpolant::over(&cell.ranges, digits.azimuth, digits.nodes);
        if interpolant.integrals() >= cell.points.len() {
            let one = |i: &usize| places[*i].direct(path, smith, digits.integrals);
            let all: Vec<Work> = cell.points.par_iter().map(one).collect();
            evaluations += all.iter().map(|work| work.evaluations).sum::<u64>();
            cell.points.iter().zip(all).for_each(|(i, work)| e[*i] = work.value);
            continue;
        }
        let (interpolant, taken) = interpolant.made(path, smith, &cell.ranges, digits);
        evaluations += taken;
        let surfaces: Vec<&[usize]> =
            cell.points.chunk_by(|a, b| places[*a].alpha == places[*b].alpha).collect();
        let line = |points: &&[usize]| -> Vec<f64> {
            let pinned = interpolant.pinned(places[points[0]].alpha);
            points.iter().map(|i| pinned.at(places[*i].mu, places[*i].phi.unwrap_or(0.0))).collect()
        };
        let lines: Vec<Vec<f64>> = surfaces.par_iter().map(line).collect();
        for (points, line) in surfaces.iter().zip(lines) {
            points.iter().zip(line).for_each(|(i, value)| e[*i] = value);
        }
        boxes.push((cell.ranges, interpolant));
    }
    (e, evaluations, Interpolants { boxes })
}

/// E at a point that is covered, by the rule of the nodes. `tolerance` sets the node counts and is
/// kept in most places, without a bound: [`super::aniso`] has one.
///
/// # Errors
/// A point that is not covered.
pub fn one(path: Path, smith: Smith, place: &Place, tolerance: f64) -> Result<Work, IntegrateError> {
    aniso::check(aniso::QUANTITY, place.alpha, place.mu, place.phi)?;
    let domain = "is below 1e-4, or alpha_x and alpha_y are too far apart";
    IntegrateError::outside(aniso::QUANTITY, [("mu", place.mu, place.is_covered(), domain)])?;
    Ok(place.direct(path, smith, digits_of(tolerance)))
}

fn digits_of(tolerance: f64) -> f64 {
    -lobefit_math::ops::log(tolerance.clamp(1e-10, 1e-2)) / std::f64::consts::LN_10
}
