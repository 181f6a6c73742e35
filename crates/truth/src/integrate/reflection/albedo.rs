//! E and its loss: one-dimensional integrals over the light's polar angle.

use crate::integrate::estimate::PanelRule;
use crate::optics::Smith;
use crate::optics::ggx;
use lobefit_math::lanes::{F8, LANES};

use super::geometry::View;

/// E(alpha, mu) for F = 1 by one rule; alpha > 0, mu in [0, 1].
/// E = int G2/(4 mu) K dmu_l over the lights above the horizon.
pub fn albedo(smith: Smith, alpha: f64, mu: f64, rule: &PanelRule) -> f64 {
    let view = View::new(smith, alpha, mu);
    rule.panels(&view.cuts(), &|u| albedo_integrand(&view, u))
}

/// A value of E and the integrand evaluations that it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    /// E.
    pub value: f64,
    /// Integrand evaluations.
    pub evaluations: usize,
}

/// E(alpha, mu) with its cost, on the graded panels or on one panel over the whole range: for studies of what accuracy
/// costs. alpha > 0, mu in [0, 1].
pub fn albedo_work(smith: Smith, alpha: f64, mu: f64, rule: &PanelRule, graded: bool) -> Work {
    let view = View::new(smith, alpha, mu);
    let mut cuts = view.cuts();
    if !graded {
        cuts = vec![cuts[0], cuts[cuts.len() - 1]];
    }
    let value = rule.panels(&cuts, &|u| albedo_integrand(&view, u));
    Work { value, evaluations: (cuts.len() - 1) * rule.nodes() }
}

/// 1 - E(alpha, mu), computed directly; alpha > 0, mu in [0, 1].
///
/// By the weak white furnace (Heitz 2014, sec. 5.1) int G1(v)/(4 mu) K dmu_l = 1 over mu_l in [-mu, 1], so the loss is the
/// light shadowed above the horizon, (G1(v) - G2)/(4 mu) K, and all that leaves below it, G1(v)/(4 mu) K.
pub fn loss(smith: Smith, alpha: f64, mu: f64, rule: &PanelRule) -> f64 {
    let view = View::new(smith, alpha, mu);
    let above = rule.panels(&view.cuts(), &|u| shadowed_integrand(&view, u));
    let below = rule.panel(-view.mu, 0.0, &|cosine| below_integrand(&view, cosine));
    above + below
}

#[inline(always)]
fn albedo_integrand(view: &View, u: &F8) -> F8 {
    let at = view.lights(u);
    let mut out = view.azimuth_integral(&at);
    for i in 0..LANES {
        let geometry = ggx::shadowing_over_cosine(view.smith, view.mu, view.s_v, at.mu_l[i], at.s_l[i]);
        out[i] *= 0.25 * geometry * at.jacobian[i];
    }
    out
}

#[inline(always)]
fn shadowed_integrand(view: &View, u: &F8) -> F8 {
    let at = view.lights(u);
    let mut out = view.azimuth_integral(&at);
    for i in 0..LANES {
        let (mu_l, s_l) = (at.mu_l[i], at.s_l[i]);
        let spread = view.alpha * view.alpha * at.sin_l[i] * at.sin_l[i];
        let geometry = ggx::shadowed_over_cosine(view.smith, view.mu, view.s_v, mu_l, s_l, spread);
        out[i] *= 0.25 * geometry * at.jacobian[i];
    }
    out
}

#[inline(always)]
fn below_integrand(view: &View, cosine: &F8) -> F8 {
    let at = view.lights_below(cosine);
    let mut out = view.azimuth_integral(&at);
    let masking = 2.0 / (view.mu + view.s_v);
    for value in &mut out {
        *value *= 0.25 * masking;
    }
    out
}
