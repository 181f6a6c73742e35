//! Pictures of a plane that reflects.

use crate::study::page;
use crate::study::parallax::findings::{RoomPicture, RoomPictureRow, RoomPictures, RoomsFindings};
use lobefit::report::figures;
use lobefit::report::numbers::{place, significant};
use lobefit::report::{
    Block, Cells, Gallery, ReportError, Section, Shade, Spread, TextTable, Tile, check, folded, words,
};

/// FLIP that gets the lightest colour of a map.
const LIMIT: f64 = 0.4;

/// The references in the order of the pairs.
const REFERENCES: [&str; 2] = ["round lobe", "GGX"];

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("pictures", "pictures", rooms.pictures.len())?;
    let mut blocks = Vec::new();
    for pictures in rooms.pictures.iter().filter(|pictures| !pictures.shown.is_empty()) {
        let grids = pictures.shown.iter().map(|shown| grid(pictures, shown, &rooms.chosen));
        let caption = format!(
            "Above: the pictures through the tone mapper, at one exposure. Below: FLIP of each pixel against either reference; {LIMIT} and above in \
             the lightest colour. A few of the methods; all are in the tables."
        );
        blocks.push(figures(&grids.collect::<Result<Vec<_>, _>>()?, &caption)?);
    }
    let tables = rooms.pictures.iter().flat_map(|pictures| {
        let heading = Block::Heading { text: format!("{}: mean FLIP", pictures.name) };
        std::iter::once(heading).chain([0, 1].map(|reference| Block::Table(flips(pictures, reference))))
    });
    blocks.push(folded("Mean FLIP of every method in every picture", tables.collect()));
    Ok(Section::new(
        "pictures",
        "Pictures",
        "A level plane that reflects, seen by a camera off the centre; the walls are as they are. FLIP (Andersson and others 2020) of the \
               pictures as displayed, at 30 pixels per degree whatever the camera’s field, over the pixels that reflect. Against the round \
               lobe, whose directions below the plane are left out, and against GGX; “exact round lobe” is the first as an approximation \
               of the second. Relative L2 of the same pixels: results.json.",
        blocks,
    ))
}

/// The pictures of one camera at one roughness, the references first, and below each its maps.
fn grid(pictures: &RoomPictures, shown: &RoomPicture, chosen: &[String]) -> Result<Gallery, ReportError> {
    check::size("pictures", "references", shown.references.len(), REFERENCES.len())?;
    for (field, count) in [("pictures", shown.pictures.len()), ("maps", shown.maps.len())] {
        check::size("pictures", field, count, pictures.rows.len())?;
    }
    let rows: Vec<usize> =
        (0..pictures.rows.len()).filter(|&i| chosen.contains(&pictures.rows[i].name)).collect();
    let references = REFERENCES.iter().map(|name| format!("{name} (reference)"));
    let images = shown.references.iter().chain(rows.iter().map(|&i| &shown.pictures[i]));
    let mut tiles = vec![images.cloned().map(Tile::Colours).collect::<Vec<Tile>>()];
    for reference in 0..REFERENCES.len() {
        let none = REFERENCES.iter().map(|_| Tile::Nothing);
        tiles
            .push(none.chain(rows.iter().map(|&i| Tile::Values(shown.maps[i][reference].clone()))).collect());
    }
    Ok(Gallery {
        title: format!("{}, roughness {}", pictures.name, place(shown.roughness)),
        column_name: String::new(),
        columns: references.chain(rows.iter().map(|&i| pictures.rows[i].name.clone())).collect(),
        rows: std::iter::once("as displayed".into())
            .chain(REFERENCES.iter().map(|name| format!("FLIP against {name}")))
            .collect(),
        side: pictures.side,
        cell: CELL,
        cells: Cells::Tiles {
            tiles,
            shade: Shade::Magnitude { min: 0.0, max: LIMIT, spread: Spread::Linear },
            unit: "FLIP".into(),
        },
    })
}

/// Side of a picture on the page.
const CELL: f64 = 98.0;

fn flips(pictures: &RoomPictures, reference: usize) -> TextTable {
    let name = REFERENCES[reference];
    let columns = page::columns_at(&format!("against {name}: mean FLIP at roughness"), &pictures.roughness);
    let row =
        |row: &RoomPictureRow| page::row(&row.name, row.flip[reference].iter().map(|&x| significant(x, 3)));
    let list = |values: &[f64]| values.iter().map(|&x| significant(x, 2)).collect::<Vec<_>>().join(", ");
    let caption = format!(
        "{} pixels. The reference’s own relative L2 noise: {}; FLIP between its two {}: {}.",
        pictures.pixels,
        list(&pictures.noise[reference]),
        ["integrals, coarse and fine", "halves"][reference],
        list(&pictures.flip_of_noise[reference]),
    );
    words::table(&columns, pictures.rows.iter().map(row).collect(), &caption)
}
