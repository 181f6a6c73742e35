//! Light directions and weights for the integral over the hemisphere, of a lobe of which nothing is
//! known but that it may be peaked about the mirror direction, or bend where diffuse lobes do.
//!
//! Two rules share the hemisphere by weights that add to 1, each smooth in the other's coordinates.
//! One runs over the light's cosine and azimuth: diffuse lobes change their formula where the
//! cosine is the view's, and at +-pi/2 from its azimuth (Oren and Nayar 1994), where panels end. The
//! other runs over half vectors of polar angle t and azimuth p, so that
//! d l = 4 (v.h) sin t dt dp (Walter et al. 2007, eq. 14), and a lobe about the normal lies at t = 0
//! whatever the view is. With v = (s, 0, c) the light's cosine is
//! sqrt(c^2 + s^2 cos^2 p) cos(2 t - d), tan d = s cos(p)/c: it is above the surface up to
//! t = pi/4 + d/2. Gauss rules on panels that halve towards t = 0 are as good for a narrow lobe as
//! for a wide one; in p panels shrink towards +-pi/2, where d turns within c of them.

use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use std::f64::consts::{FRAC_PI_2, PI};

pub(super) type Vector = [f64; 3];

/// Panels in t: the innermost ends at 2^-11 of the range, below a lobe of width 0.001.
const PANELS: i32 = 12;

/// Ends of panels in p, as fractions of a quarter of the circle.
const FRACTIONS: [f64; 6] = [0.0, 0.5, 0.8, 0.93, 0.98, 1.0];

/// Nodes of a panel in t and in p, and in the light's cosine and azimuth.
pub(super) type Nodes = [usize; 3];

/// Ends of panels in the light's cosine, beside that of the view.
const COSINES: [f64; 4] = [0.0, 0.1, 0.5, 1.0];

/// Ends of panels in the light's azimuth, as fractions of a quarter of the circle: the share of the
/// other rule turns about the mirror direction.
const AZIMUTHS: [f64; 4] = [0.0, 0.15, 0.45, 1.0];

/// Widths of the GGX lobes of half vectors whose sum is the peaked rule's share.
const WIDTHS: [f64; 4] = [0.003, 0.015, 0.06, 0.2];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The unit vector along the sum.
pub(super) fn half(a: Vector, b: Vector) -> Vector {
    let sum = [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let length = dot(sum, sum).sqrt().max(f64::MIN_POSITIVE);
    sum.map(|x| x / length)
}

/// The unit vector of a cosine and an azimuth.
pub(super) fn direction(cosine: f64, azimuth: f64) -> Vector {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    [sine * ops::cos(azimuth), sine * ops::sin(azimuth), cosine]
}

/// Lights of a view in the plane of azimuth 0, with their weights over solid angle.
pub(super) fn lights(view: Vector, [along, around, plain]: Nodes) -> Vec<(Vector, f64)> {
    let mut out = Vec::new();
    for (azimuth, weight) in nodes(&Gauss::new(around), &FRACTIONS) {
        // The four quarters, each from its axis to +-pi/2.
        for (centre, sign) in QUARTERS {
            let p = centre + sign * azimuth * FRAC_PI_2;
            let polar = along_polar(view, p, along);
            out.extend(polar.map(|(l, w)| (l, w * weight * FRAC_PI_2 * peaked(l, view))));
        }
    }
    let mut ends: Vec<f64> = COSINES.into_iter().chain([view[2]]).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|a, b| *a - *b < 1e-9);
    let (cosines, azimuths) = (nodes(&Gauss::new(plain), &ends), nodes(&Gauss::new(plain / 2), &AZIMUTHS));
    for (cosine, weight) in cosines {
        for (azimuth, around) in &azimuths {
            for (centre, sign) in QUARTERS {
                let l = direction(cosine, centre + sign * azimuth * FRAC_PI_2);
                out.push((l, weight * around * FRAC_PI_2 * (1.0 - peaked(l, view))));
            }
        }
    }
    out
}

/// The quarters of a circle, each from its axis to +-pi/2.
const QUARTERS: [(f64, f64); 4] = [(0.0, 1.0), (0.0, -1.0), (PI, 1.0), (PI, -1.0)];

/// The share of the rule over half vectors at a light: that of the lobes beside a cosine.
fn peaked(light: Vector, view: Vector) -> f64 {
    let h = half(light, view);
    let lobe = |width: f64| {
        let square = width * width;
        let base = h[2] * h[2] * (square - 1.0) + 1.0;
        square * h[2] / (base * base)
    };
    let lobes = WIDTHS.iter().map(|w| lobe(*w)).sum::<f64>() / WIDTHS.len() as f64;
    // The square leaves a narrow lobe to the one rule, and turns no faster than a rule can follow.
    let ratio = 4.0 * dot(view, h) * light[2] / lobes;
    1.0 / (1.0 + ratio * ratio)
}

/// Lights over the polar angle of the half vector, at one azimuth of it.
fn along_polar(view: Vector, p: f64, nodes_of: usize) -> impl Iterator<Item = (Vector, f64)> {
    let end = 0.25 * PI + 0.5 * ops::atan2(view[0] * ops::cos(p), view[2]);
    let ends: Vec<f64> = (0..=PANELS)
        .map(|k| if k == 0 { 0.0 } else { f64::from(1 << (k - 1)) / f64::from(1 << (PANELS - 1)) })
        .collect();
    nodes(&Gauss::new(nodes_of), &ends).into_iter().filter_map(move |(x, weight)| {
        let t = x * end;
        let half = direction(ops::cos(t), p);
        let along = dot(view, half);
        let light = [0, 1, 2].map(|i| 2.0 * along * half[i] - view[i]);
        // What rounding puts below the surface has no cosine.
        (light[2] > 0.0).then(|| (light, 4.0 * along * ops::sin(t) * weight * end))
    })
}

/// Nodes and weights of a rule on panels.
fn nodes(rule: &Gauss, ends: &[f64]) -> Vec<(f64, f64)> {
    let on = |ends: &[f64]| {
        let (half, middle) = (0.5 * (ends[1] - ends[0]), 0.5 * (ends[0] + ends[1]));
        let each = rule.nodes.iter().zip(&rule.weights);
        each.map(|(x, w)| (middle + half * x, half * w)).collect::<Vec<_>>()
    };
    ends.windows(2).flat_map(on).collect()
}
