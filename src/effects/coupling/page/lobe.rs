//! The bases under one kind of lobe: what accuracy costs, and fits beside the truth.

use std::collections::BTreeSet;
use std::slice;

use crate::effects::coupling::results::{AnyF0Finding, CouplingLobe};
use crate::report::sections::{approximations, fits, tables, words};
use crate::report::{Block, ReportError, Section, check, numbers};

/// Their sections, with the kind of lobe in title and anchor; `known` are the names that the page has.
pub(super) fn sections(
    lobe: &CouplingLobe,
    known: &mut BTreeSet<String>,
) -> Result<Vec<Section>, ReportError> {
    let mut sections = Vec::new();
    let shown: Vec<&str> = lobe.fits.iter().map(|fit| fit.name.as_str()).collect();
    if let Some(mut costs) = approximations::section(&lobe.approximations, &shown, known)? {
        costs.blocks.push(Block::Heading { text: "At any f0".into() });
        costs.blocks.push(anywhere(lobe)?);
        sections.push(costs);
    }
    sections.extend(tables::truths(slice::from_ref(&lobe.truth), &truth(lobe))?);
    sections.extend(fits::section(&lobe.fits, None, &lobe.approximations)?);
    for section in &mut sections {
        section.id = format!("{}-{}", section.id, lobe.specular);
        section.title = format!("{}, {} lobe", section.title, lobe.specular);
    }
    Ok(sections)
}

/// What to see in the map of the factor.
fn truth(lobe: &CouplingLobe) -> String {
    format!(
        "The factor at f0 = {} under a lobe that is multiplied by {}: where it is 1, all light reaches the base. Face on it is about 1 − f0; at \
         grazing a smooth lobe takes nearly all of the light, a rough one much less, since few of its facets are seen at grazing.",
        numbers::place(lobe.f0),
        lobe.multiplier
    )
}

/// What each factor is worth at every f0, not the scene's alone.
fn anywhere(lobe: &CouplingLobe) -> Result<Block, ReportError> {
    let section = format!("{} lobe", lobe.specular);
    check::size(&section, "anywhere", lobe.anywhere.len(), lobe.approximations.len())?;
    let row = |any: &AnyF0Finding| {
        vec![any.name.clone(), words::max(any.max), words::place(&any.at), any.looked_at.clone()]
    };
    let rows = lobe.anywhere.iter().map(row);
    let places = lobe.anywhere.first().map_or(0, |any| any.places);
    let caption = format!(
        "Largest error found over f0 in [0, 1]: what a factor that was fitted for the scene's f0 is worth where a texture says otherwise. \
         Looked for at {} places of roughness and mu; at each, every f0 means the exact largest value of an error that is a parabola in f0, \
         else so many values were tried.",
        numbers::grouped(places)
    );
    let columns = "name|max, any f0>|where|f0 tried";
    let mut table = words::table(columns, rows.collect(), &caption);
    table.muted = lobe.approximations.iter().map(|a| a.published).collect();
    Ok(Block::Table(table))
}
