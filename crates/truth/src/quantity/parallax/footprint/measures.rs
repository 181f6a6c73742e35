//! How far a fetch is from what it stands for.

use super::{check, radii};
use crate::integrate::IntegrateError;
use crate::optics::kernel::{Kernel, Lobe};

/// Step of ln R: between neighbours the densities cross at most once, where they have a formula.
const STEP: f64 = 0.1;

/// Steps of a table's lobes, finer the more angles it has, so that what crosses twice in one is
/// less than its noise from angle to angle.
const TABLE_STEPS: [f64; 2] = [0.005, 0.1];
const ANGLES_A_STEP: f64 = 4.0;

fn step(kernel: &Kernel) -> f64 {
    let [least, most] = TABLE_STEPS;
    kernel.angles().map_or(STEP, |angles| (ANGLES_A_STEP / angles as f64).clamp(least, most))
}

/// Halvings that place a crossing; the variation is flat there.
const HALVINGS: u32 = 30;

/// Distances between the footprints of target and fetch on the wall, W energy per area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// (1/2) int |W_t - W_c|: bounds the error of radiance in units of the scene's range.
    pub tv: f64,
    /// Root of int (W_t - W_c)^2 over that of int W_t^2.
    pub l2: f64,
    /// Largest |W_t - W_c| over the largest W_t.
    pub max: f64,
    /// Root of int (E_t - E_c)^2 d ln R of the encircled energies: what the best width minimises.
    pub encircled: f64,
}

/// The distances at a width `fetched` in [1e-12, 1] of the fetch, not necessarily the best.
///
/// # Errors
/// As [`super::adjusted`]; alpha = 0, a ray, has no density.
pub fn measures(kernel: &Kernel, alpha: f64, rho: f64, fetched: f64) -> Result<Measures, IntegrateError> {
    check(alpha, rho)?;
    let width = |input, x: f64| (input, x, (1e-12..=1.0).contains(&x), "is outside [1e-12, 1]");
    let inputs = [width("alpha", alpha), width("alpha of the fetch", fetched)];
    IntegrateError::outside(super::QUANTITY, inputs)?;
    let (target, fetch) = (kernel.lobe(alpha), kernel.lobe(fetched));
    let narrowest = fetched.min(alpha * rho);
    let (mut square, mut whole, mut largest, mut peak, mut encircled) = (0.0, 0.0, 0.0_f64, 0.0_f64, 0.0);
    let step = step(kernel);
    for radius in radii(kernel, narrowest, rho.max(1.0), step) {
        // energy per area is its slope over ln R by 2 pi R^2; dA = 2 pi R^2 d ln R
        let area = radius * radius;
        let (seen, fetched) = (target.slope(radius / rho) / area, fetch.slope(radius) / area);
        let off = seen - fetched;
        square += off * off * area;
        whole += seen * seen * area;
        largest = largest.max(off.abs());
        peak = peak.max(seen);
        let energy = target.encircled(radius / rho) - fetch.encircled(radius);
        encircled += energy * energy * step;
    }
    Ok(Measures {
        tv: variation(kernel, &target, rho, &fetch, narrowest),
        l2: (square / whole).sqrt(),
        max: largest / peak,
        encircled: encircled.sqrt(),
    })
}

/// Half of the total variation of E_t - E_c over R, which starts and ends at 0.
pub(super) fn variation(kernel: &Kernel, target: &Lobe, rho: f64, fetch: &Lobe, narrowest: f64) -> f64 {
    let slope = |radius: f64| target.slope(radius / rho) - fetch.slope(radius);
    let energy = |radius: f64| target.encircled(radius / rho) - fetch.encircled(radius);
    let (mut total, mut last) = (0.0_f64, 0.0_f64);
    let mut to = |extreme: f64| {
        total += (extreme - last).abs();
        last = extreme;
    };
    let nodes = radii(kernel, narrowest, rho.max(1.0), step(kernel));
    for (left, right) in nodes.clone().zip(nodes.skip(1)) {
        let rising = slope(left) > 0.0;
        if rising == (slope(right) > 0.0) {
            continue;
        }
        let (mut left, mut right) = (left, right);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (left + right);
            if rising == (slope(middle) > 0.0) { left = middle } else { right = middle }
        }
        to(energy(0.5 * (left + right)));
    }
    to(0.0);
    0.5 * total
}
