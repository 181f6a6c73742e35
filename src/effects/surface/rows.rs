//! All that is measured on surfaces, as rows for a page.

use serde::Serialize;

use super::colour::{ColourRow, METALS, colour_table};
use super::darker::{DarkRow, dark_table};
use super::interface::{IORS, SchlickRow, schlick_table};
use super::table::{Grid, ReciprocityRow, reciprocity_table};
use super::{Coupling, SurfaceError};
use crate::data::Smith;
use crate::integrate::walk::Walks;

/// f0 of the dielectric whose base is darkened: that of an index of refraction of 1.5.
const DARK_F0: f64 = 0.04;

/// What is measured, and how finely.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Form of the shadowing of furnace, reciprocity and Fresnel rows; the walk is correlated by nature.
    pub smith: Smith,
    /// Couplings; formulas may be among them.
    pub couplings: Vec<Coupling>,
    /// Where.
    pub grid: Grid,
    /// Paths of each walk.
    pub walks: Walks,
}

impl Wanted {
    /// Everything over the whole grid, a million paths a walk.
    pub fn full() -> Wanted {
        let walks = Walks { paths: 1 << 20, seed: 1 };
        Wanted { smith: Smith::Correlated, couplings: Coupling::ALL.to_vec(), grid: Grid::full(), walks }
    }

    /// The same over few points with few paths, for tests.
    pub fn reduced() -> Wanted {
        Wanted { grid: Grid::reduced(), walks: Walks { paths: 1 << 14, seed: 1 }, ..Wanted::full() }
    }
}

/// The rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceRows {
    /// Where they were measured.
    pub grid: Grid,
    /// Lobes and couplings.
    pub reciprocity: Vec<ReciprocityRow>,
    /// Schlick's Fresnel against the exact one.
    pub schlick: Vec<SchlickRow>,
    /// Bases below white.
    pub darker: Vec<DarkRow>,
    /// Rough metals.
    pub colour: Vec<ColourRow>,
}

impl SurfaceRows {
    /// Measures all of it.
    ///
    /// # Errors
    /// As of the tables.
    pub fn measure(wanted: &Wanted) -> Result<SurfaceRows, SurfaceError> {
        let Wanted { smith, couplings, grid, walks } = wanted;
        Ok(SurfaceRows {
            grid: grid.clone(),
            reciprocity: reciprocity_table(*smith, couplings, grid)?,
            schlick: schlick_table(*smith, &IORS, grid)?,
            darker: dark_table(*smith, DARK_F0, grid)?,
            colour: colour_table(&METALS, &grid.roughness, *walks)?,
        })
    }
}
