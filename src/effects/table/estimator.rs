//! The sources' method at texels of their tables: random visible normals, the weight G1 of the light, the mean of the samples.

use rayon::prelude::*;

use super::SliceAxis;
use crate::data::Smith;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::monte_carlo::{self, Draw, Points, Run};

/// Samples a texel in the sources.
pub const SOURCES_SAMPLES: f64 = 1e7;

/// Texels tried along each axis.
const TRIED: usize = 4;

/// Samples of each.
const SAMPLES: u64 = 1 << 14;

/// Samples that one call of [`estimate`] draws.
pub const DRAWN: u64 = SAMPLES * (TRIED * TRIED * TRIED) as u64;

/// Root mean square over texels spread over a table of the sources' of a sample's standard deviation; glass from both sides.
///
/// The same at every call, for any number of threads.
pub fn estimate(slice: SliceAxis) -> Result<f64, IntegrateError> {
    let spread = |i: usize| (i as f64 + 0.5) / TRIED as f64;
    let errors: Vec<f64> = (0..TRIED * TRIED * TRIED)
        .into_par_iter()
        .map(|i| texel(slice, [spread(i % TRIED), spread(i / TRIED % TRIED), spread(i / TRIED / TRIED)]))
        .collect::<Result<_, IntegrateError>>()?;
    let variance = errors.iter().map(|e| e * e * SAMPLES as f64).sum::<f64>() / errors.len() as f64;
    Ok(variance.sqrt())
}

/// Standard error at a place of the unit cube of the table's coordinates.
fn texel(slice: SliceAxis, [x, alpha, z]: [f64; 3]) -> Result<f64, IntegrateError> {
    let run = Run { samples: SAMPLES, seed: 1, points: Points::Random, draw: Draw::VisibleNormal };
    match slice {
        SliceAxis::Anisotropy => {
            let aspect = (1.0 - 0.9 * z.sqrt()).sqrt();
            let sampled =
                monte_carlo::aniso(Smith::Separable, [alpha / aspect, alpha * aspect], x, None, run)?;
            Ok(sampled[0].standard_error)
        }
        SliceAxis::Ior => {
            let side = if z < 0.5 { Side::Outside } else { Side::Inside };
            let [_, _, loss] = monte_carlo::glass(Smith::Separable, alpha, x * x, 1.0 + z, side, run)?;
            Ok(loss.standard_error)
        }
    }
}
