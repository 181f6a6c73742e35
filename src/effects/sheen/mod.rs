//! The effect `sheen`: the rim of cloth. Quantity `sheen-charlie`.

pub mod bake;
mod catalogue;
mod page;

use std::collections::BTreeMap;

use crate::approximate::target::TargetSpec;
use crate::approximate::{self, Counter, FitSet, FitStageError, Region, Wanted};
use crate::data::{Norm, Use};
pub use catalogue::{HYPOTHESES, RIVALS, catalogue_names, catalogue_sources};
use lobefit_truth::quantity::{SheenCharlie, Variant};

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct SheenSpec {
    /// Where the fits must hold.
    pub region: Region,
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// Errors to minimise.
    pub norms: Vec<Norm>,
}

/// Fits of E(alpha, mu), and the published ones beside them where the map of roughness is theirs.
///
/// # Errors
/// A region outside of the quantity's domain; a truth that cannot be integrated.
pub fn fit_all(spec: &SheenSpec, counter: &Counter) -> Result<FitSet, FitStageError> {
    let Region { roughness, mu, alpha_map } = spec.region;
    let spec = Wanted {
        spec: TargetSpec {
            quantity: &SheenCharlie,
            column: Some("E".into()),
            used_as: Some(Use::Value),
            variant: Variant::default(),
            alpha_map,
            domain: BTreeMap::from([("roughness".to_string(), roughness), ("mu".to_string(), mu)]),
        },
        own: &HYPOTHESES,
        user: &[],
        published: RIVALS.iter().collect(),
        norms: &spec.norms,
        max_ops: spec.max_ops,
        keeps: None,
        with_f0: None,
    };
    approximate::fit_all(&spec, counter)
}
