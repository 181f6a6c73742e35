//! Lookups end to end, with fetches integrated exactly and from a chain.

use super::measure::{Case, all, frostbite, gain, ours, relative, shaded, unchanged};
use crate::effects::parallax::{TapRule, Taps};
use crate::effects::room::cubemap::{Chain, Ratio, Viewpoint};
use crate::effects::room::{Fetch, Lookup};
use crate::report::ChainGain;

/// A lookup with its name.
type Method = (&'static str, Box<dyn Lookup>);

/// The one that the others are compared with comes second.
const RIVAL: usize = 1;

fn methods(case: &Case) -> Vec<Method> {
    let one = |ratio, width| Box::new(case.correction(Viewpoint::Probe, ratio, width)) as Box<dyn Lookup>;
    let taps = |rule| Box::new(Taps { proxy: case.shape.clone(), probe: case.room.probe, rule }) as Box<dyn Lookup>;
    vec![
        ("direction only", one(Ratio::Distance, unchanged)),
        ("Frostbite", one(Ratio::Distance, frostbite)),
        ("ours, one fetch", one(Ratio::Area, ours)),
        ("ours, two fetches", taps(TapRule::two())),
        ("ours, three fetches", taps(TapRule::three())),
    ]
}

/// What every lookup is off by in a room.
pub(super) fn gains(case: &Case, exact: &dyn Fetch, chain: &Chain) -> Vec<ChainGain> {
    let methods = methods(case);
    let errors = |fetch: &dyn Fetch| -> Vec<Vec<f64>> {
        let of = |lookup: &dyn Lookup| {
            let row = |row| relative(&shaded(row, lookup, fetch), &row.light, all);
            case.rows.iter().map(row).collect()
        };
        methods.iter().map(|(_, lookup)| of(lookup.as_ref())).collect()
    };
    let (exact, stored) = (errors(exact), errors(chain));
    let one = |(i, (name, _)): (usize, &Method)| ChainGain {
        room: case.room.name.clone(),
        method: (*name).into(),
        exact: exact[i].clone(),
        chain: stored[i].clone(),
        gain_exact: gain(&exact[RIVAL], &exact[i]),
        gain_chain: gain(&stored[RIVAL], &stored[i]),
    };
    methods.iter().enumerate().map(one).collect()
}
