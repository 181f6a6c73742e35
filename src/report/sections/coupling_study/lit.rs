//! Spheres under the environment, with the map of what is seen.

use super::super::{figures, words};
use crate::report::numbers::{brief, place, significant};
use crate::report::{
    Block, Cells, CouplingStudy, Gallery, LitRow, LitStrip, ReportError, Section, Shade, Spread, TextTable,
    check,
};

/// FLIP that gets the lightest colour of a map.
const LIMIT: f64 = 0.3;

pub(super) fn section(study: &CouplingStudy) -> Result<Section, ReportError> {
    check::filled("study", "lit", study.lit.len())?;
    let mut blocks = Vec::new();
    for strip in &study.lit {
        blocks.push(Block::Heading { text: title(strip) });
        if strip.shown {
            blocks.push(pictures(strip)?);
        }
        blocks.push(Block::Table(table(strip)));
    }
    Ok(Section {
        id: "lit".into(),
        title: "Under a sky, a sun and a cloud".into(),
        lead: "The same materials under an analytic environment of high dynamic range: a blue sky over brown ground, a sun at the upper \
               right and a bright cloud behind the spheres at the left, which lights them at grazing angles. The first row is the \
               reference. All couplings of a column are lit from the same directions, so that their differences are not noise."
            .into(),
        blocks,
    })
}

fn title(strip: &LitStrip) -> String {
    format!("Specular lobe {}, f0 {}", strip.lobe, place(strip.f0))
}

fn pictures(strip: &LitStrip) -> Result<Block, ReportError> {
    let shown =
        gallery(strip, &strip.rows, Cells::Colours(strip.rows.iter().map(|r| r.pictures.clone()).collect()));
    let others = strip.rows.get(1..).unwrap_or_default();
    let values = others.iter().map(|r| r.maps.clone()).collect();
    let shade = Shade::Magnitude { min: 0.0, max: LIMIT, spread: Spread::Linear };
    let maps = gallery(strip, others, Cells::Values { values, shade, unit: "FLIP".into() });
    let caption = format!(
        "Left: the spheres through the tone mapper of the measure, at one exposure for all. Right: HDR-FLIP of each pixel against the \
         reference, the largest over all exposures at which the reference can be shown; {LIMIT} and above in the lightest colour.",
    );
    figures(&[shown, maps], &caption)
}

fn gallery(strip: &LitStrip, rows: &[LitRow], cells: Cells) -> Gallery {
    let side = rows.iter().flat_map(|r| &r.pictures).map(|p| p.width).next().unwrap_or_default();
    let what = if matches!(cells, Cells::Colours(_)) { "as shown" } else { "FLIP" };
    Gallery {
        title: format!("{}: {what}", title(strip)),
        column_name: "roughness".into(),
        columns: strip.roughness.iter().map(|&r| place(r)).collect(),
        rows: rows.iter().map(|r| r.name.clone()).collect(),
        side,
        density: 1,
        cells,
    }
}

fn table(strip: &LitStrip) -> TextTable {
    let mut columns = vec![("mean FLIP at roughness".to_string(), false)];
    columns.extend(strip.roughness.iter().map(|&r| (place(r), true)));
    let others = strip.rows.iter().filter(|r| r.flip.iter().any(|&f| f > 0.0));
    let row = |name: &str, values: &[f64], digits: usize| {
        let cells = values.iter().map(|&x| significant(x, digits));
        std::iter::once(name.to_string()).chain(cells).collect::<Vec<_>>()
    };
    let rows = others.map(|r| row(&r.name, &r.flip, 3)).collect();
    let least = strip.rows.iter().flat_map(|r| &r.error).fold(0.0, |m: f64, &e| m.max(e));
    let caption = format!(
        "Mean over the pixels of each sphere. Relative noise of the reference: {}; FLIP between its two halves: {}; the largest standard \
         error of a figure of this table: {}.",
        list(&strip.noise),
        list(&strip.flip_of_noise),
        brief(least, 2),
    );
    let mut table = words::table(&[], rows, &caption);
    table.columns = columns;
    table
}

fn list(values: &[f64]) -> String {
    values.iter().map(|&x| significant(x, 2)).collect::<Vec<_>>().join(", ")
}
