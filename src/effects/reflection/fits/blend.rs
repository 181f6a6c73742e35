//! Fits of f0 A + B as one formula of f0.

use std::collections::BTreeMap;

use super::{FitSet, FitSpec, FitStageError};
use crate::approximate::target::TargetSpec;
use crate::approximate::{self, Counter, Entry, Wanted};
use crate::data::Use;
use crate::effects::reflection::BLEND_RIVALS;
use crate::effects::reflection::catalogue::BLENDS;
use lobefit_truth::quantity::GgxReflection;

/// The blends of the catalogue and, of the published ones, those that are `comparable` under the spec's map of roughness.
pub fn blends(
    spec: &FitSpec,
    comparable: impl Fn(&&Entry) -> bool,
    counter: &Counter,
) -> Result<FitSet, FitStageError> {
    let range = |name: &str, range: [f64; 2]| (name.to_string(), range);
    let wanted = Wanted {
        spec: TargetSpec {
            quantity: &GgxReflection,
            column: Some("E".into()),
            used_as: Some(Use::F0Blend),
            variant: spec.smith.into(),
            alpha_map: spec.region.alpha_map,
            domain: BTreeMap::from([range("roughness", spec.region.roughness), range("mu", spec.region.mu)]),
        },
        own: &BLENDS,
        rivals: BLEND_RIVALS.iter().filter(comparable).collect(),
        norms: &spec.norms,
        max_ops: spec.max_ops,
        keeps: None,
    };
    approximate::fit_all(&wanted, counter)
}
