//! Creases on the edges of the proxy.

use super::super::super::words;
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
        blocks: rooms.pictures.iter().map(|pictures| Block::Table(table(pictures))).collect(),
    })
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
