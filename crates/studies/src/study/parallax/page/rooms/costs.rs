//! What lookups take at run time, and what they are off by.

use crate::study::parallax::findings::{LookupCost, RoomsFindings};
use crate::study::parallax::measures::geometric_mean;
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check};

/// The method that corrects nothing.
const UNCORRECTED: &str = "no parallax";

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("costs", "costs", rooms.costs.len())?;
    let columns = "lookup|fetches>|operations>|relative L2>|Frostbite’s over it>|uncorrected over it>";
    let caption = "Operations as the manifest counts them: an addition, a product or a comparison 1, a root or reciprocal 4, a division 5; from place \
                   and ray to direction and level of a logarithmic chain. Relative L2 against the round lobe traced from the shading point, and how many \
                   times the errors of Frostbite’s listing and of the fetch along the uncorrected ray are as large: geometric means over roughness at \
                   points at random, for boxes of rooms A and B, for planes of the octagon, for hits of all three.";
    let rows = rooms.costs.iter().map(|cost| row(rooms, cost)).collect();
    Ok(Section::new(
        "costs",
        "What a lookup takes, and what it is off by",
        "Fetches and arithmetic of a pixel, of the emitted functions. “Of the fitted lobe” is with axis, size and squash of a GGX lobe by \
               normal, view and α; else of the round lobe about a given ray.",
        vec![Block::Table(words::table(columns, rows, caption))],
    ))
}

fn row(rooms: &RoomsFindings, cost: &LookupCost) -> Vec<String> {
    let mut row = vec![cost.lookup.clone(), cost.fetches.to_string(), cost.operations.to_string()];
    let errors = |method: &str| -> Vec<f64> {
        let measured = rooms.random.iter().filter(|room| {
            let octagon = room.room == "octagon";
            cost.lookup.starts_with("what") || octagon == cost.lookup.contains("planes")
        });
        let rows =
            measured.filter_map(|room| room.references.first()?.rows.iter().find(|row| row.name == method));
        rows.flat_map(|row| row.l2.iter().copied()).collect()
    };
    let own = cost.method.as_deref().map(errors).filter(|own| !own.is_empty());
    let mean = |own: &Vec<f64>| geometric_mean(own.iter().copied());
    row.push(own.as_ref().map_or_else(|| "–".into(), |own| format!("{:.3}", mean(own))));
    for other in [rooms.rival.as_str(), UNCORRECTED] {
        let ratio = |own: &Vec<f64>| format!("{:.2}", mean(&errors(other)) / mean(own));
        row.push(own.as_ref().map_or_else(|| "–".into(), ratio));
    }
    row
}
