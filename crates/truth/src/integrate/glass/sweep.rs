//! The sweep over the angle theta_d between view and facets: R = int F cos(theta_d) sin(theta_d)
//! (ring of mirrored light) dtheta_d, T the same with 1 - F and refracted light, and the loss what
//! both leave out (by the weak white furnace all of G1 D cos/mu adds up to 1).
//!
//! tan((theta_d - theta)/2) = (alpha/2) sinh(u) makes the peak at the macro normal one unit wide.
//! The sweep is cut where a ring turns from whole to truncated and at the critical angle; at each
//! of these it behaves as a square root, which panels that shrink geometrically down to a millionth
//! resolve to 1e-9.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::facets::Facets;
use super::interface::Interface;
use super::ring::{Ring, View};
use crate::integrate::PanelRule;
use crate::optics::Smith;
use lobefit_math::{ops, panels};

/// Longest panel in u.
const LONGEST: f64 = 2.0;

/// Smallest panel at a cut.
const FINEST: f64 = 1e-7;

/// R, T and loss.
pub(super) fn energies<D: Facets>(
    smith: Smith,
    lobe: D,
    mu: f64,
    interface: Interface,
    rule: &PanelRule,
) -> [f64; 3] {
    let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
    let view = View { smith, lobe, mu, sine, s_v: lobe.area_at(mu) };
    let theta = ops::atan2(sine, mu);
    let mut total = [0.0; 3];
    for cut in cuts(&view, theta, interface).windows(2) {
        rule.each(cut[0], cut[1], |u, weight| {
            let values = at(&view, interface, u, rule);
            for (sum, value) in total.iter_mut().zip(values) {
                *sum += weight * value;
            }
        });
    }
    total
}

/// The integrands at one facet angle.
fn at<D: Facets>(view: &View<D>, interface: Interface, u: f64, rule: &PanelRule) -> [f64; 3] {
    // theta_d = theta + 2 atan(m)
    let m = 0.5 * view.lobe.alpha() * ops::sinh(u);
    let length2 = 1.0 + m * m;
    let (cos_w, sin_w) = ((1.0 - m) * (1.0 + m) / length2, 2.0 * m / length2);
    let cosine = view.mu * cos_w - view.sine * sin_w;
    let sine = view.sine * cos_w + view.mu * sin_w;
    if cosine <= 0.0 || sine <= 0.0 {
        return [0.0; 3];
    }
    let slope = 2.0 * 0.5 * view.lobe.alpha() * ops::cosh(u) / length2;
    let weight = cosine * sine * slope;
    let ring = Ring::new(view, cosine, sine, m * m / length2);
    let facet = interface.facet(cosine, sine);
    let double = [(cosine - sine) * (cosine + sine), 2.0 * cosine * sine];
    let mirrored = if facet.fresnel > 0.0 { ring.mirrored(double, rule) } else { [0.0; 2] };
    let refracted = if facet.fresnel < 1.0 { ring.refracted(&facet, rule) } else { [0.0; 2] };
    let (kept, passed) = (facet.fresnel, 1.0 - facet.fresnel);
    [
        weight * kept * mirrored[0],
        weight * passed * refracted[0],
        weight * (kept * mirrored[1] + passed * refracted[1]),
    ]
}

/// Cuts of u from theta_d = 0 to pi/2.
fn cuts<D: Facets>(view: &View<D>, theta: f64, interface: Interface) -> Vec<f64> {
    // Facets farther from the macro normal are nothing beside the whole.
    let reach = ops::atan2(D::SPAN * view.lobe.alpha(), 1.0);
    let (low, high) = if D::SPAN.is_finite() {
        ((theta - reach).max(0.0), (theta + reach).min(FRAC_PI_2))
    } else {
        (0.0, FRAC_PI_2)
    };
    let mut angles = vec![low, high, FRAC_PI_2 - theta, FRAC_PI_4 - 0.5 * theta, FRAC_PI_4 + 0.5 * theta];
    if let Some([sine, cosine]) = interface.critical() {
        angles.push(ops::atan2(sine, cosine));
        // Refracted rays graze at psi = 0: cos(theta - theta_d) = eta sin(theta_d)
        angles.push(ops::atan2(view.mu, interface.eta - view.sine));
    }
    let u = |angle: f64| ops::asinh(2.0 * ops::tan(0.5 * (angle - theta)) / view.lobe.alpha());
    let mut breaks: Vec<f64> = angles.into_iter().filter(|a| (low..=high).contains(a)).map(u).collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|b, a| *b - *a < 1e-12);
    let mut cuts = vec![breaks[0]];
    for pair in breaks.windows(2) {
        panels::towards_both(&mut cuts, pair[0], pair[1], LONGEST, [FINEST, FINEST]);
    }
    cuts
}
