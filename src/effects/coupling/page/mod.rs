//! The page of the couplings of diffuse bases.

mod curves;
mod furnace;
mod lobe;
pub mod materials;

use std::collections::BTreeSet;

use crate::effects::coupling::results::CouplingFindings;
use crate::report::sections::called_for;
use crate::report::{Page, ReportError};

/// The whole page.
pub(super) fn page(findings: &CouplingFindings) -> Result<Page, ReportError> {
    let mut sections = vec![called_for::of(std::slice::from_ref(&findings.effect), &findings.left_out)];
    sections.push(curves::section(&findings.curves)?);
    let mut known = BTreeSet::new();
    for one in &findings.lobes {
        sections.extend(lobe::sections(one, &mut known)?);
        sections.push(furnace::section(one)?);
        sections.extend(materials::of_lobe(one)?);
    }
    Ok(Page::new(
        findings.origin.title("lobefit report", &findings.effect.effect),
        findings.origin.clone(),
        format!(
            "A specular lobe leaves part of the light for the diffuse base below it. The coupling factor is what a white base is \
             multiplied by, so that lobe and base together send back exactly all light. This page has every approximation of the factor, \
             its error and its cost. Figures in full digits: {}.json, in this folder.\n\
             E = A + B is the albedo of the bare lobe where every facet reflects all light. With Schlick’s Fresnel of reflectance f0 face \
             on, the albedo is f0 A + B. α is the width of the lobe, by default roughness squared. μ is the cosine of the view. The lobe loses \
             the light 1 − E between its facets. Its name says which factor makes up for that: none (single), 1/E (normalised), or \
             1 + f0 (1/E − 1) (compensated).",
            findings.effect.effect
        ),
        sections,
    ))
}
