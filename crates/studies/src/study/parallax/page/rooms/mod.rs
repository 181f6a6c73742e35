//! Lookups in rooms.

mod compared;
mod costs;
mod lobes;
mod pictures;
mod random;
mod smoothness;
mod verdict;

pub(super) use verdict::conclusion;

use crate::study::parallax::findings::{RoomGeometry, RoomsFindings};
use lobefit::report::numbers::significant;
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check, folded_after};

/// What came of it.
pub(super) fn answers(rooms: &RoomsFindings) -> Result<Vec<Section>, ReportError> {
    let references = rooms.random.iter().map(|room| room.references.len()).min().unwrap_or_default();
    Ok(vec![
        folded_after(1, verdict::section(rooms)?),
        folded_after(references, random::section(rooms)?),
        pictures::section(rooms)?,
        folded_after(3, smoothness::section(rooms)?),
    ])
}

/// What is compared, where, and at what price.
pub(super) fn basis(rooms: &RoomsFindings) -> Result<Vec<Section>, ReportError> {
    Ok(vec![compared::section(), geometry(&rooms.geometry)?, lobes::section(rooms)?, costs::section(rooms)?])
}

/// The rooms, and how points at random lie in them.
fn geometry(rooms: &[RoomGeometry]) -> Result<Section, ReportError> {
    check::filled("rooms", "geometry", rooms.len())?;
    let columns = [
        ("room", false),
        ("walls", true),
        ("panels", true),
        ("points", true),
        ("ρ: 5 %", true),
        ("50 %", true),
        ("95 %", true),
        ("stretch: 5 %", true),
        ("50 %", true),
        ("95 %", true),
    ];
    let row = |room: &RoomGeometry| {
        let mut cells = vec![room.room.clone()];
        cells.extend([room.walls, room.panels, room.points].map(|n| n.to_string()));
        cells.extend(room.rho.iter().chain(&room.stretch).map(|&x| significant(x, 3)));
        cells
    };
    let caption = "Places evenly inside, directions evenly over the sphere. ρ: distance of the point from where its ray meets a wall over that \
                   of the probe from there. Stretch: longer over shorter axis of a round lobe, seen from the probe.";
    Ok(Section {
        id: "rooms".into(),
        title: "The rooms".into(),
        lead: "Convex rooms of checker walls with a bright panel on each. A is a box about its probe, B a long low box with the probe off its \
               centre, the octagon a hall with a sloping roof. Lengths are metres."
            .into(),
        blocks: vec![Block::Table(words::table(&columns, rooms.iter().map(row).collect(), caption))],
    })
}
