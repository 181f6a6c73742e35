//! The colour of rough metals, by every lobe and by the random walk.

use super::walks::SHOWN;
use crate::study::coupling::surface::colour::{ColourRow, WALK_EXACT, WALK_SCHLICK};
use crate::study::page;
use lobefit::report::figures;
use lobefit::report::numbers::{bound, brief, significant};
use lobefit::report::{Block, Curves, ReportError, Section, Series, Style, TextTable, check, words};

/// The channel whose albedo is drawn.
const GREEN: usize = 1;

/// The section of the averages over the hemisphere; rows must be there.
pub(super) fn section(rows: &[ColourRow]) -> Result<Section, ReportError> {
    check::filled("colour", "rows", rows.len())?;
    for row in rows {
        let field = format!("{} {} at roughness {}", row.metal, row.model, row.roughness);
        check::values("colour", &field, &row.albedo)?;
        check::values("colour", &field, &[row.saturation, row.saturation_error])?;
    }
    let metals = distinct(rows.iter().map(|row| &row.metal));
    let mut charts = Vec::new();
    for metal in &metals {
        let of_metal: Vec<&ColourRow> = rows.iter().filter(|row| row.metal == **metal).collect();
        let saturation = |row: &ColourRow| (row.saturation, row.saturation_error);
        charts.push(chart(format!("{metal}: saturation"), "1 − min/max", &of_metal, saturation));
        let green = |row: &ColourRow| (row.albedo[GREEN], row.standard_error[GREEN]);
        charts.push(chart(format!("{metal}: green albedo"), "albedo", &of_metal, green));
    }
    let caption = "What a convex body sends back on average in an environment of radiance 1. Marks: the random walks, with bars of two standard \
                   errors either way, which are shorter than the marks where they are not seen.";
    let mut blocks = vec![figures(&charts, caption)?];
    blocks.extend(metals.iter().map(|metal| Block::Table(table(metal, rows))));
    Ok(Section::new(
        "colour",
        "The colour of rough metals",
        format!(
            "Light that met several facets has taken on their colour several times. The second opinion is a random walk on the Smith \
             microsurface (Heitz, Hanika, d’Eon and Dachsbacher 2016), reflection only: “{WALK_SCHLICK}” has Schlick’s Fresnel as the lobes have, \
             “{WALK_EXACT}” that of the metal’s complex index."
        ),
        blocks,
    ))
}

/// `value` gives what is drawn and its standard error.
fn chart(title: String, unit: &str, rows: &[&ColourRow], value: impl Fn(&ColourRow) -> (f64, f64)) -> Curves {
    let models = distinct(rows.iter().map(|row| &row.model));
    let series = models.iter().enumerate().flat_map(|(i, model)| {
        let of_model: Vec<(f64, (f64, f64))> =
            rows.iter().filter(|row| row.model == **model).map(|row| (row.roughness, value(row))).collect();
        let style = match model.as_str() {
            WALK_SCHLICK => Style::Measured,
            WALK_EXACT => Style::Marked(i),
            _ => Style::Line(i),
        };
        with_bars(model, of_model, style)
    });
    Curves::linear(title, ["roughness", unit], series.collect(), (400.0, 260.0))
}

/// A line of (x, (value, standard error)), over its error bars where something was sampled.
fn with_bars(name: &str, values: Vec<(f64, (f64, f64))>, style: Style) -> Vec<Series> {
    let points = values.iter().map(|(x, (y, _))| (*x, *y)).collect();
    let line = Series::line(name, points, style);
    if values.iter().all(|(_, (_, error))| *error == 0.0) {
        return vec![line];
    }
    let ends = values.iter().flat_map(|(x, (y, error))| [(*x, y - SHOWN * error), (*x, y + SHOWN * error)]);
    vec![Series::line("", ends.collect(), Style::Bars), line]
}

/// Saturation by roughness, a row per model.
fn table(metal: &str, rows: &[ColourRow]) -> TextTable {
    let of_metal: Vec<&ColourRow> = rows.iter().filter(|row| row.metal == metal).collect();
    let first = of_metal.first().map(|row| row.model.as_str());
    let roughness = of_metal.iter().filter(|row| Some(row.model.as_str()) == first);
    let columns =
        words::figures_after("saturation at roughness", roughness.map(|row| brief(row.roughness, 3)));
    let line = |model: &String| {
        let cells =
            of_metal.iter().filter(|row| row.model == *model).map(|row| significant(row.saturation, 3));
        page::row(model, cells)
    };
    let error = of_metal.iter().map(|row| row.saturation_error).fold(0.0, f64::max);
    let models = distinct(of_metal.iter().map(|row| &row.model));
    let caption = format!(
        "{metal}: 1 less the smallest over the largest channel of the mean albedo. Standard error of the walks at most {}.",
        bound(error, 1)
    );
    words::table(&columns, models.into_iter().map(line).collect(), &caption)
}

/// Each once, in the order of the first.
fn distinct<'a>(names: impl Iterator<Item = &'a String>) -> Vec<&'a String> {
    let mut found: Vec<&String> = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}
