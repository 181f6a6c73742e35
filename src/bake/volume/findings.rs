//! What the bake of an effect found out, for its page.

use serde_json::Value;

use super::grid::{Grid, grazing};
use super::readings::as_the_sources_read;
use super::tables::Judge;
use super::{BakedVolume, azimuth};
use crate::bake::context::Context;
use crate::bake::{BakeError, origin};
use crate::data::{Smith, VolumeLayout};
use crate::effects::Deviation;
use crate::effects::volume::{Lookup, Region, SOURCES_SAMPLES, Third, estimate};
use crate::emit::manifest::Entries;
use crate::integrate::glass::Side;
use crate::plan::{Effect, VolumeJob};
use crate::report::{
    EffectFinding, ErrorFigure, Field, Furnace, FurnaceFinding, FurnaceRow, Ruler, SourcesFinding,
    VolumeFindings, VolumeTable,
};
use crate::scene::Scene;

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 20.0;

/// Side of the maps.
const MAP: usize = 32;

/// Roughness of the furnace's spheres, and cosines of each.
const SPHERES: [f64; 7] = [0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0];
const COSINES: usize = 64;

/// Values of the third input at which pictures are drawn, as far as they lie in the range.
fn wanted(third: Third) -> &'static [f64] {
    match third {
        Third::Anisotropy => &[0.0, 0.5, 1.0],
        Third::Ior => &[1.1, 1.5, 2.0],
    }
}

/// The findings of the effect.
pub fn findings(
    scene: &Scene,
    effect: &Effect,
    jobs: &[&VolumeJob],
    tables: &[BakedVolume],
    judges: &[Judge],
    entries: &Entries,
    context: &Context,
) -> Result<VolumeFindings, BakeError> {
    let mut shown = Vec::new();
    let mut truths: Vec<Field> = Vec::new();
    let mut maps: Vec<(Smith, Region, Vec<Grid>)> = Vec::new();
    for (baked, entry) in tables.iter().zip(&entries.tables) {
        let key = (baked.approximation.smith, baked.region);
        let known = maps.iter().position(|(smith, region, _)| (*smith, *region) == key);
        let index = match known {
            Some(known) => known,
            None => {
                let roughness = Ruler::even("roughness", key.1.roughness[0], key.1.roughness[1], MAP);
                let grids = Grid::all(key.0, &key.1, &roughness, &grazing(&key.1, MAP), &thirds(&key.1))?;
                maps.push((key.0, key.1, grids));
                maps.len() - 1
            }
        };
        let grids = &maps[index].2;
        if baked.layout != VolumeLayout::PathTracer
            && truths.iter().all(|t| t.name != named(&grids[0], baked, "E"))
        {
            truths.extend(grids.iter().map(|g| g.albedo(&named(g, baked, "E"), baked.side)));
        }
        shown.push(shown_table(baked, entry, grids)?);
    }
    let measured = tables.iter().filter(|t| t.layout != VolumeLayout::PathTracer);
    let measured_error = measured.map(|t| t.errors.lookup.max).reduce(f64::max);
    Ok(VolumeFindings {
        origin: origin(scene, context),
        effect: EffectFinding {
            effect: effect.effect.name().into(),
            because: effect.because.clone(),
            ranges: effect.ranges.iter().map(|(name, range)| (name.to_string(), *range)).collect(),
            approximation: effect.approximation.clone(),
            expected_error: expected(jobs),
            measured_error,
            metric: "lookup error of the worst table in a layout of ours".into(),
        },
        sources: sources(tables)?,
        furnaces: furnaces(tables)?,
        azimuth: if tables.iter().any(|t| t.side.is_none()) {
            azimuth::finding(tables, judges)?
        } else {
            None
        },
        tables: shown,
        truths,
    })
}

/// The largest error that the scene allows a table in a layout of ours; none where one has no limit.
fn expected(jobs: &[&VolumeJob]) -> Option<f64> {
    let own: Vec<Option<f64>> =
        jobs.iter().filter(|job| job.layout != VolumeLayout::PathTracer).map(|job| job.max_error).collect();
    if own.is_empty() {
        None
    } else {
        own.into_iter().try_fold(0.0_f64, |worst, limit| limit.map(|e| worst.max(e)))
    }
}

/// The wanted values in the range, or its ends.
fn thirds(region: &Region) -> Vec<f64> {
    let inside = |x: &&f64| (region.span[0]..=region.span[1]).contains(*x);
    let values: Vec<f64> = wanted(region.third).iter().filter(inside).copied().collect();
    if values.is_empty() { region.span.to_vec() } else { values }
}

/// `E, ior 1.5, inside`.
fn named(grid: &Grid, baked: &BakedVolume, what: &str) -> String {
    let side = baked.side.map_or_else(String::new, |side| format!(", {}", side.name()));
    format!("{what}, {} {}{side}", baked.region.third.name(), grid.third)
}

fn shown_table(baked: &BakedVolume, entry: &Value, grids: &[Grid]) -> Result<VolumeTable, BakeError> {
    let table = baked.table().ok_or_else(|| BakeError::Internal("a volume without a table".into()))?;
    let lookup = Lookup::new(table, baked.decode)?;
    // A map at one azimuth would not tell of a table that resolves it: its section does.
    let maps = if baked.layout == VolumeLayout::Azimuth { &[] } else { grids };
    let files = entry["files"].as_array().into_iter().flatten();
    let formulas: Vec<String> =
        baked.decode.formulas().iter().map(|(name, formula)| format!("{name} = {formula}")).collect();
    Ok(VolumeTable {
        name: table.name.clone(),
        files: files.filter_map(|f| f.as_str().map(String::from)).collect(),
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
            .collect(),
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
    let theirs: Vec<&BakedVolume> = tables.iter().filter(|t| t.layout == VolumeLayout::PathTracer).collect();
    let Some(first) = theirs.first() else { return Ok(None) };
    let texels =
        theirs.iter().filter_map(|t| t.table()).map(|t| t.size().iter().product::<usize>() as u64).sum();
    let samples = SOURCES_SAMPLES * texels as f64;
    Ok(Some(SourcesFinding {
        texels,
        // The tables of glass share their integrals.
        evaluations: first.made.evaluations,
        worst: first.made.integration,
        samples,
        noise: estimate(first.region.third)? / SOURCES_SAMPLES.sqrt(),
    }))
}

/// Spheres under every condition: what each layout gives, and what the sources' reading of theirs gives.
fn furnaces(tables: &[BakedVolume]) -> Result<Vec<FurnaceFinding>, BakeError> {
    let Some(first) = tables.first() else { return Ok(Vec::new()) };
    let sides: &[Option<Side>] = match first.region.third {
        Third::Anisotropy => &[None],
        Third::Ior => &[Some(Side::Outside), Some(Side::Inside)],
    };
    let mut found = Vec::new();
    for third in thirds(&first.region) {
        for side in sides {
            let own: Vec<&BakedVolume> =
                tables.iter().filter(|t| t.side == *side && t.layout != VolumeLayout::Azimuth).collect();
            // With the azimuth in the table there is no mean to compensate by.
            if !own.is_empty() {
                found.push(furnace(&own, third, *side)?);
            }
        }
    }
    Ok(found)
}

fn furnace(tables: &[&BakedVolume], third: f64, side: Option<Side>) -> Result<FurnaceFinding, BakeError> {
    let first = tables.first().ok_or_else(|| BakeError::Internal("a furnace without tables".into()))?;
    let roughness = spheres(&first.region);
    let mu = grazing(&first.region, COSINES);
    let mut rows: Vec<FurnaceRow> = Vec::new();
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let (smith, region) = (baked.approximation.smith, &baked.region);
        let grids = Grid::all(smith, region, &roughness, &mu, &[third])?;
        let (grid, alpha) = (&grids[0], region.alpha_map.name());
        let uncompensated = format!("uncompensated ({} Smith, alpha = {alpha})", smith.name());
        if rows.iter().all(|row| row.name != uncompensated) {
            rows.push(FurnaceRow { name: uncompensated, factors: grid.furnace(side) });
        }
        let compensated =
            |name: String, lookup: &Lookup| FurnaceRow { name, factors: grid.compensated(lookup, side) };
        rows.push(compensated(
            format!("{} layout, as registered", baked.layout.name()),
            &Lookup::new(table, baked.decode)?,
        ));
        if baked.layout == VolumeLayout::PathTracer {
            let misread = as_the_sources_read(table, region.third, third);
            rows.push(compensated(
                "path-tracer layout, as the sources read it".into(),
                &Lookup::new(&misread, baked.decode)?,
            ));
        }
    }
    let side = side.map_or_else(String::new, |side| format!(", from {}", side.name()));
    let title = match first.region.third {
        Third::Anisotropy => format!("Metal, anisotropy {third} (mean over the azimuth)"),
        Third::Ior => format!("Glass, index of refraction {third}{side}"),
    };
    let furnace = Furnace { roughness: roughness.values, mu: mu.values, rows, amplification: AMPLIFICATION };
    Ok(FurnaceFinding { title, furnace })
}

/// The roughnesses of the spheres that lie in the region, or an even division of it.
fn spheres(region: &Region) -> Ruler {
    let [low, high] = region.roughness;
    let values: Vec<f64> = SPHERES.into_iter().filter(|r| (low..=high).contains(r)).collect();
    if values.len() < 3 {
        Ruler::even("roughness", low, high, 5)
    } else {
        Ruler { name: "roughness".into(), values }
    }
}
