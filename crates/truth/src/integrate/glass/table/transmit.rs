//! The transmission kernel: the sweep over transmitted directions, eight nodes at a time.
//!
//! In light space (n1 = eta on the side of the view, 1 on the far side; x = -v.l; phi the azimuth
//! from forward refraction) the half vector H = -+(eta v + l) gives Fresnel rationally, 1 - F = 2
//! eta P (1 + 1/x^2)/(1 - eta^2)^2 with P = |eta - x| |1 - eta x| =
//! |H|^2 (v.h) |l.h|, and with it
//!   T = int dmu_t (G2/mu) (a^2/pi) (2 eta/(1 - eta^2)^2) 2 int_0^end P^2 (1 + 1/x^2)/den^2 dphi,
//!   den = H_x^2 + H_y^2 + a^2 H_z^2.
//! mu_t is a function of the angle w of the facet in the plane of incidence, dtheta_t = -+ (h/c_t)
//! dw with h = |H| at phi = 0 = |1 - eta^2|/(c_t + eta c_i), c_i and c_t the facet's cosines.
//! Divided by h, with S = sin^2(phi/2) and c = 2 s s_t/h,
//!   v.h -> c_i -+ c S,  l.h -> c_t +- eta c S,
//!   den -> sin^2 w + a^2 cos^2 w + 2 (eta/h) c S,  x = cos(deviation) - 2 s s_t S,
//! (upper signs from the thinner side), none of which cancels as eta -> 1. The azimuth ends where
//! the first factor that falls does.

use super::lobe::{Angles, Azimuth, Lobe};
use super::rules::{Grade, Rules};
use super::tabled::Tabled;
use lobefit_math::lanes::{F8, LANES};

/// Nodes of the sweep of one lobe, for any number of interfaces: node, weight, and the interface's
/// eta, 1 - eta^2 and 1/|1 - eta^2|.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    pub u: Vec<f64>,
    pub weight: Vec<f64>,
    pub eta: Vec<f64>,
    pub contrast: Vec<f64>,
    pub over: Vec<f64>,
}

impl Sweep {
    pub fn with_capacity(n: usize) -> Sweep {
        let list = || Vec::with_capacity(n);
        Sweep { u: list(), weight: list(), eta: list(), contrast: list(), over: list() }
    }

    /// Fills the last block of lanes with copies of the last node of weight 0.
    pub fn pad(&mut self) {
        while !self.u.len().is_multiple_of(LANES) {
            for list in [&mut self.u, &mut self.eta, &mut self.contrast, &mut self.over] {
                let last = list[list.len() - 1];
                list.push(last);
            }
            self.weight.push(0.0);
        }
    }
}

/// What of eight nodes does not depend on the azimuth.
struct Nodes {
    /// v.h, l.h, den and x at phi = 0, and their coefficients of 4 tan^2(phi/4) in S.
    low: [F8; 4],
    swing: [F8; 4],
    /// The third number of [`Tabled::of_facet`].
    scale: F8,
    azimuth: Azimuth,
    /// Weight of the azimuth's integral.
    weight: F8,
}

/// Weighted integrands of every node of the sweep into `values`; returns the number of evaluations.
/// `inner` = nodes of the azimuth at v = 0 and their increase with v.
#[inline(always)]
pub(super) fn transmit<D: Tabled>(
    lobe: &Lobe<D>,
    rules: &Rules,
    inner: [f64; 2],
    sweep: &Sweep,
    values: &mut Vec<f64>,
) -> u64 {
    values.clear();
    let mut evaluations = 0;
    for at in (0..sweep.u.len()).step_by(LANES) {
        let block = |list: &[f64]| -> F8 {
            let mut block = [0.0; LANES];
            block.copy_from_slice(&list[at..at + LANES]);
            block
        };
        let [u, weight, eta, contrast, over] =
            [&sweep.u, &sweep.weight, &sweep.eta, &sweep.contrast, &sweep.over].map(|list| block(list));
        let nodes = prepare(lobe, [&u, &weight, &eta, &contrast, &over]);
        let n = (inner[0] + D::AZIMUTH + inner[1] * nodes.azimuth.reach) as usize;
        let rule = rules.rule(n, Grade::Plain);
        let mut sum = [0.0; LANES];
        for (t, w) in rule.nodes.iter().zip(&rule.weights) {
            add::<D>(&nodes, *t, *w, &mut sum);
        }
        for i in 0..LANES {
            sum[i] *= nodes.weight[i];
        }
        values.extend_from_slice(&sum);
        evaluations += (LANES * rule.nodes.len()) as u64;
    }
    evaluations
}

/// Adds the azimuth node t: with q = tan(phi/4), S = 4 q^2/(1 + q^2)^2, and every factor of the
/// integrand multiplied by (1 + q^2)^2.
#[inline(always)]
fn add<D: Tabled>(nodes: &Nodes, t: f64, w: f64, sum: &mut F8) {
    let Nodes { low, swing, azimuth, .. } = nodes;
    for i in 0..LANES {
        let [q, slope] = Azimuth::at(azimuth.top[i] * t);
        let q = azimuth.scale[i] * q;
        let q2 = q * q;
        let length = 1.0 + q2;
        let l2 = length * length;
        let view = low[0][i] * l2 + swing[0][i] * q2;
        let light = low[1][i] * l2 + swing[1][i] * q2;
        let [den, more] = D::of_light([low[2][i], swing[2][i], nodes.scale[i]], q2, l2);
        let x = low[3][i] * l2 + swing[3][i] * q2;
        let above = view * light;
        let below = den * x * l2;
        sum[i] += w * slope * (above * above) * (x * x + l2 * l2) / (below * below * length) * more;
    }
}

#[inline(always)]
fn prepare<D: Tabled>(lobe: &Lobe<D>, [u, weight, eta, contrast, over]: [&F8; 5]) -> Nodes {
    let angles = Angles::new(lobe.alpha, u);
    let zero = [0.0; LANES];
    let (mut low, mut swing) = ([zero; 4], [zero; 4]);
    let (mut end, mut peak, mut factor, mut scale) = (zero, zero, zero, zero);
    let (mu, s, a2) = (lobe.mu, lobe.sine, lobe.a2);
    for i in 0..LANES {
        let (cos_w, sin_w) = (angles.cosine[i], angles.sine[i]);
        let c_i = positive(mu * cos_w - s * sin_w);
        let s_i = s * cos_w + mu * sin_w;
        let c_t = positive(contrast[i] + eta[i] * eta[i] * c_i * c_i).sqrt();
        let sum = c_t + eta[i] * c_i;
        let inverse = 1.0 / sum;
        let h = contrast[i].abs() * inverse;
        let over_h = sum * over[i];
        let sin_d = s_i * contrast[i] * inverse;
        let cos_d = c_i * c_t + eta[i] * s_i * s_i;
        let s_t = positive(s * cos_d - mu * sin_d);
        let mu_t = positive(mu * cos_d + s * sin_d);
        let c = 2.0 * s * s_t * over_h;
        let thinner = if contrast[i] > 0.0 { 1.0 } else { -1.0 };
        let rise = 2.0 * eta[i] * c * over_h;
        let (facet, p) = D::of_facet(lobe, sin_w, cos_w, rise);
        low[0][i] = c_i;
        low[1][i] = c_t;
        low[2][i] = facet[0];
        low[3][i] = cos_d;
        swing[0][i] = -4.0 * thinner * c;
        swing[1][i] = 4.0 * thinner * eta[i] * c;
        swing[2][i] = facet[1];
        scale[i] = facet[2];
        swing[3][i] = -8.0 * s * s_t;
        let (first, steep) = if contrast[i] > 0.0 { (c_i, c) } else { (c_t, eta[i] * c) };
        let fall = first / positive(steep);
        end[i] = if fall < 1.0 { fall } else { 1.0 };
        if D::SPAN.is_finite() {
            let cut = D::SPAN * D::SPAN * p;
            end[i] = if cut < end[i] { cut } else { end[i] };
        }
        peak[i] = if p < 1e16 { p } else { 1e16 };
        let s_l = D::area_far(lobe, mu_t);
        let shadowing = lobe.own * mu_t + lobe.other * s_l;
        factor[i] = lobe.factor * mu_t * eta[i] * s_t * h * over[i] * over[i] / (shadowing * c_t);
    }
    let azimuth = Azimuth::new(&end, &peak);
    let mut total = [0.0; LANES];
    for i in 0..LANES {
        // 2 . 2 a^2/pi, and dphi = 4 dq/(1 + q^2).
        let constant = 16.0 * a2 / std::f64::consts::PI;
        total[i] = constant * weight[i] * angles.slope[i] * factor[i] * azimuth.scale[i] * azimuth.top[i];
    }
    Nodes { low, swing, scale, azimuth, weight: total }
}

/// Keeps a quantity that is positive but for rounding, and divisors, above 0.
#[inline(always)]
fn positive(x: f64) -> f64 {
    if x > 1e-150 { x } else { 1e-150 }
}
