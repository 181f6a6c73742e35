//! The proof of a table: texels integrated directly, with more nodes.

use std::collections::BTreeSet;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::azimuth::{self, Work};
use super::grid::Grid;
use crate::integrate::Path;
use crate::optics::Smith;

/// Texels drawn at random.
const DRAWN: usize = 2000;

/// Seed of the draw.
const SEED: u64 = 0x6c6f_6265_6669_7431;

/// Digits of the direct integration beyond the table's.
const MORE_DIGITS: f64 = 1.5;

/// What recomputing texels showed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// Texels recomputed.
    pub texels: usize,
    /// Worst absolute difference.
    pub worst: f64,
    /// Column, row and slice of it.
    pub at: [usize; 3],
    /// Integrand evaluations of the check.
    pub evaluations: u64,
}

/// Recomputes a random sample of texels and the hard ones: first, second, middle and last of every
/// axis.
pub(super) fn check(path: Path, smith: Smith, grid: &Grid, digits: f64, e: &[f64]) -> Checked {
    let texels = texels(grid.size());
    let [columns, rows, _] = grid.size();
    let recomputed: Vec<Work> = texels
        .par_iter()
        .map(|texel| {
            let (alpha, mu) = grid.texel(*texel);
            azimuth::mean(path, smith, alpha, mu, digits + MORE_DIGITS)
        })
        .collect();
    let mut out = Checked { texels: texels.len(), worst: 0.0, at: [0; 3], evaluations: 0 };
    for ([column, row, slice], direct) in texels.into_iter().zip(recomputed) {
        let difference = (e[(slice * rows + row) * columns + column] - direct.value).abs();
        out.evaluations += direct.evaluations;
        // A difference that is not a number is the worst.
        if difference > out.worst || difference.is_nan() {
            (out.worst, out.at) = (difference, [column, row, slice]);
        }
    }
    out
}

fn texels(size: [usize; 3]) -> Vec<[usize; 3]> {
    let hard = size.map(|n| BTreeSet::from([0, 1.min(n - 1), n / 2, n.saturating_sub(2), n - 1]));
    let mut out = BTreeSet::new();
    for &slice in &hard[2] {
        for &row in &hard[1] {
            out.extend(hard[0].iter().map(|&column| [column, row, slice]));
        }
    }
    let all = size.iter().product::<usize>();
    let mut random = Pcg64::seed_from_u64(SEED);
    for _ in 0..DRAWN.min(all) {
        let i = (random.next_u64() % all as u64) as usize;
        out.insert([i % size[0], i / size[0] % size[1], i / size[0] / size[1]]);
    }
    out.into_iter().collect()
}
