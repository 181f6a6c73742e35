//! Interpolation between knots along one input.

use multiversion::multiversion;
use rayon::prelude::*;

use super::Values;
use crate::audit::column::Base;
use lobefit_math::chebyshev;

/// Least values that one task makes.
const TASK: usize = 4096;

/// Knots of one input, in a coordinate in which the truth bends evenly or is analytic.
#[derive(Clone, Copy)]
pub(in crate::audit) struct Knots {
    /// The coordinate of an input.
    pub coordinate: fn(f64) -> f64,
    /// The input at a coordinate.
    pub input: fn(f64) -> f64,
    /// Range of the input.
    pub range: [f64; 2],
    /// How many, at least 2.
    pub count: usize,
    /// Whether they are evenly spaced with cubics between them; else they are Chebyshev nodes of
    /// one polynomial.
    pub cubic: bool,
}

impl Knots {
    /// The coordinates of the knots.
    fn coordinates(&self) -> Vec<f64> {
        let [low, high] = self.range.map(self.coordinate);
        if !self.cubic {
            return chebyshev::nodes(low, high, self.count);
        }
        let last = (self.count - 1) as f64;
        (0..self.count).map(|i| low + (high - low) * i as f64 / last).collect()
    }

    /// The inputs at the knots.
    pub(super) fn inputs(&self) -> Vec<f64> {
        let [low, high] = self.range;
        self.coordinates().into_iter().map(|u| (self.input)(u).clamp(low, high)).collect()
    }

    /// The first of the knots that an input's value is made of, and their weights: of a cubic
    /// Lagrange's, near an end the cubic of the last four.
    fn place(&self, coordinates: &[f64], x: f64) -> (usize, Vec<f64>) {
        let [low, high] = self.range.map(self.coordinate);
        let u = (self.coordinate)(x.clamp(self.range[0], self.range[1]));
        if !self.cubic {
            return (0, chebyshev::weights(coordinates, u));
        }
        let p = (u - low) / (high - low) * (self.count - 1) as f64;
        let taken = self.count.min(4);
        let first = (p.floor() as usize).saturating_sub(1).min(self.count - taken);
        let weight = |i: usize| {
            let others = (0..taken).filter(|j| *j != i);
            others.map(|j| (p - (first + j) as f64) / (i as f64 - j as f64)).product()
        };
        (first, (0..taken).map(weight).collect())
    }
}

/// Values with one axis, of knots `step` apart, taken at inputs instead of knots.
pub(super) fn along(knots: &Knots, at: &[f64], step: usize, values: &[Base]) -> Values {
    let coordinates = knots.coordinates();
    let places: Vec<(usize, Vec<f64>)> = at.iter().map(|x| knots.place(&coordinates, *x)).collect();
    let block = knots.count * step;
    let mut out = vec![[0.0; 3]; values.len() / block * at.len() * step];
    if step == 1 && !knots.cubic {
        let of_knot = |k: usize| places.iter().map(move |(_, weights)| weights[k]);
        let weights: Vec<f64> = (0..knots.count).flat_map(of_knot).collect();
        let fill = |(from, out): (&[Base], &mut [Base])| all_weighted(out, from, &weights);
        let blocks = values.par_chunks(block).zip(out.par_chunks_mut(at.len().max(1)));
        blocks.with_min_len(TASK / at.len().max(1) + 1).for_each(fill);
        return out;
    }
    let fill = |(i, out): (usize, &mut [Base])| {
        let (first, weights) = &places[i % places.len()];
        let from = &values[i / places.len() * block + first * step..];
        match out {
            [sum] => *sum = weighted(from, weights),
            _ => (0..weights.len()).for_each(|k| add(out, &from[k * step..][..step], weights[k])),
        }
    };
    out.par_chunks_mut(step).with_min_len(TASK / step + 1).enumerate().for_each(fill);
    out
}

/// A sum of values times weights.
fn weighted(values: &[Base], weights: &[f64]) -> Base {
    let (values, mut sum) = (&values[..weights.len()], [0.0; 3]);
    for k in 0..weights.len() {
        for c in 0..3 {
            sum[c] += weights[k] * values[k][c];
        }
    }
    sum
}

/// Sums of the same values times the weights of every input, knot by knot: a row of numbers for each of
/// the three.
#[multiversion(targets("x86_64+avx+avx2"))]
fn all_weighted(out: &mut [Base], values: &[Base], weights: &[f64]) {
    let inputs = out.len();
    let mut rows = vec![0.0; 3 * inputs];
    for (value, weights) in values.iter().zip(weights.chunks_exact(inputs)) {
        for (row, value) in rows.chunks_exact_mut(inputs).zip(value) {
            row.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * value);
        }
    }
    for (i, out) in out.iter_mut().enumerate() {
        *out = std::array::from_fn(|c| rows[c * inputs + i]);
    }
}

/// Adds a line times a weight, as one row of numbers: of a loop over three at a time a compiler makes
/// no vectors.
#[multiversion(targets("x86_64+avx+avx2"))]
fn add(out: &mut [Base], line: &[Base], weight: f64) {
    let (out, line) = (out.as_flattened_mut(), line.as_flattened());
    let line = &line[..out.len()];
    for i in 0..out.len() {
        out[i] += weight * line[i];
    }
}
