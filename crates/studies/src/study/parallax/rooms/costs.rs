//! What a lookup takes, by its emitted function.

use crate::study::StudyError;
use crate::study::parallax::findings::LookupCost;
use crate::study::parallax::room::proxies::Tied;
use lobefit::data::{AlphaMap, ProbeLookup, SurfaceLobe};
use lobefit::effects::parallax::probe::{Called, Wanted};
use lobefit::effects::parallax::{HYPOTHESES, TapRule};
use lobefit_shade::Hypothesis;

/// Of boxes and of the octagon's planes, sharp and smooth, with one to three fetches, of the mirror
/// lobe and of the fitted one; the width is that of the cheapest formula of the catalogue, the
/// rational one.
pub(super) fn costs(planes: u32) -> Result<Vec<LookupCost>, StudyError> {
    let [entry, ..] = HYPOTHESES;
    let width = Hypothesis::parse(entry.file, entry.source)?;
    let shapes =
        [None, Some(planes)].into_iter().flat_map(|planes| [false, true].map(|smooth| (planes, smooth)));
    let lobes = shapes.flat_map(|shape| [SurfaceLobe::Mirror, SurfaceLobe::Fitted].map(|lobe| (shape, lobe)));
    let rules = [(1, TapRule::one()), (2, TapRule::two()), (3, TapRule::three())];
    let lookups = lobes.flat_map(|((planes, smooth), lobe)| {
        rules.map(|(taps, rule)| (ProbeLookup { planes, smooth, taps, lobe }, rule))
    });
    lookups.map(|(lookup, rule)| cost(lookup, rule, &width)).collect()
}

fn cost(lookup: ProbeLookup, rule: TapRule, width: &Hypothesis) -> Result<LookupCost, StudyError> {
    let wanted = Wanted {
        name: "lookup".into(),
        fetch: "fetch".into(),
        lookup,
        rule,
        header: Vec::new(),
        width: Called::new(width, &width.starts().iter().map(|x| *x as f32).collect::<Vec<_>>())?,
        level: None,
        alpha_map: AlphaMap::RoughnessSquared,
        power: Tied::FITTED,
    };
    Ok(LookupCost { lookup: lookup.text(), fetches: lookup.taps, operations: wanted.operations()? })
}
