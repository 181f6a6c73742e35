//! A rule over the directions of light above the surface that knows where a reflection lobe has its
//! peak: for integrals of whole BRDFs, given as functions of two directions.
//!
//! Polar angle and azimuth of the light are those of `geometry` and `schlick`: the peak about the
//! mirror direction is one unit wide for every alpha, and panels are graded to the horizon on the
//! scale of alpha and of the view's cosine.

use super::effort::Effort;
use super::geometry::View;
use crate::optics::Smith;
use crate::optics::distribution::Ggx;
use crate::optics::ggx::Vec3;
use lobefit_math::lanes::LANES;
use lobefit_math::ops;

/// The lights of one polar angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    /// Their cosine to the normal.
    pub cosine: f64,
    /// Directions with the solid angle that each stands for, that of its mirror image in the plane
    /// of incidence included.
    pub lights: Vec<(Vec3, f64)>,
}

/// Rings over the hemisphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Hemisphere {
    /// Direction of the view, in the plane y = 0 with x >= 0.
    pub view: Vec3,
    /// The rings.
    pub rings: Vec<Ring>,
}

impl Hemisphere {
    /// Rings for a lobe of alpha in [1e-7, 1] seen at mu in [0, 1], for functions that are even in
    /// the y of the light.
    pub fn new(alpha: f64, mu: f64, effort: &Effort) -> Hemisphere {
        let view = View::new(Smith::Correlated, Ggx(alpha), mu);
        let mut rings = Vec::new();
        for cut in view.cuts().windows(2) {
            effort.outer.each(cut[0], cut[1], |u, weight| {
                let at = view.lights(&[u; LANES]);
                let (near, peak) = (
                    at.cos_s[0] * at.cos_s[0],
                    at.sin_d[0] * at.sin_d[0] + alpha * alpha * at.cos_d[0] * at.cos_d[0],
                );
                let polar = Polar { cosine: at.mu_l[0], sine: at.sin_l[0], near, peak };
                rings.push(polar.ring(view.sine, weight * at.jacobian[0], effort));
            });
        }
        Hemisphere { view: [view.sine, 0.0, view.mu], rings }
    }

    /// Integral over the solid angle of f(ring's cosine, light).
    pub fn integrate<const N: usize>(&self, mut f: impl FnMut(&Ring, &Vec3) -> [f64; N]) -> [f64; N] {
        let mut total = [0.0; N];
        for ring in &self.rings {
            let mut sum = [0.0; N];
            for (light, weight) in &ring.lights {
                for (sum, value) in sum.iter_mut().zip(f(ring, light)) {
                    *sum += weight * value;
                }
            }
            for (total, sum) in total.iter_mut().zip(sum) {
                *total += sum;
            }
        }
        total
    }
}

/// One polar angle, with the parts of |v + l|^2 that its azimuths share (see `schlick`).
struct Polar {
    cosine: f64,
    sine: f64,
    near: f64,
    peak: f64,
}

impl Polar {
    /// tan(psi/4) = r sinh(v), psi the azimuth from the mirror's side, 0 to pi: r puts the pole of
    /// D at v = i pi/2.
    fn ring(&self, sine_v: f64, weight: f64, effort: &Effort) -> Ring {
        let square = self.near * self.peak;
        let swing = sine_v * self.sine;
        let r = (square.sqrt() / (swing.sqrt() + (swing + square).sqrt())).min(1.0);
        let end = ops::asinh(1.0 / r);
        let mut lights = Vec::new();
        effort.inner(end).each(0.0, end, |v, part| {
            let tau = r * ops::sinh(v);
            let inverse = 1.0 / (1.0 + tau * tau);
            let slope = 4.0 * r * ops::cosh(v) * inverse;
            let (sin_half, cos_half) = (2.0 * tau * inverse, (1.0 - tau) * (1.0 + tau) * inverse);
            // cos psi = 1 - 2 sin^2(psi/2)
            let x = -self.sine * (1.0 - 2.0 * sin_half * sin_half);
            let y = self.sine * 2.0 * sin_half * cos_half;
            lights.push(([x, y, self.cosine], 2.0 * weight * part * slope));
        });
        Ring { cosine: self.cosine, lights }
    }
}
