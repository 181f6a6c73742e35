//! Whole tables: the path tracer's three, by the kernels and by its own estimator on the same
//! cores.

use std::time::Instant;

use super::seconds;
use crate::data::Smith;
use crate::effects::anisotropy::{self, Anisotropy};
use crate::effects::glass;
use crate::effects::table::{DRAWN, PATH_TRACER_SAMPLES, Sliced, estimate};
use crate::report::{TimedEstimator, TimedTableRun, TimedTables};
use lobefit_truth::integrate::{IntegrateError, Path};

/// Accuracies asked for.
const TOLERANCES: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-7];

/// Runs of each table of which the fastest counts: what is measured is the work, not what else the
/// machine does.
const RUNS: usize = 5;

/// Texels of the three tables.
const REFLECTION: f64 = 64.0 * 64.0 * 32.0;
const GLASS: f64 = 2.0 * 128.0 * 128.0 * 32.0;

/// Runs all tables in both Smith forms, and the estimator, on the threads at hand.
pub fn tables() -> Result<TimedTables, IntegrateError> {
    let mut runs = Vec::new();
    for smith in [Smith::Separable, Smith::Correlated] {
        for tolerance in TOLERANCES {
            runs.push(run(Path::Best, smith, tolerance)?);
        }
    }
    for path in [Path::Avx2, Path::Baseline] {
        runs.push(run(path, Smith::Separable, 1e-6)?);
    }
    Ok(TimedTables {
        threads: rayon::current_num_threads(),
        texels: (REFLECTION + GLASS) as u64,
        runs,
        estimator: estimator()?,
    })
}

fn run(path: Path, smith: Smith, tolerance: f64) -> Result<TimedTableRun, IntegrateError> {
    let (reflection, reflection_seconds) = fastest(|| anisotropy::path_tracer(path, smith, tolerance))?;
    let (glass, glass_seconds) = fastest(|| glass::path_tracer(path, smith, tolerance))?;
    Ok(TimedTableRun {
        instructions: path.name(),
        tolerance,
        smith,
        reflection_seconds,
        glass_seconds,
        evaluations: reflection.evaluations + glass.evaluations,
        worst: reflection.worst.max(glass.checked.worst),
        checked: (reflection.checked + glass.checked.texels) as u64,
    })
}

/// The result and the shortest time of several runs.
fn fastest<T>(work: impl Fn() -> Result<T, IntegrateError>) -> Result<(T, f64), IntegrateError> {
    let timed = || {
        let start = Instant::now();
        work().map(|value| (value, start.elapsed().as_secs_f64()))
    };
    let (value, mut shortest) = timed()?;
    for _ in 1..RUNS {
        shortest = shortest.min(timed()?.1);
    }
    Ok((value, shortest))
}

/// The path tracer's method on the same threads; seconds are extrapolated from its rate.
fn estimator() -> Result<TimedEstimator, IntegrateError> {
    let (one, two) = (drawn(&Anisotropy)?, drawn(&glass::GGX)?);
    let (rates, deviation) = ([one.0, two.0], [one.1, two.1]);
    Ok(TimedEstimator {
        samples_per_second: rates,
        deviation,
        samples_per_texel: PATH_TRACER_SAMPLES,
        seconds: PATH_TRACER_SAMPLES * (REFLECTION / rates[0] + GLASS / rates[1]),
    })
}

/// Samples a second of the path tracer's method, and their standard deviation.
fn drawn<F: Sliced>(family: &F) -> Result<(f64, f64), IntegrateError> {
    let deviation = estimate(family)?;
    let once = seconds(|| {
        let _ = std::hint::black_box(estimate(family));
    });
    Ok((DRAWN as f64 / once, deviation))
}
