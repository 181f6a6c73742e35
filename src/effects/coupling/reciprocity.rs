//! Whole materials of a job's lobe over published couplings and over the best fit, as functions of
//! two directions.

use super::bake::Lobe;
use crate::approximate::Region;
use crate::data::AlphaMap;
use crate::effects::BakeError;
use crate::effects::coupling::surface::table::{Grid, ReciprocityRow, rows_of};
use crate::effects::coupling::surface::{Coupling, Factor, Lobe as Drawn};
use crate::effects::grid::{chosen, grazing};
use lobefit_truth::quantity::Specular;

/// Roughness and cosines, as far as they lie in the region: a few, since every material is
/// integrated over the hemisphere as it is drawn. The study has them all.
const ROUGHNESS: [f64; 4] = [0.2, 0.4, 0.7, 1.0];
const COSINES: [f64; 4] = [0.1, 0.3, 0.6, 1.0];

/// The rows of a lobe, and where they were measured; none where alpha is not roughness^2, which the
/// materials take it for.
pub fn rows(lobe: &Lobe) -> Result<Option<(Grid, Vec<ReciprocityRow>)>, BakeError> {
    let (spec, region) = (&lobe.spec, &lobe.spec.region);
    if region.alpha_map != AlphaMap::RoughnessSquared {
        return Ok(None);
    }
    let drawn = match spec.specular {
        Specular::Single => Drawn::Single,
        Specular::Normalised => Drawn::Normalised,
        Specular::Compensated => Drawn::Compensated,
    };
    let mut couplings = vec![
        Coupling::None,
        Coupling::OneMinusFresnel,
        Coupling::HalfVector,
        Coupling::Pesce,
        Coupling::OneMinusOwnSpecular,
        Coupling::Kelemen,
    ];
    if let Some(best) = lobe.best() {
        let factor = Factor::fitted(best.hypothesis.name(), &best.hypothesis, &best.coefficients())?;
        couplings.extend([Coupling::Factor(factor.clone()), Coupling::Symmetrised(factor)]);
    }
    let mut f0 = vec![spec.f0[0], spec.f0[1]];
    f0.dedup();
    let grid = Grid { roughness: chosen(region, &ROUGHNESS).values, mu: cosines(region), f0 };
    let rows = rows_of(spec.smith, &[drawn], &couplings, &grid)?;
    Ok(Some((grid, rows)))
}

/// The cosines that lie in the region, or as many of a range that holds too few.
fn cosines(region: &Region) -> Vec<f64> {
    let [low, high] = region.mu;
    let inside: Vec<f64> = COSINES.into_iter().filter(|mu| (low..=high).contains(mu)).collect();
    if inside.len() < 2 { grazing(region, COSINES.len()).values } else { inside }
}
