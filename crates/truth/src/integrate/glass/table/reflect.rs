//! Reflection from the rings: R = int F W = int W - int (1 - F) W, the second over theta_d below
//! the critical angle.
//!
//! The rings are sampled on panels of u that end where they turn from whole to truncated
//! (theta_d = pi/4 - theta/2) and where they vanish (pi/4 + theta/2), graded towards both. From
//! inside 1 - F is a square root at the critical angle: panels at it are integrated on nodes of
//! their own, with W interpolated from its Legendre series on the panel.

use std::f64::consts::FRAC_PI_4;

use super::effort::Effort;
use super::lobe::{Angles, Lobe};
use super::rules::{Grade, MOST, Rules};
use super::stretch::Seen;
use super::tabled::Tabled;
use crate::integrate::Path;
use lobefit_math::lanes::{self, F8, LANES};
use lobefit_math::ops;

/// A critical angle beyond a panel's end by less than this part of its length is near. The square
/// root then has its Bernstein ellipse at 1.4 + sqrt(1.4^2 - 1) = 2.4 or closer.
const NEAR: f64 = 0.2;

/// A panel of rings.
#[derive(Clone, Debug)]
struct Panel {
    from: f64,
    to: f64,
    grade: Grade,
    /// First block of its nodes.
    block: usize,
    /// Legendre series of W over the panel's ungraded variable.
    series: Vec<f64>,
}

/// The rings of one lobe from one direction.
#[derive(Clone, Debug)]
pub(super) struct Reflection {
    panels: Vec<Panel>,
    /// cos(theta_d) of every node and its share of R(F = 1), in blocks.
    cosine: Vec<F8>,
    share: Vec<F8>,
    /// Reflection with F = 1.
    pub whole: f64,
    pub evaluations: u64,
}

impl Reflection {
    pub fn new<D: Tabled>(
        lobe: &Lobe<D>,
        effort: &Effort,
        rules: &Rules,
        matrix: &[Vec<f64>],
        path: Path,
    ) -> Reflection {
        let n = effort.ring_panel;
        let (mut nodes, mut panels) = (Vec::new(), Vec::new());
        for (from, to, grade) in cut(lobe, effort.longest) {
            panels.push(Panel { from, to, grade, block: nodes.len() / LANES, series: Vec::new() });
            nodes.extend(rules.rule(n, grade).nodes.iter().map(|t| from + (to - from) * t));
        }
        let mut density = Vec::new();
        let evaluations = path.rings(lobe, rules, effort.ring, &nodes, &mut density);
        let mut share = Vec::new();
        for (panel, values) in panels.iter_mut().zip(density.chunks(n)) {
            panel.series = vec![0.0; n];
            for (row, value) in matrix.iter().zip(values) {
                for (sum, weight) in panel.series.iter_mut().zip(row) {
                    *sum += weight * value;
                }
            }
            let rule = rules.rule(n, panel.grade);
            share.extend(values.iter().zip(&rule.weights).map(|(v, w)| v * w * (panel.to - panel.from)));
        }
        let cosine = nodes.as_chunks().0.iter().map(|u| cosines(lobe, u)).collect();
        let share = share.as_chunks().0.to_vec();
        let whole = share.iter().map(lanes::sum).sum();
        Reflection { panels, cosine, share, whole, evaluations }
    }

    /// int (1 - F) W of an interface from its thinner side.
    pub fn passed_outside(&self, seen: Seen, path: Path) -> f64 {
        path.passed(seen, &self.cosine, &self.share)
    }

    /// The same from the denser side; panels at the critical angle on nodes of their own.
    pub fn passed_inside<D: Tabled>(
        &self,
        lobe: &Lobe<D>,
        seen: Seen,
        (effort, rules): (&Effort, &Rules),
        path: Path,
    ) -> f64 {
        let critical = seen.critical(lobe);
        let far = |p: &Panel| critical - p.to > NEAR * (p.to - p.from);
        let count = self.panels.iter().take_while(|p| far(p)).count();
        let blocks = self.panels.get(count).map_or(self.cosine.len(), |p| p.block);
        let mut passed = path.passed(seen, &self.cosine[..blocks], &self.share[..blocks]);
        let rule = rules.rule(effort.near, Grade::Both);
        for panel in &self.panels[count..] {
            let length = panel.to.min(critical) - panel.from;
            if length <= 0.0 {
                break;
            }
            let n = rule.nodes.len();
            let (mut u, mut z, mut weight) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
            for (i, (t, w)) in rule.nodes.iter().zip(&rule.weights).enumerate() {
                u[i] = panel.from + length * t;
                z[i] = panel.grade.inverse(length * t / (panel.to - panel.from));
                weight[i] = length * w;
            }
            passed += path.near(lobe, seen, &panel.series, [&u[..n], &z[..n], &weight[..n]]);
        }
        passed
    }
}

/// Panels of u: from, to, grade.
fn cut<D: Tabled>(lobe: &Lobe<D>, longest: f64) -> Vec<(f64, f64, Grade)> {
    let theta = ops::atan2(lobe.sine, lobe.mu);
    let span = lobe.span();
    let u = |w: f64| lobe.u(ops::tan(0.5 * w)).clamp(-span, span);
    let (start, turn, end) = (u(-theta), u(FRAC_PI_4 - 1.5 * theta), u(FRAC_PI_4 - 0.5 * theta));
    let mut panels = Vec::new();
    let count = ((turn - start) / longest).ceil() as usize;
    split(&mut panels, start, turn, count, Grade::Plain);
    if end > turn {
        split(&mut panels, turn, end, (((end - turn) / longest).ceil() as usize).max(2), Grade::Low);
    }
    panels
}

/// Equal panels, the last graded towards its end.
fn split(panels: &mut Vec<(f64, f64, Grade)>, from: f64, to: f64, count: usize, first: Grade) {
    let at = |k: usize| if k == count { to } else { from + (to - from) * k as f64 / count as f64 };
    for k in 0..count {
        let grade = match k {
            _ if k + 1 == count => Grade::High,
            0 => first,
            _ => Grade::Plain,
        };
        panels.push((at(k), at(k + 1), grade));
    }
}

#[inline(always)]
fn cosines<D: Tabled>(lobe: &Lobe<D>, u: &F8) -> F8 {
    let angles = Angles::new(lobe.alpha, u);
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        out[i] = lobe.mu * angles.cosine[i] - lobe.sine * angles.sine[i];
    }
    out
}

/// 1 - F at cosines `c`: 2 eta c c_t (1/(eta c + c_t)^2 + 1/(c + eta c_t)^2), free of cancellation;
/// 0 at total reflection.
#[inline(always)]
fn transmittance(seen: Seen, c: &F8) -> F8 {
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        let square = seen.contrast + seen.eta * seen.eta * c[i] * c[i];
        let square = if square > 0.0 { square } else { 0.0 };
        let c_t = square.sqrt();
        let (a, b) = (seen.eta * c[i] + c_t, c[i] + seen.eta * c_t);
        let (a2, b2) = (a * a, b * b);
        out[i] = 2.0 * seen.eta * c[i] * c_t * (a2 + b2) / (a2 * b2);
    }
    out
}

/// Sum of (1 - F) over nodes given by cosine and weight.
#[inline(always)]
pub(super) fn passed(seen: Seen, cosine: &[F8], share: &[F8]) -> f64 {
    let mut sum = [0.0; LANES];
    for (c, w) in cosine.iter().zip(share) {
        let passed = transmittance(seen, c);
        for i in 0..LANES {
            sum[i] += passed[i] * w[i];
        }
    }
    lanes::sum(&sum)
}

/// Weighted sum of (1 - F) W at nodes of a panel (a multiple of eight, at most [`MOST`]), given by
/// u, by the series' variable z in [-1, 1], and by weight.
#[inline(always)]
pub(super) fn near<D: Tabled>(
    lobe: &Lobe<D>,
    seen: Seen,
    series: &[f64],
    [u, z, weight]: [&[f64]; 3],
) -> f64 {
    let mut rings = [0.0; MOST];
    let (wide, rest) = z.as_chunks::<WIDE>();
    for (z, out) in wide.iter().zip(rings.as_chunks_mut::<WIDE>().0) {
        *out = sum_series(series, z);
    }
    let done = WIDE * wide.len();
    for (z, out) in rest.as_chunks::<LANES>().0.iter().zip(rings[done..].as_chunks_mut::<LANES>().0) {
        *out = sum_series(series, z);
    }
    let blocks = u.as_chunks::<LANES>().0.iter().zip(weight.as_chunks::<LANES>().0);
    let mut total = 0.0;
    for ((u, weight), rings) in blocks.zip(rings.as_chunks::<LANES>().0) {
        let passed = transmittance(seen, &cosines(lobe, u));
        let mut term = [0.0; LANES];
        for i in 0..LANES {
            term[i] = rings[i] * passed[i] * weight[i];
        }
        total += lanes::sum(&term);
    }
    total
}

/// Several blocks at a time hide the latency of the recurrence.
const WIDE: usize = 3 * LANES;

/// A Legendre series at N places.
#[inline(always)]
fn sum_series<const N: usize>(series: &[f64], z: &[f64; N]) -> [f64; N] {
    let (mut previous, mut current, mut sum) = ([0.0; N], [1.0; N], [0.0; N]);
    let mut k = 0.0;
    for coefficient in series {
        let (rise, fall) = ((2.0 * k + 1.0) / (k + 1.0), k / (k + 1.0));
        for i in 0..N {
            sum[i] += coefficient * current[i];
            let next = rise * z[i] * current[i] - fall * previous[i];
            previous[i] = current[i];
            current[i] = next;
        }
        k += 1.0;
    }
    sum
}
