//! Where the transmission sweep begins, turns and ends, as values of u, and its pieces.
//!
//! Each place is given by the half vector H = -+(eta v + l) of its light l: tan(w/2) = sin
//! w/(1 + cos w) with (sin w, cos w) ~ H, so no angle is ever computed. With the thinner medium's
//! kappa = min(eta, 1/eta), the azimuth is whole while the polar angle of the light stays below
//! acos(kappa) - theta, and truncated beyond.

use super::effort::Effort;
use super::lobe::Lobe;
use super::rules::{self, Grade, Rule, Rules};
use super::tabled::Tabled;
use super::transmit::Sweep;

/// An interface seen from one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// n_view/n_far, and 1 - eta^2 without cancellation.
    pub eta: f64,
    pub contrast: f64,
}

impl Seen {
    pub fn outside(ior: f64) -> Seen {
        Seen { eta: 1.0 / ior, contrast: (ior - 1.0) * (ior + 1.0) / (ior * ior) }
    }

    pub fn inside(ior: f64) -> Seen {
        Seen { eta: ior, contrast: -(ior - 1.0) * (ior + 1.0) }
    }

    /// u of the critical angle, from inside: w = theta_c - theta.
    pub fn critical<D: Tabled>(&self, lobe: &Lobe<D>) -> f64 {
        let root = (-self.contrast).sqrt();
        lobe.u(half_tangent(lobe.mu - root * lobe.sine, root * lobe.mu + lobe.sine))
    }

    /// u of the critical angle on the other side of the view: w = -theta_c - theta.
    fn mirrored_critical<D: Tabled>(&self, lobe: &Lobe<D>) -> f64 {
        let root = (-self.contrast).sqrt();
        lobe.u(half_tangent(-lobe.mu - root * lobe.sine, root * lobe.mu - lobe.sine))
    }
}

/// A stretch of the sweep between two places where the integrand is not smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub from: f64,
    pub to: f64,
    pub grade: Grade,
    /// A branch point before `from`.
    pub before: Option<f64>,
    /// A branch point at or beyond `to`.
    pub beyond: Option<f64>,
}

/// tan(w/2) of the direction (sin w, cos w) ~ (sine, cosine), |w| < pi.
fn half_tangent(sine: f64, cosine: f64) -> f64 {
    let length = (sine * sine + cosine * cosine).sqrt();
    if cosine > 0.0 { sine / (length + cosine) } else { (length - cosine) / sine }
}

/// The one or two stretches of the sweep.
pub(super) fn stretches<D: Tabled>(lobe: &Lobe<D>, seen: Seen) -> [Option<Stretch>; 2] {
    let all = if seen.contrast > 0.0 { outside(lobe, seen) } else { inside(lobe, seen) };
    let span = lobe.span();
    let within = |s: Stretch| Stretch { from: s.from.clamp(-span, span), to: s.to.clamp(-span, span), ..s };
    all.map(|stretch| stretch.map(within))
}

/// From the thinner side: from w = -pi/2 (the facet's own horizon) to light straight down, or to
/// grazing incidence (theta beyond acos(kappa)).
fn outside<D: Tabled>(lobe: &Lobe<D>, seen: Seen) -> [Option<Stretch>; 2] {
    let (mu, s, eta) = (lobe.mu, lobe.sine, seen.eta);
    // The light ends at mu_t = eta mu there. The correlated G2 has its pole at mu_t = -mu; the
    // separable one its branch points at mu_t^2 = -alpha^2/(1 - alpha^2), which the same map
    // resolves.
    let pole = lobe.u(half_tangent(-(1.0 - eta) * s, -(1.0 + eta) * mu));
    let first =
        Stretch { from: lobe.u(-1.0), to: 0.0, grade: Grade::Plain, before: Some(pole), beyond: None };
    let graze = lobe.u(half_tangent(mu, s));
    if mu <= eta {
        return [Some(Stretch { to: graze, grade: Grade::Steep, ..first }), None];
    }
    let root = seen.contrast.sqrt();
    let turn = lobe.u(half_tangent(2.0 * eta * s - root * mu, root * s));
    let end = lobe.u(half_tangent(eta * s, 1.0 - eta * mu));
    [
        Some(Stretch { to: turn, grade: Grade::High, ..first }),
        Some(Stretch { from: turn, to: end, grade: Grade::Low, before: None, beyond: Some(graze) }),
    ]
}

/// From the denser side: from light straight down, or the facet's horizon, to grazing light or to
/// total reflection.
fn inside<D: Tabled>(lobe: &Lobe<D>, seen: Seen) -> [Option<Stretch>; 2] {
    let (mu, s, eta) = (lobe.mu, lobe.sine, seen.eta);
    let critical = seen.critical(lobe);
    let before = Some(seen.mirrored_critical(lobe));
    let grazing = eta * s >= 1.0;
    let to = if grazing { lobe.u(half_tangent(1.0 - eta * s, eta * mu)) } else { critical };
    let beyond = grazing.then_some(critical);
    if eta * mu <= 1.0 {
        let grade = if grazing { Grade::High } else { Grade::Steep };
        return [Some(Stretch { from: lobe.u(-1.0), to, grade, before, beyond }), None];
    }
    let root = (-seen.contrast).sqrt();
    let low = lobe.u(half_tangent(-eta * s, eta * mu - 1.0));
    let turn = lobe.u(half_tangent(root * mu - (1.0 + eta * eta) * s, root * (root * mu - s)));
    let grade = if grazing { Grade::Both } else { Grade::BothSteep };
    [
        Some(Stretch { from: low, to: turn, grade: Grade::High, before, beyond: Some(critical) }),
        Some(Stretch { from: turn, to, grade, before: None, beyond }),
    ]
}

/// Below this 1 - eta^2 the cosine of refraction, sqrt(1 - eta^2 + eta^2 c_i^2), has a layer at
/// grazing incidence that takes more nodes.
const THIN: f64 = 0.02;
const LAYER: usize = 6;

/// A branch point nearer than this part of a piece's length comes with others on its second sheet:
/// the same.
const CLOSE: f64 = 0.1;

/// A branch point farther from a piece than this part of its length does not matter.
const NEAR: f64 = 0.5;

/// Appends the nodes of a stretch to a sweep.
pub(super) fn append(sweep: &mut Sweep, stretch: &Stretch, seen: Seen, effort: &Effort, rules: &Rules) {
    let Stretch { from, to, grade, before, beyond } = *stretch;
    if to <= from {
        return;
    }
    let panels = ((to - from) / effort.longest).ceil().max(1.0);
    let length = (to - from) / panels;
    let count = panels as usize;
    let near = |branch: Option<f64>, end: f64| branch.filter(|b| (b - end).abs() < NEAR * length);
    for k in 0..count {
        let low = from + length * k as f64;
        let mut piece = grade;
        if k > 0 {
            piece = piece.high_only();
        }
        if k + 1 < count {
            piece = piece.low_only();
        }
        let (before, beyond) =
            (near(before, from).filter(|_| k == 0), near(beyond, to).filter(|_| k + 1 == count));
        let close = |branch: Option<f64>, end: f64| branch.is_some_and(|b| (b - end).abs() < CLOSE * length);
        let layer = (0.0..THIN).contains(&seen.contrast) || close(before, from) || close(beyond, to);
        let rule = rules.rule(effort.panel + if layer { LAYER } else { 0 }, piece);
        if let Some(branch) = before {
            mapped(sweep, branch, [low, low + length], rule);
        } else if let Some(branch) = beyond {
            mapped(sweep, branch, [low, to], rule);
        } else {
            for (t, w) in rule.nodes.iter().zip(&rule.weights) {
                sweep.u.push(low + length * t);
                sweep.weight.push(length * w);
            }
        }
    }
    sweep.eta.resize(sweep.u.len(), seen.eta);
    sweep.contrast.resize(sweep.u.len(), seen.contrast);
    sweep.over.resize(sweep.u.len(), 1.0 / seen.contrast.abs());
}

/// A piece with a branch point outside it: about the fourth root of the distance to it is the
/// variable.
fn mapped(sweep: &mut Sweep, branch: f64, [from, to]: [f64; 2], rule: &Rule) {
    let (near, far, sign) = if branch > from { (to, from, -1.0) } else { (from, to, 1.0) };
    let length = (far - branch).abs();
    let start = rules::fourth_root((near - branch).abs() / length);
    for (t, w) in rule.nodes.iter().zip(&rule.weights) {
        let part = if sign > 0.0 { *t } else { 1.0 - t };
        let [distance, slope] = rules::steep(start + (1.0 - start) * part);
        sweep.u.push((branch + sign * length * distance).clamp(from, to));
        sweep.weight.push(w * (1.0 - start) * length * slope);
    }
}
