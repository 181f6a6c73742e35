//! What the bake of an effect found out, for its page.

use super::grid::{Grid, grazing};
use super::tables::Judge;
use super::{BakedVolume, azimuth, furnaces};
use crate::data::{Layout, Smith};
use crate::effects::Deviation;
use crate::effects::context::Context;
use crate::effects::table::results::{SourcesFinding, VolumeFindings, VolumeTable};
use crate::effects::table::{Lookup, Region, SOURCES_SAMPLES, SliceAxis, TableJob, estimate};
use crate::effects::{BakeError, Part};
use crate::emit::manifest::TableEntry;
use crate::report::{ErrorFigure, Field, Ruler};
use lobefit_truth::integrate::glass::Side;

/// Side of the maps.
const MAP: usize = 32;

/// Values of the axis of the slices at which pictures are drawn, as far as they lie in the range.
fn wanted(slice: SliceAxis) -> &'static [f64] {
    match slice {
        SliceAxis::Anisotropy => &[0.0, 0.5, 1.0],
        SliceAxis::Ior => &[1.1, 1.5, 2.0],
    }
}

/// The findings of the effect.
pub fn findings(
    part: &Part,
    tables: &[BakedVolume],
    judges: &[Judge],
    context: &Context,
) -> Result<VolumeFindings, BakeError> {
    let mut shown = Vec::new();
    let mut truths: Vec<Field> = Vec::new();
    let mut maps: Vec<(Smith, Region, Vec<Grid>)> = Vec::new();
    let own = || tables.iter().filter(|t| t.layout != Layout::PathTracer).map(|t| t.region.roughness);
    let alike = own().all(|roughness| own().next() == Some(roughness));
    for (baked, entry) in tables.iter().zip(&part.entries.tables) {
        let key = (baked.smith, baked.region);
        let known = maps.iter().position(|(smith, region, _)| (*smith, *region) == key);
        let index = match known {
            Some(known) => known,
            None => {
                let roughness = Ruler::even("roughness", key.1.roughness[0], key.1.roughness[1], MAP);
                let grids =
                    Grid::all(key.0, &key.1, &roughness, &grazing(&key.1, MAP), &values_shown(&key.1))?;
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
        shown.push(shown_table(baked, entry, grids)?);
    }
    Ok(VolumeFindings {
        origin: context.origin(),
        effect: part.finding.clone(),
        sources: sources(tables)?,
        furnaces: furnaces::findings(tables)?,
        azimuth: azimuth::findings(tables, judges)?,
        tables: shown,
        truths,
    })
}

/// The largest lookup error of a table in a layout of ours.
pub fn measured(tables: &[BakedVolume]) -> Option<f64> {
    let own = tables.iter().filter(|t| t.layout != Layout::PathTracer);
    own.map(|t| t.errors.lookup.max).reduce(f64::max)
}

/// The largest error that the scene allows a table in a layout of ours; none where one has no limit.
pub fn expected(jobs: &[TableJob]) -> Option<f64> {
    let own: Vec<Option<f64>> =
        jobs.iter().filter(|job| job.layout != Layout::PathTracer).map(|job| job.max_error).collect();
    if own.is_empty() {
        None
    } else {
        own.into_iter().try_fold(0.0_f64, |worst, limit| limit.map(|e| worst.max(e)))
    }
}

/// The wanted values in the range, or its ends.
pub fn values_shown(region: &Region) -> Vec<f64> {
    let inside = |x: &&f64| (region.slices.range[0]..=region.slices.range[1]).contains(*x);
    let values: Vec<f64> = wanted(region.slices.axis).iter().filter(inside).copied().collect();
    if values.is_empty() { region.slices.range.to_vec() } else { values }
}

/// `, roughness 0.2 to 0.6`: tells apart what was made in several ranges.
pub fn roughness_text([low, high]: [f64; 2]) -> String {
    format!(", roughness {low} to {high}")
}

/// `E, ior 1.5, inside`.
fn named(grid: &Grid, baked: &BakedVolume, what: &str) -> String {
    let side = baked.side.map_or_else(String::new, |side| format!(", {}", side.name()));
    format!("{what}, {} {}{side}", baked.region.slices.axis.name(), grid.slice)
}

fn shown_table(baked: &BakedVolume, entry: &TableEntry, grids: &[Grid]) -> Result<VolumeTable, BakeError> {
    let table = baked.table().ok_or_else(|| BakeError::Internal("a volume without a table".into()))?;
    let lookup = Lookup::new(table, baked.decode)?;
    // A map at one azimuth would not tell of a table that resolves it: its section does.
    let maps = if baked.layout == Layout::Azimuth { &[] } else { grids };
    let formulas: Vec<String> =
        baked.decode.formulas().iter().map(|(name, formula)| format!("{name} = {formula}")).collect();
    Ok(VolumeTable {
        name: table.name.clone(),
        files: entry.files.clone(),
        quantity: table.quantity.clone(),
        smith: table.smith,
        alpha_map: table.alpha_map,
        axes: table.axes.clone(),
        channels: table.channels.iter().map(|c| c.name.clone()).collect(),
        decode: formulas.join(", "),
        note: baked.note().unwrap_or_default().into(),
        format: table.format,
        bytes: table.bytes(),
        ops: baked.approximation.cost.ops,
        evaluations: baked.made.evaluations,
        errors: errors(baked),
        lookup_error: maps
            .iter()
            .map(|g| g.errors(&named(g, baked, "error of E"), &lookup, baked.side))
            .collect::<Result<_, _>>()?,
    })
}

/// The errors of a table, one line each.
fn errors(baked: &BakedVolume) -> Vec<(String, ErrorFigure)> {
    let e = &baked.errors;
    let lookup = |what: &str, error: &Deviation| {
        (what.to_string(), ErrorFigure { max: error.max, rms: Some(error.rms), at: error.at.clone() })
    };
    let integration = ErrorFigure { max: e.integration, rms: None, at: crate::data::Place::new() };
    let mut lines = vec![(
        "integration (texels and the truth that judges them: worst checked, or tolerance)".to_string(),
        integration,
    )];
    for r in &e.quantisation {
        let figure = ErrorFigure { max: r.max, rms: Some(r.rms), at: r.at.clone() };
        lines.push((format!("quantisation of {}", r.channel), figure));
    }
    lines.push(lookup("lookup of E", &e.lookup));
    lines.push(lookup("lookup of E, weights of 8 bits", &e.lookup_8_bit));
    lines
}

/// The sources' method beside ours, where their layout was baked.
fn sources(tables: &[BakedVolume]) -> Result<Option<SourcesFinding>, BakeError> {
    let theirs: Vec<&BakedVolume> = tables.iter().filter(|t| t.layout == Layout::PathTracer).collect();
    let Some(first) = theirs.first() else { return Ok(None) };
    let texels =
        theirs.iter().filter_map(|t| t.table()).map(|t| t.size().iter().product::<usize>() as u64).sum();
    let samples = SOURCES_SAMPLES * texels as f64;
    // The tables of glass share their integrals; tables in another format have theirs again.
    let jobs = || theirs.iter().filter(|t| t.side != Some(Side::Inside)).map(|t| t.made);
    Ok(Some(SourcesFinding {
        texels,
        evaluations: jobs().map(|made| made.evaluations).sum(),
        worst: jobs().map(|made| made.integration).fold(0.0, f64::max),
        samples,
        noise: estimate(first.region.slices.axis)? / SOURCES_SAMPLES.sqrt(),
    }))
}
