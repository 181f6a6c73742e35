//! What a fit for the scene's f0 is worth at every other.

use super::CouplingSpec;
use crate::effects::reflection::{Counter, Fit, FitStageError};
use crate::effects::target::Target;
use crate::fit::{measure, round_up};
use crate::math::chebyshev;

/// The error of a fit over all f0 in [0, 1], and where the largest is.
#[derive(Clone, Debug, PartialEq)]
pub struct AnyF0 {
    /// Largest error of the factor.
    pub max: f64,
    /// Where it is.
    pub at: crate::data::Place,
}

/// Nodes per axis of roughness and mu, and values of f0: a survey beside the certificate, with a hundredth of its points.
const SIDE: usize = 64;
const F0: usize = 17;

/// The errors of fits and published formulas over f0 in [0, 1], in their order; region and truth as of the spec.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be integrated; a formula that is not finite at some f0.
pub fn anywhere(spec: &CouplingSpec, fits: &[&Fit], counter: &Counter) -> Result<Vec<AnyF0>, FitStageError> {
    let Some(first) = fits.first() else { return Ok(Vec::new()) };
    let target = Target::new(&spec.target([0.0, 1.0]), &first.hypothesis)?;
    let nodes = |[low, high]: [f64; 2]| chebyshev::nodes(low, high, SIDE);
    let (roughness, mu) = (nodes(spec.region.roughness), nodes(spec.region.mu));
    let row = |r: &f64| mu.iter().map(|m| place(&target, *r, *m)).collect::<Vec<_>>();
    let places: Vec<Vec<f64>> = roughness.iter().flat_map(row).collect();
    let f0: Vec<f64> = (0..F0).map(|i| i as f64 / (F0 - 1) as f64).collect();
    counter.add(places.len());
    let sampled = target.at(&places, &f0)?;
    let one = |fit: &&Fit| {
        let inputs = sampled.inputs(fit.hypothesis.name(), fit.hypothesis.inputs())?;
        let error =
            measure(fit.hypothesis.tape(), &fit.coefficients(), &inputs, &sampled.scale, &sampled.target)?;
        Ok(AnyF0 { max: round_up(error.max_abs, 4), at: sampled.points.place(error.worst) })
    };
    fits.iter().map(one).collect()
}

/// The values of the target's axes, in their order.
fn place(target: &Target, roughness: f64, mu: f64) -> Vec<f64> {
    target.axes.iter().map(|axis| if axis.name == "mu" { mu } else { roughness }).collect()
}
