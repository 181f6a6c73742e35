//! All rays of facets about the macro normal.
//!
//! The azimuth is that of the stretched slopes, psi: a ray points along (alpha_x cos psi, alpha_y
//! sin psi), and E = (1/pi) int dpsi (ray integral)/g^2 with g the length of that vector: the rays'
//! weights do not depend on the anisotropy.

use std::f64::consts::PI;

use super::ray::Ray;
use super::view::View;
use crate::integrate::PanelRule;
use lobefit_math::{ops, panels};

/// Longest panel over the azimuth.
const LONGEST: f64 = 1.6;

/// The rays of one view.
pub(super) struct Rays {
    view: View,
    cuts: Vec<f64>,
}

impl Rays {
    pub fn new(view: View) -> Rays {
        Rays::with(view, |_| Vec::new())
    }

    /// The same with directions, as (x, y), about which the ray integral varies fast besides, and the
    /// scale on which it does.
    pub fn with(view: View, beside: impl Fn(&View) -> Vec<([f64; 2], f64)>) -> Rays {
        let [ax, ay] = view.alpha;
        let mut breaks = breaks(&view);
        breaks.extend(beside(&view).into_iter().map(|([x, y], scale)| {
            let psi = ops::atan2(y / ay, x / ax);
            let (gx, gy) = (ax * ops::cos(psi), ay * ops::sin(psi));
            (psi, (scale * (gx * gx + gy * gy) / (ax * ay)).clamp(1e-9, 1.0))
        }));
        Rays { view, cuts: cuts(breaks) }
    }

    /// E and loss, by a rule along the rays and over their azimuth.
    pub fn albedo(&self, rule: &PanelRule) -> [f64; 2] {
        self.integrate(rule, |ray| ray.integrate(rule))
    }

    /// The integral over the azimuth of what a ray gives.
    pub fn integrate<const N: usize>(&self, rule: &PanelRule, of_ray: impl Fn(&Ray) -> [f64; N]) -> [f64; N] {
        let mut total = [0.0; N];
        for cut in self.cuts.windows(2) {
            rule.each(cut[0], cut[1], |psi, weight| {
                let (sin_psi, cos_psi) = ops::sincos(psi);
                let value = of_ray(&Ray::new(&self.view, [cos_psi, sin_psi]));
                for (sum, value) in total.iter_mut().zip(value) {
                    *sum += weight * value;
                }
            });
        }
        total.map(|x| x / PI)
    }
}

/// Azimuths psi where the ray integral varies fast, with the scale on which it does.
fn breaks(view: &View) -> Vec<(f64, f64)> {
    let [ax, ay] = view.alpha;
    let [cos_phi, sin_phi] = view.azimuth;
    let ratio = (ax / ay).min(ay / ax);
    let mut breaks = Vec::new();
    // g, the length of (ax cos psi, ay sin psi), has branch points at this distance from the short
    // axis.
    let short = if ax < ay { 0.0 } else { 0.5 * PI };
    for turn in [0.0, PI] {
        breaks.push((short + turn, ratio));
        breaks.push((short + 0.5 * PI + turn, 1.0));
    }
    // The radius of the disc turns from large to small where a ray is perpendicular to the view, on
    // the scale mu/sin(theta).
    if view.sine > 0.0 {
        let across = ops::atan2(cos_phi / ay, -sin_phi / ax);
        let (x, y) = (ax * ops::cos(across), ay * ops::sin(across));
        let scale = (view.mu / view.sine) * (x * x + y * y) / (ax * ay);
        for turn in [0.0, PI] {
            breaks.push((across + turn, scale.clamp(1e-9, 1.0)));
        }
    }
    // The light's stretched length dips where the light runs along the short axis at the horizon: h
    // ~ v + l.
    for sign in [-1.0, 1.0] {
        let along = if ax < ay { [sign, 0.0] } else { [0.0, sign] };
        let (x, y) = (view.sine * cos_phi + along[0], view.sine * sin_phi + along[1]);
        if x != 0.0 || y != 0.0 {
            let psi = ops::atan2(y / ay, x / ax);
            let (gx, gy) = (ax * ops::cos(psi), ay * ops::sin(psi));
            breaks.push((psi, (ratio * (gx * gx + gy * gy) / (ax * ay)).clamp(1e-9, 1.0)));
        }
    }
    breaks
}

fn cuts(breaks: Vec<(f64, f64)>) -> Vec<f64> {
    let turn = 2.0 * PI;
    let mut breaks: Vec<(f64, f64)> =
        breaks.into_iter().map(|(psi, scale)| (psi - turn * (psi / turn).floor(), scale)).collect();
    breaks.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Breaks that coincide keep the finer scale.
    breaks.dedup_by(|b, a| {
        let same = b.0 - a.0 < 1e-9;
        if same {
            a.1 = a.1.min(b.1);
        }
        same
    });
    // A break is also as fine as its neighbours are near.
    let near = |at: f64| {
        let distance = |psi: f64| {
            let d = (at - psi).abs();
            d.min(turn - d)
        };
        breaks.iter().fold(f64::INFINITY, |finest, (psi, scale)| finest.min(scale + distance(*psi)))
    };
    let scales: Vec<f64> = breaks.iter().map(|(psi, _)| near(*psi)).collect();
    for (entry, scale) in breaks.iter_mut().zip(scales) {
        entry.1 = scale;
    }
    let first = breaks[0];
    breaks.push((first.0 + turn, first.1));
    let mut cuts = vec![first.0];
    for pair in breaks.windows(2) {
        panels::towards_both(&mut cuts, pair[0].0, pair[1].0, LONGEST, [pair[0].1, pair[1].1]);
    }
    cuts
}
