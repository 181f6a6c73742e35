//! Planes blended by a p-norm whose power is tied to the lobe's footprint.

use super::super::{Meeting, Proxy};
use super::Body;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot, normalise, plus, scaled};

/// The power of a p-norm, clamp(`over`/(alpha^`power` s), [`Tie::LEAST`], [`Tie::MOST`]), s the
/// spread of the planes ahead.
///
/// Planes i and j blend where |ln(t_i/t_j)| is up to some 1/p. Turning the ray by an angle e
/// changes ln t_i by n_i.e/(n_i.R): a lobe that is alpha wide reaches over alpha |v_i - v_j| of it,
/// v_i = n_i/max(n_i.R, [`Tie::GRAZING`]), which is much where a plane is met at a grazing angle,
/// little at an obtuse edge. A power by alpha alone leaves a seam at the first and bends the middle
/// of walls at the second. s is twice the standard deviation of the v_i with weights (t/t_i)^4, t
/// the nearest plane's distance: |v_i - v_j| at an edge, less the farther from one, where the power
/// does not matter, and as smooth as the distances.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Tie {
    /// Numerator.
    pub over: f64,
    /// Power of alpha: 1, 1.25, 1.5 or 2.
    pub power: f64,
}

impl Tie {
    /// The least power keeps the normal continuous where a plane comes ahead.
    pub const LEAST: f64 = 2.0;

    /// Least cosine in the spread: without one a wall that a ray runs along, and hardly meets,
    /// would blend all others. Of the values 0.001, 0.1, 0.2, 0.3 and 0.5 this is the largest that
    /// leaves no more creases in the study's rooms than the first does, nearly; it was compared
    /// there.
    pub const GRAZING: f64 = 0.1;

    /// Above this nothing changes that is seen.
    pub const MOST: f64 = 256.0;

    /// The power of a p-norm; finite, also at alpha = 0 and s = 0.
    pub fn at(self, alpha: f64, spread: f64) -> f64 {
        let reach = ops::pow(alpha, self.power) * spread;
        (self.over / reach.max(self.over / Tie::MOST)).max(Tie::LEAST)
    }

    /// In a formula of alpha and s.
    pub fn formula(self) -> String {
        let Tie { over, power } = self;
        let power = if power == 1.0 { String::new() } else { format!("^{power}") };
        format!("clamp({over} / (alpha{power} s), {}, {})", Tie::LEAST, Tie::MOST)
    }
}

/// The planes [`blended`] with a power that is tied to how far the lobe reaches over edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Tied {
    /// The planes.
    pub body: Body,
    /// The power.
    pub tie: Tie,
}

impl Tied {
    /// That of the lookups that were emitted before, chosen in the practice room: the power of alpha between that of the
    /// smallest error of one fetch (1.5) and that of the lobe's own width (1), the numerator the
    /// largest, which bends least, that leaves creases of its pictures on edges about 1.3 times
    /// those elsewhere at most.
    pub const FITTED: Tie = Tie { over: 1.2, power: 1.25 };

    /// s of the planes ahead, `steepest` the largest of 1 over their distances along the ray.
    fn spread(&self, from: Vec3, towards: Vec3, steepest: f64) -> f64 {
        let (mut whole, mut first, mut second) = (0.0, [0.0; 3], 0.0);
        for plane in self.body.ahead(from, towards) {
            let share = plane.approach / (plane.depth * steepest);
            let square = share * share;
            let (weight, over) = (square * square, 1.0 / plane.approach.max(Tie::GRAZING));
            whole += weight;
            first = plus(first, scaled(plane.normal, weight * over));
            second += weight * over * over;
        }
        let variance = second / whole - dot(first, first) / (whole * whole);
        2.0 * variance.max(0.0).sqrt()
    }
}

impl Proxy for Tied {
    fn meet(&self, from: Vec3, towards: Vec3, alpha: f64) -> Option<Meeting> {
        let ahead = self.body.ahead(from, towards);
        let steepest = ahead.map(|plane| plane.approach / plane.depth).reduce(f64::max)?;
        let power = self.tie.at(alpha, self.spread(from, towards, steepest));
        blended(&self.body, from, towards, power)
    }
}

/// Where a ray meets the planes blended by a power p.
///
/// The ray meets them at t = (sum t_i^-p)^(-1/p), t_i the distances along the ray of the planes
/// ahead: a smooth body about the shading point inside the planes, which it nears as p grows. With
/// x = t R the body is g(x) = (sum (n_i.x/h_i)^p)^(1/p) = 1, h_i the planes' distances from the
/// shading point, and its normal the gradient, along sum (t/t_i)^(p-1) n_i/h_i. Where a plane comes
/// ahead its term starts as the p-th power of the cosine, in the normal as the (p-1)-th: of a whole
/// p the distance has p - 1 continuous derivatives, the normal p - 2.
///
/// All terms are scaled by the nearest plane's, so that no power overflows: a term is at most 1, p
/// may be any finite number above 1.
pub fn blended(body: &Body, from: Vec3, towards: Vec3, power: f64) -> Option<Meeting> {
    let ahead = || body.ahead(from, towards);
    // inverse distances: no distance is divided by a cosine that may be 0
    let steepest = ahead().map(|plane| plane.approach / plane.depth).reduce(f64::max)?;
    let (mut sum, mut normal) = (0.0, [0.0; 3]);
    for plane in ahead() {
        let share = plane.approach / plane.depth / steepest;
        let weight = ops::pow(share, power - 1.0);
        sum += weight * share;
        // n_i/h_i, in units of the steepest
        normal = plus(normal, scaled(plane.normal, weight / (plane.depth * steepest)));
    }
    let distance = 1.0 / (steepest * ops::pow(sum, 1.0 / power));
    let place = plus(from, scaled(towards, distance));
    Some(Meeting { distance, place, normal: normalise(normal) })
}
