//! The node integrals of a table: rows and columns in groups, each pair of groups a tensor of
//! nodes.
//!
//! A row or a column that lies far from its neighbour in value (alpha = 1e-4 beside 1/64) is a
//! group of its own, exact in that variable. Rows and columns may come in any order. A row that the
//! floor raises is too, and exact in every slice: it is not smooth in the anisotropy.

use super::axes::{self, Cosine};
use super::barycentric::Nodes;
use super::grid::{Columns, Grid};
use lobefit_math::ops;

/// Ratio of neighbours, as a logarithm, from which on they are in different groups.
const APART: f64 = 1.5;

/// Rows that share nodes.
pub(super) struct Rows {
    pub rows: Vec<usize>,
    /// alpha_x and alpha_y of the nodes, those of one slice of nodes together.
    pub alphas: Vec<[f64; 2]>,
    /// Nodes over alpha, and over the anisotropy.
    pub size: [usize; 2],
    /// Weights of the nodes over alpha for each row, and of those over the anisotropy for each
    /// slice.
    pub to_rows: Vec<Vec<f64>>,
    pub to_slices: Vec<Vec<f64>>,
}

/// Columns that share nodes.
pub(super) struct Cosines {
    pub columns: Vec<usize>,
    pub cosine: Cosine,
    pub nodes: Nodes,
    /// mu of the nodes.
    pub mu: Vec<f64>,
}

/// Indices of values in groups of ascending values, neighbours not far apart.
fn groups(values: &[f64]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let near = |a: &usize, b: &usize| ops::log(values[*b]) - ops::log(values[*a]) <= APART;
    order.chunk_by(near).map(<[usize]>::to_vec).collect()
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |r, x| [r[0].min(x), r[1].max(x)])
}

/// Groups of rows with their nodes.
pub(super) fn rows(grid: &Grid, digits: f64) -> Vec<Rows> {
    let mut out = Vec::new();
    for group in groups(grid.alphas) {
        let raised = |row: &usize| grid.raised(*row);
        out.extend(group.iter().filter(|row| raised(row)).map(|row| raised_row(grid, *row)));
        let smooth = group.split(raised).filter(|rows| !rows.is_empty());
        out.extend(smooth.map(|rows| smooth_rows(grid, rows.to_vec(), digits)));
    }
    out
}

fn raised_row(grid: &Grid, row: usize) -> Rows {
    let slices = grid.aspects.len();
    let unit = |slice| (0..slices).map(|k| if k == slice { 1.0 } else { 0.0 }).collect();
    Rows {
        rows: vec![row],
        alphas: grid.aspects.iter().map(|aspect| grid.alpha(grid.alphas[row], *aspect)).collect(),
        size: [1, slices],
        to_rows: vec![vec![1.0]],
        to_slices: (0..slices).map(unit).collect(),
    }
}

fn smooth_rows(grid: &Grid, rows: Vec<usize>, digits: f64) -> Rows {
    let logs: Vec<f64> = rows.iter().map(|row| ops::log(grid.alphas[*row])).collect();
    let squares: Vec<f64> = grid.aspects.iter().map(|x| axes::lean(*x) * axes::lean(*x)).collect();
    let alpha = axes::alphas(range(logs.iter().copied()), digits);
    let lean = axes::leans(range(squares.iter().copied()), digits);
    let mut alphas = Vec::new();
    for square in lean.at() {
        let aspect = axes::aspect(-square.sqrt());
        alphas.extend(alpha.at().iter().map(|log| [ops::exp(*log) / aspect, ops::exp(*log) * aspect]));
    }
    Rows {
        rows,
        alphas,
        size: [alpha.at().len(), lean.at().len()],
        to_rows: logs.iter().map(|x| alpha.weights(*x)).collect(),
        to_slices: squares.iter().map(|x| lean.weights(*x)).collect(),
    }
}

/// Groups of columns with their nodes; one group where the cosines vary.
pub(super) fn cosines(grid: &Grid, digits: f64) -> Vec<Cosines> {
    match grid.columns {
        Columns::Fixed(mu) => groups(mu)
            .into_iter()
            .map(|columns| {
                let over = range(columns.iter().map(|column| mu[*column]));
                group_of_columns(columns, over, digits)
            })
            .collect(),
        Columns::Varying { count, .. } => {
            vec![group_of_columns((0..count).collect(), grid.cosines(), digits)]
        }
    }
}

fn group_of_columns(columns: Vec<usize>, [low, high]: [f64; 2], digits: f64) -> Cosines {
    let cosine = Cosine::from(low);
    let nodes = axes::cosines(cosine, [low, high], digits);
    // The ends are nodes; rounding must not carry them out of the range.
    let mu = nodes.at().iter().map(|u| cosine.mu(*u).clamp(low, high)).collect();
    Cosines { columns, cosine, nodes, mu }
}
