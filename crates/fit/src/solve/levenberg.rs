//! A formula's coefficients from one start: least squares, or another p-norm.

use super::fitted::SecondOrder;
use super::marquardt::{Halt, Least, Limits, NEARLY_ORTHOGONAL, ORTHOGONAL, Squares, least};
use super::objective::{Linear, Objective, Refused, largest, rms};
use super::power::{Model, PNorm};
use super::reduce::Triangle;
use super::route::is_zero;
use crate::FitError;

/// A search that comes to a halt with residuals this much of the targets times 1e-14 has reproduced
/// them: rounding hides the rest.
const NEARLY_ZERO: f64 = 0.01;

/// Trials of larger damping before an iteration gives up.
const TRIALS: usize = 40;

/// Undamped steps at the end of a search.
const POLISHES: usize = 3;

/// Rounding of a norm.
const ROUNDING: f64 = 1e-14;

/// How a least-squares search has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    Minimum {
        cosine: f64,
    },
    Zero,
    Stalled {
        cosine: f64,
    },
    Cap,
    /// First-order conditions hold, and there is lower ground beside it.
    Saddle,
}

/// The outcome of one search.
#[derive(Clone, Debug)]
pub(super) struct Search {
    pub coefficients: Vec<f64>,
    /// The norm that was minimised.
    pub value: f64,
    pub rms: f64,
    pub max: f64,
    pub end: End,
    pub rank: usize,
    /// Lengths of the Jacobian's columns.
    pub norms: Vec<f64>,
    pub evaluations: u64,
    /// What [`super::escape`] has found beside the end; before it, `Unused`.
    pub second_order: SecondOrder,
}

/// Searches from one start.
///
/// # Errors
/// Within: the start is refused. Without: the driver fails.
pub(super) fn search(
    objective: &Objective,
    start: &[f64],
    norm: PNorm,
    iterations: u64,
) -> Result<Result<Search, Refused>, FitError> {
    if let Err(refused) = objective.linearise(start) {
        return Ok(Err(refused));
    }
    let limits = Limits { iterations, trials: TRIALS, longest: f64::INFINITY, settled: None };
    let Least { at: coefficients, halt, evaluations, .. } =
        least(&Normed { objective, norm }, start, limits)?;
    // The driver's reason to end says nothing of convergence: look again at where it ended.
    let linear = match objective.linearise(&coefficients) {
        Ok(linear) => linear,
        Err(refused) => return Ok(Err(refused)),
    };
    let (coefficients, linear, cosine) = polished(objective, norm, coefficients, linear);
    let end = if is_zero(objective, rms(&linear.residuals)) {
        End::Zero
    } else if cosine <= NEARLY_ORTHOGONAL {
        End::Minimum { cosine }
    } else if is_zero(objective, NEARLY_ZERO * rms(&linear.residuals)) {
        End::Zero
    } else if halt == Halt::Cap {
        End::Cap
    } else {
        End::Stalled { cosine }
    };
    let (rank, norms) = (linear.triangle.rank(), linear.triangle.column_norms());
    let residuals = &linear.residuals;
    let (value, rms, max) = (norm.of(residuals), rms(residuals), largest(residuals));
    let second_order = SecondOrder::Unused;
    Ok(Ok(Search { coefficients, value, rms, max, end, rank, norms, evaluations, second_order }))
}

/// Undamped steps from a halt beside a minimum, as long as each makes the residuals more
/// orthogonal: there the norm is flat to rounding, so that its differences no longer tell which way
/// is down, and the gradient still does.
fn polished(objective: &Objective, norm: PNorm, start: Vec<f64>, linear: Linear) -> (Vec<f64>, Linear, f64) {
    let mut best = (start, linear);
    let mut model = norm.model(&best.1).triangle;
    let mut cosine = model.orthogonality();
    for _ in 0..POLISHES {
        if cosine > NEARLY_ORTHOGONAL || cosine <= ORTHOGONAL {
            break;
        }
        let Some(step) = model.step(&model.column_norms(), 0.0) else { break };
        let next: Vec<f64> = best.0.iter().zip(&step).map(|(p, d)| p + d).collect();
        let Ok(linear) = objective.linearise(&next) else { break };
        let triangle = norm.model(&linear).triangle;
        let flat = norm.of(&linear.residuals) <= norm.of(&best.1.residuals) * (1.0 + ROUNDING);
        if !flat || triangle.orthogonality() >= cosine {
            break;
        }
        (best, model) = ((next, linear), triangle);
        cosine = model.orthogonality();
    }
    (best.0, best.1, cosine)
}

/// Residuals in a norm.
struct Normed<'a, 'b> {
    objective: &'a Objective<'b>,
    norm: PNorm,
}

/// The quadratic model of the norm's powers, and the root mean square of the residuals.
struct Local {
    model: Model,
    rms: f64,
}

impl Squares for Normed<'_, '_> {
    type Point = Vec<f64>;
    type Model = Local;

    fn point(&self, at: &[f64]) -> Option<Vec<f64>> {
        self.objective.residuals(at).ok()
    }

    fn value(&self, residuals: &Vec<f64>) -> f64 {
        self.norm.of(residuals)
    }

    fn model(&self, at: &[f64], _: &Vec<f64>) -> Result<Local, String> {
        let linear = self.objective.linearise(at);
        let linear = linear.map_err(|refused| format!("sample {} is not finite", refused.sample))?;
        Ok(Local { model: self.norm.model(&linear), rms: rms(&linear.residuals) })
    }

    fn triangle<'a>(&self, local: &'a Local) -> &'a Triangle {
        &local.model.triangle
    }

    fn gain(&self, local: &Local, residuals: &Vec<f64>, step: &[f64]) -> (f64, f64) {
        self.norm.gain(&local.model, residuals, step)
    }

    fn is_zero(&self, local: &Local) -> bool {
        is_zero(self.objective, local.rms)
    }
}
