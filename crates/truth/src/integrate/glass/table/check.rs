//! The check that is part of every table: a fixed random sample of texels and those on the hard
//! places, integrated directly.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::grid::{Checked, GlassGrid, Tabulated};
use super::kernel::{Energies, Kernel};
use crate::integrate::{IntegrateError, Path};

/// Random texels.
const RANDOM: usize = 1000;

/// Compares texels of a table with their direct integrals; returns besides the number of
/// evaluations.
pub(super) fn check(
    path: Path,
    grid: &GlassGrid,
    table: &Tabulated,
) -> Result<(Checked, u64), IntegrateError> {
    let (columns, rows) = (grid.columns, grid.alphas.len());
    if table.outside.is_empty() {
        return Ok((Checked::default(), 0));
    }
    let kernel = Kernel::finer(grid.smith, grid.tolerance)?.on(path);
    let mut texels: Vec<[usize; 3]> = random(grid);
    texels.extend(hard(grid));
    texels.sort_unstable();
    texels.dedup();
    let differences: Vec<(f64, u64)> = texels
        .par_iter()
        .map(|[x, y, z]| {
            let (alpha, ior) = (grid.alphas[*y], grid.iors[*z]);
            let mut direct = [Energies::default()];
            let evaluations = kernel.energies(alpha, (grid.mu)(*x, alpha, ior), &[ior], &mut direct)?;
            let at = x + columns * (y + rows * z);
            let [outside, inside] = direct[0].e();
            let worst = (table.outside[at] - outside).abs().max((table.inside[at] - inside).abs());
            Ok((if worst.is_nan() { f64::INFINITY } else { worst }, evaluations))
        })
        .collect::<Result<_, IntegrateError>>()?;
    let evaluations = differences.iter().map(|(_, n)| n).sum();
    let mut worst = (0.0, [0; 3]);
    for ((difference, _), texel) in differences.iter().zip(&texels) {
        if *difference > worst.0 {
            worst = (*difference, *texel);
        }
    }
    if worst.0 > grid.tolerance {
        let [x, y, z] = worst.1;
        return Err(IntegrateError::Tolerance {
            quantity: "ggx-glass",
            place: format!("column {x}, alpha = {:?}, ior = {:?} of a table", grid.alphas[y], grid.iors[z]),
            reached: worst.0,
            tolerance: grid.tolerance,
        });
    }
    Ok((Checked { texels: 2 * texels.len(), worst: worst.0 }, evaluations))
}

fn random(grid: &GlassGrid) -> Vec<[usize; 3]> {
    let mut random = Pcg64::seed_from_u64(1);
    let mut below = |n: usize| ((random.random::<f64>() * n as f64) as usize).min(n - 1);
    (0..RANDOM).map(|_| [below(grid.columns), below(grid.alphas.len()), below(grid.iors.len())]).collect()
}

/// The texels next to theta = acos(1/n), theta = theta_c and theta = |pi/2 - 2 theta_c|, and the
/// corners, at a few rows of every slice.
fn hard(grid: &GlassGrid) -> Vec<[usize; 3]> {
    let rows = grid.alphas.len();
    let mut texels = Vec::new();
    for (z, ior) in grid.iors.iter().enumerate() {
        let sine = 1.0 / ior;
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        for y in [0, rows / 4, rows - 1] {
            for mu in [sine, cosine, 2.0 * sine * cosine, 0.0, 1.0] {
                let distance = |x: &usize| ((grid.mu)(*x, grid.alphas[y], *ior) - mu).abs();
                let nearest = (0..grid.columns).min_by(|a, b| distance(a).total_cmp(&distance(b)));
                texels.extend(nearest.map(|x| [x, y, z]));
            }
        }
    }
    texels
}
