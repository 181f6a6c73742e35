//! Whole tables: the sources' three, by the kernels and by the sources' estimator on the same cores.

use std::time::Instant;

use rayon::prelude::*;

use super::seconds;
use crate::data::Smith;
use crate::effects::{anisotropy, glass};
use crate::integrate::glass::Side;
use crate::integrate::monte_carlo::{self, Draw, Points, Run};
use crate::integrate::{IntegrateError, Path};
use crate::report::{TimedEstimator, TimedTableRun, TimedTables};

/// Accuracies asked for.
const TOLERANCES: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-7];

/// Runs of each table of which the fastest counts: what is measured is the work, not what else the machine does.
const RUNS: usize = 5;

/// Texels of the three tables.
const REFLECTION: f64 = 64.0 * 64.0 * 32.0;
const GLASS: f64 = 2.0 * 128.0 * 128.0 * 32.0;

/// Samples a texel in the sources.
const SAMPLES: f64 = 1e7;

/// Texels tried along each axis of each table, and samples of each.
const TRIED: usize = 4;
const PER_TEXEL: u64 = 1 << 14;

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
    let (reflection, reflection_seconds) = fastest(|| anisotropy::sources(path, smith, tolerance))?;
    let (glass, glass_seconds) = fastest(|| glass::sources(path, smith, tolerance))?;
    Ok(TimedTableRun {
        instructions: path.name(),
        tolerance,
        smith,
        reflection_seconds,
        glass_seconds,
        evaluations: reflection.evaluations + reflection.checked.evaluations + glass.evaluations,
        worst: reflection.checked.worst.max(glass.checked.worst),
        checked: (reflection.checked.texels + glass.checked.texels) as u64,
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

/// The sources' method: random visible normals, the weight G1 of the light, the mean of the samples. Timed at texels spread over the
/// tables, each texel on one thread as theirs are.
fn estimator() -> Result<TimedEstimator, IntegrateError> {
    let spread = |i: usize| (i as f64 + 0.5) / TRIED as f64;
    let places: Vec<[f64; 3]> = (0..TRIED * TRIED * TRIED)
        .map(|i| [spread(i % TRIED), spread(i / TRIED % TRIED), spread(i / TRIED / TRIED)])
        .collect();
    let run = Run { samples: PER_TEXEL, seed: 1, points: Points::Random, draw: Draw::VisibleNormal };
    let reflection = |[mu, alpha, z]: [f64; 3]| {
        let aspect = (1.0 - 0.9 * z.sqrt()).sqrt();
        let sampled = monte_carlo::aniso(Smith::Separable, [alpha / aspect, alpha * aspect], mu, None, run)?;
        Ok(sampled[0].standard_error)
    };
    let glass = |[x, alpha, z]: [f64; 3]| {
        let side = if z < 0.5 { Side::Outside } else { Side::Inside };
        let [r, t, _] = monte_carlo::glass(Smith::Separable, alpha, x * x, 1.0 + z, side, run)?;
        // R and T of a sample are drawn together here; their sum varies no more than both.
        Ok(r.standard_error.max(t.standard_error))
    };
    let (reflection_rate, reflection_deviation) = rate(&places, reflection)?;
    let (glass_rate, glass_deviation) = rate(&places, glass)?;
    Ok(TimedEstimator {
        samples_per_second: [reflection_rate, glass_rate],
        deviation: [reflection_deviation, glass_deviation],
        samples_per_texel: SAMPLES,
        seconds: SAMPLES * (REFLECTION / reflection_rate + GLASS / glass_rate),
    })
}

/// Samples a second, and the root mean square of a sample's standard deviation, from the standard error of each texel.
fn rate(
    places: &[[f64; 3]],
    texel: impl Fn([f64; 3]) -> Result<f64, IntegrateError> + Sync,
) -> Result<(f64, f64), IntegrateError> {
    let all = || places.par_iter().map(|place| texel(*place)).collect::<Result<Vec<f64>, IntegrateError>>();
    let errors = all()?;
    let time = seconds(|| {
        let _ = std::hint::black_box(all());
    });
    let samples = PER_TEXEL as f64;
    let variance = errors.iter().map(|e| e * e * samples).sum::<f64>() / errors.len() as f64;
    Ok((samples * places.len() as f64 / time, variance.sqrt()))
}
