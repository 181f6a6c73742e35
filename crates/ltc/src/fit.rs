//! The matrix that is nearest to a lobe.

use crate::LtcError;
use crate::lobe::View;
use crate::matrix::Matrix;
use lobefit_fit::{Limits, Squares, Triangle, least};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, length, scaled};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes of the cosine's disk over half a turn: radii, azimuths.
const NODES: [usize; 2] = [24, 24];

/// Searches one after the other, each with the nodes and weights that the one before ended at.
const ROUNDS: usize = 5;

/// A step that gains less than 1e-6 ends a search; no logarithm and no angle moves by more than 1/2.
const LIMITS: Limits = Limits { iterations: 30, trials: 20, longest: 0.5, settled: Some(1e-6) };

/// Difference that a derivative is taken over.
const STEP: f64 = 1e-6;

/// Least part of the density at which a difference counts as one of it: where both agree, the weight
/// of absolute values has a pole.
const SMOOTHED: f64 = 0.02;

/// Directions of the cosine, evenly many in its light, with half a turn for all.
static DISK: LazyLock<Vec<(Vec3, f64)>> = LazyLock::new(|| {
    let (radii, azimuths) = (Gauss::new(NODES[0]), NODES[1]);
    let each = radii.nodes.iter().zip(&radii.weights).flat_map(|(x, w)| {
        let r = 0.5 + 0.5 * x;
        (0..azimuths).map(move |k| {
            let (s, c) = ops::sincos(PI * (k as f64 + 0.5) / azimuths as f64);
            ([r * c, r * s, ((1.0 - r) * (1.0 + r)).sqrt()], w * r / azimuths as f64)
        })
    });
    each.collect()
});

/// What is searched over: ln m11' and ln m33' of the lobe's own frame, its shear over m33', and the
/// angle that the frame is turned by.
fn matrix([a, b, shear, angle]: [f64; 4]) -> Matrix {
    let (a, b) = (ops::exp(a), ops::exp(b));
    let (s, c) = ops::sincos(angle);
    let shear = shear * b;
    Matrix { m11: a * c + shear * s, m13: shear * c - a * s, m31: b * s, m33: b * c }
}

/// All of them, of which a lobe that is round about the normal has ln m33' alone.
fn full(at: &[f64]) -> [f64; 4] {
    match *at {
        [a, b, shear, angle] => [a, b, shear, angle],
        _ => [0.0, at.first().copied().unwrap_or(0.0), 0.0, 0.0],
    }
}

fn parameters(m: Matrix) -> [f64; 4] {
    let (b, angle) = ((m.m31 * m.m31 + m.m33 * m.m33).sqrt(), ops::atan2(m.m31, m.m33));
    let (s, c) = ops::sincos(angle);
    let (a, shear) = (m.m11 * c - m.m13 * s, m.m11 * s + m.m13 * c);
    [ops::log(a.abs().max(1e-12)), ops::log(b.max(1e-12)), shear / b, angle]
}

/// Differences of the densities at the directions that a matrix takes the disk to.
struct Nodes<'a> {
    view: &'a View,
    /// Direction, the lobe's density, the root of its weight.
    at: Vec<(Vec3, f64, f64)>,
}

impl<'a> Nodes<'a> {
    fn new(view: &'a View, from: Matrix) -> Nodes<'a> {
        let node = |&(cosine, weight): &(Vec3, f64)| {
            let light = from.given(cosine);
            let light = scaled(light, 1.0 / length(light));
            let (p, q) = (view.density(light), from.density(light));
            // The solid angle is the weight over q; the integral is of |p - q|.
            let absolute = weight / q / (p - q).abs().max(SMOOTHED * q);
            (light, p, absolute.sqrt())
        };
        let at = DISK.iter().map(node).filter(|(_, _, w)| w.is_finite()).collect();
        Nodes { view, at }
    }

    fn residuals(&self, at: &[f64]) -> Option<Vec<f64>> {
        let m = matrix(full(at));
        let all: Vec<f64> = self.at.iter().map(|(light, p, w)| w * (m.density(*light) - p)).collect();
        all.iter().all(|r| r.is_finite()).then_some(all)
    }
}

impl Squares for Nodes<'_> {
    type Point = Vec<f64>;
    type Model = (Triangle, f64);

    fn point(&self, at: &[f64]) -> Option<Vec<f64>> {
        self.residuals(at)
    }

    fn value(&self, residuals: &Vec<f64>) -> f64 {
        residuals.iter().map(|r| r * r).sum()
    }

    fn model(&self, at: &[f64], residuals: &Vec<f64>) -> Result<(Triangle, f64), String> {
        let column = |k: usize| {
            let mut moved = at.to_vec();
            moved[k] += STEP;
            let moved = self.residuals(&moved)?;
            Some(moved.iter().zip(residuals).map(|(b, a)| (b - a) / STEP).collect::<Vec<f64>>())
        };
        let view = self.view;
        let none = || format!("no derivative at alpha {}, mu {}", view.alpha, view.mu);
        let columns: Option<Vec<Vec<f64>>> = (0..at.len()).map(column).collect();
        let columns = columns.ok_or_else(none)?;
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let n = at.len();
        let gradient = DVector::from_fn(n, |i, _| product(&columns[i], residuals));
        let hessian = DMatrix::from_fn(n, n, |i, j| product(&columns[i], &columns[j]));
        let value = self.value(residuals);
        Ok((Triangle::of_products(value, &gradient, &hessian).ok_or_else(none)?, value))
    }

    fn triangle<'b>(&self, model: &'b (Triangle, f64)) -> &'b Triangle {
        &model.0
    }

    fn gain(&self, model: &(Triangle, f64), to: &Vec<f64>, step: &[f64]) -> (f64, f64) {
        (model.1 - self.value(to), model.1 - model.0.predicted(step))
    }

    fn is_zero(&self, model: &(Triangle, f64)) -> bool {
        model.1 == 0.0
    }
}

/// The share of the light that a matrix sends from elsewhere than the lobe: half the integral of |p
/// - q|, which no light of any shape errs by more than.
pub fn misplaced(view: &View, matrix: Matrix) -> f64 {
    let lost = |&(cosine, weight): &(Vec3, f64)| {
        let light = matrix.given(cosine);
        let light = scaled(light, 1.0 / length(light));
        let (p, q) = (view.density(light), matrix.density(light));
        // A matrix that sends no light there sends it all elsewhere.
        if q > 0.0 { weight * (1.0 - p / q).max(0.0) } else { weight }
    };
    DISK.iter().map(lost).sum()
}

/// The matrix of least misplaced light near one of some starts, by reweighted least squares; at mu =
/// 1 one that is round about the normal.
///
/// # Errors
/// No start; a start from which the solver finds nothing.
pub fn fitted(view: &View, starts: &[Matrix]) -> Result<Matrix, LtcError> {
    let found: Vec<(f64, Matrix)> =
        starts.iter().map(|start| from(view, *start, view.mu >= 1.0)).collect::<Result<_, _>>()?;
    let best = found.into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a });
    best.map(|(_, matrix)| matrix).ok_or(LtcError::NoStart { alpha: view.alpha, mu: view.mu })
}

fn from(view: &View, start: Matrix, is_round: bool) -> Result<(f64, Matrix), LtcError> {
    let mut best = (misplaced(view, start), start);
    let mut now = start;
    for _ in 0..ROUNDS {
        let nodes = Nodes::new(view, now);
        let all = parameters(now);
        let from: &[f64] = if is_round { &all[1..2] } else { &all };
        let found = least(&nodes, from, LIMITS).map_err(|source| LtcError::Fit {
            alpha: view.alpha,
            mu: view.mu,
            source,
        })?;
        now = matrix(full(&found.at));
        let off = misplaced(view, now);
        if off < best.0 {
            best = (off, now);
        }
    }
    Ok(best)
}
