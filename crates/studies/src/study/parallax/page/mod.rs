//! The page of the study of lookups of a probe's cubemap, a file for each part.

mod chain;
mod rooms;
mod slant;

use crate::study::parallax::findings::ParallaxStudy;
use lobefit::report::{Page, ReportError, folded_after};

/// The page.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn page(study: &ParallaxStudy) -> Result<Page, ReportError> {
    // the answers first and open, then what they rest on
    let rest =
        [rooms::basis(&study.rooms)?, slant::sections(&study.slant)?, vec![chain::section(&study.chain)?]];
    let mut sections = rooms::answers(&study.rooms)?;
    sections.extend(rest.into_iter().flatten().map(|section| folded_after(0, section)));
    Ok(Page::new(
        "lobefit study: parallax",
        study.origin.clone(),
        format!(
            "{}{}{LEAD}",
            if study.reduced { crate::study::REDUCED } else { "" },
            rooms::conclusion(&study.rooms)
        ),
        sections,
    ))
}

const LEAD: &str = "The prefiltered cubemap of a probe, looked up from shading points elsewhere in a room: what each way to correct direction and \
     roughness is off by, against lobes traced from the shading point. Figures in full digits: results.json, in this folder.";
