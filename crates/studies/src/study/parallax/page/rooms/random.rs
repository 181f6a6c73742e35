//! Errors at points at random.

use crate::study::page;
use crate::study::parallax::findings::{RandomReference, RandomRoom, RandomRow, RoomsFindings};
use lobefit::report::figures;
use lobefit::report::numbers::significant;
use lobefit::report::{Block, Curves, ReportError, Section, Series, Spread, Style, TextTable, check, words};

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("random", "rooms", rooms.random.len())?;
    let references = rooms.random.iter().map(|room| room.references.len()).min().unwrap_or_default();
    let mut blocks: Vec<Block> = (0..references).map(|i| Block::Table(gains(rooms, i))).collect();
    blocks.push(charts(rooms)?);
    for room in &rooms.random {
        for reference in &room.references {
            blocks.push(Block::Table(table(room, reference)));
        }
    }
    Ok(Section::new(
        "random",
        "Points at random",
        "Relative L2 of linear radiance over the points, every fetch and reference integrated without texels. “Round lobe”: the lobe that \
               the chain is prefiltered with, traced from the point itself; no surface is there. “GGX”: what a GGX surface with \
               height-correlated Smith and no Fresnel reflects over its own albedo, n·v even from 0.05 to 1. Where there is no \
               surface, methods that differ in what they take its lobe for are the same but for its width. Roughness is √α.",
        blocks,
    ))
}

/// Gains of every method in every room, against one of the references.
fn gains(rooms: &RoomsFindings, reference: usize) -> TextTable {
    let name = rooms.random.first().and_then(|room| room.references.get(reference));
    let against = name.map_or("", |reference| reference.name.as_str());
    let gains = rooms.random.iter().map(|room| format!("{}: L2>|displayed", titled(&room.room)));
    let columns = words::figures_after(&format!("gain against {against}|fetches>"), gains);
    let references: Vec<&RandomReference> =
        rooms.random.iter().filter_map(|room| room.references.get(reference)).collect();
    let names = references.first().map_or(&[][..], |reference| &reference.rows[..]);
    let row = |(i, first): (usize, &RandomRow)| {
        let mut cells = vec![first.name.clone(), first.fetches.to_string()];
        for row in references.iter().filter_map(|reference| reference.rows.get(i)) {
            cells.extend([row.gain_l2, row.gain_mae].map(|gain| format!("{gain:.2}")));
        }
        cells
    };
    let caption = "Gain over Frostbite’s listing: its error over the method’s, the geometric mean over the roughnesses; above 1 is better. L2: of \
                   linear radiance. Displayed: mean absolute error of x/(1 + x).";
    words::table(&columns, names.iter().enumerate().map(row).collect(), caption)
}

fn charts(rooms: &RoomsFindings) -> Result<Block, ReportError> {
    let charts: Vec<Curves> = rooms
        .random
        .iter()
        .flat_map(|room| room.references.iter().map(|reference| chart(room, reference, &rooms.chosen)))
        .collect();
    figures(
        &charts,
        "Relative L2 over roughness of some of the methods, and the noise of the reference itself.",
    )
}

fn chart(room: &RandomRoom, reference: &RandomReference, chosen: &[String]) -> Curves {
    let line = |name: &str, values: &[f64], style| {
        Series::line(name, room.roughness.iter().copied().zip(values.iter().copied()).collect(), style)
    };
    let rows = reference.rows.iter().filter(|row| chosen.contains(&row.name));
    let mut series: Vec<Series> =
        rows.enumerate().map(|(i, row)| line(&row.name, &row.l2, Style::Marked(i))).collect();
    series.push(line("noise of the reference", &reference.noise, Style::Truth));
    let title = format!("{}, {}", titled(&room.room), reference.name);
    let axes = [("roughness", Spread::Linear), ("relative L2", Spread::Log)];
    Curves { y_limits: Some((0.002, 1.0)), ..Curves::new(title, axes, series, (380.0, 280.0)) }
}

/// `room A`, `octagon`.
fn titled(room: &str) -> String {
    if room.chars().count() == 1 { format!("room {room}") } else { room.into() }
}

fn table(room: &RandomRoom, reference: &RandomReference) -> TextTable {
    let first = format!("{}, {}: relative L2 at roughness", titled(&room.room), reference.name);
    let columns = page::columns_at(&first, &room.roughness) + "|least gain>";
    let rows = reference.rows.iter().map(|row| {
        let values = row.l2.iter().map(|&x| significant(x, 3));
        page::row(&row.name, values.chain([format!("{:.2}", row.least_l2)]))
    });
    let noise: Vec<String> = reference.noise.iter().map(|&x| significant(x, 2)).collect();
    let caption = format!(
        "Noise of the reference, from its two halves: {}. Least gain: over Frostbite, at the roughness where it is smallest.",
        noise.join(", ")
    );
    words::table(&columns, rows.collect(), &caption)
}
