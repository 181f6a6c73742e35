//! The rings of facets at one angle theta_d to the view: W = 2 int G2 D dpsi over the part of the
//! ring that mirrors light upwards, eight rings at a time. They depend on the lobe and the view
//! alone, so that one set serves every index of refraction and both sides.
//!
//! Heights as in `ring`: with S = sin^2(psi/2), 1 - h_z = 2 sin^2(w/2) + 2 s sin(theta_d) S and
//! l_z = cos(2 theta_d - theta) - 2 s sin(2 theta_d) S.

use super::lobe::{Angles, Azimuth, Lobe};
use super::rules::{Grade, Rules};
use super::tabled::Tabled;
use lobefit_math::lanes::{F8, LANES};

/// Eight rings.
struct Rings {
    /// 1 - h_z and l_z at psi = 0, and their coefficients of tan^2(psi/4) in S.
    low: [F8; 2],
    swing: [F8; 2],
    azimuth: Azimuth,
    weight: F8,
}

/// cos(theta_d) sin(theta_d) W/mu du-density at every u into `values`; returns the number of
/// evaluations. `u` is a whole number of blocks.
#[inline(always)]
pub(super) fn rings<D: Tabled>(
    lobe: &Lobe<D>,
    rules: &Rules,
    nodes: usize,
    u: &[f64],
    values: &mut Vec<f64>,
) -> u64 {
    values.clear();
    // Shadowing has a layer at the light's horizon: of width mu (correlated) or alpha (separable).
    let rule = rules.rule(nodes, Grade::High);
    let mut evaluations = 0;
    for block in u.as_chunks::<LANES>().0 {
        let rings = prepare(lobe, block);
        let mut sum = [0.0; LANES];
        for (t, w) in rule.nodes.iter().zip(&rule.weights) {
            add(lobe, &rings, *t, *w, &mut sum);
        }
        for i in 0..LANES {
            sum[i] *= rings.weight[i];
        }
        values.extend_from_slice(&sum);
        evaluations += (LANES * rule.nodes.len()) as u64;
    }
    evaluations
}

/// Adds the azimuth node t, heights multiplied by L^2 = (1 + q^2)^2, q = tan(psi/4): S = 4 q^2/L^2.
#[inline(always)]
fn add<D: Tabled>(lobe: &Lobe<D>, rings: &Rings, t: f64, w: f64, sum: &mut F8) {
    let Rings { low, swing, azimuth, .. } = rings;
    for i in 0..LANES {
        let [q, slope] = Azimuth::at(azimuth.top[i] * t);
        let q = azimuth.scale[i] * q;
        let q2 = q * q;
        let length = 1.0 + q2;
        let l2 = length * length;
        let l4 = l2 * l2;
        let depth = low[0][i] * l2 + swing[0][i] * q2;
        let [d, more] = D::of_ring(lobe, depth, l2, l4);
        let light = low[1][i] * l2 - swing[1][i] * q2;
        let light = if light > 0.0 { light } else { 0.0 };
        let stretched = D::area_over(lobe, light, l2, l4);
        let shadowing = lobe.own * light + lobe.other * stretched;
        sum[i] += w * slope * light * l4 * l4 / (d * d * shadowing * length) * more;
    }
}

#[inline(always)]
fn prepare<D: Tabled>(lobe: &Lobe<D>, u: &F8) -> Rings {
    let angles = Angles::new(lobe.alpha, u);
    let zero = [0.0; LANES];
    let (mut low, mut swing) = ([zero; 2], [zero; 2]);
    let (mut end, mut peak, mut factor) = (zero, zero, zero);
    let (mu, s) = (lobe.mu, lobe.sine);
    for i in 0..LANES {
        let (cos_w, sin_w) = (angles.cosine[i], angles.sine[i]);
        let cosine = positive(mu * cos_w - s * sin_w);
        let sine = positive(s * cos_w + mu * sin_w);
        let (cos2, sin2) = ((cosine - sine) * (cosine + sine), 2.0 * cosine * sine);
        let half = angles.square[i] / (1.0 + angles.square[i]);
        let reach = s * sine;
        let highest = positive(mu * cos2 + s * sin2);
        low[0][i] = 2.0 * half;
        swing[0][i] = 8.0 * reach;
        low[1][i] = highest;
        swing[1][i] = 8.0 * s * sin2;
        let fall = highest / positive(2.0 * s * sin2);
        end[i] = if fall < 1.0 { fall } else { 1.0 };
        if D::SPAN.is_finite() {
            let cut = (lobe.facets.deepest(low[0][i]) - low[0][i]) / positive(2.0 * reach);
            end[i] = if cut < end[i] { cut } else { end[i] };
        }
        let p = lobe.facets.width(2.0 * half) / positive(2.0 * reach);
        peak[i] = if p < 1e16 { p } else { 1e16 };
        factor[i] = cosine * sine;
    }
    let azimuth = Azimuth::new(&end, &peak);
    let mut weight = zero;
    for i in 0..LANES {
        // 2 a^2/pi for both halves, dpsi = 4 dq/(1 + q^2).
        let constant = 8.0 * lobe.a2 / std::f64::consts::PI * lobe.factor;
        weight[i] = constant * factor[i] * angles.slope[i] * azimuth.scale[i] * azimuth.top[i];
    }
    Rings { low, swing, azimuth, weight }
}

/// Keeps a quantity that is positive but for rounding, and divisors, above 0.
#[inline(always)]
fn positive(x: f64) -> f64 {
    if x > 1e-150 { x } else { 1e-150 }
}
