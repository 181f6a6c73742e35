//! Total variation of fits and published formulas, apart for fetches that are narrowed and widened.

use super::grid::{Cell, Grid, Spread};
use crate::approximate::{Fit, FitStageError};

/// Total variation over the cells of a grid that are not saturated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variation {
    /// Where the shading point is nearer than the probe, rho < 1; none without such cells.
    pub nearer: Option<Spread>,
    /// Where it is farther, rho > 1; none without such cells.
    pub farther: Option<Spread>,
}

impl Variation {
    /// Of fetches of these widths, one for each cell.
    ///
    /// # Errors
    /// A width outside of [1e-12, 1].
    pub fn of(grid: &Grid, widths: &[f64]) -> Result<Variation, FitStageError> {
        let open = |cell: &Cell| !cell.saturated;
        Ok(Variation {
            nearer: grid.spread(widths, |cell| open(cell) && cell.rho < 1.0 - SAME)?,
            farther: grid.spread(widths, |cell| open(cell) && cell.rho > 1.0 + SAME)?,
        })
    }

    /// The larger of the two maxima; none where every cell is saturated or at rho = 1.
    pub fn max(&self) -> Option<f64> {
        [self.nearer, self.farther].into_iter().flatten().map(|spread| spread.max).reduce(f64::max)
    }
}

/// Ratios this close to 1 are 1: a grid's powers of 2 have rounding errors.
const SAME: f64 = 1e-9;

/// Of every fit, in order.
///
/// # Errors
/// As [`Variation::of`]; a formula of other inputs.
pub fn variations(grid: &Grid, fits: &[Fit]) -> Result<Vec<Variation>, FitStageError> {
    let of = |fit: &Fit| Variation::of(grid, &grid.widths(&fit.hypothesis, &fit.coefficients())?);
    fits.iter().map(of).collect()
}
