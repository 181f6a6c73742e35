//! Bases darker than white. Every factor is made for a white base, which it leaves exactly what the
//! lobe does not take; a darker base absorbs its share of that, so that no albedo in [0, 1] can
//! make light where white does not. How dark it looks is a choice: the plain factor gives rho times
//! the light that is left, the interreflected one also absorbs light that the lobe sends back to
//! the base.

use rayon::prelude::*;
use serde::Serialize;

use super::measure::Rules;
use super::table::Grid;
use super::{Base, Coupling, Fresnel, Lobe, Material, Surface, SurfaceError};
use lobefit::data::Smith;
use lobefit_truth::integrate::Estimate;

/// Albedos of the base that are compared.
pub const ALBEDOS: [f64; 6] = [0.0, 0.2, 0.5, 0.8, 0.95, 1.0];

/// One coupling and one albedo of the base.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AbsorbingRow {
    /// Name of the coupling.
    pub coupling: String,
    /// Albedo of the base.
    pub rho: f64,
    /// Least total albedo of the material over the grid.
    pub least: f64,
    /// Largest total albedo over the grid.
    pub most: f64,
    /// Mean over the grid of the base's part over rho times what the lobe leaves: 1 for a plain
    /// factor; none for a black base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// Whether nowhere on the grid the material got darker, beyond what is known of it, as its base
    /// got lighter.
    pub monotone: bool,
}

/// Measures the couplings that close the furnace of a white base, over [`ALBEDOS`], with a
/// compensated lobe of the f0 given.
///
/// # Errors
/// A surface that cannot be measured.
pub fn absorbing_table(smith: Smith, f0: f64, grid: &Grid) -> Result<Vec<AbsorbingRow>, SurfaceError> {
    let couplings = [Coupling::OneMinusOwnSpecular, Coupling::Kelemen, Coupling::Interreflected];
    let (views, albedos) = (grid.views(), grid.albedos(smith)?);
    let mut rows: Vec<AbsorbingRow> = Vec::new();
    for coupling in couplings {
        let mut before: Option<Vec<Estimate>> = None;
        for rho in ALBEDOS {
            let at =
                |(i, (alpha, mu)): (usize, &(f64, f64))| -> Result<(Estimate, Option<f64>), SurfaceError> {
                    let base = Some(Base { albedo: [rho; 3], coupling: coupling.clone() });
                    let (alpha, fresnel, lobe) = (*alpha, Fresnel::Schlick([f0; 3]), Lobe::Compensated);
                    let material = Material { smith, alpha, fresnel, lobe, base };
                    let surface = Surface::with(&material, albedos[i / grid.mu.len()].clone())?;
                    let found = Rules::new(alpha, *mu).albedo(&surface)?;
                    let left = surface.side(*mu).left[0];
                    Ok((found.total()[0], (rho > 0.0).then(|| found.base[0].value / (rho * left))))
                };
            let found: Vec<Result<_, SurfaceError>> = views.par_iter().enumerate().map(at).collect();
            let found: Vec<(Estimate, Option<f64>)> = found.into_iter().collect::<Result<_, _>>()?;
            let total: Vec<Estimate> = found.iter().map(|x| x.0).collect();
            let shares: Option<f64> = found.iter().map(|x| x.1).sum();
            // Both are known to their bounds only.
            let lighter =
                |(now, before): (&Estimate, &Estimate)| now.value + now.error >= before.value - before.error;
            rows.push(AbsorbingRow {
                coupling: coupling.name().into(),
                rho,
                least: total.iter().map(|x| x.value).fold(f64::INFINITY, f64::min),
                most: total.iter().map(|x| x.value).fold(f64::NEG_INFINITY, f64::max),
                share: shares.map(|shares| shares / found.len() as f64),
                monotone: before.is_none_or(|before| total.iter().zip(&before).all(lighter)),
            });
            before = Some(total);
        }
    }
    Ok(rows)
}
