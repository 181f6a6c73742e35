//! Sixteen points in which trials of an audit on other people's files found it wrong, each as a test of its
//! number, of tables and functions that are made here.
//!
//! | point | about | where |
//! |---|---|---|
//! | 1, 2, 6, 8, 13 | lookups, clamps, quantisers, order, rounding | `readings` |
//! | 3, 5 | channels of other quantities, sums, averages, encodings | `contents`, `glass` |
//! | 4, 14 | shadowings of Karis, of Estevez and Kulla | `lobes` |
//! | 7 | what samples and formats leave | `samples` |
//! | 9 | this tool's own files | `sidecars` |
//! | 10, 15, 16 | shapes, the verdict, large files | `files` |
//! | 11, 12 | shader files, functions that clamp | `shaders` |
//!
//! `uses` is what a later trial found: clamps, copies and halves that passed.

mod contents;
mod files;
mod glass;
pub mod lobes;
mod readings;
mod samples;
mod shaders;
mod sidecars;
mod uses;

use lobefit::data::Smith;

use crate::support::{Filled, both, plane};
use lobefit_audit::audit::AuditedTable;

/// Texels along each axis of most tables here.
const N: usize = 16;

/// The centre of a texel.
fn at(i: usize) -> f64 {
    (i as f64 + 0.5) / N as f64
}

/// E and B of GGX at the centre of a texel: mu along x, roughness along y.
fn ggx(x: usize, y: usize) -> (f64, f64) {
    both(Smith::Correlated, at(y) * at(y), at(x))
}

fn a(x: usize, y: usize) -> f64 {
    ggx(x, y).0 - ggx(x, y).1
}

fn b(x: usize, y: usize) -> f64 {
    ggx(x, y).1
}

fn e(x: usize, y: usize) -> f64 {
    ggx(x, y).0
}

/// A table of N x N texels.
fn table(channels: &[Filled]) -> AuditedTable {
    plane([N; 2], channels)
}
