//! The page of the study of lookups of a probe's cubemap, a file for each part.

mod chain;
mod fold;
mod proxies;
mod rooms;
mod seed;
mod slant;

use crate::report::{Page, ParallaxStudy, ReportError};

/// The page.
pub(super) fn page(study: &ParallaxStudy) -> Result<Page, ReportError> {
    // the answers first and open, then what they rest on
    let rest = [
        rooms::basis(&study.rooms)?,
        seed::sections(&study.seed)?,
        slant::sections(&study.slant)?,
        proxies::sections(&study.proxies)?,
        chain::sections(&study.chain)?,
    ];
    let mut sections = rooms::answers(&study.rooms)?;
    sections.extend(rest.into_iter().flatten().map(|section| fold::after(0, section)));
    Ok(Page {
        title: "lobefit study: parallax".into(),
        origin: study.origin.clone(),
        lead: lead(study),
        sections,
    })
}

const LEAD: &str = "The prefiltered cubemap of a probe, looked up from shading points elsewhere in a room: what each way to correct direction and \
     roughness is off by, against lobes traced from the shading point. Figures in full digits: results.json, in this folder.";

const REDUCED: &str = "REDUCED SIZE, for tests: few points, small pictures, few roughnesses. What it says of better and worse is not the study's.";

fn lead(study: &ParallaxStudy) -> String {
    if study.origin.command.contains("--reduced") { format!("{REDUCED} {LEAD}") } else { LEAD.into() }
}
