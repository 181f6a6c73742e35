//! What the bake of an effect found out, for its page.

use super::grid::Grid;
use super::results::{PathTracerFinding, SlicedFindings};
use super::{BakedTable, Lookup, Region, Sliced, furnaces};
use crate::data::{Half, HalfError, Layout, Place, Smith};
use crate::effects::context::Context;
use crate::effects::grid::{self, grazing};
use crate::effects::table::estimator::{PATH_TRACER_SAMPLES, estimate};
use crate::effects::{BakeError, Deviation, Part};
use crate::report::{ChannelFinding, ErrorFigure, Field, Ruler, TableFinding};

/// Side of the maps.
const MAP: usize = 32;

/// The findings of the effect.
pub fn findings<F: Sliced>(
    family: &F,
    part: &Part,
    tables: &[BakedTable],
    context: &Context,
) -> Result<SlicedFindings, BakeError> {
    let mut shown = Vec::new();
    let mut truths: Vec<Field> = Vec::new();
    let mut maps: Vec<(Smith, Region, Vec<Grid>)> = Vec::new();
    let own = || tables.iter().filter(|t| t.layout != Layout::PathTracer).map(|t| t.region.roughness);
    let alike = own().all(|roughness| own().next() == Some(roughness));
    for baked in tables {
        if baked.layout == Layout::FiveAxis {
            shown.extend(finding(baked, part, Vec::new()));
            continue;
        }
        let Some((table, smith)) = baked.table().and_then(|table| Some((table, table.smith?))) else {
            continue;
        };
        let key = (smith, baked.region);
        let known = maps.iter().position(|(smith, region, _)| (*smith, *region) == key);
        let index = match known {
            Some(known) => known,
            None => {
                let roughness = Ruler::even("roughness", key.1.roughness[0], key.1.roughness[1], MAP);
                let flat = key.1.flat();
                let over = grid::Grid::new(&flat, roughness, grazing(&flat, MAP));
                let grids = Grid::all(family, (key.0, &key.1), &over, &shown_slices(family, &key.1))?;
                maps.push((key.0, key.1, grids));
                maps.len() - 1
            }
        };
        let grids = &maps[index].2;
        let rows = if alike { String::new() } else { roughness_text(baked.region.roughness) };
        if baked.layout != Layout::PathTracer {
            for grid in grids {
                let name = named(grid, baked, "E") + &rows;
                if truths.iter().all(|t| t.name != name) {
                    truths.push(grid.albedo(&name, baked.side));
                }
            }
        }
        // A map at one azimuth says nothing of a table that resolves the azimuth: its section does.
        let grids = if baked.layout == Layout::Azimuth { &[] } else { &grids[..] };
        let lookup = Lookup::new(table, baked.decode)?;
        let map = |g: &Grid| g.errors(&named(g, baked, "error of E"), &lookup, baked.side);
        shown.extend(finding(baked, part, grids.iter().map(map).collect::<Result<_, _>>()?));
    }
    Ok(SlicedFindings {
        origin: context.origin(),
        effect: part.finding.clone(),
        path_tracer: path_tracer(family, tables)?,
        furnaces: furnaces::findings(family, tables)?,
        ways: family.ways(tables)?,
        tables: shown,
        truths,
    })
}

/// The slices that pictures show: those of the family in the range, or its ends.
pub fn shown_slices<F: Sliced>(family: &F, region: &Region) -> Vec<f64> {
    let Some([low, high]) = region.slices.map(|slices| slices.range) else { return Vec::new() };
    let inside: Vec<f64> = family.shown().iter().copied().filter(|x| (low..=high).contains(x)).collect();
    match inside.is_empty() {
        true if low == high => vec![low],
        true => vec![low, high],
        false => inside,
    }
}

/// `, roughness 0.2 to 0.6`: tells apart what was made in several ranges.
pub fn roughness_text([low, high]: [f64; 2]) -> String {
    format!(", roughness {low} to {high}")
}

/// `E, ior 1.5, inside`.
fn named(grid: &Grid, baked: &BakedTable, what: &str) -> String {
    let side = baked.side.map_or_else(String::new, |side| format!(", {}", side.name()));
    let axis = baked.region.slices.map_or("", |slices| slices.axis.name());
    format!("{what}, {axis} {}{side}", grid.slice)
}

/// A table as a page shows it, with the maps of its lookup's error; `part` has its entry. None of
/// what is no table.
pub fn finding(baked: &BakedTable, part: &Part, lookup_error: Vec<Field>) -> Option<TableFinding> {
    let table = baked.table()?;
    let entry = part.entries.tables.iter().find(|entry| entry.name == table.name)?;
    let formulas = baked.decode.formulas().iter().map(|(name, formula)| format!("{name} = {formula}"));
    let channel =
        |c: &crate::data::Channel| ChannelFinding { name: c.name.clone(), texels: c.texels.clone() };
    Some(TableFinding {
        name: table.name.clone(),
        files: entry.files.clone(),
        quantity: table.quantity.clone(),
        smith: table.smith,
        alpha_map: table.alpha_map,
        axes: table.axes.clone(),
        channels: table.channels.iter().map(channel).collect(),
        decode: formulas.collect::<Vec<_>>().join(", "),
        note: baked.note.unwrap_or_default().into(),
        format: table.format,
        bytes: table.bytes(),
        ops: baked.approximation.cost.ops,
        evaluations: baked.made.evaluations,
        errors: errors(baked),
        lookup_error,
    })
}

/// The errors of a table, one line each.
fn errors(baked: &BakedTable) -> Vec<(String, ErrorFigure)> {
    let e = &baked.errors;
    let lookup = |what: &str, error: &Deviation| {
        (what.to_string(), ErrorFigure { max: error.max, rms: Some(error.rms), at: error.at.clone() })
    };
    let integration = ErrorFigure { max: e.integration, rms: None, at: Place::new() };
    let what = "integration (texels and the truth that judges them: worst checked, or tolerance)";
    let mut lines = vec![(what.to_string(), integration)];
    for r in &e.quantisation {
        let figure = ErrorFigure { max: r.max, rms: Some(r.rms), at: r.at.clone() };
        lines.push((format!("quantisation of {}", r.channel), figure));
    }
    lines.push(lookup(&format!("lookup of {}", baked.decode.formulas()[0].0), &e.lookup_e));
    lines.extend(e.lookup_b.iter().map(|b| lookup("lookup of B", b)));
    lines.push(lookup("lookup in use, weights of 8 bits", &e.lookup_8_bit));
    if let Half::Measured(HalfError { max_abs, rms, at, .. }) = &e.half {
        let figure = ErrorFigure { max: *max_abs, rms: Some(*rms), at: at.clone() };
        lines.push(("lookup in use, coordinates and decoding in f16".into(), figure));
    }
    lines
}

/// The path tracer's own method beside ours, where its layout was baked.
fn path_tracer<F: Sliced>(family: &F, tables: &[BakedTable]) -> Result<Option<PathTracerFinding>, BakeError> {
    let theirs: Vec<&BakedTable> = tables.iter().filter(|t| t.layout == Layout::PathTracer).collect();
    if theirs.is_empty() {
        return Ok(None);
    }
    let texels =
        theirs.iter().filter_map(|t| t.table()).map(|t| t.size().iter().product::<usize>() as u64).sum();
    let samples = PATH_TRACER_SAMPLES * texels as f64;
    // The tables of a job share their integrals; tables in another format have theirs again.
    let jobs = || theirs.iter().filter(|t| t.side == family.sides()[0]).map(|t| t.made);
    Ok(Some(PathTracerFinding {
        texels,
        evaluations: jobs().map(|made| made.evaluations).sum(),
        worst: jobs().map(|made| made.integration).fold(0.0, f64::max),
        samples,
        noise: estimate(family)? / PATH_TRACER_SAMPLES.sqrt(),
    }))
}
