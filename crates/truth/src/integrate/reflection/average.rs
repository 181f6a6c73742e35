//! `ggx-average`: E_avg = 2 int_0^1 E(mu) mu dmu and its loss.

use super::{Effort, LOSS_TOLERANCE, albedo, check_inputs, loss};
use crate::integrate::{Estimate, IntegrateError};
use crate::optics::Smith;
use lobefit_math::gauss::Gauss;
use lobefit_math::panels;

/// `ggx-average` at one alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Average {
    /// Cosine-weighted average of E.
    pub e_avg: f64,
    /// 1 - E_avg, computed directly.
    pub loss_avg: f64,
    /// Bound on the absolute error of both.
    pub error: f64,
    /// Bound on the relative error of the loss.
    pub loss_error: f64,
}

/// Nodes per panel of the coarse and the fine rule over mu. E behaves as mu ln(mu) at mu = 0, which
/// the grading of the panels resolves down to a thousandth of alpha; what is left there is below
/// 1e-13.
const NODES: [usize; 2] = [8, 16];

/// Integrates `ggx-average` at alpha in {0} or [1e-7, 1].
pub fn average(smith: Smith, alpha: f64, tolerance: f64) -> Result<Average, IntegrateError> {
    check_inputs("ggx-average", alpha, 1.0)?;
    if alpha == 0.0 {
        return Ok(Average { e_avg: 1.0, loss_avg: 0.0, error: 0.0, loss_error: 0.0 });
    }
    let ladder = Effort::ladder();
    let both = |f: &dyn Fn(f64, &Effort) -> f64| {
        [0, 1].map(|i| mean_over_cosine(alpha, &Gauss::new(NODES[i]), |mu| f(mu, &ladder[i])))
    };
    let e = both(&|mu, effort| albedo(smith, alpha, mu, &effort.outer));
    let taken = both(&|mu, effort| loss(smith, alpha, mu, &effort.outer));
    let e = Estimate::from_pair(e[0], e[1], 1.0);
    let taken = Estimate::from_pair(taken[0], taken[1], taken[1]);
    let loss_error = taken.error / taken.value;
    let error = e.error.max(taken.error);
    if !(e.value.is_finite() && taken.value.is_finite()) {
        return Err(IntegrateError::NotFinite {
            quantity: "ggx-average",
            place: format!("alpha = {alpha:?}"),
        });
    }
    if error > tolerance || loss_error > LOSS_TOLERANCE {
        let place = format!("alpha = {alpha:?}");
        return Err(IntegrateError::Tolerance { quantity: "ggx-average", place, reached: error, tolerance });
    }
    Ok(Average { e_avg: e.value, loss_avg: taken.value, error, loss_error })
}

/// 2 int_0^1 f(mu) mu dmu over panels graded towards mu = 0.
fn mean_over_cosine(alpha: f64, rule: &Gauss, f: impl Fn(f64) -> f64) -> f64 {
    let cuts = panels::from_zero(1.0, 1e-3 * alpha);
    2.0 * cuts.windows(2).map(|cut| rule.integrate(cut[0], cut[1], |mu| mu * f(mu))).sum::<f64>()
}
