//! The grid of the published comparison, the truth on it, and its error columns.

#![allow(dead_code, reason = "each test binary uses its part")]
#![allow(clippy::disallowed_methods, reason = "an oracle may use the standard functions")]

pub mod forms;
pub mod page;

use lobefit::approximate::Entry;
use lobefit::data::Smith;
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::reflection::{Effort, split};
use rayon::prelude::*;

/// Points per axis: roughness over [0.02, 1], mu over [0.01, 1], ends included.
pub const SIDE: usize = 200;

/// The grid's points, mu running fastest, and the truth there.
pub struct Grid {
    pub roughness: Vec<f64>,
    pub mu: Vec<f64>,
    pub e: Vec<f64>,
    pub b: Vec<f64>,
}

impl Grid {
    /// The page's grid with E and B for alpha = roughness^2, within 1e-6.
    pub fn new(smith: Smith) -> Grid {
        Grid::of(smith, SIDE)
    }

    /// The same with `side` points per axis.
    pub fn of(smith: Smith, side: usize) -> Grid {
        let mut grid = Grid::over(0.02, side);
        let effort = Effort::new(8, 6.0);
        let points: Vec<(f64, f64)> = grid.roughness.iter().copied().zip(grid.mu.iter().copied()).collect();
        let at = |(r, mu): &(f64, f64)| split(smith, r * r, *mu, &effort);
        (grid.e, grid.b) = points.par_iter().map(at).collect();
        grid
    }

    /// Points without a truth, from another smallest roughness on.
    pub fn over(smallest: f64, side: usize) -> Grid {
        let at = |low: f64, i: usize| low + (1.0 - low) * i as f64 / (side - 1) as f64;
        let roughness = (0..side * side).map(|i| at(smallest, i / side)).collect();
        let mu = (0..side * side).map(|i| at(0.01, i % side)).collect();
        Grid { roughness, mu, e: Vec::new(), b: Vec::new() }
    }

    /// A function of roughness and mu on the grid.
    pub fn map(&self, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        self.roughness.iter().zip(&self.mu).map(|(r, mu)| f(*r, *mu)).collect()
    }
}

/// How an input of a published formula is fed.
pub type Feed = fn(&str, f64) -> f64;

/// A formula of the catalogue on the grid, in f32; `feed` gives its inputs from the grid's
/// roughness.
pub fn evaluate(entry: &Entry, grid: &Grid, f0: f32, feed: Feed) -> Vec<f64> {
    let hypothesis = Hypothesis::parse(entry.file, entry.source).expect("parses");
    let column = |name: &String| -> Vec<f32> {
        match name.as_str() {
            "mu" => grid.mu.iter().map(|mu| *mu as f32).collect(),
            "f0" => vec![f0; grid.mu.len()],
            name => grid.roughness.iter().map(|r| feed(name, *r) as f32).collect(),
        }
    };
    let inputs: Vec<Vec<f32>> = hypothesis.inputs().iter().map(column).collect();
    let values = hypothesis.tape().evaluate(&inputs, &[]).expect("finite");
    values.into_iter().map(f64::from).collect()
}

/// max, root mean square and 99th percentile (linear between order statistics) of |error|, and the
/// index of the largest.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    pub max: f64,
    pub rms: f64,
    pub p99: f64,
    pub worst: usize,
}

impl Column {
    pub fn of(found: &[f64], exact: &[f64]) -> Column {
        let errors: Vec<f64> = found.iter().zip(exact).map(|(f, e)| (f - e).abs()).collect();
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        let worst = (0..errors.len()).fold(0, |w, i| if errors[i] > errors[w] { i } else { w });
        let mut sorted = errors.clone();
        sorted.sort_by(f64::total_cmp);
        let place = 0.99 * (errors.len() - 1) as f64;
        let (low, part) = (place.floor() as usize, place.fract());
        let p99 = sorted[low] + part * (sorted[(low + 1).min(sorted.len() - 1)] - sorted[low]);
        Column { max: errors[worst], rms, p99, worst }
    }
}

/// The figures of a printed cell, as `.459/.128/.320`; none of `-`.
pub fn figures(cell: &str) -> Vec<&str> {
    let cell = cell.trim();
    if cell == "-" { Vec::new() } else { cell.split('/').map(str::trim).collect() }
}

/// Compares a measured figure with a printed one: within 2 % or one unit of the last digit printed.
/// None where it agrees.
pub fn differs(what: &str, measured: f64, printed: &str) -> Option<String> {
    let value: f64 = printed.parse().unwrap_or_else(|_| panic!("{what}: `{printed}`"));
    let digits = printed.split_once('.').map_or(0, |(_, d)| d.len());
    let unit = (0..digits).fold(1.0, |unit: f64, _| unit / 10.0);
    let near = (measured - value).abs() <= (0.02 * value.abs()).max(unit * (1.0 + 1e-9));
    (!near).then(|| format!("{what}: {measured:.5}, printed {printed}"))
}
