//! The couplings in the furnace: what departs from white.

use crate::study::coupling::findings::{CouplingStudy, FurnaceStrip, FurnaceStripRow};
use crate::study::page;
use lobefit::report::figures;
use lobefit::report::numbers::{bound, brief, place};
use lobefit::report::{Block, Cells, Gallery, ReportError, Section, Shade, TextTable, check, disc, words};

/// Departure that gets the deepest colours.
const LIMIT: f64 = 0.1;

/// Pixels along a side of a cell, and along the radius of its sphere.
const SIDE: usize = 48;
const RADIUS: f64 = 21.5;

/// Side of a cell in pixels of the page: two pictures of nine columns stand side by side.
const CELL: f64 = 36.0;

pub(super) fn section(study: &CouplingStudy) -> Result<Section, ReportError> {
    check::filled("study", "furnace", study.furnace.len())?;
    let mut blocks = Vec::new();
    for ranking in &study.rankings {
        let lobe = &ranking.lobe;
        let shown = study.furnace.iter().filter(|s| s.shown && s.lobe == *lobe);
        let shown: Vec<Gallery> = shown.map(gallery).collect::<Result<_, _>>()?;
        let caption = format!(
            "All spheres here are under the lobe {lobe}. Their departure from the light is amplified {} times: grey is exact, the deepest blue \
             a loss of {LIMIT} or more, the deepest red a gain of {LIMIT} or more.",
            brief(1.0 / LIMIT, 2)
        );
        blocks.push(Block::Heading { text: format!("White spheres under a lobe: {lobe}") });
        blocks.push(figures(&shown, &caption)?);
        blocks.push(Block::Table(summary(study, lobe)));
    }
    Ok(Section::new(
        "furnace",
        "In the furnace",
        "Specular lobe plus coupled white base in light of radiance 1 from everywhere: whatever comes in must go out, so the right \
               picture is an empty one. At f0 = 1 the facets let nothing through: under a lobe that keeps all light the base must vanish; \
               the single lobe loses some, and what is blue there the base did not give back.",
        blocks,
    ))
}

fn gallery(strip: &FurnaceStrip) -> Result<Gallery, ReportError> {
    let cell = |albedo: &Vec<f64>| disc(SIDE, RADIUS, &strip.mu, albedo);
    check::increasing("furnace", "mu", &strip.mu)?;
    for row in &strip.rows {
        for albedo in &row.albedo {
            check::size("furnace", &row.name, albedo.len(), strip.mu.len())?;
        }
    }
    let columns: Vec<usize> =
        (0..strip.roughness.len()).filter(|&i| strip.drawn.contains(&strip.roughness[i])).collect();
    let spheres =
        |row: &FurnaceStripRow| columns.iter().filter_map(|&i| row.albedo.get(i)).map(cell).collect();
    let values = strip.rows.iter().map(spheres).collect();
    Ok(Gallery {
        title: title(strip),
        column_name: "roughness".into(),
        columns: columns.iter().map(|&i| place(strip.roughness[i])).collect(),
        rows: strip.rows.iter().map(|r| r.name.clone()).collect(),
        side: SIDE,
        cell: CELL,
        cells: Cells::Values {
            values, shade: Shade::Departure { limit: LIMIT }, unit: "albedo − 1".into()
        },
    })
}

fn title(strip: &FurnaceStrip) -> String {
    format!("{}, f0 {}", strip.lobe, place(strip.f0))
}

/// The largest departures over roughness and mu, by reflectance.
fn summary(study: &CouplingStudy, lobe: &str) -> TextTable {
    let strips: Vec<&FurnaceStrip> = study.furnace.iter().filter(|s| s.lobe == lobe).collect();
    let first = format!("specular lobe {lobe}: departure at");
    let columns = words::figures_after(&first, strips.iter().map(|s| format!("f0 {}", place(s.f0))));
    let rows = strips.first().map_or(0, |s| s.rows.len());
    let cell = |strip: &&FurnaceStrip, i: usize| {
        let worst = strip.rows.get(i).map_or(0.0, |r| farthest(&r.worst));
        if worst.abs() < 1e-6 { "0".into() } else { bound(worst, 2) }
    };
    let row = |i: usize| page::row(strips[0].rows[i].name.clone(), strips.iter().map(|s| cell(s, i)));
    let ends = |values: &[f64]| match (values.first(), values.last()) {
        (Some(low), Some(high)) => format!("{} to {}", place(*low), place(*high)),
        _ => "–".into(),
    };
    let (roughness, mu) =
        strips.first().map_or((String::new(), String::new()), |s| (ends(&s.roughness), ends(&s.mu)));
    let caption = format!(
        "Departure of the albedo from 1 with the largest magnitude over roughness {roughness} (more than is drawn) and μ {mu}, with its sign, \
         rounded away from zero; by roughness in results.json."
    );
    words::table(&columns, (0..rows).map(row).collect(), &caption)
}

fn farthest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, &d| if d.abs() > m.abs() { d } else { m })
}
