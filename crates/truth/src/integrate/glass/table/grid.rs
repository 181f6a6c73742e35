//! A table of E = R + T: from far fewer integrals than texels.
//!
//! At a fixed column and index of refraction E is analytic in ln(alpha), with its nearest
//! singularities at imaginary part pi/2 (alpha^2 negative), so Chebyshev nodes in ln(alpha)
//! converge geometrically. In mu and the index it is not smooth (critical angles), so there every
//! texel's own value is integrated.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::check;
use super::interpolation::Interpolation;
use super::kernel::{Energies, Kernel};
use crate::integrate::{IntegrateError, Path};
use crate::optics::Smith;

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
    /// mu, in [`MU`](super::MU), of a column at an alpha and an index of refraction. A table is
    /// five times as fast where mu does not depend on alpha, and faster again where it is the same
    /// for all indices.
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

/// Computes and checks a table. Equal columns, rows and slices are computed once. A column of which
/// mu moves with alpha is integrated at every row, because it crosses the critical angles, where E
/// is not smooth in mu. The result does not depend on the number of threads.
///
/// # Errors
/// [`IntegrateError::Domain`] for an input outside its range, [`IntegrateError::Option`] for a
/// tolerance outside [1e-8, 1e-2], [`IntegrateError::Tolerance`] if the check finds a texel that
/// misses the tolerance.
pub fn tabulate(grid: &GlassGrid) -> Result<Tabulated, IntegrateError> {
    tabulate_on(Path::Best, grid)
}

/// [`tabulate`] with given instructions, for benchmarks and for checks that all give the same bits.
///
/// # Errors
/// As [`tabulate`].
pub fn tabulate_on(path: Path, grid: &GlassGrid) -> Result<Tabulated, IntegrateError> {
    let (alphas, rows) = distinct(grid.alphas);
    let (iors, slices) = distinct(grid.iors);
    let (columns, places) = columns(grid, &alphas, &iors);
    let (values, evaluations) = integrate(path, grid, &columns, &alphas, &iors)?;
    let texels = |side: usize| -> Vec<f64> {
        let mut out = vec![0.0; grid.columns * grid.alphas.len() * grid.iors.len()];
        out.par_chunks_mut(grid.columns.max(1)).enumerate().for_each(|(line, out)| {
            let (row, slice) = (rows[line % grid.alphas.len()], slices[line / grid.alphas.len()]);
            for (texel, place) in out.iter_mut().zip(&places) {
                *texel = values[*place][(row * iors.len() + slice) * 2 + side];
            }
        });
        out
    };
    let table = Tabulated { outside: texels(0), inside: texels(1), evaluations, checked: Checked::default() };
    let (checked, more) = check::check(path, grid, &table)?;
    Ok(Tabulated { checked, evaluations: evaluations + more, ..table })
}

/// E of every column, as [`Interpolation::apply`] orders it, and the number of evaluations.
fn integrate(
    path: Path,
    grid: &GlassGrid,
    columns: &[Column],
    alphas: &[f64],
    iors: &[f64],
) -> Result<(Vec<Vec<f64>>, u64), IntegrateError> {
    let kernel = Kernel::new(grid.smith, grid.tolerance)?.on(path);
    let direct = Interpolation::none(alphas);
    let chebyshev = Interpolation::chebyshev(alphas, grid.tolerance);
    let rule = |column: &Column| chebyshev.as_ref().filter(|_| column.straight).unwrap_or(&direct);
    let tasks: Vec<(usize, f64)> = columns
        .iter()
        .flat_map(|column| rule(column).nodes.iter().map(|alpha| (column.index, *alpha)))
        .collect();
    let nodes: Vec<(Vec<Energies>, u64)> = tasks
        .par_iter()
        .map(|(column, alpha)| column_node(grid, &kernel, *column, *alpha, iors))
        .collect::<Result<_, _>>()?;
    let mut rest = nodes.as_slice();
    let shares: Vec<_> = columns
        .iter()
        .map(|column| {
            let rule = rule(column);
            let (share, next) = rest.split_at(rule.nodes.len());
            rest = next;
            (rule, share)
        })
        .collect();
    let values = shares.into_par_iter().map(|(rule, nodes)| rule.apply(nodes, iors.len())).collect();
    Ok((values, nodes.iter().map(|(_, evaluations)| evaluations).sum()))
}

/// E of one column at one alpha for every index of refraction; indices that share mu share their
/// rings.
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

/// A column that differs from those before it.
struct Column {
    index: usize,
    /// mu does not depend on alpha.
    straight: bool,
}

/// The different columns, and the place of each column among them.
fn columns(grid: &GlassGrid, alphas: &[f64], iors: &[f64]) -> (Vec<Column>, Vec<usize>) {
    let keys: Vec<Vec<u64>> = (0..grid.columns)
        .into_par_iter()
        .map(|column| {
            let line =
                |ior: &f64| alphas.iter().map(|alpha| (grid.mu)(column, *alpha, *ior).to_bits()).collect();
            iors.iter().flat_map(|ior| -> Vec<u64> { line(ior) }).collect()
        })
        .collect();
    let (mut found, mut seen) = (Vec::new(), BTreeMap::new());
    let mut places = Vec::with_capacity(keys.len());
    for (index, key) in keys.into_iter().enumerate() {
        let straight = key.chunks(alphas.len().max(1)).all(|line| line.iter().all(|mu| *mu == line[0]));
        places.push(*seen.entry(key).or_insert_with(|| {
            found.push(Column { index, straight });
            found.len() - 1
        }));
    }
    (found, places)
}
