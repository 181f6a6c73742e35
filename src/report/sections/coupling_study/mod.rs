//! The page of the study of diffuse couplings: what can be seen of an error, beside how large it is, and what is measured of whole
//! materials.

mod furnace;
mod lit;
mod ranking;

use crate::report::{CouplingStudy, Page, ReportError};

/// The page: the ranking, the pictures, the furnace.
pub(super) fn page(study: &CouplingStudy) -> Result<Page, ReportError> {
    let mut sections = vec![ranking::section(study)?];
    sections.push(lit::section(study)?);
    sections.push(furnace::section(study)?);
    sections.extend(super::surfaces::sections(&study.surfaces)?);
    Ok(Page {
        title: "lobefit study: coupling".into(),
        origin: study.origin.clone(),
        lead: "A diffuse base under a GGX lobe: what the published ways to couple the two lose or gain in a furnace, and what an eye \
               sees of that under a sky, a sun and a bright cloud. Figures in full digits: results.json, in this folder."
            .into(),
        sections,
    })
}
