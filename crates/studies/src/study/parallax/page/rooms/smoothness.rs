//! Creases on the edges of the proxy.

use crate::study::page;
use crate::study::parallax::findings::{RoomPictureRow, RoomPictures, RoomsFindings};
use lobefit::report::figures;
use lobefit::report::{Block, Curves, ReportError, Section, Series, Spread, Style, TextTable, check, words};
use lobefit_math::sum::mean;

/// Asked for: creases on edges over those elsewhere.
const BAR: f64 = 1.2;

pub(super) fn section(rooms: &RoomsFindings) -> Result<Section, ReportError> {
    check::filled("creases", "pictures", rooms.pictures.len())?;
    let all = all(&rooms.pictures);
    let mut blocks = vec![charts(rooms)?, Block::Text { text: WHY.into() }, Block::Table(ratios(&all))];
    for pictures in std::iter::once(&all).chain(&rooms.pictures) {
        blocks.push(Block::Heading { text: format!("Creases: {}", pictures.name) });
        blocks.push(Block::Table(pairs(pictures)));
    }
    Ok(Section::new(
        "creases",
        "Creases",
        "Mean magnitude of the second difference of the error of displayed luminance (sRGB’s curve of the tone-mapped light’s, in [0, 1]) over three \
               pixels in a row or a column of the pictures, against the round lobe: where their mirror rays meet two walls, and farther than a pixel \
               from there. A crease on the proxy’s edges has a larger first number. References and fetches are integrated without samples: noise, which \
               is the same on edges and elsewhere, would bring every ratio near to 1.",
        blocks,
    ))
}

/// What causes creases, by what changes them.
const WHY: &str = "Where they come from. Through the walls themselves the ratio of areas jumps at an edge, and the width of the fetch with it: a seam, the \
     larger the rougher, until wide lobes hide it. By distances nothing jumps, but the looked-up direction has a kink. Rounded by how far the lobe \
     reaches over the edge, it has none. At roughness 0.15 the lobe is about as wide as the three pixels by which an edge is found, whatever the \
     error is at edges falls together there, and a rounder body would look the corner up in a wrong place. Several fetches have smaller errors \
     elsewhere, which alone raises their ratio; at small roughness the kink of the direction at edges is theirs too. From roughness 0.5 what is left on \
     edges is less than a step of a display of 8 bits but for room B and three fetches at 0.9.";

/// The mean over the pictures, of the methods and roughnesses of the first.
fn all(pictures: &[RoomPictures]) -> RoomPictures {
    let mut all = RoomPictures { name: "all pictures".into(), ..pictures[0].clone() };
    let columns = 0..all.roughness.len();
    let over = |value: &dyn Fn(&RoomPictures) -> Option<f64>| {
        mean(&pictures.iter().filter_map(value).collect::<Vec<f64>>())
    };
    for (i, row) in all.rows.iter_mut().enumerate() {
        let of = |each: fn(&RoomPictureRow) -> &[f64], column: usize| {
            over(&|p| each(p.rows.get(i)?).get(column).copied())
        };
        row.edges = columns.clone().map(|column| of(|row| &row.edges, column)).collect();
        row.elsewhere = columns.clone().map(|column| of(|row| &row.elsewhere, column)).collect();
    }
    let own = |i: usize| columns.clone().map(|c| over(&|p| p.detail[i].get(c).copied())).collect();
    all.detail = [own(0), own(1)];
    all
}

/// The names and their creases; the reference itself has no error.
fn shown(pictures: &RoomPictures) -> impl Iterator<Item = &RoomPictureRow> {
    pictures.rows.iter().filter(|row| row.fetches > 0)
}

fn named(pictures: &RoomPictures, what: &str) -> String {
    page::columns_at(&format!("{}: {what} at roughness", pictures.name), &pictures.roughness)
}

fn ratio(edge: f64, elsewhere: f64) -> Option<f64> {
    (elsewhere > 0.0).then(|| edge / elsewhere)
}

fn ratios(pictures: &RoomPictures) -> TextTable {
    let row = |row: &RoomPictureRow| {
        let cells = row.edges.iter().zip(&row.elsewhere);
        let cells = cells.map(|(a, b)| ratio(*a, *b).map_or("–".into(), |x| format!("{x:.2}")));
        page::row(&row.name, cells)
    };
    let caption = format!("The same means, edges over elsewhere: {BAR} or lower is what was asked for.");
    words::table(&named(pictures, "edges over elsewhere"), shown(pictures).map(row).collect(), &caption)
}

fn pairs(pictures: &RoomPictures) -> TextTable {
    let cells = |name: &str, edges: &[f64], elsewhere: &[f64]| {
        let pairs = edges.iter().zip(elsewhere);
        let pairs = pairs.map(|(a, b)| format!("{:.2} / {:.2}", 100.0 * a, 100.0 * b));
        page::row(name, pairs)
    };
    let [edges, elsewhere] = &pictures.detail;
    let mut rows = vec![cells("the round lobe’s own second differences", edges, elsewhere)];
    rows.extend(shown(pictures).map(|row| cells(&row.name, &row.edges, &row.elsewhere)));
    let caption = "Times 100, edges / elsewhere. A step of a display of 8 bits is 0.39.";
    words::table(&named(pictures, "edges / elsewhere"), rows, caption)
}

/// Ratios over roughness of some of the methods, for each picture.
fn charts(rooms: &RoomsFindings) -> Result<Block, ReportError> {
    let line = |pictures: &RoomPictures, (i, row): (usize, &RoomPictureRow)| {
        let pairs = row.edges.iter().zip(&row.elsewhere);
        let ratios = pairs.zip(&pictures.roughness).filter_map(|((a, b), r)| Some((*r, ratio(*a, *b)?)));
        Series::line(&row.name, ratios.collect(), Style::Marked(i))
    };
    let chart = |pictures: &RoomPictures| {
        let rows = shown(pictures).filter(|row| rooms.chosen.contains(&row.name));
        let mut series: Vec<Series> = rows.enumerate().map(|row| line(pictures, row)).collect();
        let bar = pictures.roughness.iter().map(|r| (*r, BAR)).collect();
        series.push(Series::line(format!("{BAR}"), bar, Style::Truth));
        let axes = [("roughness", Spread::Linear), ("edges over elsewhere", Spread::Log)];
        let chart = Curves::new(&pictures.name, axes, series, (380.0, 280.0));
        Curves { y_limits: Some((0.4, 40.0)), ..chart }
    };
    let charts: Vec<Curves> = rooms.pictures.iter().map(chart).collect();
    figures(&charts, "Creases on edges over those elsewhere; the line is what was asked for.")
}
