//! Whether a halt is a minimum. First-order conditions hold at saddles as well: where a product of
//! parameters is 0, its derivatives vanish, whatever the product could gain. Here the second order
//! is looked at, and the directions that the first does not see are walked.

use nalgebra::{DMatrix, SymmetricEigen};
use rayon::prelude::*;

use super::bounds::{Bounds, LinearBounds};
use super::fitted::SecondOrder;
use super::levenberg::{End, Search, search};
use super::objective::{Linear, Objective, largest};
use super::options::{Goal, Options};
use super::power::PNorm;
use super::reduce::{RANK_TOLERANCE, reduce};
use super::starts::starts;
use crate::FitError;
use lobefit_math::ops::pow;

/// A search that ends lower by less than this part has found the same minimum.
pub(super) const LOWER: f64 = 1e-6;

/// Steps of the differences that make second derivatives, in units of a parameter's own size: the
/// error of central ones is its square, that of rounding some 1e-16 divided by it.
const DIFFERENCE: f64 = 1e-4;

/// Curvatures above minus this, in units of the norm's power per square unit of each parameter, are
/// those of a minimum.
const CURVED: f64 = 1e-6;

/// Steps along a direction: the first, in units of each parameter, the factor to the next, and
/// their number.
const STEPS: (f64, f64, usize) = (1e-3, 4.0, 9);

/// Points in a null space that searches are made from, and half the sides of the boxes that they
/// lie in, by turns.
const POINTS: usize = 8;
const BOXES: [f64; 2] = [1.0, 0.1];

/// Residuals at least this part of the largest hold a minimax in place, and their gradients are
/// independent above this part of the largest: those of one peak are nearly parallel.
const ACTIVE: f64 = 1.0 - 1e-4;
const INDEPENDENT: f64 = 1e-3;

/// The search, or a better one that starts beside its end. Where more saddles would have to be left
/// than the options allow, the best point in hand is returned, its end named a saddle: beside that
/// nobody has looked.
///
/// # Errors
/// The driver of the searches fails.
pub(super) fn escaped(
    objective: &Objective,
    from: Search,
    norm: PNorm,
    options: &Options,
) -> Result<Search, FitError> {
    let mut at = from;
    for _ in 0..=options.saddles {
        if !matches!(at.end, End::Minimum { .. }) {
            return Ok(at);
        }
        let (better, second_order) = better(objective, &at, norm, options.iterations)?;
        let Some(better) = better else { return Ok(Search { second_order, ..at }) };
        at = Search { evaluations: at.evaluations + better.evaluations, ..better };
    }
    if matches!(at.end, End::Minimum { .. }) {
        at.end = End::Saddle;
    }
    Ok(at)
}

/// The best of the searches from points beside a halt, if it is a better one; and whether second
/// derivatives chose among the points.
fn better(
    objective: &Objective,
    at: &Search,
    norm: PNorm,
    iterations: u64,
) -> Result<(Option<Search>, SecondOrder), FitError> {
    let Ok(linear) = objective.linearise(&at.coefficients) else {
        return Ok((None, SecondOrder::NotChecked));
    };
    let units = units(&at.coefficients, &linear);
    let (mut points, second_order) = match hessian(objective, &at.coefficients, norm, &linear, &units) {
        Some(hessian) => (below(objective, at, norm, hessian, &units), SecondOrder::Checked),
        None => (Vec::new(), SecondOrder::NotChecked),
    };
    points.extend(unseen(&at.coefficients, &units, &null(&linear)));
    let found: Vec<_> = points.par_iter().map(|point| search(objective, point, norm, iterations)).collect();
    let mut best: Option<Search> = None;
    let mut evaluations = 0;
    for search in found {
        // A point that is refused is one fewer.
        let Ok(search) = search? else { continue };
        evaluations += search.evaluations;
        if best.as_ref().is_none_or(|b| search.value < b.value) {
            best = Some(search);
        }
    }
    let best = best.filter(|b| b.value < at.value * (1.0 - LOWER));
    Ok((best.map(|b| Search { evaluations, ..b }), second_order))
}

/// The size of each parameter: its own magnitude, or what moves the residuals by their own size, at
/// most 1.
fn units(p: &[f64], linear: &Linear) -> Vec<f64> {
    let length = linear.triangle.residual_norm();
    let norms = linear.triangle.column_norms();
    let moving = |norm: f64| if norm > length { length / norm } else { 1.0 };
    p.iter().zip(norms).map(|(p, norm)| p.abs().max(moving(norm))).collect()
}

/// Points with a lower norm along the directions of negative curvature, the lowest of each.
fn below(
    objective: &Objective,
    at: &Search,
    norm: PNorm,
    hessian: DMatrix<f64>,
    units: &[f64],
) -> Vec<Vec<f64>> {
    let eigen = SymmetricEigen::new(hessian);
    let mut points = Vec::new();
    for k in (0..units.len()).filter(|&k| eigen.eigenvalues[k] < -CURVED) {
        let along = |t: f64| -> Vec<f64> {
            let moved = at.coefficients.iter().zip(units).enumerate();
            moved.map(|(j, (p, unit))| p + t * unit * eigen.eigenvectors[(j, k)]).collect()
        };
        let mut lowest = (at.value, None);
        for (sign, step) in [1.0, -1.0].into_iter().flat_map(|s| steps().map(move |t| (s, t))) {
            let point = along(sign * step);
            let value = objective.residuals(&point).map_or(f64::INFINITY, |r| norm.of(&r));
            if value < lowest.0 {
                lowest = (value, Some(point));
            }
        }
        points.extend(lowest.1);
    }
    points
}

fn steps() -> impl Iterator<Item = f64> {
    let (first, factor, count) = STEPS;
    std::iter::successors(Some(first), move |t| Some(factor * t)).take(count)
}

/// Second derivatives of the mean power of the residuals, in units of the largest at the point, by
/// central differences of its gradient; `None` where the formula is not finite beside the point, or
/// a divisor changes its sign.
fn hessian(
    objective: &Objective,
    p: &[f64],
    norm: PNorm,
    linear: &Linear,
    units: &[f64],
) -> Option<DMatrix<f64>> {
    let n = p.len();
    let unit = largest(&linear.residuals);
    if unit == 0.0 {
        return None;
    }
    let mut columns = DMatrix::zeros(n, n);
    for k in 0..n {
        for sign in [1.0, -1.0] {
            let mut moved = p.to_vec();
            moved[k] += sign * DIFFERENCE * units[k];
            let gradient = gradient(&objective.linearise(&moved).ok()?, norm, unit, units);
            for (j, g) in gradient.iter().enumerate() {
                columns[(j, k)] += sign * g / (2.0 * DIFFERENCE);
            }
        }
    }
    let symmetric = (&columns + columns.transpose()) * 0.5;
    symmetric.iter().all(|x| x.is_finite()).then_some(symmetric)
}

/// The gradient of mean (|r|/unit)^p by parameters in their units.
fn gradient(linear: &Linear, norm: PNorm, unit: f64, units: &[f64]) -> Vec<f64> {
    let n = units.len();
    let mut sums = vec![0.0; n];
    for (r, row) in linear.residuals.iter().zip(linear.jacobian.chunks(n)) {
        let ratio = r / unit;
        let slope = if norm == PNorm::SQUARE {
            2.0 * ratio
        } else {
            norm.0 * pow(ratio.abs(), norm.0 - 1.0).copysign(ratio)
        };
        for (sum, (j, size)) in sums.iter_mut().zip(row.iter().zip(units)) {
            *sum += slope * j * size / unit;
        }
    }
    let count = linear.residuals.len() as f64;
    sums.iter().map(|s| s / count).collect()
}

/// Directions that the Jacobian does not see, each as a row of parameters scaled by the lengths of
/// the Jacobian's columns (1 for 0).
fn null(linear: &Linear) -> Vec<Vec<f64>> {
    let norms = linear.triangle.column_norms();
    let scale: Vec<f64> = norms.iter().map(|norm| if *norm > 0.0 { 1.0 / norm } else { 1.0 }).collect();
    kernel(&linear.triangle.scaled(), RANK_TOLERANCE, &scale)
}

/// Directions along which what holds an end does not change to first order: the residuals that hold
/// a minimax, and the constraints that are no more than touched.
fn tangent(linear: &Linear, held: Option<&LinearBounds>, goal: Goal) -> Vec<Vec<f64>> {
    let n = linear.triangle.r.ncols();
    let top = largest(&linear.residuals);
    let holds = |i: &usize| goal == Goal::Max && linear.residuals[*i].abs() >= ACTIVE * top;
    let active = (0..linear.residuals.len()).filter(holds);
    let mut rows: Vec<f64> = active.flat_map(|i| &linear.jacobian[i * n..(i + 1) * n]).copied().collect();
    if let Some(held) = held {
        let touched = |i: &usize| held.equal[*i] || held.values[*i] <= (1.0 - ACTIVE) * top;
        let active = (0..held.values.len()).filter(touched);
        rows.extend(active.flat_map(|i| &held.jacobian[i * n..(i + 1) * n]).copied());
    }
    let triangle = reduce(&rows, &vec![0.0; rows.len() / n], n);
    let norms = triangle.column_norms();
    let scale: Vec<f64> = norms.iter().map(|norm| if *norm > 0.0 { 1.0 / norm } else { 1.0 }).collect();
    kernel(&triangle.scaled(), INDEPENDENT, &scale)
}

/// An orthonormal basis of what a matrix maps to less than this part of its largest singular value,
/// columns times `scale`.
pub(super) fn kernel(matrix: &DMatrix<f64>, part: f64, scale: &[f64]) -> Vec<Vec<f64>> {
    let svd = matrix.clone().svd(false, true);
    let top = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let Some(v) = svd.v_t else { return Vec::new() };
    let small = (0..v.nrows()).filter(|&k| svd.singular_values[k] <= part * top);
    small.map(|k| v.row(k).iter().zip(scale).map(|(v, s)| v * s).collect()).collect()
}

/// Points in the space of some directions about p: the box of their combinations, each scaled to
/// move some parameter by its unit.
fn unseen(p: &[f64], units: &[f64], directions: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let size = |d: &[f64]| d.iter().zip(units).fold(0.0_f64, |top, (d, unit)| top.max((d / unit).abs()));
    let directions: Vec<(f64, &Vec<f64>)> =
        directions.iter().map(|d| (size(d), d)).filter(|(size, _)| *size > 0.0).collect();
    if directions.is_empty() {
        return Vec::new();
    }
    let mixes = starts(&vec![0.0; directions.len()], 1 + POINTS, 1.0);
    let moved = |(i, mix): (usize, &Vec<f64>)| {
        let mut point = p.to_vec();
        for (t, (size, direction)) in mix.iter().zip(&directions) {
            let step = BOXES[i % BOXES.len()] * t / size;
            point.iter_mut().zip(*direction).for_each(|(x, d)| *x += step * d);
        }
        point
    };
    mixes[1..].iter().enumerate().map(moved).collect()
}

/// Points about the end of a descent, in the space that neither the largest residuals, where they
/// are what is minimised, nor the constraints hold it in to first order, those with the smallest
/// value first; none where as many hold it as there are parameters to move.
pub(super) fn beside(objective: &Objective, bounds: Option<&Bounds>, p: &[f64], goal: Goal) -> Vec<Vec<f64>> {
    let Ok(linear) = objective.linearise(p) else { return Vec::new() };
    let Ok(held) = bounds.map(|bounds| bounds.linearise(p)).transpose() else { return Vec::new() };
    let units = units(p, &linear);
    let size = |residuals: &[f64]| match goal {
        Goal::Max => largest(residuals),
        Goal::Rms => PNorm::SQUARE.of(residuals),
        Goal::Power(p) => PNorm(p).of(residuals),
    };
    let value = |point: &Vec<f64>| objective.residuals(point).map_or(f64::INFINITY, |r| size(&r));
    let directions = tangent(&linear, held.as_ref(), goal);
    let mut points: Vec<(f64, Vec<f64>)> =
        unseen(p, &units, &directions).into_iter().map(|point| (value(&point), point)).collect();
    points.retain(|(value, _)| value.is_finite());
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.into_iter().map(|(_, point)| point).collect()
}
