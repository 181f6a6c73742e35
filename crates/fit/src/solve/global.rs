//! The globally best largest residual of formulas that are recognised as quotients of affine
//! expressions.

use super::bounds::Bounds;
use super::fitted::{Gap, Method, SecondOrder, Stage, Termination};
use super::objective::{Objective, largest};
use super::power::PNorm;
use super::recognise::{Rows, recognise};
use super::route::{Route, is_zero};
use crate::FitError;
use crate::rational::{Optimum, Rational, Row, minimax};

/// A gap that counts as closed, as in [`crate::rational`].
const CLOSED: f64 = 1e-4;

/// Denominators at a constraint's points are at least this part of their largest term.
const FLOOR: f64 = 1e-7;

/// The best coefficients, whose denominator keeps its sign from sample to sample as it does at
/// `start`, or has the opposite one everywhere. None if the formula is no such quotient, a
/// constraint is not linear in its parameters, or the programs fail: other routes remain.
pub(super) fn global(objective: &Objective, bounds: Option<&Bounds>, start: &[f64]) -> Option<Route> {
    let samples = objective.samples;
    let rows = recognise(objective.tape, &samples.inputs, samples.len())?;
    let signs = signs(&rows, start)?;
    let mut best: Option<Optimum> = None;
    let mut bound = Some(f64::INFINITY);
    let mut programs = 0;
    for flip in if rows.linear { &[1.0][..] } else { &[1.0, -1.0] } {
        let turned: Vec<f64> = signs.iter().map(|s| s * flip).collect();
        let extra = match bounds {
            Some(bounds) => bounds.rows(start, *flip)?,
            None => Vec::new(),
        };
        let problem = Rational {
            parameters: start.len(),
            numerator: by_row(&rows.numerator, &turned),
            denominator: by_row(&rows.denominator, &turned),
            scale: samples.scale.clone(),
            target: samples.target.clone(),
        };
        match minimax(&problem, &extra, (*flip > 0.0).then_some(start)) {
            Ok(optimum) => {
                programs += optimum.programs as u64;
                bound = bound.map(|bound| optimum.bound.min(bound));
                if best.as_ref().is_none_or(|b| optimum.max < b.max) {
                    best = Some(optimum);
                }
            }
            // Proven that no coefficients turn every denominator round: nothing to find there.
            Err(FitError::NoDenominator { .. } | FitError::Infeasible { .. }) if *flip < 0.0 => {}
            // Neither searched nor excluded: what was found on this side is not claimed to be the
            // best of both.
            Err(_) if *flip < 0.0 => bound = None,
            Err(_) => return None,
        }
    }
    arrive(objective, bounds, best?, bound, programs)
}

/// The optimum as a route, if the samples (and the constraints, rounding to f32 included) accept
/// it.
fn arrive(
    objective: &Objective,
    bounds: Option<&Bounds>,
    optimum: Optimum,
    bound: Option<f64>,
    programs: u64,
) -> Option<Route> {
    let (own, mut coefficients) = (optimum.bound, optimum.coefficients);
    if let Some(bounds) = bounds {
        super::constrained::correct(bounds, &mut coefficients).ok()?;
        super::constrained::kept(bounds, &coefficients).then_some(())?;
    }
    let residuals = objective.residuals(&coefficients).ok()?;
    let (max, rms) = (largest(&residuals), PNorm::SQUARE.of(&residuals));
    let gap = |bound: f64| if max > 0.0 { ((max - bound) / max).max(0.0) } else { 0.0 };
    let termination = match bound {
        _ if is_zero(objective, rms) => Termination::ZeroResidual,
        Some(bound) if gap(bound) <= CLOSED => Termination::GlobalMinimax,
        None if gap(own) <= CLOSED => Termination::Minimax,
        _ => Termination::Stalled,
    };
    let stage = Stage { method: Method::DifferentialCorrection, end: termination, max, rms };
    Some(Route {
        coefficients,
        termination,
        second_order: SecondOrder::Unused,
        stages: vec![stage],
        evaluations: programs,
        gap: bound.map_or(Gap::Unknown, |bound| Gap::Global(gap(bound))),
        bound,
    })
}

/// Coefficients of a quotient whose denominators all have one sign, whatever they are at the
/// declared starts: those with the smallest largest residual. None if the formula is no such
/// quotient, or there are none.
pub(super) fn seed(objective: &Objective) -> Option<Vec<f64>> {
    let samples = objective.samples;
    let rows = recognise(objective.tape, &samples.inputs, samples.len())?;
    let best = [1.0, -1.0].into_iter().filter_map(|sign| {
        let problem = Rational {
            parameters: objective.tape.parameters(),
            numerator: by_row(&rows.numerator, &vec![sign; samples.len()]),
            denominator: by_row(&rows.denominator, &vec![sign; samples.len()]),
            scale: samples.scale.clone(),
            target: samples.target.clone(),
        };
        // A sign that no coefficients have is left out; without any sign the caller reports it.
        minimax(&problem, &[], None).ok()
    });
    let best = best.reduce(|a, b| if b.max < a.max { b } else { a })?;
    objective.residuals(&best.coefficients).ok().map(|_| best.coefficients)
}

/// The sign of each denominator at a point; none if one is 0 or not a number.
fn signs(rows: &Rows, p: &[f64]) -> Option<Vec<f64>> {
    let width = 1 + p.len();
    let value = |row: &[f64]| row[0] + row[1..].iter().zip(p).map(|(a, p)| a * p).sum::<f64>();
    let sign = |row: &[f64]| match value(row) {
        q if q > 0.0 => Some(1.0),
        q if q < 0.0 => Some(-1.0),
        _ => None,
    };
    rows.denominator.chunks(width).map(sign).collect()
}

fn by_row(matrix: &[f64], factors: &[f64]) -> Vec<f64> {
    let width = matrix.len() / factors.len();
    let rows = matrix.chunks(width).zip(factors);
    rows.flat_map(|(row, factor)| row.iter().map(move |x| x * factor)).collect()
}

impl Bounds<'_> {
    /// The constraints as rows that are linear in the parameters, denominators having the sign that
    /// they have at `start`, times `flip`. None if they are not linear.
    fn rows(&self, start: &[f64], flip: f64) -> Option<Vec<Row>> {
        let points = self.points();
        let rows = recognise(self.tape(), &points.inputs, points.len())?;
        let signs = signs(&rows, start)?;
        let width = 1 + start.len();
        let mut found = Vec::new();
        let part = |matrix: &[f64], i: usize, factor: f64| -> Vec<f64> {
            matrix[i * width..(i + 1) * width].iter().map(|x| x * factor).collect()
        };
        let add = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
        for (at, other, sign, value, equal) in self.asked() {
            let turned = signs[at] * if rows.linear { 1.0 } else { flip };
            let q = part(&rows.denominator, at, turned);
            let p = part(&rows.numerator, at, turned);
            // sign (p - value q) >= 0, or = 0
            let mut row = add(part(&p, 0, -sign), part(&q, 0, sign * value));
            if let Some(other) = other {
                if !rows.linear {
                    return None;
                }
                row = add(row, part(&rows.numerator, other, sign));
            }
            found.push(below(row, equal));
            if !rows.linear {
                let size = q.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                let mut floor = part(&q, 0, -1.0);
                floor[0] += FLOOR * size;
                found.push(below(floor, false));
            }
        }
        Some(found)
    }
}

/// row (1, p) <= 0
fn below(row: Vec<f64>, equal: bool) -> Row {
    Row { bound: -row[0], coefficients: row[1..].to_vec(), equal }
}
