//! The page of the study of diffuse couplings: what can be seen of an error, beside how large it
//! is, and what is measured of whole materials.

mod furnace;
mod lit;
mod metals;
mod ranking;
mod walks;

use crate::study::coupling::findings::CouplingStudy;
use crate::study::coupling::surface::SurfaceRows;
use lobefit::effects::coupling::page::materials;
use lobefit::report::words;
use lobefit::report::{Block, Page, ReportError, Section, check};

const LEAD: &str = "A diffuse base under a GGX lobe: what the published ways to couple the two lose or gain in a furnace, and what an eye \
     sees of that under a sky, a sun and a bright cloud. Figures in full digits: results.json, in this folder.";

/// The page: the ranking, what the names mean, the pictures, the furnace.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn page(study: &CouplingStudy) -> Result<Page, ReportError> {
    let mut sections = vec![ranking::section(study)?, names(study)?];
    sections.push(lit::section(study)?);
    sections.push(furnace::section(study)?);
    sections.extend(surfaces(&study.surfaces)?);
    Ok(Page::new(
        "lobefit study: coupling",
        study.origin.clone(),
        format!(
            "{}{}{LEAD}",
            if study.reduced { crate::study::REDUCED } else { "" },
            ranking::conclusion(study)
        ),
        sections,
    ))
}

/// The sections of what is measured on whole materials, in the order of a page.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn surfaces(rows: &SurfaceRows) -> Result<Vec<Section>, ReportError> {
    Ok(vec![
        materials::section(&rows.reciprocity)?,
        metals::section(&rows.colour)?,
        walks::section(&rows.bounces)?,
    ])
}

/// What the names of lobes and couplings mean.
fn names(study: &CouplingStudy) -> Result<Section, ReportError> {
    check::filled("study", "meanings", study.meanings.len())?;
    let table = |lobe: bool, columns: &str, caption: &str| {
        let meanings = study.meanings.iter().filter(|m| m.lobe == lobe);
        let rows = meanings.map(|m| vec![m.name.clone(), m.meaning.clone()]).collect();
        Block::Table(words::table(columns, rows, caption))
    };
    Ok(Section::new(
        "names",
        "What is compared",
        "A specular lobe over a diffuse base of albedo ρ: f(l, v) = lobe + ρ/π factor. l and v are the directions of light and view, n the \
               normal, h the half vector, F Fresnel’s reflectance (Schlick’s), f0 that at normal incidence; E is the albedo of the single lobe \
               with F = 1, “avg” the average over the hemisphere weighted with the cosine.",
        vec![
            table(true, "lobe|what it is", "Specular lobes."),
            table(false, "coupling|factor of the base", "Couplings of the base."),
        ],
    ))
}
