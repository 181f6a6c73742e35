//! What accuracy costs: seconds, measured on this machine, and records of other machines and of
//! compilers. No part of a bake.

pub mod costs;
pub mod isa;
pub mod listings;
pub mod offline;
pub mod priced;
pub mod record;
pub mod searches;
mod tables;

use lobefit_shade::ShadeError;
use serde::Deserialize;
use serde_json::Value;
use std::hint::black_box;
use std::time::Instant;

use crate::approximate::{Fit, FitStageError, Region, certification};
use crate::bake::{BakeError, Baked};
use crate::data::{Approximation, Source};
use crate::effects::demand::hull;
use crate::effects::table::Lookup;
use crate::effects::{Effect, catalogue};
use crate::report::{Origin, TimedApproximation, TimedEffects, Timings};
use crate::scene::Scene;
use lobefit_truth::points::Points;

/// The version of a record, whatever else is in it.
#[derive(Deserialize)]
struct Versioned {
    #[serde(default)]
    schema_version: Value,
}

/// Runs of which the fastest counts: what is measured is the work, not what else the machine does.
const RUNS: usize = 5;

/// Shortest time that a run is allowed to take: below it, the work is repeated within the run.
const SHORTEST: f64 = 2e-3;

/// 2^15 uniform points and half as many again: what formulas are evaluated at.
const LOG2_POINTS: u32 = 15;

/// Measures every formula and table of a bake; `effects` is what bakes took.
pub fn timings(
    (scene, baked): (&Scene, &Baked),
    effects: Option<TimedEffects>,
    origin: Origin,
    device: String,
) -> Result<Timings, BakeError> {
    // One thread: a time per evaluation is that of one core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|e| BakeError::Internal(format!("cannot start a thread: {e}")))?;
    let evaluations = pool.install(|| evaluations(scene, baked))?;
    let sliced = baked.tables.iter().any(|table| table.region.slices.is_some());
    // The whole machine: tables are made on all threads.
    let tables = if sliced { Some(tables::tables()?) } else { None };
    let timed = |effect: &&dyn Effect| effect.timed(scene, &|work| seconds(work));
    let lookups = pool.install(|| catalogue().iter().flat_map(timed).collect());
    Ok(Timings { origin, device, tables, effects, evaluations, lookups })
}

/// Seconds of one execution.
fn seconds(mut work: impl FnMut()) -> f64 {
    work();
    let mut repeats = 1_u32;
    loop {
        let times = (0..RUNS).map(|_| {
            let start = Instant::now();
            (0..repeats).for_each(|_| work());
            start.elapsed().as_secs_f64()
        });
        let shortest = times.fold(f64::INFINITY, f64::min);
        if shortest >= SHORTEST || repeats >= 1 << 20 {
            return shortest / f64::from(repeats);
        }
        repeats *= 4;
    }
}

fn evaluations(scene: &Scene, baked: &Baked) -> Result<Vec<TimedApproximation>, BakeError> {
    let mut timed = Vec::new();
    for baked in &baked.tables {
        let Some(table) = baked.table() else { continue };
        let lookup = Lookup::new(table, baked.decode)?;
        let points = &baked.judge.points;
        let time = seconds(|| {
            for point in &points.all {
                black_box(lookup.at(point));
            }
        });
        timed.push(entry(&baked.approximation, true, time / points.len() as f64));
    }
    let ranges = baked.fits.iter().filter_map(|fit| fit.approximation.certificate.domain.get("roughness"));
    let Some(roughness) = ranges.copied().reduce(hull) else { return Ok(timed) };
    let points = certification(&Region { roughness, mu: scene.mu, alpha_map: scene.alpha }, LOG2_POINTS);
    for fit in &baked.fits {
        timed.push(entry(&fit.approximation, false, fit_seconds(fit, &points)? / points.len() as f64));
    }
    Ok(timed)
}

fn fit_seconds(fit: &Fit, points: &Points) -> Result<f64, BakeError> {
    let inputs = columns(fit, points).map_err(FitStageError::from)?;
    let (tape, coefficients) = (fit.hypothesis.tape(), fit.coefficients());
    tape.evaluate(&inputs, &coefficients).map_err(FitStageError::from)?;
    Ok(seconds(|| {
        let _ = black_box(tape.evaluate(&inputs, &coefficients));
    }))
}

/// The columns of a fit's inputs: those of the points, and evenly spaced values of any other input
/// of its certified domain.
fn columns(fit: &Fit, points: &Points) -> Result<Vec<Vec<f32>>, ShadeError> {
    let domain = &fit.approximation.certificate.domain;
    let spread = |[low, high]: [f64; 2]| {
        let step = (high - low) / points.len().max(1) as f64;
        (0..points.len()).map(|i| (low + (i as f64 + 0.5) * step) as f32).collect::<Vec<f32>>()
    };
    let column = |name: &String| {
        let given = points.column_f32(name);
        given.or_else(|| domain.get(name).copied().map(spread)).ok_or_else(|| ShadeError::UnknownInput {
            function: fit.hypothesis.name().into(),
            input: name.clone(),
            given: domain.keys().cloned().collect::<Vec<_>>().join(", "),
        })
    };
    fit.hypothesis.inputs().iter().map(column).collect()
}

fn entry(approximation: &Approximation, table: bool, seconds: f64) -> TimedApproximation {
    TimedApproximation {
        name: approximation.name.clone(),
        quantity: approximation.quantity.clone(),
        column: approximation.column.clone(),
        used_as: approximation.used_as,
        nanoseconds: seconds * 1e9,
        ops: approximation.cost.ops,
        max_error: approximation.certificate.max_abs,
        published: matches!(approximation.source, Source::Published(_)),
        table,
    }
}
