//! `eon-single`: E of the single-scattering lobe of the energy-preserving Oren-Nayar model
//! (Portsmouth, Kutz and Hill, "EON: A practical energy-preserving rough diffuse BRDF", 2024), which
//! is Fujii's form of Oren and Nayar's lobe (1994). The lobe of several bounces sends back what this
//! one loses.
//!
//! E = 1 - r L(mu)/(1 + C r) with r the roughness: a closed form, with the loss itself and no
//! difference.

use std::f64::consts::{FRAC_PI_2, PI};

use lobefit_math::ops;

use super::{Facts, Input, MU, Quantity, Variant};
use crate::integrate::IntegrateError;
use crate::integrate::brdf::Brdf;
use crate::integrate::monte_carlo::{Run, Sampled, check_samples, column, replicas};
use crate::optics::ggx::Vec3;

/// What a lobe of roughness 1 loses face on before it is scaled: 1/2 - 2/(3 pi).
const FACE_ON: f64 = 0.5 - 2.0 / (3.0 * PI);

/// The cosine-weighted average of 1 + (the lobe's swing) at roughness 1, less 1: 2/3 - 28/(15 pi).
const SWING: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// Rounding of the closed form.
const ERROR: f64 = 2e-15;

/// The quantity.
#[derive(Clone, Copy, Debug)]
pub struct EonSingle;

/// E and 1 - E at roughness and mu in [0, 1]. Both ends of mu are exact: E = 1 at grazing.
pub fn albedo(roughness: f64, mu: f64) -> [f64; 2] {
    let loss = roughness * lost(mu) / (1.0 + FACE_ON * roughness);
    [1.0 - loss, loss]
}

/// The cosine-weighted average of E over all views, and of 1 - E.
pub fn average(roughness: f64) -> [f64; 2] {
    let scale = 1.0 / (1.0 + FACE_ON * roughness);
    [(1.0 + SWING * roughness) * scale, (FACE_ON - SWING) * roughness * scale]
}

/// The lobe of a white surface, 1/sr, at the cosines of view and light and the cosine between them.
pub fn lobe(roughness: f64, mu: f64, mu_l: f64, l_dot_v: f64) -> f64 {
    let s = l_dot_v - mu * mu_l;
    let t = if s > 0.0 { mu.max(mu_l) } else { 1.0 };
    (1.0 + roughness * s / t) / (PI * (1.0 + FACE_ON * roughness))
}

/// L, the loss at roughness 1 before it is scaled. With c = mu, s = sqrt(1 - c^2), phi = asin(c) it is
/// FACE_ON less the integral of the lobe's swing: (pi/2 (1 - s) + s phi + s^2 c - 2/3 (1 - s) - 2/3 c s
/// (1 + s + s^2)/(1 + s))/pi, of which 1 - s = c^2/(1 + s). Near grazing it is c/pi.
fn lost(c: f64) -> f64 {
    let s = ((1.0 - c) * (1.0 + c)).sqrt();
    let (grazing, phi) = (c * c / (1.0 + s), ops::atan2(c, s));
    let swing = s * phi + s * s * c - 2.0 / 3.0 * c * s * (1.0 + s + s * s) / (1.0 + s);
    ((FRAC_PI_2 - 2.0 / 3.0) * grazing + swing) / PI
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Quantity for EonSingle {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "eon-single",
                inputs: &[Input::new("roughness", [0.0, 1.0]).studied([0.5, 1.0]), MU],
                outputs: &["E", "loss", "error"],
                tolerance: 1e-14,
                changes_at_alpha: false,
                remark: "roughness is the model's own, not squared",
                ..Facts::NONE
            }
        }
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        check(self.name(), x)?;
        let [e, loss] = albedo(x[0], x[1]);
        if tolerance < ERROR {
            let place = format!("roughness = {:?}, mu = {:?}", x[0], x[1]);
            return Err(IntegrateError::Tolerance {
                quantity: self.name(),
                place,
                reached: ERROR,
                tolerance,
            });
        }
        Ok(vec![e, loss, ERROR])
    }

    fn brdf(&self, _: &Variant, x: &[f64]) -> Result<Brdf<'_>, IntegrateError> {
        check(self.name(), x)?;
        let roughness = x[0];
        let weighted = Box::new(move |view: Vec3, light: Vec3| {
            light[2] * lobe(roughness, view[2], light[2], dot(view, light))
        });
        // The lobe has kinks, where the light is as high as the view and a quarter turn from it.
        Ok(Brdf { weighted, width: 1e-3 })
    }

    fn microseconds(&self, _: &[&str]) -> f64 {
        0.05
    }

    /// Lights drawn in proportion to their cosine.
    fn second_opinion(&self, _: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        check(self.name(), x)?;
        check_samples(run)?;
        let (roughness, mu) = (x[0], x[1]);
        let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
        let means = replicas(run, |u| {
            let (mu_l, sine_l) = ((1.0 - u[0]).sqrt(), u[0].sqrt());
            let l_dot_v = mu * mu_l + sine * sine_l * ops::cos(2.0 * PI * u[1]);
            let e = PI * lobe(roughness, mu, mu_l, l_dot_v);
            [e, 1.0 - e, 0.0]
        });
        Ok((0..2).map(|k| column(&means, run.samples, |w| w[k])).collect())
    }
}

/// Refuses inputs outside the domain.
fn check(quantity: &'static str, x: &[f64]) -> Result<(), IntegrateError> {
    let of = |(input, x): (_, &f64)| (input, *x, (0.0..=1.0).contains(x), "is outside [0, 1]");
    IntegrateError::outside(quantity, ["roughness", "mu"].into_iter().zip(x).map(of))
}
