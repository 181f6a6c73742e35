//! What a fit for the scene's f0 is worth at every other.

use super::CouplingSpec;
use crate::approximate::target::{Sampled, Target};
use crate::approximate::{self, Fit, FitStageError, Memo};
use crate::data::Place;
use lobefit_math::chebyshev;
use lobefit_shade::{measure, round_up};

/// The largest error of a factor that was found over all f0 in [0, 1], and where.
#[derive(Clone, Debug, PartialEq)]
pub struct AnyF0 {
    /// Largest error of the factor.
    pub max: f64,
    /// Where it is.
    pub at: Place,
    /// Places of roughness and mu that were looked at.
    pub places: u64,
    /// How f0 was looked at there.
    pub f0: Between,
}

/// What is known of the error between the values of f0 at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// At the values looked at it is a parabola to rounding, whose largest value is taken exactly.
    Bounded,
    /// It is looked at for so many values of f0.
    Sampled(usize),
}

impl Between {
    /// `every f0`, or how many.
    pub fn words(self) -> String {
        match self {
            Between::Bounded => "every f0".into(),
            Between::Sampled(n) => format!("{n} values of f0"),
        }
    }
}

/// Nodes per axis of roughness and mu: a survey beside the certificate, with a hundredth of its points.
const SIDE: usize = 64;

/// Values of f0 from 0 to 1 that errors are looked at for.
pub const F0: usize = 17;

/// An error differs from its parabola in f0 by no more than this where it is one: eight roundings
/// of f32, of values up to 1.
const ROUNDING: f64 = 8.0 * f32::EPSILON as f64;

/// The errors of fits and published formulas over f0 in [0, 1], in their order; region and truth as
/// of the spec. Never below a fit's own certificate, whose place is looked at too.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be integrated; a formula that is
/// not finite at some f0.
pub fn anywhere(spec: &CouplingSpec, fits: &[&Fit], memo: &Memo) -> Result<Vec<AnyF0>, FitStageError> {
    let Some(first) = fits.first() else { return Ok(Vec::new()) };
    let target = Target::new(&spec.target([0.0, 1.0]), &first.hypothesis)?;
    let nodes = |[low, high]: [f64; 2]| chebyshev::nodes(low, high, SIDE);
    let (roughness, mu) = (nodes(spec.region.roughness), nodes(spec.region.mu));
    let row = |r: &f64| mu.iter().map(|m| place(&target, *r, *m)).collect::<Vec<_>>();
    let mut places: Vec<Vec<f64>> = roughness.iter().flat_map(row).collect();
    let worst = |fit: &&Fit| {
        let at = &fit.approximation.certificate.at;
        Some(place(&target, *at.get("roughness")?, *at.get("mu")?))
    };
    places.extend(fits.iter().filter_map(worst));
    let f0: Vec<f64> = (0..F0).map(|i| i as f64 / (F0 - 1) as f64).collect();
    memo.add(places.len());
    let sampled = target.at(&places, &f0)?;
    fits.iter().map(|fit| of_fit(fit, &sampled, places.len())).collect()
}

fn of_fit(fit: &Fit, sampled: &Sampled, places: usize) -> Result<AnyF0, FitStageError> {
    let (tape, coefficients) = (fit.hypothesis.tape(), fit.coefficients());
    let inputs = sampled.inputs(fit.hypothesis.name(), fit.hypothesis.inputs())?;
    // Refuses what is not finite, with the place.
    let largest = measure(tape, &coefficients, &inputs, &sampled.scale, &sampled.target)?;
    let values = tape.evaluate(&inputs, &coefficients)?;
    let errors: Vec<f64> = values.iter().zip(&sampled.target).map(|(v, t)| f64::from(*v) - t).collect();
    let parabolas: Option<Vec<Peak>> = (0..places).map(|i| Peak::of(|k| errors[i + k * places])).collect();
    let certificate = &fit.approximation.certificate;
    let mut any = AnyF0 {
        max: round_up(largest.max_abs, 4),
        at: approximate::place(&sampled.points, largest.worst),
        places: places as u64,
        f0: if parabolas.is_some() { Between::Bounded } else { Between::Sampled(F0) },
    };
    for (i, peak) in parabolas.into_iter().flatten().enumerate() {
        if round_up(peak.error, 4) > any.max {
            any.max = round_up(peak.error, 4);
            any.at = approximate::place(&sampled.points, i);
            any.at.insert("f0".into(), peak.f0);
        }
    }
    if certificate.max_abs > any.max {
        (any.max, any.at) = (certificate.max_abs, certificate.at.clone());
    }
    Ok(any)
}

/// Where a parabola is farthest from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The reflectance at normal incidence.
    pub f0: f64,
    /// Distance from 0 there.
    pub error: f64,
}

impl Peak {
    /// The peak of the errors at [`F0`] even values of f0 from 0 to 1; none if they are no parabola.
    pub fn of(at: impl Fn(usize) -> f64) -> Option<Peak> {
        let (first, middle, last) = (at(0), at(F0 / 2), at(F0 - 1));
        // first + b x + c x^2 through three of them
        let c = 2.0 * (first + last) - 4.0 * middle;
        let b = last - first - c;
        let value = |x: f64| first + x * (b + c * x);
        let is_one = (0..F0).all(|k| (value(k as f64 / (F0 - 1) as f64) - at(k)).abs() <= ROUNDING);
        let vertex = -b / (2.0 * c);
        let candidates = [0.0, 1.0, if (0.0..=1.0).contains(&vertex) { vertex } else { 0.0 }];
        let peaks = candidates.map(|x| Peak { f0: x, error: value(x).abs() });
        let highest = peaks.into_iter().reduce(|a, b| if b.error > a.error { b } else { a });
        highest.filter(|_| is_one)
    }
}

/// The values of the target's axes, in their order.
fn place(target: &Target, roughness: f64, mu: f64) -> Vec<f64> {
    target.axes.iter().map(|axis| if axis.name == "mu" { mu } else { roughness }).collect()
}
