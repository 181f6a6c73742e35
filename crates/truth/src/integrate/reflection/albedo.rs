//! E and its loss: one-dimensional integrals over the light's polar angle.

use crate::integrate::estimate::PanelRule;
use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Ggx};
use lobefit_math::lanes::{F8, LANES};

use super::geometry::{Lights, View};

/// E(alpha, mu) of the GGX lobe for F = 1 by one rule; alpha > 0, mu in [0, 1].
pub fn albedo(smith: Smith, alpha: f64, mu: f64, rule: &PanelRule) -> f64 {
    kept(&View::new(smith, Ggx(alpha), mu), rule)
}

/// 1 - E(alpha, mu) of the GGX lobe, computed directly; alpha > 0, mu in [0, 1].
pub fn loss(smith: Smith, alpha: f64, mu: f64, rule: &PanelRule) -> f64 {
    lost(&View::new(smith, Ggx(alpha), mu), rule)
}

/// E = int G2/(4 mu) K dmu_l over the lights above the horizon, K the azimuth integral of D.
pub(super) fn kept<D: Distribution>(view: &View<D>, rule: &PanelRule) -> f64 {
    rule.panels(&view.cuts(), &|u| albedo_integrand(view, u))
}

/// 1 - E, computed directly.
///
/// By the weak white furnace (Heitz 2014, sec. 5.1) int G1(v)/(4 mu) K dmu_l = 1 over mu_l in [-mu,
/// 1], so the loss is the light shadowed above the horizon, (G1(v) - G2)/(4 mu) K, and all that
/// leaves below it, G1(v)/(4 mu) K.
pub(super) fn lost<D: Distribution>(view: &View<D>, rule: &PanelRule) -> f64 {
    let above = rule.panels(&view.cuts(), &|u| shadowed_integrand(view, u));
    // A peak with a power for a tail is smooth below the horizon, over the cosine itself; another
    // is resolved as it is above.
    let below = if D::REACH.is_finite() {
        rule.panels(&view.cuts_below(), &|u| {
            let at = view.lights_above(u, -1.0);
            below_integrand(view, &at)
        })
    } else {
        rule.panel(-view.mu, 0.0, &|cosine| below_integrand(view, &view.lights_below(cosine)))
    };
    above + below
}

/// E of a lobe on one panel over the whole range, in place of the graded panels: what they are worth.
/// alpha > 0, mu in [0, 1].
pub(crate) fn on_one_panel<D: Distribution>(smith: Smith, lobe: D, mu: f64, rule: &PanelRule) -> f64 {
    let view = View::new(smith, lobe, mu);
    let cuts = view.cuts();
    rule.panel(cuts[0], cuts[cuts.len() - 1], &|u| albedo_integrand(&view, u))
}

#[inline(always)]
fn albedo_integrand<D: Distribution>(view: &View<D>, u: &F8) -> F8 {
    let at = view.lights(u);
    let mut out = view.azimuth_integral(&at);
    for i in 0..LANES {
        let geometry = view.smith.shadowing_over_cosine(view.mu, view.s_v, at.mu_l[i], at.s_l[i]);
        out[i] *= 0.25 * geometry * at.jacobian[i];
    }
    out
}

#[inline(always)]
fn shadowed_integrand<D: Distribution>(view: &View<D>, u: &F8) -> F8 {
    let at = view.lights(u);
    let mut out = view.azimuth_integral(&at);
    for i in 0..LANES {
        let (mu_l, s_l) = (at.mu_l[i], at.s_l[i]);
        let lift = view.lobe.lift(mu_l, at.sin_l[i], s_l);
        let geometry = view.smith.shadowed_over_cosine(view.mu, view.s_v, mu_l, s_l, lift);
        out[i] *= 0.25 * geometry * at.jacobian[i];
    }
    out
}

#[inline(always)]
fn below_integrand<D: Distribution>(view: &View<D>, at: &Lights) -> F8 {
    let mut out = view.azimuth_integral(at);
    let masking = 2.0 / (view.mu + view.s_v);
    for i in 0..LANES {
        out[i] *= 0.25 * masking * at.jacobian[i];
    }
    out
}
