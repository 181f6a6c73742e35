//! The functions that look a probe up through a proxy.

use crate::effects::parallax::results::{LookupFinding, ParallaxLobe};
use crate::report::sections::words;
use crate::report::{Block, Section};

const COLUMNS: &str = "function|proxy|edges|lobe|fetches>|ops>|width|chain";

/// Nothing where no lookup was asked for.
pub(super) fn section(lobe: &ParallaxLobe) -> Option<Section> {
    if lobe.lookups.is_empty() {
        return None;
    }
    let row = |one: &LookupFinding| {
        vec![
            one.function.clone(),
            one.proxy.replace('_', " "),
            one.edges.clone(),
            one.lobe.clone(),
            one.fetches.to_string(),
            one.ops.to_string(),
            one.width.clone(),
            one.chain.clone().unwrap_or_else(|| "none: returns widths".into()),
        ]
    };
    let caption = "Operations of a call, those of the functions that it calls among them; the chain is the one whose levels are returned. What \
                   one fetch is off by is said of its width, above. Lobes: `mirror` is round about the reflected ray; `fitted` leans and narrows as GGX \
                   does, by normal and view.";
    Some(Section::new(
        "lookups",
        "Lookups through a proxy",
        "Where the ray that a surface reflects meets the proxy of the room, what to fetch from there, and in how many fetches.",
        vec![Block::Table(words::table(COLUMNS, lobe.lookups.iter().map(row).collect(), caption))],
    ))
}
