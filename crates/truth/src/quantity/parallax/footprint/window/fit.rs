//! Width, scale and offset on a wall at right angles.

use std::sync::LazyLock;

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

use super::QUANTITY;
use crate::integrate::IntegrateError;
use crate::optics::kernel::{Kernel, Lobe};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;

/// What is plotted over the wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ordinate {
    /// The lobe's values.
    Value,
    /// Energy per area: times the cube of the cosine.
    PerArea,
}

/// The best fetch of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowFit {
    /// alpha', at most 0.999.
    pub alpha: f64,
    /// What multiplies the fetch, whose peak is 1.
    pub scale: f64,
    /// What is added, in units of the target's peak.
    pub offset: f64,
    /// Root mean square difference over the window, over the target's root mean square.
    pub error: f64,
    /// Whether alpha' is at its bound: scale and offset then cancel and mean nothing.
    pub saturated: bool,
}

/// Largest alpha': lobe `ndf` is constant at 1, where scale and offset are the same.
pub const WIDEST: f64 = 0.999;

/// Widths above count as [`WIDEST`].
const SATURATED: f64 = 0.99;

/// Smallest width of a lobe, its largest, and distances.
const ALPHAS: [f64; 2] = [0.01, 0.98];
const DISTANCES: [f64; 2] = [0.1, 10.0];

/// Nodes of [0, 1] with their weights: panels that double from 1/1024 on resolve lobes as narrow as
/// 1e-3, 12 nodes each.
static WINDOW: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let rule = Gauss::new(12);
    let ends = (0..=10).map(|i| if i == 0 { 0.0 } else { 1.0 / f64::from(1_u32 << (10 - i)) });
    let panel = |[from, to]: [f64; 2]| {
        let half = 0.5 * (to - from);
        let nodes = rule.nodes.iter().zip(&rule.weights);
        nodes.map(move |(x, w)| (from + half * (1.0 + x), half * w)).collect::<Vec<_>>()
    };
    let ends: Vec<f64> = ends.collect();
    ends.windows(2).flat_map(|pair| panel([pair[0], pair[1]])).collect()
});

/// A lobe over the tangent t >= 0 of the angle, 1 at 0.
pub fn ordinate(lobe: &Lobe, ordinate: Ordinate, t: f64) -> f64 {
    let half = t / (1.0 + (1.0 + t * t).sqrt());
    let value = lobe.per_solid_angle(half * half) / lobe.per_solid_angle(0.0);
    match ordinate {
        Ordinate::Value => value,
        Ordinate::PerArea => value / ((1.0 + t * t) * (1.0 + t * t).sqrt()),
    }
}

/// The best fetch in distance 1 for a lobe of width alpha in [0.01, 0.98] from a distance in [0.1,
/// 10], with an offset and without.
///
/// # Errors
/// An input outside of its domain; a solver that fails.
pub fn fits(
    kernel: &Kernel,
    plotted: Ordinate,
    alpha: f64,
    distance: f64,
) -> Result<[WindowFit; 2], IntegrateError> {
    for (input, value, [low, high], domain) in [
        ("alpha", alpha, ALPHAS, "is outside [0.01, 0.98]"),
        ("distance", distance, DISTANCES, "is outside [0.1, 10]"),
    ] {
        if !(low..=high).contains(&value) {
            return Err(IntegrateError::Domain { quantity: QUANTITY, input, value, domain });
        }
    }
    let lobe = kernel.lobe(alpha);
    let target: Vec<f64> = WINDOW.iter().map(|(x, _)| ordinate(&lobe, plotted, x / distance)).collect();
    let window = |shifted: bool| Window { kernel, plotted, target: target.clone(), shifted };
    let place = || format!("alpha = {alpha}, distance = {distance}");
    Ok([search(window(true), place)?, search(window(false), place)?])
}

#[derive(Clone)]
struct Window<'a> {
    kernel: &'a Kernel,
    plotted: Ordinate,
    target: Vec<f64>,
    /// Whether there is an offset.
    shifted: bool,
}

impl Window<'_> {
    fn fit(&self, alpha: f64) -> WindowFit {
        let lobe = self.kernel.lobe(alpha);
        let fetch: Vec<f64> = WINDOW.iter().map(|(x, _)| ordinate(&lobe, self.plotted, *x)).collect();
        let mean =
            |f: &dyn Fn(usize) -> f64| WINDOW.iter().enumerate().map(|(i, (_, w))| w * f(i)).sum::<f64>();
        // about the means, which the offset takes: [0, 1] has length 1
        let (middle, centre) =
            if self.shifted { (mean(&|i| fetch[i]), mean(&|i| self.target[i])) } else { (0.0, 0.0) };
        let squares = mean(&|i| (fetch[i] - middle) * (fetch[i] - middle));
        let scale = mean(&|i| (fetch[i] - middle) * (self.target[i] - centre)) / squares;
        let off = |i: usize| self.target[i] - centre - scale * (fetch[i] - middle);
        let whole = mean(&|i| self.target[i] * self.target[i]);
        WindowFit {
            alpha,
            scale,
            offset: centre - scale * middle,
            error: (mean(&|i| off(i) * off(i)) / whole).sqrt(),
            saturated: alpha > SATURATED,
        }
    }
}

impl CostFunction for Window<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, ln_alpha: &f64) -> Result<f64, argmin::core::Error> {
        Ok(self.fit(ops::exp(*ln_alpha)).error)
    }
}

/// Widths tried first, between whose neighbours of the best one is sought on.
const TRIED: usize = 48;

/// Least width tried.
const NARROWEST: f64 = 1e-3;

/// Tolerance of ln alpha'.
const SOUGHT: f64 = 1e-9;

const ITERATIONS: u64 = 100;

fn search(window: Window, place: impl Fn() -> String) -> Result<WindowFit, IntegrateError> {
    let failed = || IntegrateError::NotFinite { quantity: QUANTITY, place: place() };
    let (from, to) = (ops::log(NARROWEST), ops::log(WIDEST));
    let width = |i: usize| from + (to - from) * i as f64 / (TRIED - 1) as f64;
    let errors: Vec<f64> = (0..TRIED).map(|i| window.fit(ops::exp(width(i))).error).collect();
    if errors.iter().any(|error| !error.is_finite()) {
        return Err(failed());
    }
    let best = (0..TRIED).min_by(|a, b| errors[*a].total_cmp(&errors[*b])).unwrap_or(0);
    let (low, high) = (width(best.saturating_sub(1)), width((best + 1).min(TRIED - 1)));
    let solver = BrentOpt::new(low, high).set_tolerance(SOUGHT, SOUGHT);
    let outcome = Executor::new(window.clone(), solver)
        .configure(|state| state.max_iters(ITERATIONS))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|_| failed())?;
    let found = outcome.state.get_best_param().copied().filter(|x| x.is_finite()).ok_or_else(failed)?;
    // Brent's method never tries the ends of its interval
    let fit = window.fit(ops::exp(found));
    let end = window.fit(WIDEST);
    Ok(if end.error < fit.error { end } else { fit })
}
