//! The truth at many points.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::PointSet;
use crate::data::Smith;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::reflection::{Effort, Interpolant, albedo, split};

/// Largest error of a truth in a field, eight nodes a panel: measured 6.1e-8 over alpha and mu in [1e-4, 1], held by
/// `tests/effects/reflection_field.rs`. The texels of tables are made with sixteen and are better.
pub const TRUTH_ERROR: f64 = 1e-7;

/// Points of a field that one task computes: work is cut by index alone.
const CHUNK: usize = 1024;

/// From so many points on, values come from an interpolant, which takes some ten thousand integrals.
const MANY: usize = 30_000;

/// Counts the truths that were integrated: how `bake` shows that nothing is computed which the scene does not call for.
#[derive(Debug, Default)]
pub struct Counter(AtomicU64);

impl Counter {
    /// Notes `n` integrated points.
    pub fn add(&self, n: usize) {
        self.0.fetch_add(n as u64, Ordering::Relaxed);
    }

    /// Points integrated so far.
    pub fn total(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

/// E, and B where it was asked for, at every point of a set.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Directional albedo.
    pub e: Vec<f64>,
    /// Schlick's bias; empty if not computed.
    pub b: Vec<f64>,
}

impl Field {
    /// E at the points of a set, within [`TRUTH_ERROR`].
    pub fn albedo(smith: Smith, points: &PointSet, counter: &Counter) -> Field {
        let known = interpolant(points, |alpha, mu| Interpolant::albedo(smith, alpha, mu));
        let e = each(points, counter, |alpha, mu| match &known {
            Some(known) if alpha.min(mu) >= Interpolant::SMALLEST => known.at(alpha, mu).0,
            _ => one_albedo(smith, alpha, mu),
        });
        Field { e, b: Vec::new() }
    }

    /// E and B at the points of a set, within [`TRUTH_ERROR`].
    pub fn split(smith: Smith, points: &PointSet, counter: &Counter) -> Field {
        let known = interpolant(points, |alpha, mu| Interpolant::new(smith, alpha, mu));
        let both = each(points, counter, |alpha, mu| match &known {
            Some(known) if alpha.min(mu) >= Interpolant::SMALLEST => known.at(alpha, mu),
            _ => split(smith, alpha, mu, &Effort::ladder()[0]),
        });
        Field { e: both.iter().map(|v| v.0).collect(), b: both.iter().map(|v| v.1).collect() }
    }
}

/// For many points, where a patch of integrals serves thousands. Where no polynomial follows the integrals, none: each is integrated.
fn interpolant(
    points: &PointSet,
    new: impl Fn([f64; 2], [f64; 2]) -> Result<Interpolant, IntegrateError>,
) -> Option<Interpolant> {
    if points.len() < MANY {
        return None;
    }
    let inside = points.alpha.iter().zip(&points.mu).map(|(a, m)| [f64::from(*a), f64::from(*m)]);
    let inside = inside.filter(|[alpha, mu]| alpha.min(*mu) >= Interpolant::SMALLEST);
    let ranges = inside.fold([[f64::INFINITY, f64::NEG_INFINITY]; 2], |ranges, place| {
        [0, 1].map(|k| [ranges[k][0].min(place[k]), ranges[k][1].max(place[k])])
    });
    new(ranges[0], ranges[1]).ok()
}

fn one_albedo(smith: Smith, alpha: f64, mu: f64) -> f64 {
    if alpha == 0.0 { 1.0 } else { albedo(smith, alpha, mu, &Effort::ladder()[0].outer) }
}

fn each<T: Send>(points: &PointSet, counter: &Counter, f: impl Fn(f64, f64) -> T + Sync) -> Vec<T> {
    counter.add(points.len());
    let inputs: Vec<(&[f32], &[f32])> = points.alpha.chunks(CHUNK).zip(points.mu.chunks(CHUNK)).collect();
    let parts: Vec<Vec<T>> = inputs
        .par_iter()
        .map(|(alpha, mu)| alpha.iter().zip(*mu).map(|(a, m)| f(f64::from(*a), f64::from(*m))).collect())
        .collect();
    parts.into_iter().flatten().collect()
}
