//! The page of lookups of prefiltered probes.

mod chains;
mod lookups;
mod measures;
mod variation;
mod widths;

use std::collections::BTreeSet;

use crate::effects::parallax::results::{ParallaxFindings, ParallaxLobe};
use crate::report::sections::{approximations, called_for};
use crate::report::{Page, ReportError, Section};

/// The whole page.
pub(super) fn page(findings: &ParallaxFindings) -> Result<Page, ReportError> {
    let mut sections = vec![called_for::of(std::slice::from_ref(&findings.effect), &findings.left_out)];
    let mut known = BTreeSet::new();
    for one in &findings.lobes {
        sections.extend(of_lobe(one, &mut known)?);
    }
    Ok(Page::new(
        findings.origin.title("lobefit report", &findings.effect.effect),
        findings.origin.clone(),
        format!(
            "How wide a lobe to fetch from a prefiltered probe so that it covers the wall as a lobe of the shading point does: the \
             width α′ by the lobe's α and ρ, the shading point's distance from the wall over the probe's; every formula of it with \
             its measured error and its cost. Figures in full digits: {}.json, in this folder.",
            findings.effect.effect
        ),
        sections,
    ))
}

/// The sections of a lobe, with its name in title and anchor. Published formulas are those of every lobe:
/// links lead to the first list that has a name.
fn of_lobe(lobe: &ParallaxLobe, known: &mut BTreeSet<String>) -> Result<Vec<Section>, ReportError> {
    let mut sections = vec![variation::section(lobe)?];
    sections.extend(approximations::section(&lobe.approximations, &[], known)?);
    sections.push(widths::section(lobe)?);
    sections.extend(chains::section(lobe));
    sections.extend(lookups::section(lobe));
    for section in &mut sections {
        section.id = format!("{}-{}", section.id, lobe.kernel);
        section.title = format!("{}, {} chains", section.title, lobe.kernel);
    }
    Ok(sections)
}
