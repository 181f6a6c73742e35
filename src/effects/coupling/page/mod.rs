//! The page of the couplings of diffuse bases.

mod curves;
mod furnace;
mod lobe;
pub mod materials;

use crate::effects::coupling::results::CouplingFindings;
use crate::report::sections::called_for;
use crate::report::{Page, ReportError};

/// The whole page.
pub(super) fn page(findings: &CouplingFindings) -> Result<Page, ReportError> {
    let mut sections = vec![called_for::of(std::slice::from_ref(&findings.effect), &findings.left_out)];
    sections.push(curves::section(&findings.curves)?);
    for one in &findings.lobes {
        sections.extend(lobe::sections(one)?);
        sections.push(furnace::section(one)?);
        sections.extend(materials::of_lobe(one)?);
    }
    Ok(Page {
        title: findings.origin.title("lobefit report", &findings.effect.effect),
        origin: findings.origin.clone(),
        lead: format!(
            "How much light a specular lobe leaves for the diffuse base below it: the factor by which a white base is multiplied so \
             that lobe and base together send back exactly all light, every approximation of it with its measured error and its \
             cost, and what is left of the light in a furnace, which is a white environment: the same light from everywhere, so that what \
             absorbs nothing is not seen in it. E = A + B is the albedo of the bare lobe where every facet reflects all light, \
             f0 A + B that with Schlick’s Fresnel of reflectance f0 face on; α is the lobe’s width (by default roughness squared), μ the cosine \
             of the view. Lobes are named after what multiplies them against the loss 1 − E of light between facets: nothing \
             (single), 1/E (normalised), or 1 + f0 (1/E − 1) (compensated). Figures in full digits: {}.json, in this folder.",
            findings.effect.effect
        ),
        sections,
    })
}
