//! Spheres under a sky.

use super::figures;
use crate::report::{Cells, Findings, Gallery, ReportError, Section, SkySpheres, numbers};

/// Side of a sphere in pixels of the page.
const CELL: f64 = 92.0;

pub(crate) fn section(findings: &Findings) -> Result<Option<Section>, ReportError> {
    if findings.spheres.is_empty() {
        return Ok(None);
    }
    let blocks = findings.spheres.iter().map(|one| figures(&[gallery(one)], &one.caption));
    Ok(Some(Section::new(
        "spheres",
        "Spheres under a sky",
        "What a surface shows of bright bars and dark gaps: by its lobe, and by the lobe of the roughness that stands in its place.",
        blocks.collect::<Result<_, _>>()?,
    )))
}

fn gallery(one: &SkySpheres) -> Gallery {
    Gallery {
        title: one.title.clone(),
        column_name: "roughness".into(),
        columns: one.roughness.iter().map(|r| numbers::brief(*r, 3)).collect(),
        rows: one.rows.clone(),
        side: one.pictures.first().and_then(|row| row.first()).map_or(0, |picture| picture.width),
        cell: CELL,
        cells: Cells::Colours(one.pictures.clone()),
    }
}
