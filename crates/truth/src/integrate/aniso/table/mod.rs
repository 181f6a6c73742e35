//! Tables of the anisotropic reflection lobe: E (F = 1) averaged over the view's azimuth at every
//! texel of a grid, from far fewer integrals than texels, and proved by integrating a sample of
//! texels directly.

mod axes;
mod azimuth;
mod azimuthal;
mod barycentric;
mod check;
mod dispatch;
mod grid;
mod kernel;
mod plan;
mod rules;
mod tensor;

use rayon::prelude::*;

use super::QUANTITY;
use crate::integrate::{IntegrateError, Path};
use crate::optics::Smith;
pub use azimuth::Work;
pub use azimuthal::{Azimuthal, POINTS, Pinned};
pub use check::Checked;
pub use grid::{ASPECT, Columns, Grid, MU};

/// Digits of a node's integral beyond the tolerance.
const NODE_DIGITS: f64 = 0.5;

/// Digits beyond those asked for, tried in turn until the checked texels keep the tolerance. The
/// last two are for grids at grazing mu whose alpha is about 1.
const LADDER: [f64; 5] = [0.0, 0.6, 1.2, 1.8, 2.4];

/// A table's texels.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabulated {
    /// E of every texel, columns fastest, then rows, then slices.
    pub e: Vec<f64>,
    /// Integrand evaluations of the nodes' integrals; a first try that missed the tolerance counts
    /// with its check. Those of the last check are its own.
    pub evaluations: u64,
    /// What recomputing texels showed.
    pub checked: Checked,
}

/// E averaged over the azimuth at every texel of a grid, to an absolute `tolerance` in [1e-10,
/// 1e-2].
///
/// Errors: a grid outside its domain; a checked texel that misses the tolerance even with more
/// nodes. The node counts are fitted down to 1e-7, which grids with mu and alpha below 1e-2 may
/// miss; below it most do.
pub fn tabulate(smith: Smith, grid: &Grid, tolerance: f64) -> Result<Tabulated, IntegrateError> {
    tabulate_on(Path::Best, smith, grid, tolerance)
}

/// [`tabulate`] with given instructions, for checks that all give the same bits.
pub fn tabulate_on(
    path: Path,
    smith: Smith,
    grid: &Grid,
    tolerance: f64,
) -> Result<Tabulated, IntegrateError> {
    let asked = grid::digits(tolerance)?;
    grid.check()?;
    let (mut evaluations, mut reached, mut place) = (0, f64::INFINITY, String::new());
    for more in LADDER {
        let digits = asked + more;
        let (e, taken) = texels(path, smith, grid, digits);
        let checked = check::check(path, smith, grid, digits, &e);
        evaluations += taken;
        reached = checked.worst;
        let (alpha, mu) = grid.texel(checked.at);
        place = format!("alpha_x = {}, alpha_y = {}, mu = {mu}", alpha[0], alpha[1]);
        if checked.worst.is_nan() {
            return Err(IntegrateError::NotFinite { quantity: QUANTITY, place });
        }
        if checked.worst <= tolerance {
            return Ok(Tabulated { e, evaluations, checked });
        }
        evaluations += checked.evaluations;
    }
    Err(IntegrateError::Tolerance { quantity: QUANTITY, place, reached, tolerance })
}

fn texels(path: Path, smith: Smith, grid: &Grid, digits: f64) -> (Vec<f64>, u64) {
    let rows = plan::rows(grid, digits);
    let cosines = plan::cosines(grid, digits);
    let mut nodes = Vec::new();
    for group in &rows {
        for columns in &cosines {
            for alpha in &group.alphas {
                nodes.extend(columns.mu.iter().map(|mu| (*alpha, *mu)));
            }
        }
    }
    let work: Vec<Work> = nodes
        .par_iter()
        .map(|(alpha, mu)| azimuth::mean(path, smith, *alpha, *mu, digits + NODE_DIGITS))
        .collect();
    let values: Vec<f64> = work.iter().map(|w| w.value).collect();
    let mut e = vec![f64::NAN; grid.size().iter().product()];
    let mut start = 0;
    for group in &rows {
        for columns in &cosines {
            let end = start + group.alphas.len() * columns.mu.len();
            tensor::fill(grid, group, columns, &values[start..end], &mut e);
            start = end;
        }
    }
    (e, work.iter().map(|w| w.evaluations).sum())
}

/// E averaged over the azimuth at one point, by the rules that a table takes. alpha_x and alpha_y
/// in [1e-4, 4], mu in [1e-4, 1].
///
/// `tolerance`, in [1e-10, 1e-2], sets the node counts and is kept in most places, without a bound:
/// [`super::aniso`] has one.
pub fn mean(smith: Smith, alpha: [f64; 2], mu: f64, tolerance: f64) -> Result<Work, IntegrateError> {
    let digits = domain(alpha, mu, tolerance)?;
    Ok(azimuth::mean(Path::Best, smith, alpha, mu, digits))
}

/// E at an azimuth of the view (phi, radians, from the alpha_x axis), by the same rules: see
/// [`mean`].
pub fn at(smith: Smith, alpha: [f64; 2], mu: f64, phi: f64, tolerance: f64) -> Result<Work, IntegrateError> {
    let digits = domain(alpha, mu, tolerance)?;
    super::check(alpha, mu, Some(phi))?;
    Ok(azimuth::at(Path::Best, smith, alpha, mu, phi, digits))
}

/// Refuses a point outside the kernel's domain; else the digits of the tolerance.
fn domain(alpha: [f64; 2], mu: f64, tolerance: f64) -> Result<f64, IntegrateError> {
    let grid = Grid { columns: Columns::Fixed(&[mu]), alphas: &[1.0], aspects: &[1.0], floor: 0.0 };
    grid.check()?;
    for (input, value) in [("alpha_x", alpha[0]), ("alpha_y", alpha[1])] {
        grid::check_alpha(input, value)?;
    }
    grid::digits(tolerance)
}
