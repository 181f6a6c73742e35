//! The truth at many points.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::PointSet;
use crate::data::Smith;
use lobefit_truth::integrate::reflection::{Effort, albedo, split};

/// Largest error of a truth in a field, eight nodes a panel: measured 6.1e-8 over alpha and mu in [1e-4, 1], held by
/// `tests/effects/reflection_field.rs`. The texels of tables are made with sixteen and are better.
pub const TRUTH_ERROR: f64 = 1e-7;

/// Points of a field that one task computes: work is cut by index alone.
const CHUNK: usize = 1024;

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
        Field { e: each(points, counter, |alpha, mu| one_albedo(smith, alpha, mu)), b: Vec::new() }
    }

    /// E and B at the points of a set, within [`TRUTH_ERROR`].
    pub fn split(smith: Smith, points: &PointSet, counter: &Counter) -> Field {
        let both = each(points, counter, |alpha, mu| split(smith, alpha, mu, &Effort::ladder()[0]));
        Field { e: both.iter().map(|v| v.0).collect(), b: both.iter().map(|v| v.1).collect() }
    }
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
