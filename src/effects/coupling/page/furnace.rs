//! The furnace: lobe and white base together, which should not be seen.

use crate::effects::coupling::results::CouplingLobe;
use crate::report::sections::figures;
use crate::report::sections::furnace::CELL;
use crate::report::{
    Block, FurnaceRow, ReportError, Section, Shade, SphereRow, Spheres, TextTable, check, numbers,
};

pub(super) fn section(lobe: &CouplingLobe) -> Result<Section, ReportError> {
    let furnace = &lobe.furnace;
    check::finite("furnace", "amplification", furnace.amplification)?;
    if furnace.amplification <= 0.0 {
        return Err(check::domain("furnace", "amplification", "must be positive"));
    }
    let limit = 1.0 / furnace.amplification;
    let panels: Vec<Spheres> =
        furnace.panels.iter().map(|(f0, rows)| spheres(lobe, *f0, rows, limit)).collect();
    let deepest = numbers::brief(limit, 2);
    let caption = format!(
        "Departure from the environment, amplified {} times: grey is exact, the deepest blue a loss of {deepest} or more, the deepest red a \
         gain of {deepest} or more. The lobe is exact here and multiplied by {}; what is seen is the error of the factor alone.",
        numbers::brief(furnace.amplification, 3),
        lobe.multiplier,
    );
    let mut blocks = vec![figures(&panels, &caption)?];
    blocks.extend(furnace.panels.iter().map(|(f0, rows)| worst(lobe, *f0, rows)));
    Ok(Section::new(
        format!("furnace-{}", lobe.specular),
        format!("The furnace, {} lobe", lobe.specular),
        "Spheres of rising roughness with a white base, in equal light from everywhere and without absorption: lobe and base together \
               must send back all of it, so the right picture is an empty one.",
        blocks,
    ))
}

fn spheres<'a>(lobe: &'a CouplingLobe, f0: f64, rows: &'a [FurnaceRow], limit: f64) -> Spheres<'a> {
    Spheres {
        title: format!("f0 = {}, {} lobe", numbers::place(f0), lobe.specular),
        column_name: "roughness".into(),
        columns: &lobe.furnace.roughness,
        mu: &lobe.furnace.mu,
        rows: rows.iter().map(|r| SphereRow { name: r.name.clone(), factors: &r.factors }).collect(),
        shade: Shade::Departure { limit },
        unit: "lobe + base − 1".into(),
        cell: CELL,
    }
}

/// The largest departure of every sphere in figures.
fn worst(lobe: &CouplingLobe, f0: f64, rows: &[FurnaceRow]) -> Block {
    let mut columns = vec![("roughness".to_string(), false)];
    columns.extend(lobe.furnace.roughness.iter().map(|&r| (numbers::place(r), true)));
    let farthest = |factors: &Vec<f64>| {
        factors.iter().map(|f| f - 1.0).fold(0.0, |m: f64, d| if d.abs() > m.abs() { d } else { m })
    };
    let row = |r: &FurnaceRow| {
        let cells = r.factors.iter().map(|f| numbers::bound(farthest(f), 2));
        std::iter::once(r.name.clone()).chain(cells).collect::<Vec<String>>()
    };
    let caption = format!(
        "f0 = {}: largest signed departure over each sphere, rounded away from zero. Where it is larger than the sphere looks, it is at the \
         rim.",
        numbers::place(f0)
    );
    let rows: Vec<Vec<String>> = rows.iter().map(row).collect();
    Block::Table(TextTable { columns, muted: vec![false; rows.len()], names: None, rows, caption })
}
