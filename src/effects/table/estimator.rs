//! The path tracer's own method at texels of its tables: random visible normals, the weight G1 of
//! the light, the mean of the samples.

use rayon::prelude::*;

use super::Sliced;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::monte_carlo::{Draw, Points, Run};

/// Samples a texel in the path tracer.
pub const PATH_TRACER_SAMPLES: f64 = 1e7;

/// Texels tried along each axis.
const TRIED: usize = 4;

/// Samples of each.
const SAMPLES: u64 = 1 << 14;

/// Samples that one call of [`estimate`] draws.
pub const DRAWN: u64 = SAMPLES * (TRIED * TRIED * TRIED) as u64;

/// The draw of each texel tried.
pub const RUN: Run = Run { samples: SAMPLES, seed: 1, points: Points::Random, draw: Draw::VisibleNormal };

/// Root mean square of a sample's standard deviation, over texels spread over a table of the path
/// tracer's layout.
///
/// The same at every call, for any number of threads.
pub fn estimate<F: Sliced>(family: &F) -> Result<f64, IntegrateError> {
    let spread = |i: usize| (i as f64 + 0.5) / TRIED as f64;
    let errors: Vec<f64> = (0..TRIED * TRIED * TRIED)
        .into_par_iter()
        .map(|i| {
            family.path_tracer_error([
                spread(i % TRIED),
                spread(i / TRIED % TRIED),
                spread(i / TRIED / TRIED),
            ])
        })
        .collect::<Result<_, IntegrateError>>()?;
    let variance = errors.iter().map(|e| e * e * SAMPLES as f64).sum::<f64>() / errors.len() as f64;
    Ok(variance.sqrt())
}
