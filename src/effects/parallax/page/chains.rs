//! The functions of the levels of chains.

use crate::effects::parallax::results::ParallaxLobe;
use crate::report::sections::words;
use crate::report::{Block, Section};

const COLUMNS: &str = "function|chain|gives|ops>|max, levels>|where";

/// Nothing where no chain was asked for.
pub(super) fn section(lobe: &ParallaxLobe) -> Option<Section> {
    if lobe.chains.is_empty() {
        return None;
    }
    let row = |one: &crate::effects::parallax::results::ChainFinding| {
        vec![
            one.function.clone(),
            one.chain.clone(),
            one.gives.clone(),
            one.ops.to_string(),
            words::max(one.max),
            words::place(&one.at),
        ]
    };
    let caption = "Errors in levels, in f32: of `mip` against the map itself, of `roughness` after the round trip from roughness to mip and back, of the others \
                   against the level that holds the best width, where a fetch is not saturated and the chain holds the roughness.";
    Some(Section::new(
        "levels",
        "Levels of the chain",
        "From the level of a lobe to the level to fetch, by the most accurate of the fits.",
        vec![Block::Table(words::table(COLUMNS, lobe.chains.iter().map(row).collect(), caption))],
    ))
}
