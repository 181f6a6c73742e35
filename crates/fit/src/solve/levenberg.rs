//! Levenberg-Marquardt as an argmin solver: least squares, or another p-norm, from one start.
//!
//! For p > 2 it was preferred to L-BFGS: the weighted problem has the same cost per iteration and converges quadratically, where
//! L-BFGS takes hundreds of evaluations on rational forms and its line search gives up early.

use argmin::core::{
    Error, Executor, IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus,
};

use super::objective::{Linear, Objective, Refused, largest, rms};
use super::power::{Model, PNorm};
use super::route::is_zero;
use crate::FitError;

/// Residuals orthogonal to the Jacobian within this cosine are a minimum.
const ORTHOGONAL: f64 = 1e-10;

/// A minimum that rounding keeps from being sharper than [`ORTHOGONAL`] still counts up to here.
const NEARLY_ORTHOGONAL: f64 = 1e-5;

/// A search that comes to a halt with residuals this much of the targets times 1e-14 has reproduced them: rounding hides the rest.
const NEARLY_ZERO: f64 = 0.01;

/// Trials of larger damping before an iteration gives up.
const TRIALS: usize = 40;

/// Trials at what may be a minimum already: only its last digits are left to gain.
const LAST_TRIALS: usize = 6;

/// Undamped steps at the end of a search.
const POLISHES: usize = 3;

/// Rounding of a norm.
const ROUNDING: f64 = 1e-14;

type LeastSquaresState = IterState<Vec<f64>, (), (), (), (), f64>;

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
    let solver = Marquardt { norm, damping: 1e-3, growth: 2.0, scale: vec![0.0; start.len()] };
    let outcome = Executor::new(objective.clone(), solver)
        .configure(|state: LeastSquaresState| state.param(start.to_vec()).max_iters(iterations))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|e| FitError::Solver { message: e.to_string() })?;
    let evaluations = outcome.problem.counts.values().sum();
    let status = outcome.state.get_termination_status().clone();
    let coefficients = outcome.state.get_best_param().cloned().unwrap_or_else(|| start.to_vec());
    // argmin's Ok, and even its reason, says nothing of convergence: look again at where it ended.
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
    } else if status == TerminationStatus::Terminated(TerminationReason::MaxItersReached) {
        End::Cap
    } else {
        End::Stalled { cosine }
    };
    let (rank, norms) = (linear.triangle.rank(), linear.triangle.column_norms());
    let residuals = &linear.residuals;
    let (value, rms, max) = (norm.of(residuals), rms(residuals), largest(residuals));
    Ok(Ok(Search { coefficients, value, rms, max, end, rank, norms, evaluations }))
}

/// Undamped steps from a halt beside a minimum, as long as each makes the residuals more orthogonal: there the norm is flat to rounding, so
/// that its differences no longer tell which way is down, and the gradient still does.
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

/// Levenberg-Marquardt with Nielsen's damping and Moré's scaling (columns of the largest length seen).
struct Marquardt {
    norm: PNorm,
    damping: f64,
    growth: f64,
    scale: Vec<f64>,
}

/// A refused point, as argmin's error.
fn refuse(refused: Refused) -> Error {
    Error::msg(format!("sample {} is not finite", refused.sample))
}

impl<'a> Solver<Objective<'a>, LeastSquaresState> for Marquardt {
    fn name(&self) -> &str {
        "Levenberg-Marquardt"
    }

    fn init(
        &mut self,
        problem: &mut Problem<Objective<'a>>,
        state: LeastSquaresState,
    ) -> Result<(LeastSquaresState, Option<KV>), Error> {
        let start = state.get_param().cloned().unwrap_or_default();
        let residuals = problem.problem("cost_count", |o| o.residuals(&start).map_err(refuse))?;
        Ok((state.param(start).cost(self.norm.of(&residuals)), None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Objective<'a>>,
        state: LeastSquaresState,
    ) -> Result<(LeastSquaresState, Option<KV>), Error> {
        let at = state.get_param().cloned().unwrap_or_default();
        let linear = problem.problem("jacobian_count", |o| o.linearise(&at).map_err(refuse))?;
        let model = self.norm.model(&linear);
        for (scale, norm) in self.scale.iter_mut().zip(model.triangle.column_norms()) {
            *scale = scale.max(norm);
        }
        let zero = problem.problem("zero_count", |o| Ok(is_zero(o, rms(&linear.residuals))))?;
        if zero || model.triangle.orthogonality() <= ORTHOGONAL {
            return Ok((state.terminate_with(TerminationReason::SolverConverged), None));
        }
        match self.advance(problem, &at, &model) {
            Some((next, cost)) => Ok((state.param(next).cost(cost), None)),
            None => {
                let reason = TerminationReason::SolverExit("no step makes the residuals smaller".into());
                Ok((state.terminate_with(reason), None))
            }
        }
    }
}

impl Marquardt {
    /// The next point and its norm, with damping raised until the norm shrinks. None if nothing shrinks it.
    fn advance(
        &mut self,
        problem: &mut Problem<Objective>,
        at: &[f64],
        model: &Model,
    ) -> Option<(Vec<f64>, f64)> {
        let near = model.triangle.orthogonality() <= NEARLY_ORTHOGONAL;
        for _ in 0..if near { LAST_TRIALS } else { TRIALS } {
            let trial = model.triangle.step(&self.scale, self.damping).and_then(|step| {
                let next: Vec<f64> = at.iter().zip(&step).map(|(p, d)| p + d).collect();
                let moved = next.iter().zip(at).any(|(a, b)| a != b);
                let trial = |o: &Objective| Ok(o.residuals(&next).ok());
                let residuals = problem.problem("cost_count", trial).ok().flatten();
                residuals.filter(|_| moved).map(|r| (next.clone(), r, step))
            });
            if let Some((next, residuals, step)) = trial {
                let (gained, promised) = self.norm.gain(model, &residuals, &step);
                if gained > 0.0 && promised > 0.0 {
                    let ratio = (gained / promised).min(1.0);
                    let t = 2.0 * ratio - 1.0;
                    // Nielsen 1999: smooth between 1/3 and 2
                    self.damping = (self.damping * (1.0 - t * t * t).max(1.0 / 3.0)).max(1e-15);
                    self.growth = 2.0;
                    return Some((next, self.norm.of(&residuals)));
                }
            }
            self.damping *= self.growth;
            self.growth *= 2.0;
            if !self.damping.is_finite() {
                return None;
            }
        }
        None
    }
}
