//! Pictures of a plane that reflects.

use super::super::super::{figures, words};
use crate::report::numbers::{place, significant};
use crate::report::{
    Block, Cells, Gallery, Image, ReportError, RoomPicture, RoomPictureRow, RoomPictures, RoomsFindings,
    Section, Shade, Spread, TextTable, check,
};

/// FLIP that gets the lightest colour of a map.
const LIMIT: f64 = 0.4;

/// The references in the order of the pairs.
const REFERENCES: [&str; 2] = ["round lobe", "GGX"];

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("pictures", "pictures", rooms.pictures.len())?;
    let mut blocks = Vec::new();
    for pictures in rooms.pictures.iter().filter(|pictures| !pictures.shown.is_empty()) {
        blocks.push(Block::Heading { text: pictures.name.clone() });
        blocks.extend(shown(pictures, &rooms.chosen)?);
    }
    for pictures in &rooms.pictures {
        blocks.push(Block::Heading { text: format!("{}: mean FLIP", pictures.name) });
        blocks.extend([0, 1].map(|reference| Block::Table(flips(pictures, reference))));
    }
    Ok(Section {
        id: "pictures".into(),
        title: "Pictures".into(),
        lead: "A level plane that reflects, seen by a camera off the centre; the walls are as they are. FLIP (Andersson and others 2020) of the \
               pictures as displayed, at 30 pixels per degree whatever the camera’s field, over the pixels that reflect. Against the round \
               lobe, whose directions below the plane are left out, and against GGX; “exact round lobe” is the first as an approximation \
               of the second. Relative L2 of the same pixels: results.json."
            .into(),
        blocks,
    })
}

/// The pictures of one camera with their maps, side by side.
fn shown(pictures: &RoomPictures, chosen: &[String]) -> Result<Vec<Block>, ReportError> {
    let rows: Vec<usize> =
        (0..pictures.rows.len()).filter(|&i| chosen.contains(&pictures.rows[i].name)).collect();
    let names = |with: &[&str]| -> Vec<String> {
        let own = rows.iter().map(|&i| pictures.rows[i].name.clone());
        with.iter().map(|name| format!("{name} (reference)")).chain(own).collect()
    };
    let columns = |each: &dyn Fn(&RoomPicture) -> Vec<Image>| -> Vec<Vec<Image>> {
        transposed(pictures.shown.iter().map(each).collect())
    };
    let all = columns(&|shown: &RoomPicture| {
        shown.references.iter().cloned().chain(rows.iter().map(|&i| shown.pictures[i].clone())).collect()
    });
    let mut figures_shown = vec![gallery(pictures, "as displayed", names(&REFERENCES), Cells::Colours(all))];
    for (reference, name) in REFERENCES.iter().enumerate() {
        let maps = |shown: &RoomPicture| -> Vec<Vec<f64>> {
            rows.iter().map(|&i| shown.maps[i][reference].clone()).collect()
        };
        let values = transposed(pictures.shown.iter().map(maps).collect());
        let shade = Shade::Magnitude { min: 0.0, max: LIMIT, spread: Spread::Linear };
        let cells = Cells::Values { values, shade, unit: "FLIP".into() };
        figures_shown.push(gallery(pictures, &format!("FLIP against {name}"), names(&[]), cells));
    }
    let caption = format!(
        "Left: the pictures through the tone mapper, at one exposure. Then FLIP of each pixel against either reference; {LIMIT} and above in the \
         lightest colour. A few of the methods; all are in the tables."
    );
    Ok(vec![figures(&figures_shown, &caption)?])
}

fn gallery(pictures: &RoomPictures, what: &str, rows: Vec<String>, cells: Cells) -> Gallery {
    Gallery {
        title: format!("{}: {what}", pictures.name),
        column_name: "roughness".into(),
        columns: pictures.shown.iter().map(|shown| place(shown.roughness)).collect(),
        rows,
        side: pictures.side,
        cell: 108.0,
        cells,
    }
}

/// Rows of columns from columns of rows.
fn transposed<T: Clone>(columns: Vec<Vec<T>>) -> Vec<Vec<T>> {
    let rows = columns.iter().map(Vec::len).min().unwrap_or_default();
    (0..rows).map(|i| columns.iter().map(|column| column[i].clone()).collect()).collect()
}

fn flips(pictures: &RoomPictures, reference: usize) -> TextTable {
    let name = REFERENCES[reference];
    let mut columns = vec![(format!("against {name}: mean FLIP at roughness"), false)];
    columns.extend(pictures.roughness.iter().map(|&r| (place(r), true)));
    let row = |row: &RoomPictureRow| {
        let values = row.flip[reference].iter().map(|&x| significant(x, 3));
        std::iter::once(row.name.clone()).chain(values).collect()
    };
    let list = |values: &[f64]| values.iter().map(|&x| significant(x, 2)).collect::<Vec<_>>().join(", ");
    let caption = format!(
        "{} pixels. The reference’s own relative L2 noise: {}; FLIP between its two {}: {}.",
        pictures.pixels,
        list(&pictures.noise[reference]),
        ["integrals, coarse and fine", "halves"][reference],
        list(&pictures.flip_of_noise[reference]),
    );
    let mut table = words::table(&[], pictures.rows.iter().map(row).collect(), &caption);
    table.columns = columns;
    table
}
