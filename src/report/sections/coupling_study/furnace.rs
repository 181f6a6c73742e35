//! The couplings in the furnace: what departs from white.

use super::super::{figures, words};
use crate::report::numbers::{bound, brief, place};
use crate::report::{
    Block, Cells, CouplingStudy, FurnaceStrip, Gallery, ReportError, Section, Shade, TextTable, check, disc,
};

/// Departure that gets the deepest colours.
const LIMIT: f64 = 0.1;

/// Pixels along a side of a cell, and along the radius of its sphere.
const SIDE: usize = 56;
const RADIUS: f64 = 25.0;

/// Side of a cell in pixels of the page: two pictures of nine columns stand side by side.
const CELL: f64 = 36.0;

pub(super) fn section(study: &CouplingStudy) -> Result<Section, ReportError> {
    check::filled("study", "furnace", study.furnace.len())?;
    let shown: Vec<Gallery> =
        study.furnace.iter().filter(|s| s.shown).map(gallery).collect::<Result<_, _>>()?;
    let caption = format!(
        "White spheres in light of radiance 1 from everywhere, their departure from it amplified {} times: grey is exact, the deepest blue a \
         loss of {LIMIT} or more, the deepest red a gain of {LIMIT} or more.",
        brief(1.0 / LIMIT, 2)
    );
    let mut blocks = vec![figures(&shown, &caption)?];
    blocks.extend(study.rankings.iter().map(|r| Block::Table(summary(study, &r.lobe))));
    Ok(Section {
        id: "furnace".into(),
        title: "In the furnace".into(),
        lead: "Specular lobe plus coupled white base: whatever comes in must go out, so the right picture is an empty one. At f0 = 1 the \
               facets let nothing through and the base must vanish; what is blue there was lost by the lobe itself."
            .into(),
        blocks,
    })
}

fn gallery(strip: &FurnaceStrip) -> Result<Gallery, ReportError> {
    let cell = |albedo: &Vec<f64>| disc(SIDE, RADIUS, &strip.mu, albedo);
    check::increasing("furnace", "mu", &strip.mu)?;
    for row in &strip.rows {
        for albedo in &row.albedo {
            check::size("furnace", &row.name, albedo.len(), strip.mu.len())?;
        }
    }
    let values = strip.rows.iter().map(|row| row.albedo.iter().map(cell).collect()).collect();
    Ok(Gallery {
        title: title(strip),
        column_name: "roughness".into(),
        columns: strip.roughness.iter().map(|&r| place(r)).collect(),
        rows: strip.rows.iter().map(|r| r.name.clone()).collect(),
        side: SIDE,
        cell: CELL,
        cells: Cells::Values {
            values, shade: Shade::Departure { limit: LIMIT }, unit: "albedo − 1".into()
        },
    })
}

fn title(strip: &FurnaceStrip) -> String {
    format!("furnace: specular lobe {}, f0 {}", strip.lobe, place(strip.f0))
}

/// The largest departures over roughness and mu, by reflectance.
fn summary(study: &CouplingStudy, lobe: &str) -> TextTable {
    let strips: Vec<&FurnaceStrip> = study.furnace.iter().filter(|s| s.lobe == lobe).collect();
    let mut columns = vec![(format!("specular lobe {lobe}: departure at"), false)];
    columns.extend(strips.iter().map(|s| (format!("f0 {}", place(s.f0)), true)));
    let rows = strips.first().map_or(0, |s| s.rows.len());
    let cell = |strip: &&FurnaceStrip, i: usize| {
        let worst = strip.rows.get(i).map_or(0.0, |r| farthest(&r.worst));
        if worst.abs() < 1e-6 { "0".into() } else { bound(worst, 2) }
    };
    let row = |i: usize| {
        let name = strips[0].rows[i].name.clone();
        std::iter::once(name).chain(strips.iter().map(|s| cell(s, i))).collect()
    };
    let caption = "Departure of the albedo from 1 with the largest magnitude over roughness and μ, with its sign, rounded away from zero; \
                   by roughness in results.json.";
    let mut table = words::table(&[], (0..rows).map(row).collect(), caption);
    table.columns = columns;
    table
}

fn farthest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, &d| if d.abs() > m.abs() { d } else { m })
}
