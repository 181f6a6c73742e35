//! The lobe over its base as a function of two directions.

use super::super::reciprocity;
use crate::report::{CouplingLobe, ReportError, Section};

/// The section of a lobe; none where it was not measured.
pub(super) fn section(lobe: &CouplingLobe) -> Result<Option<Section>, ReportError> {
    if lobe.reciprocity.is_empty() {
        return Ok(None);
    }
    let section = reciprocity::section(&lobe.reciprocity)?;
    Ok(Some(Section {
        id: format!("{}-{}", section.id, lobe.specular),
        title: format!("{}, {} lobe", section.title, lobe.specular),
        lead: format!(
            "{} Here at a few places only; all lobes, couplings and places are those of the study, “lobefit report --study coupling”.",
            section.lead
        ),
        blocks: section.blocks,
    }))
}
