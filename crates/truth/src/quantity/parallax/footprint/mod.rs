//! `parallax-alpha`: the width of a prefiltered lobe, seen from a probe, that covers a wall as a
//! given lobe does from a shading point.
//!
//! A lobe whose axis meets a wall at a right angle in distance d holds within the wall radius R the
//! energy E(R/d) of its cone. With the probe at distance 1 and the shading point at distance rho,
//! the target is E(alpha; R/rho) and a single fetch of width alpha' gives E(alpha'; R). The best
//! alpha' minimises int (E(alpha; R/rho) - E(alpha'; R))^2 d ln R, the expected squared error over
//! images with a 1/f^2 spectrum. Both are analytic in the strip |Im ln R| < pi/2 and decay as R^2
//! and R^-2 (R^-1 where the lobe does not vanish at the horizon), so that the trapezoidal rule of
//! step h is off by exp(-pi^2/h).
//!
//! Ends of the domain: at alpha = 0 the lobe is a ray and alpha' = 0; at rho = 1, alpha' = alpha;
//! where the best width is above 1 the fetch is saturated, alpha' = 1. alpha' grows with alpha and
//! rho.

mod best;
mod measures;
pub mod slant;

pub use best::{Adjusted, adjusted, best};
pub use measures::{Measures, measures};

use crate::integrate::IntegrateError;
use crate::optics::kernel::Kernel;
use lobefit_math::ops;

/// Smallest width above 0.
pub const SMALLEST_ALPHA: f64 = 1e-6;

/// Ratios of distances.
pub const RHO: [f64; 2] = [1e-6, 1e3];

/// The tolerance of a value by default.
pub const TOLERANCE: f64 = 1e-7;

/// The tolerance of a value of a kernel by default; coarser where it is a table, and
/// where that ends with a jump, as a cone.
pub fn usual_tolerance(kernel: &Kernel) -> f64 {
    match (kernel.is_analytic(), kernel.is_cut()) {
        (true, _) => TOLERANCE,
        (false, false) => 1e-4,
        (false, true) => 1e-3,
    }
}

/// How far [`best`] is from the best width at most: of a lobe with a formula, of a table of a dozen
/// angles or more, and of one whose density ends with a jump, as a cone's.
pub fn quick_error(kernel: &Kernel) -> f64 {
    match (kernel.is_analytic(), kernel.is_cut()) {
        (true, _) => TOLERANCE,
        (false, false) => 1e-4,
        (false, true) => 1e-2,
    }
}

const QUANTITY: &str = "parallax-alpha";

fn check(alpha: f64, rho: f64) -> Result<(), IntegrateError> {
    let inside = alpha == 0.0 || (SMALLEST_ALPHA..=1.0).contains(&alpha);
    let inputs = [
        ("alpha", alpha, inside, "is neither 0 nor in [1e-6, 1]"),
        ("rho", rho, (RHO[0]..=RHO[1]).contains(&rho), "is outside [1e-6, 1e3]"),
    ];
    IntegrateError::outside(QUANTITY, inputs)
}

/// Wall radii of equal steps in the logarithm that hold all that lies between two lobes: from 1e-4
/// of the narrower one's radius, inside which there is 1e-8 of its energy, to where there is 1e-8
/// beyond.
fn radii(kernel: &Kernel, narrowest: f64, farthest: f64, step: f64) -> impl Iterator<Item = f64> + Clone {
    const REACH: f64 = 18.6;
    let (from, to) = (ops::log(narrowest) - 0.5 * REACH, ops::log(farthest) + REACH / kernel.decay());
    let count = ((to - from) / step).ceil() as usize + 1;
    (0..count).map(move |i| ops::exp(from + step * i as f64))
}
