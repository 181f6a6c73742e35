//! From values at a tensor of nodes to values at texels.

use super::grid::{Columns, Grid};
use super::plan::{Cosines, Rows};

/// Applies a matrix (rows of weights) along the middle axis of [outer][n][inner].
fn along(values: &[f64], n: usize, inner: usize, matrix: &[Vec<f64>]) -> Vec<f64> {
    let outer = values.len() / (n * inner);
    let mut out = vec![0.0; outer * matrix.len() * inner];
    for (source, target) in values.chunks(n * inner).zip(out.chunks_mut(matrix.len() * inner)) {
        for (weights, line) in matrix.iter().zip(target.chunks_mut(inner)) {
            for (weight, from) in weights.iter().zip(source.chunks(inner)) {
                for (to, x) in line.iter_mut().zip(from) {
                    *to += weight * x;
                }
            }
        }
    }
    out
}

/// Writes the texels of one group of rows and one of columns into `e`. `values`: nodes of mu
/// fastest, then of alpha, then of the anisotropy.
pub(super) fn fill(grid: &Grid, rows: &Rows, cosines: &Cosines, values: &[f64], e: &mut [f64]) {
    let nodes = cosines.mu.len();
    let values = match grid.columns {
        Columns::Fixed(mu) => {
            let weights = |column: &usize| cosines.nodes.weights(cosines.cosine.of(mu[*column]));
            let matrix: Vec<Vec<f64>> = cosines.columns.iter().map(weights).collect();
            along(values, nodes, 1, &matrix)
        }
        Columns::Varying { .. } => values.to_vec(),
    };
    let width = match grid.columns {
        Columns::Fixed(_) => cosines.columns.len(),
        Columns::Varying { .. } => nodes,
    };
    let values = along(&values, rows.size[0], width, &rows.to_rows);
    let values = along(&values, rows.size[1], rows.rows.len() * width, &rows.to_slices);
    let [columns, all_rows, _] = grid.size();
    let mut lines = values.chunks(width);
    for (slice, aspect) in grid.aspects.iter().enumerate() {
        for &row in &rows.rows {
            let Some(line) = lines.next() else { return };
            let target = &mut e[(slice * all_rows + row) * columns..][..columns];
            for (i, &column) in cosines.columns.iter().enumerate() {
                target[column] = match grid.columns {
                    Columns::Fixed(_) => line[i],
                    Columns::Varying { mu, .. } => {
                        let at = cosines.cosine.of(mu(column, row, *aspect));
                        cosines.nodes.weights(at).iter().zip(line).map(|(w, x)| w * x).sum()
                    }
                };
            }
        }
    }
}
