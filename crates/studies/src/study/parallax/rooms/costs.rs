//! What a lookup takes, by its emitted function.

use crate::study::StudyError;
use crate::study::parallax::findings::LookupCost;
use lobefit::data::{AlphaMap, MipChain, MipMap, ProbeLookup, SurfaceLobe};
use lobefit::effects::parallax::probe::{Level, Wanted};
use lobefit::effects::parallax::{Ratio, TapRule};

/// Of boxes and of the octagon's planes, sharp and smooth, with one to three fetches, of the mirror
/// lobe and of the fitted one; with the level of a logarithmic chain.
pub(super) fn costs(planes: u32) -> Result<Vec<LookupCost>, StudyError> {
    let shapes =
        [None, Some(planes)].into_iter().flat_map(|planes| [false, true].map(|smooth| (planes, smooth)));
    let lobes = shapes.flat_map(|shape| [SurfaceLobe::Mirror, SurfaceLobe::Fitted].map(|lobe| (shape, lobe)));
    let rules = [(1, TapRule::one()), (2, TapRule::two()), (3, TapRule::three())];
    let lookups = lobes.flat_map(|((planes, smooth), lobe)| {
        rules.map(|(taps, rule)| (ProbeLookup { hit: false, planes, smooth, taps, lobe }, rule))
    });
    let hit = ProbeLookup { hit: true, planes: None, smooth: true, taps: 1, lobe: SurfaceLobe::Mirror };
    let all = std::iter::once((hit, TapRule::one())).chain(lookups);
    all.map(|(lookup, rule)| cost(lookup, rule)).collect()
}

fn cost(lookup: ProbeLookup, rule: TapRule) -> Result<LookupCost, StudyError> {
    let chain = MipChain::Mapped { map: MipMap::Log, count: 7 };
    let wanted = Wanted {
        name: "lookup".into(),
        fetch: "fetch".into(),
        lookup,
        rule,
        header: Vec::new(),
        flow: 1.0,
        rho: Ratio::CERTIFIED,
        level: Some(Level { name: "level".into(), text: String::new(), chain }),
        alpha_map: AlphaMap::RoughnessSquared,
    };
    let (method, operations) = (method(lookup), wanted.operations()?);
    Ok(LookupCost { lookup: lookup.text(), fetches: lookup.taps, operations, method })
}

/// The method that measures it in rooms, where one does.
fn method(lookup: ProbeLookup) -> Option<String> {
    let ProbeLookup { hit, smooth, taps, .. } = lookup;
    let edges = if smooth { ", smooth" } else { "" };
    let fetches = if taps == 1 { "1 fetch".into() } else { format!("{taps} fetches") };
    match (hit, lookup.is_fitted(), taps) {
        (true, ..) => Some("rational, distances".into()),
        (false, false, 1) => Some(format!("rational, areas{edges}")),
        (false, false, _) => Some(format!("{fetches}{edges}")),
        (false, true, _) => smooth.then(|| format!("{fetches}, fitted lobe, smooth")),
    }
}
