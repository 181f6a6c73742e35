//! What tells whether a lobe or a coupling is still the formula that it was.

use std::sync::Arc;

use serde::Serialize;

use super::{Albedos, Base, Coupling, Lobe, Material, Surface, SurfaceError};
use lobefit::data::Smith;
use lobefit::effects::coupling::surface::source;
use lobefit_truth::optics::ggx::Vec3;

/// Where materials are evaluated: rough enough for light of several bounces, at a reflectance of a
/// dielectric and two of metals, over a grey base.
const ALPHA: f64 = 0.36;
const F0: [f64; 3] = [0.04, 0.3, 0.9];
const ALBEDO: f64 = 0.6;

/// Pairs of directions of unit length; the first is far from grazing, the second grazing on one
/// side.
const PAIRS: [[Vec3; 2]; 2] =
    [[[0.48, 0.6, 0.64], [0.6, 0.0, 0.8]], [[-0.96, 0.248, 0.13], [0.36, 0.48, 0.8]]];

/// One lobe over one coupling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fingerprint {
    lobe: &'static str,
    coupling: String,
    /// The formula whose operations are counted.
    source: String,
    /// f(l, v) of every pair and channel to six digits: more would tell a formula from itself with
    /// its terms in another order.
    values: Vec<String>,
}

/// The formulas and values of couplings under every lobe.
///
/// # Errors
/// A surface that cannot be made.
pub fn fingerprint(couplings: &[Coupling]) -> Result<Vec<Fingerprint>, SurfaceError> {
    let albedos = Arc::new(Albedos::new(Smith::Correlated, ALPHA)?);
    let one = |lobe: Lobe, coupling: &Coupling| {
        let base = Some(Base { albedo: [ALBEDO; 3], coupling: coupling.clone() });
        let (smith, alpha) = (Smith::Correlated, ALPHA);
        let surface = Surface::with(&Material { smith, alpha, f0: F0, lobe, base }, albedos.clone())?;
        let values = PAIRS.iter().flat_map(|[l, v]| surface.evaluate(*l, *v));
        Ok(Fingerprint {
            lobe: lobe.name(),
            coupling: coupling.name().into_owned(),
            source: source(lobe, Some(coupling)),
            values: values.map(|f| format!("{f:.5e}")).collect(),
        })
    };
    Lobe::ALL.into_iter().flat_map(|lobe| couplings.iter().map(move |c| one(lobe, c))).collect()
}
