//! What Schlick's approximation costs a dielectric, against the exact Fresnel equations.

use std::sync::Arc;

use rayon::prelude::*;
use serde::Serialize;

use super::{Albedos, Fresnel, Lobe, Material, Surface, SurfaceError};
use lobefit::data::{AlphaMap, Smith};
use lobefit_truth::optics::fresnel;

/// Cosines that are compared: 1/50 to 1.
const COSINES: usize = 50;

/// Indices of refraction that are compared.
pub const IORS: [f64; 6] = [1.2, 1.33, 1.5, 1.8, 2.0, 2.5];

/// The largest difference Schlick less exact over the grid, and where.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Schlick less exact, the largest in size.
    pub worst: f64,
    /// GGX alpha.
    pub alpha: f64,
    /// Cosine of the view.
    pub mu: f64,
}

/// One index of refraction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SchlickRow {
    /// n_inside/n_outside.
    pub ior: f64,
    /// Reflectance at normal incidence, the same for both.
    pub f0: f64,
    /// Average reflectance of a smooth surface by Schlick, (1 + 20 f0)/21.
    pub average_schlick: f64,
    /// The same exactly.
    pub average_exact: f64,
    /// Of the smooth surface, F(mu).
    pub smooth: Difference,
    /// Of the albedo of the specular lobe, single scattering; the factor of a white base differs by
    /// the same with the other sign.
    pub albedo: Difference,
    /// Of the factor of the base by lobe, normalised and compensated.
    pub factor: Vec<(String, Difference)>,
}

/// Compares both for every index of refraction, over roughnesses and 50 cosines from 0.02 to 1.
///
/// # Errors
/// A surface that cannot be made; no roughness.
pub fn schlick_table(smith: Smith, iors: &[f64], roughness: &[f64]) -> Result<Vec<SchlickRow>, SurfaceError> {
    let rows: Vec<Result<SchlickRow, SurfaceError>> =
        iors.par_iter().map(|ior| row(smith, *ior, roughness)).collect();
    rows.into_iter().collect()
}

fn row(smith: Smith, ior: f64, roughness: &[f64]) -> Result<SchlickRow, SurfaceError> {
    let mus: Vec<f64> = (1..=COSINES).map(|i| i as f64 / COSINES as f64).collect();
    let f0 = fresnel::f0_of_ior(ior);
    let lobes = [Lobe::Single, Lobe::Normalised, Lobe::Compensated];
    let mut differences: Vec<Vec<Difference>> = vec![Vec::new(); lobes.len()];
    for roughness in roughness {
        let alpha = AlphaMap::RoughnessSquared.alpha(*roughness);
        let albedos = Arc::new(Albedos::new(smith, alpha, Some(ior))?);
        for (lobe, found) in lobes.iter().zip(&mut differences) {
            let of = |fresnel| {
                Surface::with(&Material { smith, alpha, fresnel, lobe: *lobe, base: None }, albedos.clone())
            };
            let (schlick, exact) = (of(Fresnel::Schlick([f0; 3]))?, of(Fresnel::Dielectric(ior))?);
            found.extend(mus.iter().map(|mu| {
                let worst = schlick.side(*mu).left[0] - exact.side(*mu).left[0];
                Difference { worst, alpha, mu: *mu }
            }));
        }
    }
    let worst =
        |found: &[Difference]| largest(found).ok_or(SurfaceError::Empty { what: "list of roughnesses" });
    let smooth: Vec<Difference> = mus
        .iter()
        .map(|mu| {
            let worst = fresnel::schlick(f0, 1.0 - mu) - fresnel::dielectric(ior, *mu);
            Difference { worst, alpha: 0.0, mu: *mu }
        })
        .collect();
    let single = worst(&differences[0])?;
    let factor = |i: usize| worst(&differences[i]).map(|found| (lobes[i].name().to_string(), found));
    Ok(SchlickRow {
        ior,
        f0,
        average_schlick: fresnel::schlick_average(f0),
        average_exact: fresnel::dielectric_average(ior),
        smooth: worst(&smooth)?,
        albedo: Difference { worst: -single.worst, ..single },
        factor: vec![factor(1)?, factor(2)?],
    })
}

fn largest(found: &[Difference]) -> Option<Difference> {
    found.iter().copied().reduce(|a, b| if b.worst.abs() > a.worst.abs() { b } else { a })
}
