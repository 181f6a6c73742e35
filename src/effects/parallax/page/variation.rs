//! What a fetch of each formula's width is off by on the wall.

use super::measures;
use crate::effects::parallax::results::{ParallaxLobe, VariationFinding, VariationRow};
use crate::report::sections::{figures, words};
use crate::report::{Block, Dot, ReportError, Scatter, Section, Spread, check};

const COLUMNS: &str = "name|ops>|ρ < 1: mean>|max>|where|ρ > 1: mean>|max>|where";

pub(super) fn section(lobe: &ParallaxLobe) -> Result<Section, ReportError> {
    check::filled("total variation", "variations", lobe.variations.len())?;
    let mut blocks = Vec::new();
    let near = |v: &VariationFinding| v.nearer.as_ref().map(|row| row.mean);
    let far = |v: &VariationFinding| v.farther.as_ref().map(|row| row.mean);
    let charts: Vec<Scatter> = [
        scatter(lobe, "nearer than the probe, ρ < 1", near),
        scatter(lobe, "farther, ρ > 1, not saturated", far),
    ]
    .into_iter()
    .flatten()
    .collect();
    if !charts.is_empty() {
        let caption = "Mean total variation over the cells against operations per evaluation; lower is nearer to the wanted footprint; \
                       published formulas are rings. The best width, in the last row of the table, has the least difference of energy within a radius: a \
                       formula may lie a little below its total variation.";
        blocks.push(figures(&charts, caption)?);
    }
    let mut table = words::table(COLUMNS, lobe.variations.iter().map(row).collect(), CAPTION);
    table.muted = lobe.variations.iter().map(|v| v.published).collect();
    blocks.push(Block::Table(table));
    blocks.extend(measures::blocks(lobe)?);
    Ok(Section::new(
        "variation",
        "What a fetch is off by on the wall",
        format!(
            "The chain is prefiltered with the {} lobe, {}; a formula for one lobe is not one for another. Total variation is half of \
             the absolute difference between the energy per wall area that the shading point asks for and the one that is \
             fetched: 0 where they agree, 1 where they do not overlap. It bounds the error of radiance in units of the \
             scene's range.",
            lobe.kernel, lobe.formula
        ),
        blocks,
    ))
}

const CAPTION: &str = "Total variation over an even grid of roughness and ln ρ, without the cells where even the widest lobe is too \
                       narrow. Maxima are rounded up. Published formulas are set back in grey.";

fn scatter(
    lobe: &ParallaxLobe,
    title: &str,
    value: impl Fn(&VariationFinding) -> Option<f64>,
) -> Option<Scatter> {
    let dot = |v: &VariationFinding| {
        let (ops, y) = (v.ops?, value(v).filter(|y| *y > 0.0)?);
        Some(Dot { name: v.name.clone(), x: f64::from(ops), y, published: v.published, table: false })
    };
    let dots: Vec<Dot> = lobe.variations.iter().filter_map(dot).collect();
    words::worth_a_chart(&dots).then(|| Scatter {
        title: title.into(),
        x: ("operations (square-root scale)".into(), Spread::Root),
        y: ("mean total variation".into(), Spread::Log),
        dots,
        size: (480.0, 300.0),
    })
}

fn row(v: &VariationFinding) -> Vec<String> {
    let cells = |row: &Option<VariationRow>| match row {
        Some(row) => [words::mean(row.mean), words::max(row.max), words::place(&row.at)],
        None => ["–", "–", "–"].map(String::from),
    };
    let ops = v.ops.map_or_else(|| "–".into(), |ops| ops.to_string());
    let mut out = vec![v.name.clone(), ops];
    out.extend(cells(&v.nearer));
    out.extend(cells(&v.farther));
    out
}
