//! Creases on the edges of the proxy.

use super::super::super::words;
use crate::math::sum::mean;
use crate::report::numbers::place;
use crate::report::{
    Block, ReportError, RoomPictureRow, RoomPictures, RoomsFindings, Section, TextTable, check,
};

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("creases", "pictures", rooms.pictures.len())?;
    Ok(Section {
        id: "creases".into(),
        title: "Creases".into(),
        lead: "Mean absolute error of the second differences of displayed luminance (the root 2.2 of the tone-mapped light, in [0, 1]) along rows \
               and columns of the pictures, against the round lobe, times 100: where the mirror rays of neighbouring pixels meet two walls / \
               farther than a pixel from there. A crease on the proxy’s edges has a larger first number; a ratio of 1 is none."
            .into(),
        blocks: std::iter::once(&all(&rooms.pictures))
            .chain(&rooms.pictures)
            .map(|pictures| Block::Table(table(pictures)))
            .collect(),
    })
}

/// The mean over the pictures, of the methods and roughnesses of the first.
fn all(pictures: &[RoomPictures]) -> RoomPictures {
    let mut all = RoomPictures { name: "all pictures".into(), ..pictures[0].clone() };
    for (i, row) in all.rows.iter_mut().enumerate() {
        let of = |each: fn(&RoomPictureRow) -> &[f64], column: usize| {
            let values = pictures.iter().filter_map(|p| each(p.rows.get(i)?).get(column).copied());
            mean(&values.collect::<Vec<f64>>())
        };
        row.edges = (0..all.roughness.len()).map(|column| of(|row| &row.edges, column)).collect();
        row.elsewhere = (0..all.roughness.len()).map(|column| of(|row| &row.elsewhere, column)).collect();
    }
    all
}

fn table(pictures: &RoomPictures) -> TextTable {
    let mut columns = vec![(format!("{}: edges / elsewhere at roughness", pictures.name), false)];
    columns.extend(pictures.roughness.iter().map(|&r| (place(r), true)));
    columns.extend(pictures.roughness.iter().enumerate().map(|(i, &r)| {
        let before = if i == 0 { "ratio at " } else { "" };
        (format!("{before}{}", place(r)), true)
    }));
    let row = |row: &RoomPictureRow| {
        let pairs = row.edges.iter().zip(&row.elsewhere);
        let cells = pairs.clone().map(|(a, b)| format!("{:.2} / {:.2}", 100.0 * a, 100.0 * b));
        let ratios = pairs.map(|(a, b)| if *b > 0.0 { format!("{:.2}", a / b) } else { "–".into() });
        std::iter::once(row.name.clone()).chain(cells).chain(ratios).collect()
    };
    // the reference itself has no error
    let rows = pictures.rows.iter().filter(|row| row.fetches > 0).map(row).collect();
    let mut table = words::table(&[], rows, "");
    table.columns = columns;
    table
}
