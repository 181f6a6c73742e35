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
    blocks.extend(study.furnace.iter().map(|strip| Block::Table(table(strip))));
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
        density: 1,
        cells: Cells::Values {
            values, shade: Shade::Departure { limit: LIMIT }, unit: "albedo − 1".into()
        },
    })
}

fn title(strip: &FurnaceStrip) -> String {
    format!("furnace: specular lobe {}, f0 {}", strip.lobe, place(strip.f0))
}

fn table(strip: &FurnaceStrip) -> TextTable {
    let mut columns = vec![(format!("{}, f0 {}: roughness", strip.lobe, place(strip.f0)), false)];
    columns.extend(strip.roughness.iter().map(|&r| (place(r), true)));
    let row = |r: &crate::report::FurnaceStripRow| {
        let cells = r.worst.iter().map(|&x| if x.abs() < 1e-6 { "0".into() } else { bound(x, 2) });
        std::iter::once(r.name.clone()).chain(cells).collect()
    };
    let caption = "Departure of the albedo from 1 with the largest magnitude over μ, rounded away from zero.";
    let mut table = words::table(&[], strip.rows.iter().map(row).collect(), caption);
    table.columns = columns;
    table
}
