//! What lookups take at run time.

use crate::study::parallax::findings::{LookupCost, RoomsFindings};
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check};

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("costs", "costs", rooms.costs.len())?;
    let columns = [("lookup", false), ("fetches", true), ("operations", true)];
    let row =
        |cost: &LookupCost| vec![cost.lookup.clone(), cost.fetches.to_string(), cost.operations.to_string()];
    let caption = "Operations as the manifest counts them: an addition, a product or a comparison 1, a root 4, a division 5, a power 9.";
    Ok(Section {
        id: "costs".into(),
        title: "What a lookup takes".into(),
        lead: "Fetches and arithmetic of a pixel, of the emitted functions that take the ratio of areas and the rational width. \
               “Of the fitted lobe” is with axis, size and squash of a GGX lobe by normal, view and α; else of the round lobe about a given ray."
            .into(),
        blocks: vec![Block::Table(words::table(&columns, rooms.costs.iter().map(row).collect(), caption))],
    })
}
