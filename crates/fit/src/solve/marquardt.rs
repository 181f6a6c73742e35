//! Levenberg-Marquardt as an argmin solver, for whatever has a value and beside it a model |R
//! d + q|^2 of its squares.
//!
//! For norms of p > 2 it was preferred to L-BFGS: the weighted problem has the same cost per
//! iteration and converges quadratically, where L-BFGS takes hundreds of evaluations on rational
//! forms and its line search gives up early.

use argmin::core::{
    Error, Executor, IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus,
};

use super::reduce::Triangle;
use crate::FitError;

/// Residuals orthogonal to the Jacobian within this cosine are a minimum.
pub(super) const ORTHOGONAL: f64 = 1e-10;

/// A minimum that rounding keeps from being sharper than [`ORTHOGONAL`] still counts up to here.
pub(super) const NEARLY_ORTHOGONAL: f64 = 1e-5;

/// Trials at what may be a minimum already: only its last digits are left to gain.
const LAST_TRIALS: usize = 6;

/// Damping of the first step, relative to the squared lengths of the Jacobian's columns.
const FIRST_DAMPING: f64 = 1e-3;

/// What is minimised.
pub trait Squares {
    /// What an evaluation without derivatives gives.
    type Point;
    /// What an evaluation with derivatives gives.
    type Model;

    /// The point of some parameters; `None` where they are refused.
    fn point(&self, at: &[f64]) -> Option<Self::Point>;

    /// The value that is to be smallest.
    fn value(&self, point: &Self::Point) -> f64;

    /// The model of the squares about a point.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn model(&self, at: &[f64], point: &Self::Point) -> Result<Self::Model, String>;

    /// The model's squares.
    fn triangle<'a>(&self, model: &'a Self::Model) -> &'a Triangle;

    /// What a step to a point has gained, and what the model promised for it.
    fn gain(&self, model: &Self::Model, to: &Self::Point, step: &[f64]) -> (f64, f64);

    /// Whether nothing but rounding is left of the squares.
    fn is_zero(&self, model: &Self::Model) -> bool;
}

/// Where a search gives up.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most iterations.
    pub iterations: u64,
    /// Trials of larger damping before an iteration gives up.
    pub trials: usize,
    /// No parameter moves farther in a step.
    pub longest: f64,
    /// Relative gain of a step that ends the search; `None`: no step is too small.
    pub settled: Option<f64>,
}

/// Why a search has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// The residuals are orthogonal to the Jacobian or 0, or the last step gained next to nothing.
    Settled,
    /// No step makes the value smaller.
    NoStep,
    /// The iterations are used up.
    Cap,
}

/// The best point of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// Its parameters.
    pub at: Vec<f64>,
    /// Its value.
    pub value: f64,
    /// The value at the start.
    pub start: f64,
    /// Why the search ended.
    pub halt: Halt,
    /// Evaluations of points and models.
    pub evaluations: u64,
}

/// Searches from one start. Deterministic.
///
/// # Errors
/// A start that is refused; a point without a model.
pub fn least<S: Squares>(squares: &S, start: &[f64], limits: Limits) -> Result<Least, FitError> {
    let failed = |message: String| FitError::Solver { message };
    let first = squares.point(start).ok_or_else(|| failed("the start is refused".into()))?;
    let value = squares.value(&first);
    let scale = vec![0.0; start.len()];
    let (damping, growth, evaluations) = (FIRST_DAMPING, 2.0, 1);
    let solver = Marquardt { squares, limits, now: first, damping, growth, scale, evaluations };
    let outcome = Executor::new((), solver)
        .configure(|state: Walk| state.param(start.to_vec()).cost(value).max_iters(limits.iterations))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|e| failed(e.to_string()))?;
    let halt = match outcome.state.get_termination_status() {
        TerminationStatus::Terminated(TerminationReason::SolverConverged) => Halt::Settled,
        TerminationStatus::Terminated(TerminationReason::MaxItersReached) => Halt::Cap,
        _ => Halt::NoStep,
    };
    let evaluations = outcome.solver.evaluations;
    let at = outcome.state.get_best_param().cloned().unwrap_or_else(|| start.to_vec());
    Ok(Least { at, value: outcome.state.get_best_cost().min(value), start: value, halt, evaluations })
}

type Walk = IterState<Vec<f64>, (), (), (), (), f64>;

/// Levenberg-Marquardt with Nielsen's damping and Moré's scaling (columns of the largest length
/// seen).
struct Marquardt<'a, S: Squares> {
    squares: &'a S,
    limits: Limits,
    now: S::Point,
    damping: f64,
    growth: f64,
    scale: Vec<f64>,
    evaluations: u64,
}

impl<S: Squares> Solver<(), Walk> for Marquardt<'_, S> {
    fn name(&self) -> &str {
        "Levenberg-Marquardt"
    }

    fn next_iter(&mut self, _: &mut Problem<()>, state: Walk) -> Result<(Walk, Option<KV>), Error> {
        let at = state.get_param().cloned().ok_or_else(|| Error::msg("a search without parameters"))?;
        let model = self.squares.model(&at, &self.now).map_err(Error::msg)?;
        self.evaluations += 1;
        let triangle = self.squares.triangle(&model);
        for (scale, norm) in self.scale.iter_mut().zip(triangle.column_norms()) {
            *scale = scale.max(norm);
        }
        let settled = TerminationReason::SolverConverged;
        if self.squares.is_zero(&model) || triangle.orthogonality() <= ORTHOGONAL {
            return Ok((state.terminate_with(settled), None));
        }
        let before = state.get_cost();
        let Some((next, value)) = self.advance(&at, &model) else {
            let reason = TerminationReason::SolverExit("no step makes the residuals smaller".into());
            return Ok((state.terminate_with(reason), None));
        };
        let small = self.limits.settled.is_some_and(|least| 1.0 - value / before < least);
        let state = state.param(next).cost(value);
        Ok((if small { state.terminate_with(settled) } else { state }, None))
    }
}

impl<S: Squares> Marquardt<'_, S> {
    /// The next point and its value, with damping raised until the value shrinks. `None` if nothing
    /// shrinks it.
    fn advance(&mut self, at: &[f64], model: &S::Model) -> Option<(Vec<f64>, f64)> {
        let (triangle, longest) = (self.squares.triangle(model), self.limits.longest);
        let near = triangle.orthogonality() <= NEARLY_ORTHOGONAL;
        for _ in 0..if near { LAST_TRIALS } else { self.limits.trials } {
            if let Some(step) = triangle.step(&self.scale, self.damping) {
                let step: Vec<f64> = step.iter().map(|d| d.clamp(-longest, longest)).collect();
                let next: Vec<f64> = at.iter().zip(&step).map(|(p, d)| p + d).collect();
                let moved = next.iter().zip(at).any(|(a, b)| a != b);
                self.evaluations += 1;
                if let Some(point) = self.squares.point(&next).filter(|_| moved) {
                    let (gained, promised) = self.squares.gain(model, &point, &step);
                    if gained > 0.0 && promised > 0.0 {
                        let ratio = (gained / promised).min(1.0);
                        let t = 2.0 * ratio - 1.0;
                        // Nielsen 1999: smooth between 1/3 and 2
                        self.damping = (self.damping * (1.0 - t * t * t).max(1.0 / 3.0)).max(1e-15);
                        self.growth = 2.0;
                        let value = self.squares.value(&point);
                        self.now = point;
                        return Some((next, value));
                    }
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
