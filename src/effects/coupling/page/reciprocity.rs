//! The lobe over its base as a function of two directions.

use crate::effects::coupling::results::CouplingLobe;
use crate::report::sections::reciprocity;
use crate::report::{ReportError, Section, numbers};

/// The section of a lobe; none where it was not measured.
pub(super) fn section(lobe: &CouplingLobe) -> Result<Option<Section>, ReportError> {
    let Some(measured) = &lobe.reciprocity else { return Ok(None) };
    let section = reciprocity::section(&measured.rows)?;
    let list = |values: &[f64]| values.iter().map(|x| numbers::place(*x)).collect::<Vec<_>>().join(", ");
    let lead = format!(
        "Whole materials as functions f(l, v) of the directions of light and view, integrated over the hemisphere as they are drawn: at \
         roughness {} and cosine of the view {} alone. Furnace: what a white material sends back less 1, the largest of those places; \
         minus loses light, plus makes it. The tables above look at the whole domain, where errors are larger, at grazing above all. \
         Reciprocity: the largest |f(l, v) − f(v, l)| relative to their mean there, between 0 and 2. A path tracer that connects paths \
         from both ends needs 0; a game that shades towards one eye does not. All lobes, couplings and places are those of the study, \
         “lobefit report --study coupling”.",
        list(&measured.places.roughness),
        list(&measured.places.mu),
    );
    Ok(Some(Section {
        id: format!("{}-{}", section.id, lobe.specular),
        title: format!("{}, {} lobe", section.title, lobe.specular),
        lead,
        blocks: section.blocks,
    }))
}
