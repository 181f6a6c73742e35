//! What is measured on whole materials, section by section; here Schlick's Fresnel and bases below
//! white.

use super::{metals, walks};
use crate::study::coupling::surface::SurfaceRows;
use crate::study::coupling::surface::absorbing::AbsorbingRow;
use crate::study::coupling::surface::interface::{Difference, SchlickRow};
use lobefit::effects::coupling::page::materials;
use lobefit::report::numbers::{bound, brief, significant};
use lobefit::report::words;
use lobefit::report::{Block, ReportError, Section, check};

/// The sections of all rows, in the order of a page.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub fn sections(rows: &SurfaceRows) -> Result<Vec<Section>, ReportError> {
    Ok(vec![
        materials::section(&rows.reciprocity)?,
        metals::section(&rows.colour, &rows.views)?,
        walks::section(&rows.bounces)?,
        schlick(&rows.schlick)?,
        darker(&rows.darker)?,
    ])
}

fn schlick(rows: &[SchlickRow]) -> Result<Section, ReportError> {
    check::filled("fresnel", "rows", rows.len())?;
    let mut columns = vec![("ior", true), ("f0", true), ("F_avg, Schlick", true), ("exact", true)];
    columns.extend([("smooth", true), ("where", false), ("lobe", true), ("where", false)]);
    let factors: Vec<String> =
        rows.iter().take(1).flat_map(|row| &row.factor).map(|(lobe, _)| format!("base, {lobe}")).collect();
    columns.extend(factors.iter().map(|name| (name.as_str(), true)));
    let signed = |d: &Difference| bound(d.worst, 2);
    let row = |row: &SchlickRow| {
        let mut cells = vec![
            brief(row.ior, 3),
            significant(row.f0, 3),
            significant(row.average_schlick, 3),
            significant(row.average_exact, 3),
            signed(&row.smooth),
            format!("μ\u{a0}{}", brief(row.smooth.mu, 3)),
            signed(&row.albedo),
            format!("α\u{a0}{}, μ\u{a0}{}", brief(row.albedo.alpha, 3), brief(row.albedo.mu, 3)),
        ];
        cells.extend(row.factor.iter().map(|(_, difference)| signed(difference)));
        cells
    };
    let table = words::table(
        &columns,
        rows.iter().map(row).collect(),
        "ior: index of refraction. F_avg: average of the reflectance over the hemisphere. The others: Schlick less exact, the largest in size \
         over roughness and angle, of a smooth surface, of the albedo of the single-scattering lobe and of the factor of the base under two \
         others. What the lobe takes too much the base gets too little, so that the furnace stays closed.",
    );
    Ok(Section {
        id: "fresnel".into(),
        title: "What Schlick’s Fresnel costs".into(),
        lead: "A dielectric’s f0 follows from its index of refraction, ((n − 1)/(n + 1))²; between normal incidence and grazing \
               Schlick’s curve departs from the exact equations."
            .into(),
        blocks: vec![Block::Table(table)],
    })
}

fn darker(rows: &[AbsorbingRow]) -> Result<Section, ReportError> {
    check::filled("darker", "rows", rows.len())?;
    let columns = [
        ("coupling", false),
        ("albedo of the base", true),
        ("least", true),
        ("most", true),
        ("share of the base", true),
        ("monotone", false),
    ];
    let row = |row: &AbsorbingRow| {
        vec![
            row.coupling.clone(),
            brief(row.rho, 3),
            significant(row.least, 3),
            significant(row.most, 3),
            row.share.map_or("–".into(), |share| significant(share, 3)),
            if row.monotone { "yes" } else { "no" }.into(),
        ]
    };
    let table = words::table(
        &columns,
        rows.iter().map(row).collect(),
        "Least and most total albedo of lobe and base over roughness and angle. Share: the base’s part over its albedo times what the lobe \
         leaves. Monotone: nowhere darker for a lighter base.",
    );
    Ok(Section {
        id: "darker".into(),
        title: "Bases below white".into(),
        lead: "The factor is made for a white base, which it leaves what the lobe does not take; a darker base absorbs its share of that, \
               and nothing is ever above 1. Only the form with the base’s albedo follows the light that goes back and forth between lobe and base, and knows \
               that a dark base also absorbs what the lobe sends back to it."
            .into(),
        blocks: vec![Block::Table(table)],
    })
}
