//! What is measured on whole materials beside reciprocity: Schlick's Fresnel, bases below white, the colour of rough metals.

use super::{figures, reciprocity, words};
use crate::effects::surface::SurfaceRows;
use crate::effects::surface::colour::{ColourRow, WALK_EXACT, WALK_SCHLICK};
use crate::effects::surface::darker::DarkRow;
use crate::effects::surface::interface::{Difference, SchlickRow};
use crate::report::numbers::{bound, brief, significant};
use crate::report::{Block, Curves, ReportError, Section, Series, Spread, Style, TextTable, check};

/// The sections of all rows, in the order of a page.
pub(crate) fn sections(rows: &SurfaceRows) -> Result<Vec<Section>, ReportError> {
    Ok(vec![
        reciprocity::section(&rows.reciprocity)?,
        colour(&rows.colour)?,
        schlick(&rows.schlick)?,
        darker(&rows.darker)?,
    ])
}

fn schlick(rows: &[SchlickRow]) -> Result<Section, ReportError> {
    check::filled("fresnel", "rows", rows.len())?;
    let mut columns =
        vec![("index of refraction", true), ("f0", true), ("F_avg, Schlick", true), ("F_avg, exact", true)];
    columns.extend([("smooth", true), ("where", false), ("albedo of the lobe", true), ("where", false)]);
    let factors: Vec<String> =
        rows.iter().take(1).flat_map(|row| &row.factor).map(|(lobe, _)| format!("factor, {lobe}")).collect();
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
        "Schlick less exact, the largest in size over roughness and angle. The factor of the base differs by as much as the lobe, with \
         the other sign: what one takes too much the other gets too little, so that the furnace stays closed.",
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

fn darker(rows: &[DarkRow]) -> Result<Section, ReportError> {
    check::filled("darker", "rows", rows.len())?;
    let columns = [
        ("coupling", false),
        ("albedo of the base", true),
        ("least", true),
        ("most", true),
        ("share of the base", true),
        ("monotone", false),
    ];
    let row = |row: &DarkRow| {
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
               and nothing is ever above 1. Only the interreflected form knows that a dark base also absorbs what the lobe sends back to it."
            .into(),
        blocks: vec![Block::Table(table)],
    })
}

fn colour(rows: &[ColourRow]) -> Result<Section, ReportError> {
    check::filled("colour", "rows", rows.len())?;
    for row in rows {
        let field = format!("{} {} at roughness {}", row.metal, row.model, row.roughness);
        check::values("colour", &field, &row.albedo)?;
        check::values("colour", &field, &[row.saturation, row.saturation_error])?;
    }
    let metals = distinct(rows.iter().map(|row| &row.metal));
    let mut charts = Vec::new();
    for metal in &metals {
        let of_metal: Vec<&ColourRow> = rows.iter().filter(|row| row.metal == **metal).collect();
        let red = |row: &ColourRow| row.albedo[0];
        charts.push(chart(format!("{metal}: saturation"), "1 − min/max", &of_metal, |row| row.saturation));
        charts.push(chart(format!("{metal}: red albedo"), "albedo", &of_metal, red));
    }
    let caption = "What a convex body sends back on average in an environment of radiance 1. The heavy line is the random walk; its standard \
                   errors are in the table and narrower than the line.";
    let mut blocks = vec![figures(&charts, caption)?];
    blocks.extend(metals.iter().map(|metal| Block::Table(table(metal, rows))));
    Ok(Section {
        id: "colour".into(),
        title: "The colour of rough metals".into(),
        lead: format!(
            "Light that met several facets has taken on their colour several times. The second opinion is a random walk on the Smith \
             microsurface (Heitz, Hanika, d’Eon and Dachsbacher 2016), reflection only: “{WALK_SCHLICK}” has Schlick’s Fresnel as the lobes have, \
             “{WALK_EXACT}” that of the metal’s complex index."
        ),
        blocks,
    })
}

fn chart(title: String, unit: &str, rows: &[&ColourRow], value: impl Fn(&ColourRow) -> f64) -> Curves {
    let models = distinct(rows.iter().map(|row| &row.model));
    let series = models.iter().enumerate().map(|(i, model)| {
        let of_model = rows.iter().filter(|row| row.model == **model);
        let style = if *model == WALK_SCHLICK { Style::Truth } else { Style::Line(i) };
        let points = of_model.map(|row| (row.roughness, value(row))).collect();
        Series { name: model.to_string(), points, style, end: None }
    });
    Curves {
        title,
        x: ("roughness".into(), Spread::Linear),
        y: (unit.into(), Spread::Linear),
        series: series.collect(),
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size: (400.0, 260.0),
    }
}

/// Saturation by roughness, a row per model.
fn table(metal: &str, rows: &[ColourRow]) -> TextTable {
    let of_metal: Vec<&ColourRow> = rows.iter().filter(|row| row.metal == metal).collect();
    let mut columns = vec![("saturation at roughness".to_string(), false)];
    let first = of_metal.first().map(|row| row.model.as_str());
    let roughness = of_metal.iter().filter(|row| Some(row.model.as_str()) == first);
    columns.extend(roughness.map(|row| (brief(row.roughness, 3), true)));
    let line = |model: &String| {
        let cells = of_metal.iter().filter(|row| row.model == *model).map(|row| {
            let error = row.saturation_error;
            let value = significant(row.saturation, 3);
            if error > 0.0 { format!("{value}\u{a0}±\u{a0}{}", bound(error, 1)) } else { value }
        });
        std::iter::once(model.clone()).chain(cells).collect()
    };
    let models = distinct(of_metal.iter().map(|row| &row.model));
    let caption = format!(
        "{metal}: 1 less the smallest over the largest channel of the mean albedo. ± is one standard error, an upper bound."
    );
    let mut table = words::table(&[], models.into_iter().map(line).collect(), &caption);
    table.columns = columns;
    table
}

/// Each once, in the order of the first.
fn distinct<'a>(names: impl Iterator<Item = &'a String>) -> Vec<&'a String> {
    let mut found: Vec<&String> = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}
