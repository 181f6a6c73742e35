//! All that is measured on surfaces, as rows for a page.

use serde::Serialize;

use super::colour::{ColourRow, METALS, colour_table};
use super::random_walk::{BounceRow, bounce_table};
use super::table::{Grid, ReciprocityRow, rows_with};
use super::{Coupling, Factor, Lobe, SurfaceError};
use lobefit::data::Smith;
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::walk::Walks;

/// (1 - f0)(1 - b) with b = ((1 - roughness)(1 - mu)^2)^2 for B/E, a formula without constants: a
/// factor of one side that costs little and knows no texel, as it is and made reciprocal.
const SEVEN: &str = "fn seven(roughness: f32, mu: f32, f0: f32) -> f32 {\n    let x = 1.0 - mu;\n    let y = (1.0 - roughness) * (x * x);\n    \
                     return (1.0 - f0) * (1.0 - y * y);\n}\n";

/// (roughness, mu) of the walks of white facets: where single scattering loses a sixth, and up to
/// two thirds.
const BOUNCE_VIEWS: [(f64, f64); 4] = [(0.5, 0.3), (0.8, 0.3), (1.0, 0.3), (1.0, 0.9)];

/// What is measured, and how finely.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Form of the shadowing of furnace and reciprocity rows; the walk is correlated by
    /// nature.
    pub smith: Smith,
    /// Couplings under every lobe; formulas may be among them.
    pub couplings: Vec<Coupling>,
    /// Couplings that are made for one lobe each.
    pub own: Vec<(Lobe, Coupling)>,
    /// Where.
    pub grid: Grid,
    /// Paths of each walk.
    pub walks: Walks,
}

impl Wanted {
    /// Everything over the whole grid, a million paths a walk.
    ///
    /// # Errors
    /// A formula that does not parse, a defect of this program.
    pub fn full() -> Result<Wanted, SurfaceError> {
        let walks = Walks { paths: 1 << 20, seed: 1 };
        let hypothesis =
            Hypothesis::parse("seven.wgsl", SEVEN).map_err(|e| SurfaceError::Formula(Box::new(e)))?;
        let factor = Factor::fitted("7 operations", &hypothesis, &[])?;
        let formulas = [Coupling::Factor(factor.clone()), Coupling::Symmetrised(factor)];
        let couplings = Coupling::ALL.into_iter().chain(formulas).collect();
        Ok(Wanted { smith: Smith::Correlated, couplings, own: Vec::new(), grid: Grid::full(), walks })
    }

    /// The same over few points with few paths, for tests.
    ///
    /// # Errors
    /// As of [`Wanted::full`].
    pub fn reduced() -> Result<Wanted, SurfaceError> {
        Ok(Wanted { grid: Grid::reduced(), walks: Walks { paths: 1 << 14, seed: 1 }, ..Wanted::full()? })
    }
}

/// The rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceRows {
    /// Where they were measured.
    pub grid: Grid,
    /// Lobes and couplings.
    pub reciprocity: Vec<ReciprocityRow>,
    /// Rough metals.
    pub colour: Vec<ColourRow>,
    /// The random walk of white facets.
    pub bounces: Vec<BounceRow>,
}

impl SurfaceRows {
    /// Measures all of it.
    ///
    /// # Errors
    /// As of the tables.
    pub fn measure(wanted: &Wanted) -> Result<SurfaceRows, SurfaceError> {
        let Wanted { smith, couplings, own, grid, walks } = wanted;
        Ok(SurfaceRows {
            grid: grid.clone(),
            reciprocity: rows_with(*smith, &Lobe::ALL, couplings, own, grid)?,
            colour: colour_table(&METALS, &grid.roughness, *walks)?,
            bounces: bounce_table(&BOUNCE_VIEWS, *walks)?,
        })
    }
}
