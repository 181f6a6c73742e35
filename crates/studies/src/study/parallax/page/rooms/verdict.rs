//! Where a method is not at least as good as Frostbite's listing.

use crate::study::parallax::findings::RoomsFindings;
use crate::study::parallax::measures::geometric_mean;
use lobefit::report::numbers::place;
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check};

/// What methods are compared against.
const REFERENCES: [&str; 2] = ["the round lobe", "GGX"];

/// One comparison with the listing: where, Frostbite's error over the method's.
struct Cell {
    place: String,
    gain: f64,
}

/// All comparisons of a method against one reference.
struct Compared {
    /// Geometric mean of the gains.
    gain: f64,
    /// Comparisons in which it is worse than the listing.
    worse: usize,
    /// Comparisons.
    of: usize,
    /// The least gain, and where.
    least: Cell,
}

impl Compared {
    /// None where nothing is compared.
    fn of(rooms: &RoomsFindings, name: &str, reference: usize) -> Option<Compared> {
        let cells = cells(rooms, name, reference);
        let gain = geometric_mean(cells.iter().map(|cell| cell.gain));
        let (worse, of) = (cells.iter().filter(|cell| cell.gain < 1.0).count(), cells.len());
        let least = cells.into_iter().min_by(|a, b| a.gain.total_cmp(&b.gain))?;
        Some(Compared { gain, worse, of, least })
    }
}

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("verdict", "chosen", rooms.chosen.len())?;
    let columns = "method|against|comparisons>|gain>|worse than Frostbite>|least gain>|where";
    let mut rows = Vec::new();
    for name in rooms.chosen.iter().filter(|name| **name != rooms.rival) {
        for (reference, against) in REFERENCES.into_iter().enumerate() {
            let Some(found) = Compared::of(rooms, name, reference) else { continue };
            rows.push(vec![
                name.clone(),
                against.into(),
                found.of.to_string(),
                format!("{:.2}", found.gain),
                found.worse.to_string(),
                format!("{:.2}", found.least.gain),
                found.least.place,
            ]);
        }
    }
    let caption = "Each comparison is one roughness: relative L2 and displayed error at points at random in each room, FLIP and relative L2 in each \
                   picture. Gain: Frostbite’s error over the method’s, the geometric mean of the comparisons. A method that is worse nowhere has a least gain of 1 or more.";
    Ok(Section::new(
        "verdict",
        "At least as good everywhere?",
        answer(rooms),
        vec![Block::Table(words::table(columns, rows, caption)), Block::Table(losses(rooms))],
    ))
}

/// The method that gains most over the listing against the round lobe, and what it gains against
/// either reference: figures of the table.
pub(in super::super) fn conclusion(rooms: &RoomsFindings) -> String {
    let names = rooms.chosen.iter().filter(|name| **name != rooms.rival);
    let gains = names.filter_map(|name| Some((name, Compared::of(rooms, name, 0)?.gain)));
    let Some((name, _)) = gains.max_by(|a, b| a.1.total_cmp(&b.1)) else { return String::new() };
    let against = REFERENCES.into_iter().enumerate().filter_map(|(reference, against)| {
        let Compared { gain, worse, of, .. } = Compared::of(rooms, name, reference)?;
        Some(format!(
            "against {against} {gain:.2} times less error than Frostbite’s listing, worse in {worse} of {of} cases"
        ))
    });
    format!("{name}: {}.\n", against.collect::<Vec<_>>().join("; "))
}

/// The question answered, for either reference.
fn answer(rooms: &RoomsFindings) -> String {
    let shown = || rooms.chosen.iter().filter(|name| **name != rooms.rival);
    let sentences = REFERENCES.iter().enumerate().map(|(reference, against)| {
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
    let columns = "worse than Frostbite|against|where|gain>";
    let mut rows = Vec::new();
    for name in rooms.chosen.iter().filter(|name| **name != rooms.rival) {
        for (reference, against) in REFERENCES.into_iter().enumerate() {
            let lost = cells(rooms, name, reference).into_iter().filter(|cell| cell.gain < 1.0);
            rows.extend(
                lost.map(|cell| vec![name.clone(), against.into(), cell.place, format!("{:.2}", cell.gain)]),
            );
        }
    }
    words::table(columns, rows, "Frostbite’s error over the method’s.")
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
