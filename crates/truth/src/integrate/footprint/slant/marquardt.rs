//! Sums of squares by their normal equations, with Levenberg's and Marquardt's steps as an argmin solver.

use argmin::core::{
    Error, Executor, IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus,
};
use nalgebra::{DMatrix, DVector};

use super::QUANTITY;
use crate::integrate::IntegrateError;

/// A sum of squares with half its gradient and its Gauss-Newton Hessian.
#[derive(Clone, Debug)]
pub struct Normal {
    /// |r|^2.
    pub value: f64,
    /// J^T r.
    pub gradient: DVector<f64>,
    /// J^T J.
    pub hessian: DMatrix<f64>,
}

impl Normal {
    /// Of residuals and the columns of their Jacobian; `None` if a number is none.
    pub fn of(residuals: &[f64], columns: &[Vec<f64>]) -> Option<Normal> {
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let gradient = DVector::from_iterator(columns.len(), columns.iter().map(|c| product(c, residuals)));
        let mut hessian = DMatrix::zeros(columns.len(), columns.len());
        for (i, a) in columns.iter().enumerate() {
            for (j, b) in columns[..=i].iter().enumerate() {
                let value = product(a, b);
                (hessian[(i, j)], hessian[(j, i)]) = (value, value);
            }
        }
        Normal { value: product(residuals, residuals), gradient, hessian }.finite()
    }

    /// Itself, if all of it is finite.
    pub fn finite(self) -> Option<Normal> {
        let parts = self.gradient.iter().chain(self.hessian.iter()).all(|x| x.is_finite());
        (parts && self.value.is_finite()).then_some(self)
    }

    /// Adds `weight` times a sum of squares of other parameters, whose derivatives by these are `by`.
    pub fn add(&mut self, weight: f64, other: &Normal, by: &DMatrix<f64>) {
        self.value += weight * other.value;
        self.gradient += by.tr_mul(&other.gradient) * weight;
        self.hessian += by.tr_mul(&(&other.hessian * by)) * weight;
    }
}

/// Where a search ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Least {
    /// The parameters.
    pub at: Vec<f64>,
    /// The sum of squares.
    pub value: f64,
    /// Whether the last step gained less than the tolerance, not the iterations ran out.
    pub settled: bool,
}

/// Minimises a sum of squares from a start; `squares` gives none where its parameters are refused. Deterministic.
///
/// # Errors
/// A start that is refused; normal equations that no damping makes solvable.
pub fn least<F>(squares: F, start: &[f64], iterations: u64) -> Result<Least, IntegrateError>
where
    F: Fn(&[f64]) -> Option<Normal>,
{
    let failed =
        |reason: String| IntegrateError::Search { quantity: QUANTITY, start: start.to_vec(), reason };
    let first = squares(start).ok_or_else(|| failed("the start is refused".into()))?;
    let solver = Steps { damping: FIRST_DAMPING, now: first.clone() };
    let outcome = Executor::new(Refusing(squares), solver)
        .configure(|state: Walk| state.param(start.to_vec()).cost(first.value).max_iters(iterations))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|error| failed(error.to_string()))?;
    let settled = matches!(
        outcome.state.get_termination_status(),
        TerminationStatus::Terminated(TerminationReason::SolverConverged)
    );
    let at = outcome.state.get_best_param().cloned().unwrap_or_else(|| start.to_vec());
    Ok(Least { at, value: outcome.state.get_best_cost().min(first.value), settled })
}

type Walk = IterState<Vec<f64>, (), (), (), (), f64>;

/// What is minimised.
struct Refusing<F>(F);

/// Damping of the first step, relative to the diagonal.
const FIRST_DAMPING: f64 = 1e-2;

/// Dampings between which an iteration looks for a gain, each 4 times the last.
const TRIALS: usize = 14;
const DAMPING: [f64; 2] = [1e-8, 1e8];

/// No parameter moves farther in a step: widths and weights are logarithms, tilts multiples of the lobe's width.
const LONGEST: f64 = 0.5;

/// Relative gain of a step that ends the search.
const SETTLED: f64 = 1e-7;

/// Added to the diagonal, over its largest: parameters without effect stay where they are.
const FLOOR: f64 = 1e-9;

struct Steps {
    damping: f64,
    now: Normal,
}

impl Steps {
    /// The damped step; `None` where the equations are not positive definite.
    fn step(&self) -> Option<DVector<f64>> {
        let mut damped = self.now.hessian.clone();
        let largest = damped.diagonal().max();
        for i in 0..damped.nrows() {
            damped[(i, i)] += self.damping * damped[(i, i)] + FLOOR * largest;
        }
        Some(-damped.cholesky()?.solve(&self.now.gradient))
    }
}

impl<F: Fn(&[f64]) -> Option<Normal>> Solver<Refusing<F>, Walk> for Steps {
    fn name(&self) -> &str {
        "Levenberg-Marquardt on normal equations"
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Refusing<F>>,
        state: Walk,
    ) -> Result<(Walk, Option<KV>), Error> {
        let at = state.get_param().cloned().unwrap_or_default();
        let settled = TerminationReason::SolverConverged;
        // where nothing has an effect there are no equations to solve
        let mut solved = self.now.gradient.iter().all(|g| *g == 0.0);
        for _ in 0..TRIALS {
            if let Some(step) = self.step() {
                solved = true;
                let next: Vec<f64> =
                    at.iter().zip(step.iter()).map(|(p, d)| p + d.clamp(-LONGEST, LONGEST)).collect();
                let tried = problem.problem("squares_count", |f| Ok((f.0)(&next)))?;
                if let Some(normal) = tried.filter(|normal| normal.value < self.now.value) {
                    let gain = 1.0 - normal.value / self.now.value;
                    self.damping = (0.25 * self.damping).max(DAMPING[0]);
                    self.now = normal;
                    let state = state.param(next).cost(self.now.value);
                    return Ok((if gain < SETTLED { state.terminate_with(settled) } else { state }, None));
                }
            }
            self.damping = (4.0 * self.damping).min(DAMPING[1]);
        }
        if !solved {
            let damping = self.damping;
            return Err(Error::msg(format!(
                "the normal equations are not positive definite, damped by up to {damping:e}"
            )));
        }
        // nothing near is lower
        Ok((state.terminate_with(settled), None))
    }
}
