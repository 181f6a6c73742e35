//! Width and scale on a wall at a slant.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

use super::QUANTITY;
use crate::integrate::IntegrateError;
use crate::optics::kernel::{Kernel, Lobe};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;

/// The best fetch for a slanted lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlantedFit {
    /// alpha'.
    pub alpha: f64,
    /// What multiplies the fetch.
    pub scale: f64,
    /// Root mean square difference over the window, over the target's root mean square.
    pub error: f64,
    /// The same of the lobe's own width, with its own best scale.
    pub same: f64,
    /// Where the target falls to half of its peak: across the tilt; along it, towards the shading
    /// point and away from it.
    pub half: [f64; 3],
}

/// Nodes of [-1, 1] by panels that double away from 0, dense where the narrowest lobe lies.
fn nodes() -> Vec<(f64, f64)> {
    let rule = Gauss::new(10);
    let mut out = Vec::new();
    for i in 0..=8 {
        let from = if i == 0 { 0.0 } else { 1.0 / f64::from(1_u32 << (9 - i)) };
        let half = 0.5 * (1.0 / f64::from(1_u32 << (8 - i)) - from);
        for (x, w) in rule.nodes.iter().zip(&rule.weights) {
            let at = from + half * (1.0 + x);
            out.extend([(at, half * w), (-at, half * w)]);
        }
    }
    out
}

/// A lobe's value at a place (x, y) of the wall, from distance 1 at a slant along x, over its peak.
pub fn profile(lobe: &Lobe, slant: f64, [x, y]: [f64; 2]) -> f64 {
    let (s, c) = ops::sincos(slant);
    // from (-s, 0, c) along (s, 0, -c)
    let (dx, dz) = (x + s, -c);
    let cosine = (dx * s - dz * c) / (dx * dx + y * y + dz * dz).sqrt();
    if cosine <= 0.0 {
        return 0.0;
    }
    let u = ((1.0 - cosine) / (1.0 + cosine)).max(0.0);
    lobe.per_solid_angle(u) / lobe.per_solid_angle(0.0)
}

#[derive(Clone)]
struct Square<'a> {
    kernel: &'a Kernel,
    places: Vec<([f64; 2], f64)>,
    target: Vec<f64>,
}

impl Square<'_> {
    fn fit(&self, alpha: f64) -> (f64, f64) {
        let lobe = self.kernel.lobe(alpha);
        let (mut own, mut both, mut whole) = (0.0, 0.0, 0.0);
        for ((place, weight), target) in self.places.iter().zip(&self.target) {
            let fetch = profile(&lobe, 0.0, *place);
            own += weight * fetch * fetch;
            both += weight * fetch * target;
            whole += weight * target * target;
        }
        let scale = both / own;
        (scale, (1.0 - scale * both / whole).max(0.0).sqrt())
    }
}

impl CostFunction for Square<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, ln_alpha: &f64) -> Result<f64, argmin::core::Error> {
        Ok(self.fit(ops::exp(*ln_alpha)).1)
    }
}

/// The values of a lobe of width alpha in [0.02, 0.5] from distance 1 at a slant in [0, 1.4]
/// radians, against a fetch at right angles from distance 1, over the square window.
///
/// # Errors
/// An input outside of its domain; a solver that fails.
pub fn slanted(kernel: &Kernel, alpha: f64, slant: f64) -> Result<SlantedFit, IntegrateError> {
    let refuse =
        |input, value, domain| Err(IntegrateError::Domain { quantity: QUANTITY, input, value, domain });
    if !(0.02..=0.5).contains(&alpha) {
        return refuse("alpha", alpha, "is outside [0.02, 0.5]");
    }
    if !(0.0..=1.4).contains(&slant) {
        return refuse("slant", slant, "is outside [0, 1.4]");
    }
    let line = nodes();
    let places: Vec<([f64; 2], f64)> =
        line.iter().flat_map(|(x, v)| line.iter().map(move |(y, w)| ([*x, *y], v * w))).collect();
    let lobe = kernel.lobe(alpha);
    let target = places.iter().map(|(place, _)| profile(&lobe, slant, *place)).collect();
    let square = Square { kernel, places, target };
    let failed = || IntegrateError::NotFinite {
        quantity: QUANTITY,
        place: format!("alpha = {alpha}, slant = {slant}"),
    };
    let solver =
        BrentOpt::new(ops::log(0.5 * alpha), ops::log((6.0 * alpha).min(1.0))).set_tolerance(1e-8, 1e-8);
    let outcome = Executor::new(square.clone(), solver)
        .configure(|state| state.max_iters(100))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|_| failed())?;
    let found = outcome.state.get_best_param().copied().filter(|x| x.is_finite()).ok_or_else(failed)?;
    let (scale, error) = square.fit(ops::exp(found));
    let half = [[0.0, 1.0], [-1.0, 0.0], [1.0, 0.0]]
        .map(|[x, y]| halved(&|r| profile(&lobe, slant, [x * r, y * r])));
    Ok(SlantedFit { alpha: ops::exp(found), scale, error, same: square.fit(alpha).1, half })
}

/// Where a function that falls from 1 at 0 is 1/2, at most 1.
fn halved(f: &dyn Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.5 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
