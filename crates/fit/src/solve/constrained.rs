//! Coefficients within constraints: exact penalties from several starts, then a correction of what
//! the programs leave.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bounds::{Bounds, violation};
use super::descent::{Descent, Problem};
use super::escape::{LOWER, beside};
use super::fitted::{Gap, Held, Method, SecondOrder, Stage, Termination};
use super::levenberg::Search;
use super::objective::{Objective, Refused};
use super::options::{Goal, Options};
use super::power::PNorm;
use super::route::{Route, is_zero, ladder, refused};
use crate::FitError;

/// Weights of the norm against violations, tried in this order until the constraints are kept. With
/// multipliers of order 1, as where residuals and the formula's values have like units, the first
/// will do.
const WEIGHTS: [f64; 3] = [0.1, 1e-3, 1e-5];

/// Newton steps of the last correction.
const CORRECTIONS: usize = 4;

/// Directions of a correction below this part of the largest are not taken.
const NEGLIGIBLE: f64 = 1e-9;

/// The best coefficients that keep all constraints.
///
/// # Errors
/// No descent ends where they are kept, with the constraint that is furthest off.
pub(super) fn constrained(
    objective: &Objective,
    bounds: &Bounds,
    searches: &[Search],
    declared: &[f64],
    options: &Options,
    finalists: usize,
) -> Result<Route, FitError> {
    let mut starts: Vec<&[f64]> =
        searches.iter().take(finalists).map(|s| s.coefficients.as_slice()).collect();
    starts.push(declared);
    let mut evaluations: u64 = searches.iter().map(|s| s.evaluations).sum();
    let best = settled(objective, bounds, &starts, options, &mut evaluations);
    let Some(mut best) = best else { return Err(refused(objective, declared)) };
    let mut saddle = best.over == 0.0 && best.descent.optimal;
    for _ in 0..=options.saddles {
        if !saddle {
            break;
        }
        let points = beside(objective, Some(bounds), &best.descent.coefficients, options.goal);
        let points: Vec<&[f64]> = points.iter().take(finalists).map(Vec::as_slice).collect();
        let lowest = settled(objective, bounds, &points, options, &mut evaluations);
        let below = best.descent.value * (1.0 - LOWER);
        match lowest.filter(|lowest| lowest.over == 0.0 && lowest.descent.value < below) {
            Some(lowest) => best = lowest,
            None => saddle = false,
        }
        saddle &= best.descent.optimal;
    }
    let held = bounds.held(&best.descent.coefficients)?;
    if let Some(worst) = worst(&held) {
        return Err(bounds.unsatisfiable(worst, &held[worst]));
    }
    let descent = best.descent;
    let termination = match () {
        () if is_zero(objective, descent.rms) => Termination::ZeroResidual,
        () if saddle => Termination::Saddle,
        () if descent.optimal && descent.bounded => Termination::Constrained,
        () if descent.optimal && options.goal == Goal::Max => Termination::Minimax,
        () if descent.optimal => Termination::Converged { cosine: best.cosine },
        () if descent.capped => Termination::IterationCap,
        () => Termination::Stalled,
    };
    let last = Stage { method: Method::Programs, end: termination, max: descent.max, rms: descent.rms };
    let gap = if options.goal == Goal::Max { Gap::Local(descent.gap) } else { Gap::Unknown };
    let (coefficients, stages) = (descent.coefficients, vec![last]);
    let second_order = SecondOrder::Unused;
    Ok(Route { coefficients, termination, second_order, stages, evaluations, gap, bound: None })
}

/// The best of the ends from some starts; none if all are refused.
fn settled(
    objective: &Objective,
    bounds: &Bounds,
    starts: &[&[f64]],
    options: &Options,
    evaluations: &mut u64,
) -> Option<Outcome> {
    let outcomes: Vec<Result<Outcome, Refused>> =
        starts.par_iter().map(|start| settle(objective, bounds, start, options)).collect();
    let mut best: Option<Outcome> = None;
    for outcome in outcomes {
        // A start that is refused by a constraint's points is one fewer.
        let Ok(outcome) = outcome else { continue };
        *evaluations += outcome.evaluations;
        if best.as_ref().is_none_or(|b| outcome.rank() < b.rank()) {
            best = Some(outcome);
        }
    }
    best
}

/// The constraint that is furthest beyond its tolerance, if one is.
pub(super) fn worst(held: &[Held]) -> Option<usize> {
    let excess = |i: usize| held[i].worst / held[i].tolerance;
    let over = (0..held.len()).filter(|&i| excess(i) > 1.0);
    over.reduce(|a, b| if excess(b) > excess(a) { b } else { a })
}

/// Where one start has led.
struct Outcome {
    descent: Descent,
    /// Largest violation in tolerances, 0 where all constraints are kept.
    over: f64,
    cosine: f64,
    evaluations: u64,
}

impl Outcome {
    /// Smaller is better: constraints kept, then the norm.
    fn rank(&self) -> (f64, f64) {
        (self.over, if self.over == 0.0 { self.descent.value } else { 0.0 })
    }
}

/// Descends from a start with ever smaller weights of the norm until the constraints are kept.
fn settle(
    objective: &Objective,
    bounds: &Bounds,
    start: &[f64],
    options: &Options,
) -> Result<Outcome, Refused> {
    let norms: Vec<Option<PNorm>> = match options.goal {
        Goal::Max => vec![None],
        Goal::Rms => vec![Some(PNorm::SQUARE)],
        Goal::Power(p) => std::iter::once(2.0).chain(ladder(p)).map(|q| Some(PNorm(q))).collect(),
    };
    let mut evaluations = 0;
    let mut descend = |norm: Option<PNorm>, weight: f64, start: &[f64]| {
        let problem =
            Problem { objective, bounds: Some(bounds), norm, weight, iterations: options.iterations };
        let mut found = problem.descend(start)?;
        evaluations += found.evaluations;
        correct(bounds, &mut found.coefficients)?;
        let residuals = objective.residuals(&found.coefficients)?;
        found.value = norm.map_or_else(|| super::largest(&residuals), |norm| norm.of(&residuals));
        (found.max, found.rms) = (super::largest(&residuals), PNorm::SQUARE.of(&residuals));
        let over = over(bounds, &found.coefficients);
        Ok::<(Descent, f64), Refused>((found, over))
    };
    let last = norms.last().copied().flatten();
    let mut at = start.to_vec();
    let mut weight = WEIGHTS[0];
    for norm in &norms[..norms.len() - 1] {
        at = descend(*norm, weight, &at)?.0.coefficients;
    }
    let mut reached = descend(last, weight, &at)?;
    for smaller in &WEIGHTS[1..] {
        if reached.1 == 0.0 {
            break;
        }
        weight = *smaller;
        reached = descend(last, weight, &reached.0.coefficients)?;
    }
    if reached.1 > 0.0 {
        let kept = descend(last, 0.0, &reached.0.coefficients)?;
        reached = match kept.1 {
            0.0 => Some(descend(last, weight, &kept.0.coefficients)?).filter(|again| again.1 == 0.0),
            _ => None,
        }
        .unwrap_or((Descent { optimal: false, ..kept.0 }, kept.1));
    }
    let (descent, over) = reached;
    let linear = objective.linearise(&descent.coefficients)?;
    let cosine = last.map_or(0.0, |norm| norm.model(&linear).triangle.orthogonality());
    Ok(Outcome { descent, over, cosine, evaluations })
}

/// Largest violation in tolerances; 0 where all constraints are kept; infinite where the
/// coefficients are no f32.
fn over(bounds: &Bounds, p: &[f64]) -> f64 {
    match bounds.held(p) {
        Ok(held) => worst(&held).map_or(0.0, |i| held[i].worst / held[i].tolerance),
        Err(_) => f64::INFINITY,
    }
}

/// Whether all constraints are kept within their tolerances.
pub(super) fn kept(bounds: &Bounds, p: &[f64]) -> bool {
    over(bounds, p) == 0.0
}

/// Moves coefficients by the least relative change that undoes what violates constraints.
pub(super) fn correct(bounds: &Bounds, p: &mut Vec<f64>) -> Result<(), Refused> {
    let n = p.len();
    for _ in 0..CORRECTIONS {
        let here = bounds.linearise(p)?;
        let before = here.worst(&here.values);
        let rows: Vec<usize> =
            (0..here.values.len()).filter(|&i| violation(here.values[i], here.equal[i]) > 0.0).collect();
        if rows.is_empty() {
            return Ok(());
        }
        let a = DMatrix::from_fn(rows.len(), n, |i, j| here.jacobian[rows[i] * n + j] * p[j].abs());
        let g = DVector::from_fn(rows.len(), |i, _| -here.values[rows[i]]);
        // The decomposition of a matrix that is not finite never ends.
        if !a.iter().all(|x| x.is_finite()) {
            return Ok(());
        }
        let svd = a.svd(true, true);
        let top = svd.singular_values.iter().copied().fold(0.0, f64::max);
        let Ok(step) = svd.solve(&g, NEGLIGIBLE * top) else { return Ok(()) };
        let next: Vec<f64> = p.iter().zip(step.iter()).map(|(p, s)| p + p.abs() * s).collect();
        match bounds.values(&next) {
            Ok(values) if here.worst(&values) < 0.5 * before => *p = next,
            _ => return Ok(()),
        }
    }
    Ok(())
}
