//! What the lobe of a surface is taken for.

use crate::study::parallax::findings::{FittedLobe, RoomsFindings};
use lobefit::report::numbers::significant;
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check};

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("lobes", "fits", rooms.lobes.len())?;
    let columns = "fetches>|a, b, c|d, e, f|g, h|error>|with the shipped constants>|as emitted>|mirror direction>|as emitted>|dominant direction>";
    let list = |values: &[f64]| values.iter().map(|&x| significant(x, 4)).collect::<Vec<_>>().join(", ");
    let row = |lobe: &FittedLobe| {
        let mut cells =
            vec![lobe.fetches.to_string(), list(&lobe.lean), list(&lobe.narrow), list(&lobe.squash)];
        cells.extend(
            [lobe.error, lobe.shipped, lobe.emitted, lobe.mirror, lobe.mirror_emitted, lobe.dominant]
                .map(|x| significant(x, 4)),
        );
        cells
    };
    let caption = "Errors: geometric mean over the roughnesses of the relative L2 against GGX at points of a room that is none of those above, \
                   half of them on its walls, looked up through the smooth proxy. Columns are of the rational width, as all lookups above; “as emitted” is the same \
                   with the width that emitted lookups take, `parallax_1` of the built-in scene.";
    Ok(Section::new(
        "lobes",
        "The lobe of a surface",
        "A GGX lobe leans towards the normal and is narrower across the plane of incidence. “Fitted lobe”: its axis is the mirror ray mixed \
               with the normal by min(1, a α^b μ^c), μ = n·v; its footprint is μ^(d − e α) (1 − f α) times that of the round lobe; across the \
               plane of incidence it is min(1, μ^(g − h α)) times as wide as along it, which only several fetches can follow. With \
               them the map that they are laid along is that of the wall after that of the lobe.",
        vec![Block::Table(words::table(columns, rooms.lobes.iter().map(row).collect(), caption))],
    ))
}
