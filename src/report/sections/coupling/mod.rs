//! The page of the couplings of diffuse bases.

mod curves;
mod furnace;
mod lobe;
mod reciprocity;

use super::called_for;
use crate::report::{CouplingFindings, Page, ReportError};

/// The whole page.
pub(super) fn page(findings: &CouplingFindings) -> Result<Page, ReportError> {
    let mut sections = vec![called_for::of(std::slice::from_ref(&findings.effect), &findings.left_out)];
    sections.push(curves::section(&findings.curves)?);
    for one in &findings.lobes {
        sections.extend(lobe::sections(one, &findings.origin)?);
        sections.push(furnace::section(one)?);
        sections.extend(reciprocity::section(one)?);
    }
    Ok(Page {
        title: format!("lobefit report: {}: {}", findings.origin.scene, findings.effect.effect),
        origin: findings.origin.clone(),
        lead: format!(
            "How much light a specular lobe leaves for the diffuse base below it: the factor by which a white base is multiplied so \
             that lobe and base together send back exactly all light, every approximation of it with its measured error and its \
             cost, and what is left of the light in a furnace. Figures in full digits: {}.json, in this folder.",
            findings.effect.effect
        ),
        sections,
    })
}
