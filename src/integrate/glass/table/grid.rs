//! A table of E = R + T: from far fewer integrals than texels.
//!
//! At a fixed column and index of refraction E is analytic in ln(alpha), with its nearest singularities at imaginary part pi/2 (alpha^2
//! negative), so Chebyshev nodes in ln(alpha) converge geometrically. In mu and the index it is not smooth (critical angles), so
//! there every texel's own value is integrated.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::check;
use super::kernel::{Energies, Kernel};
use crate::data::Smith;
use crate::integrate::IntegrateError;
use crate::math::{chebyshev, ops};

/// A grid of alpha (rows) by columns by indices of refraction (slices).
pub struct GlassGrid<'a> {
    /// Shadowing form.
    pub smith: Smith,
    /// alpha of every row, in [4e-4, 1].
    pub alphas: &'a [f64],
    /// Number of columns.
    pub columns: usize,
    /// Index of refraction of every slice, in [1, 3].
    pub iors: &'a [f64],
    /// mu in [1e-3, 1] of a column at an alpha and an index of refraction; smooth in alpha.
    pub mu: &'a (dyn Fn(usize, f64, f64) -> f64 + Sync),
    /// Largest absolute error of E at a texel.
    pub tolerance: f64,
}

/// A table of E.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabulated {
    /// E from outside, columns fastest, then rows, then slices.
    pub outside: Vec<f64>,
    /// E from inside, likewise.
    pub inside: Vec<f64>,
    /// Integrand evaluations, the check's included.
    pub evaluations: u64,
    /// What was recomputed.
    pub checked: Checked,
}

/// The check of a table: texels integrated again directly, with more nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Checked {
    /// Texels, both sides.
    pub texels: usize,
    /// Largest difference.
    pub worst: f64,
}

/// Computes and checks a table. Equal texels are computed once; the result does not depend on the number of threads.
///
/// # Errors
/// [`IntegrateError::Domain`] for an input outside its range, [`IntegrateError::Option`] for a tolerance below 1e-8,
/// [`IntegrateError::Tolerance`] if the check finds a texel that misses the tolerance.
pub fn tabulate(grid: &GlassGrid) -> Result<Tabulated, IntegrateError> {
    let kernel = Kernel::new(grid.smith, grid.tolerance)?;
    let (alphas, rows) = distinct(grid.alphas);
    let (iors, slices) = distinct(grid.iors);
    let rule = Interpolation::new(&alphas, grid.tolerance);
    let (columns, places) = distinct_columns(grid, &rule.nodes, &iors);
    let count = rule.nodes.len();
    let tasks: Vec<(Vec<Energies>, u64)> = (0..columns.len() * count)
        .into_par_iter()
        .map(|task| column_node(grid, &kernel, columns[task / count], rule.nodes[task % count], &iors))
        .collect::<Result<_, _>>()?;
    let evaluations = tasks.iter().map(|(_, n)| n).sum::<u64>();
    let interpolated: Vec<Vec<f64>> =
        tasks.par_chunks(count).map(|nodes| rule.apply(nodes, iors.len())).collect();
    let texels = |side: usize| -> Vec<f64> {
        let mut out = vec![0.0; grid.columns * grid.alphas.len() * grid.iors.len()];
        out.par_chunks_mut(grid.columns.max(1)).enumerate().for_each(|(line, out)| {
            let (row, slice) = (rows[line % grid.alphas.len()], slices[line / grid.alphas.len()]);
            for (texel, place) in out.iter_mut().zip(&places) {
                *texel = interpolated[*place][(row * iors.len() + slice) * 2 + side];
            }
        });
        out
    };
    let mut table =
        Tabulated { outside: texels(0), inside: texels(1), evaluations, checked: Checked::default() };
    let (checked, more) = check::check(grid, &table)?;
    table.checked = checked;
    table.evaluations += more;
    Ok(table)
}

/// E of one column at one alpha for every index of refraction; indices that share mu share their rings.
fn column_node(
    grid: &GlassGrid,
    kernel: &Kernel,
    column: usize,
    alpha: f64,
    iors: &[f64],
) -> Result<(Vec<Energies>, u64), IntegrateError> {
    let mus: Vec<f64> = iors.iter().map(|ior| (grid.mu)(column, alpha, *ior)).collect();
    let (distinct, group) = distinct(&mus);
    let mut out = vec![Energies::default(); iors.len()];
    let mut evaluations = 0;
    for (index, mu) in distinct.iter().enumerate() {
        let members: Vec<usize> = (0..iors.len()).filter(|i| group[*i] == index).collect();
        let asked: Vec<f64> = members.iter().map(|i| iors[*i]).collect();
        let mut values = vec![Energies::default(); asked.len()];
        evaluations += kernel.energies(alpha, *mu, &asked, &mut values)?;
        for (member, value) in members.into_iter().zip(values) {
            out[member] = value;
        }
    }
    Ok((out, evaluations))
}

/// The different values in order of first appearance, and the place of each among them.
fn distinct(values: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let (mut found, mut seen) = (Vec::new(), BTreeMap::new());
    let places = values.iter().map(|value| {
        *seen.entry(value.to_bits()).or_insert_with(|| {
            found.push(*value);
            found.len() - 1
        })
    });
    let places = places.collect();
    (found, places)
}

/// Columns of which mu differs somewhere, and the place of each column among them.
fn distinct_columns(grid: &GlassGrid, alphas: &[f64], iors: &[f64]) -> (Vec<usize>, Vec<usize>) {
    let (mut found, mut seen) = (Vec::new(), BTreeMap::new());
    let places = (0..grid.columns).map(|column| {
        let mut key = Vec::with_capacity(alphas.len() * iors.len());
        for alpha in alphas {
            key.extend(iors.iter().map(|ior| (grid.mu)(column, *alpha, *ior).to_bits()));
        }
        *seen.entry(key).or_insert_with(|| {
            found.push(column);
            found.len() - 1
        })
    });
    let places = places.collect();
    (found, places)
}

/// Interpolation in ln(alpha).
struct Interpolation {
    /// alpha of the nodes.
    nodes: Vec<f64>,
    /// Weights of the nodes, by row.
    weights: Vec<Vec<f64>>,
}

impl Interpolation {
    /// Chebyshev nodes for the tolerance; the rows themselves where these are fewer.
    fn new(alphas: &[f64], tolerance: f64) -> Interpolation {
        let low = alphas.iter().copied().fold(f64::INFINITY, f64::min);
        let high = alphas.iter().copied().fold(0.0, f64::max);
        let identity = |i: usize| (0..alphas.len()).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        let direct =
            || Interpolation { nodes: alphas.to_vec(), weights: (0..alphas.len()).map(identity).collect() };
        if alphas.len() < 3 || !(low > 0.0 && high.is_finite()) {
            return direct();
        }
        let count = nodes_for(ops::log(high / low), tolerance);
        if count >= alphas.len() {
            return direct();
        }
        let logs = chebyshev::nodes(ops::log(low), ops::log(high), count);
        let mut nodes: Vec<f64> = logs.iter().map(|x| ops::exp(*x)).collect();
        (nodes[0], nodes[count - 1]) = (low, high);
        let weights = alphas.iter().map(|alpha| chebyshev::weights(&logs, ops::log(*alpha))).collect();
        Interpolation { nodes, weights }
    }

    /// E of every row and index of refraction: [row][index][side].
    fn apply(&self, nodes: &[(Vec<Energies>, u64)], iors: usize) -> Vec<f64> {
        let values: Vec<Vec<f64>> =
            nodes.iter().map(|(energies, _)| energies.iter().flat_map(Energies::e).collect()).collect();
        let mut out = vec![0.0; self.weights.len() * iors * 2];
        for (row, weights) in out.chunks_mut(iors * 2).zip(&self.weights) {
            for (values, weight) in values.iter().zip(weights) {
                for (sum, value) in row.iter_mut().zip(values) {
                    *sum += weight * value;
                }
            }
        }
        out
    }
}

/// Chebyshev nodes over a range of ln(alpha): with the singularities at distance pi/2 from the real axis, n nodes on a range of
/// half length h leave an error of about exp(-n asinh(pi/(2 h))); the factor is measured.
fn nodes_for(range: f64, tolerance: f64) -> usize {
    let rate = ops::asinh(std::f64::consts::PI / range);
    (ops::log(2.0 / tolerance) / rate).ceil() as usize
}
