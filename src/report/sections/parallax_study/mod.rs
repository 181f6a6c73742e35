//! The page of the study of lookups of a probe's cubemap, a file for each part.

mod chain;
mod proxies;
mod rooms;
mod seed;
mod slant;

use crate::report::{Page, ParallaxStudy, ReportError};

/// The page.
pub(super) fn page(study: &ParallaxStudy) -> Result<Page, ReportError> {
    let parts = [
        seed::sections(&study.seed)?,
        slant::sections(&study.slant)?,
        rooms::sections(&study.rooms)?,
        proxies::sections(&study.proxies)?,
        chain::sections(&study.chain)?,
    ];
    let sections = parts.into_iter().flatten().collect();
    Ok(Page {
        title: "lobefit study: parallax".into(),
        origin: study.origin.clone(),
        lead: "The prefiltered cubemap of a probe, looked up from shading points elsewhere in a room: what each way to correct direction and \
               roughness is off by, against lobes traced from the shading point. Figures in full digits: results.json, in this folder."
            .into(),
        sections,
    })
}
