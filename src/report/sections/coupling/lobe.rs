//! The bases under one kind of lobe: what accuracy costs, and fits beside the truth.

use super::super::{approximations, fits, tables, words};
use crate::report::{Block, CouplingLobe, Findings, Origin, ReportError, Section, check};

/// Their sections, with the kind of lobe in title and anchor.
pub(super) fn sections(lobe: &CouplingLobe, origin: &Origin) -> Result<Vec<Section>, ReportError> {
    let findings = Findings {
        origin: origin.clone(),
        effects: Vec::new(),
        left_out: Vec::new(),
        tables: Vec::new(),
        truths: vec![lobe.truth.clone()],
        approximations: lobe.approximations.clone(),
        fits: lobe.fits.clone(),
        averages: None,
        furnace: None,
        studies: Vec::new(),
    };
    let mut sections = Vec::new();
    if let Some(mut costs) = approximations::section(&findings)? {
        costs.blocks.push(anywhere(lobe)?);
        sections.push(costs);
    }
    sections.extend(tables::truths(&findings)?);
    sections.extend(fits::section(&findings)?);
    for section in &mut sections {
        section.id = format!("{}-{}", section.id, lobe.specular);
        section.title = format!("{}, {} lobe", section.title, lobe.specular);
    }
    Ok(sections)
}

/// What each factor is worth at every f0, not the scene's alone.
fn anywhere(lobe: &CouplingLobe) -> Result<Block, ReportError> {
    let section = format!("{} lobe", lobe.specular);
    check::size(&section, "anywhere", lobe.anywhere.len(), lobe.approximations.len())?;
    let rows =
        lobe.anywhere.iter().map(|any| vec![any.name.clone(), words::max(any.max), words::place(&any.at)]);
    let caption = "Largest error over every f0 in [0, 1]: what a factor that was fitted for the scene's f0 is worth where a texture says \
                   otherwise.";
    let columns = [("name", false), ("max, any f0", true), ("where", false)];
    let mut table = words::table(&columns, rows.collect(), caption);
    table.muted = lobe.approximations.iter().map(|a| a.published).collect();
    Ok(Block::Table(table))
}
