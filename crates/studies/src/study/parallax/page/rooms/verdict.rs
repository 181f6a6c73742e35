//! Where a method is not at least as good as Frostbite's listing.

use crate::study::parallax::findings::RoomsFindings;
use lobefit::report::numbers::place;
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check};
use lobefit_math::{ops, sum};

/// One comparison with the listing: where, Frostbite's error over the method's.
struct Cell {
    place: String,
    gain: f64,
}

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("verdict", "chosen", rooms.chosen.len())?;
    let columns = [
        ("method", false),
        ("against", false),
        ("comparisons", true),
        ("worse than Frostbite", true),
        ("least gain", true),
        ("where", false),
    ];
    let mut rows = Vec::new();
    for name in rooms.chosen.iter().filter(|name| **name != rooms.rival) {
        for (reference, against) in ["round lobe", "GGX"].into_iter().enumerate() {
            let cells = cells(rooms, name, reference);
            let Some(least) = cells.iter().min_by(|a, b| a.gain.total_cmp(&b.gain)) else { continue };
            let worse = cells.iter().filter(|cell| cell.gain < 1.0).count();
            rows.push(vec![
                name.clone(),
                against.into(),
                cells.len().to_string(),
                worse.to_string(),
                format!("{:.2}", least.gain),
                least.place.clone(),
            ]);
        }
    }
    let caption = "Each comparison is one roughness: relative L2 and displayed error at points at random in each room, FLIP and relative L2 in each \
                   picture. A method that is worse nowhere has a least gain of 1 or more.";
    Ok(Section {
        id: "verdict".into(),
        title: "At least as good everywhere?".into(),
        lead: answer(rooms),
        blocks: vec![Block::Table(words::table(&columns, rows, caption)), Block::Table(losses(rooms))],
    })
}

/// The method that gains most over the listing against the round lobe, in the geometric mean of all
/// comparisons.
pub(in super::super) fn conclusion(rooms: &RoomsFindings) -> String {
    let gains = |name: &String| -> Option<(String, f64, usize, usize)> {
        let cells = cells(rooms, name, 0);
        let logs: Vec<f64> = cells.iter().map(|cell| ops::log(cell.gain)).collect();
        let worse = cells.iter().filter(|cell| cell.gain < 1.0).count();
        (!logs.is_empty()).then(|| (name.clone(), ops::exp(sum::mean(&logs)), worse, cells.len()))
    };
    let all = rooms.chosen.iter().filter(|name| **name != rooms.rival).filter_map(gains);
    let best = all.max_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or_else(String::new, |(name, gain, worse, of)| {
        format!(
            "{name}: {gain:.1} times less error than Frostbite’s listing, worse in {worse} of {of} cases.\n"
        )
    })
}

/// The question answered, for either reference.
fn answer(rooms: &RoomsFindings) -> String {
    let shown = || rooms.chosen.iter().filter(|name| **name != rooms.rival);
    let sentences = ["the round lobe", "GGX"].iter().enumerate().map(|(reference, against)| {
        let never: Vec<&str> = shown()
            .filter(|name| cells(rooms, name, reference).iter().all(|cell| cell.gain >= 1.0))
            .map(String::as_str)
            .collect();
        match never.as_slice() {
            [] => format!("Against {against} none of them is at least as good everywhere."),
            names => {
                format!("Against {against} these are at least as good everywhere: {}.", names.join("; "))
            }
        }
    });
    let sentences: Vec<String> = sentences.collect();
    format!(
        "Frostbite’s listing against the methods that the page shows pictures of. {} Some losses are within the noise of the references \
         (FLIP: see the tables of the pictures).",
        sentences.join(" ")
    )
}

/// Every comparison that is lost.
fn losses(rooms: &RoomsFindings) -> lobefit::report::TextTable {
    let columns = [("worse than Frostbite", false), ("against", false), ("where", false), ("gain", true)];
    let mut rows = Vec::new();
    for name in rooms.chosen.iter().filter(|name| **name != rooms.rival) {
        for (reference, against) in ["round lobe", "GGX"].into_iter().enumerate() {
            let lost = cells(rooms, name, reference).into_iter().filter(|cell| cell.gain < 1.0);
            rows.extend(
                lost.map(|cell| vec![name.clone(), against.into(), cell.place, format!("{:.2}", cell.gain)]),
            );
        }
    }
    words::table(&columns, rows, "Frostbite’s error over the method’s.")
}

fn cells(rooms: &RoomsFindings, name: &str, reference: usize) -> Vec<Cell> {
    let mut cells = Vec::new();
    let mut add = |place: &str, roughness: &[f64], theirs: &[f64], own: &[f64]| {
        for ((r, theirs), own) in roughness.iter().zip(theirs).zip(own) {
            cells.push(Cell { place: format!("{place}, roughness {}", self::place(*r)), gain: theirs / own });
        }
    };
    for room in &rooms.random {
        let rows = room.references.get(reference).map_or(&[][..], |reference| &reference.rows[..]);
        let find = |name: &str| rows.iter().find(|row| row.name == name);
        if let (Some(theirs), Some(own)) = (find(&rooms.rival), find(name)) {
            add(&format!("random points in {}, L2", room.room), &room.roughness, &theirs.l2, &own.l2);
            add(
                &format!("random points in {}, displayed", room.room),
                &room.roughness,
                &theirs.mae,
                &own.mae,
            );
        }
    }
    for pictures in &rooms.pictures {
        let find = |name: &str| pictures.rows.iter().find(|row| row.name == name);
        if let (Some(theirs), Some(own)) = (find(&rooms.rival), find(name)) {
            let (r, a, b) = (&pictures.roughness, &theirs.flip[reference], &own.flip[reference]);
            add(&format!("{}, FLIP", pictures.name), r, a, b);
            add(&format!("{}, L2", pictures.name), r, &theirs.l2[reference], &own.l2[reference]);
        }
    }
    cells
}
