//! Spheres under the environment, with the map of what is seen.

use crate::study::coupling::findings::{CouplingStudy, LitRow, LitStrip};
use crate::study::page;
use lobefit::report::figures;
use lobefit::report::numbers::{brief_bound, place, significant};
use lobefit::report::{Block, Cells, Gallery, ReportError, Section, Shade, Spread, TextTable, check, words};

/// FLIP that gets the lightest colour of a map.
const LIMIT: f64 = 0.3;

pub(super) fn section(study: &CouplingStudy) -> Result<Section, ReportError> {
    check::filled("study", "lit", study.lit.len())?;
    let mut blocks = Vec::new();
    for strip in study.lit.iter().filter(|strip| strip.shown) {
        blocks.push(Block::Heading { text: title(strip) });
        blocks.push(pictures(strip)?);
        blocks.push(Block::Table(table(strip)));
    }
    blocks.push(Block::Heading { text: "Every lobe and reflectance".into() });
    blocks.extend(study.rankings.iter().map(|r| Block::Table(summary(study, &r.lobe))));
    Ok(Section::new(
        "lit",
        "Under a sky, a sun and a cloud",
        "The same materials under an analytic environment of high dynamic range: a blue sky over brown ground, a sun at the upper \
               right and a bright cloud behind the spheres at the left, which lights them at grazing angles. The first row is the \
               reference. All couplings of a column are lit from the same directions, so that their differences are not noise. FLIP: how \
               different two pictures look to somebody who flips between them (Andersson and others 2020; 2021 for the high dynamic range, \
               HDR-FLIP).",
        blocks,
    ))
}

/// Mean FLIP over the roughnesses, by reflectance.
fn summary(study: &CouplingStudy, lobe: &str) -> TextTable {
    let strips: Vec<&LitStrip> = study.lit.iter().filter(|s| s.lobe == lobe).collect();
    let first = format!("specular lobe {lobe}: mean FLIP at");
    let columns = words::figures_after(&first, strips.iter().map(|s| format!("f0 {}", place(s.f0))));
    let names: Vec<&String> = strips.first().map_or(Vec::new(), |s| s.rows.iter().map(|r| &r.name).collect());
    let cell = |strip: &&LitStrip, i: usize| {
        let flip = strip.rows.get(i).map_or(0.0, |r| lobefit_math::sum::mean(&r.flip));
        significant(flip, 3)
    };
    let row = |(i, name): (usize, &&String)| page::row(*name, strips.iter().map(|s| cell(s, i)));
    let caption = "Mean over the spheres of all roughnesses; by roughness in results.json. At f0 = 1 the facets let nothing through, and all that a \
                   base can do is to give back what the lobe loses.";
    words::table(&columns, names.iter().enumerate().map(row).collect(), caption)
}

fn title(strip: &LitStrip) -> String {
    format!("Specular lobe {}, f0 {}", strip.lobe, place(strip.f0))
}

fn pictures(strip: &LitStrip) -> Result<Block, ReportError> {
    // The reference has a map too, of nothing, so that a sphere and its map stand side by side.
    let rows: Vec<&LitRow> = strip.rows.iter().filter(|r| !r.pictures.is_empty()).collect();
    let shown = gallery(strip, &rows, Cells::Colours(rows.iter().map(|r| r.pictures.clone()).collect()));
    let values = rows.iter().map(|r| r.maps.clone()).collect();
    let shade = Shade::Magnitude { min: 0.0, max: LIMIT, spread: Spread::Linear };
    let maps = gallery(strip, &rows, Cells::Values { values, shade, unit: "FLIP".into() });
    let caption = format!(
        "Left: the spheres through the tone mapper of the measure, all at one exposure. Right, or below: HDR-FLIP of each pixel against the \
         reference, the largest over all exposures at which the reference can be shown; {LIMIT} and above in the lightest colour.{}",
        if rows.len() < strip.rows.len() { " A few of the couplings; all are in the table." } else { "" },
    );
    figures(&[shown, maps], &caption)
}

fn gallery(strip: &LitStrip, rows: &[&LitRow], cells: Cells) -> Gallery {
    let side = rows.iter().flat_map(|r| &r.pictures).map(|p| p.width).next().unwrap_or_default();
    let what = if matches!(cells, Cells::Colours(_)) { "as shown" } else { "FLIP" };
    Gallery {
        title: format!("f0 {}: {what}", place(strip.f0)),
        column_name: "roughness".into(),
        columns: strip.roughness.iter().map(|&r| place(r)).collect(),
        rows: rows.iter().map(|r| labelled(strip, r)).collect(),
        side,
        cell: 48.0,
        cells,
    }
}

/// A row's name; the first of all is the reference.
fn labelled(strip: &LitStrip, row: &LitRow) -> String {
    let reference = strip.rows.first().is_some_and(|first| first.name == row.name);
    if reference { format!("{} (reference)", row.name) } else { row.name.clone() }
}

fn table(strip: &LitStrip) -> TextTable {
    let columns = page::columns_at("mean FLIP at roughness", &strip.roughness);
    let others = strip.rows.iter().filter(|r| r.flip.iter().any(|&f| f > 0.0));
    let rows = others.map(|r| page::row(&r.name, r.flip.iter().map(|&x| significant(x, 3)))).collect();
    let most = strip.rows.iter().flat_map(|r| &r.error).fold(0.0, |m: f64, &e| m.max(e));
    let caption = format!(
        "Mean over the pixels of each sphere. Relative noise of the reference: {}; FLIP between its two halves: {}; the largest standard \
         error of a figure of this table: {}.",
        list(&strip.noise),
        list(&strip.flip_of_noise),
        brief_bound(most, 2),
    );
    words::table(&columns, rows, &caption)
}

fn list(values: &[f64]) -> String {
    values.iter().map(|&x| significant(x, 2)).collect::<Vec<_>>().join(", ")
}
