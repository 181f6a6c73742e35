//! Furnace and reciprocity of a surface, measured on the function that a renderer would call.

use super::{Surface, SurfaceError};
use crate::integrate::Estimate;
use crate::integrate::reflection::Effort;
use crate::integrate::reflection::hemisphere::Hemisphere;
use crate::math::ops;
use crate::optics::ggx::Vec3;

/// Error bound that a furnace measurement must reach.
pub const TOLERANCE: f64 = 1e-6;

/// What a surface sends back to one view in an environment of radiance 1, by channel, with error bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// The specular lobe, with what was added to it.
    pub specular: [Estimate; 3],
    /// The base.
    pub base: [Estimate; 3],
}

impl Albedo {
    /// Both together.
    pub fn total(&self) -> [Estimate; 3] {
        [0, 1, 2].map(|i| Estimate {
            value: self.specular[i].value + self.base[i].value,
            error: self.specular[i].error + self.base[i].error,
        })
    }
}

/// The rules of one view, each finer than the one before: made once and used for every material of that alpha.
#[derive(Clone, Debug)]
pub struct Rules {
    alpha: f64,
    mu: f64,
    rules: Vec<Hemisphere>,
}

impl Rules {
    /// Rules for surfaces of alpha seen at mu in (0, 1].
    pub fn new(alpha: f64, mu: f64) -> Rules {
        let rules = Effort::ladder()[..3].iter().map(|effort| Hemisphere::new(alpha, mu, effort)).collect();
        Rules { alpha, mu, rules }
    }

    /// int f(l, v) n.l dl over the hemisphere of lights, to [`TOLERANCE`].
    ///
    /// # Errors
    /// A rule that does not settle; a value that is not finite.
    pub fn albedo(&self, surface: &Surface) -> Result<Albedo, SurfaceError> {
        let (alpha, mu) = (self.alpha, self.mu);
        let mut coarse = integral(surface, &self.rules[0]);
        let mut reached = f64::INFINITY;
        for rule in &self.rules[1..] {
            let fine = integral(surface, rule);
            if !fine.iter().all(|x| x.is_finite()) {
                return Err(SurfaceError::NotFinite { what: "furnace", alpha, mu });
            }
            let pair = |i: usize| Estimate::from_slow_pair(coarse[i], fine[i], 1.0);
            let albedo = Albedo { specular: [0, 1, 2].map(pair), base: [3, 4, 5].map(pair) };
            reached = albedo.total().iter().fold(0.0, |worst, x| x.error.max(worst));
            if reached <= TOLERANCE {
                return Ok(albedo);
            }
            coarse = fine;
        }
        Err(SurfaceError::Tolerance { alpha, mu, reached, tolerance: TOLERANCE })
    }
}

/// What `surface` sends back at mu in (0, 1].
///
/// # Errors
/// As [`Rules::albedo`].
pub fn albedo(surface: &Surface, mu: f64) -> Result<Albedo, SurfaceError> {
    super::albedos::check("mu", mu, [f64::MIN_POSITIVE, 1.0])?;
    Rules::new(surface.material().alpha, mu).albedo(surface)
}

fn integral(surface: &Surface, hemisphere: &Hemisphere) -> [f64; 6] {
    let view = surface.side(hemisphere.view[2]);
    let mut total = [0.0; 6];
    for ring in &hemisphere.rings {
        let light = surface.side(ring.cosine);
        let mut sum = [0.0; 6];
        for (direction, weight) in &ring.lights {
            let parts = surface.between(&light, &view, *direction, hemisphere.view);
            for i in 0..3 {
                sum[i] += weight * parts.specular[i];
                sum[i + 3] += weight * parts.base[i];
            }
        }
        for i in 0..6 {
            total[i] += ring.cosine * sum[i];
        }
    }
    total
}

/// Two directions above the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Cosine of one.
    pub mu_l: f64,
    /// Cosine of the other.
    pub mu_v: f64,
    /// Azimuth between them in degrees; at 180 they are on opposite sides of the normal.
    pub azimuth: f64,
}

impl Pair {
    /// The directions.
    pub fn directions(&self) -> [Vec3; 2] {
        let [sine_l, sine_v] = [self.mu_l, self.mu_v].map(|mu: f64| ((1.0 - mu) * (1.0 + mu)).sqrt());
        let (sin, cos) = ops::sincos(self.azimuth.to_radians());
        [[sine_l * cos, sine_l * sin, self.mu_l], [sine_v, 0.0, self.mu_v]]
    }
}

/// Cosines of the pairs: from almost grazing to almost normal.
const COSINES: [f64; 12] = [1e-3, 5e-3, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 1.0];

/// Azimuths of the pairs in degrees.
const AZIMUTHS: [f64; 6] = [0.0, 45.0, 90.0, 135.0, 170.0, 180.0];

/// All unordered pairs of 12 cosines from 1e-3 to 1, at six azimuths each.
pub fn pairs() -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (i, mu_l) in COSINES.into_iter().enumerate() {
        for mu_v in COSINES.into_iter().skip(i + 1) {
            pairs.extend(AZIMUTHS.map(|azimuth| Pair { mu_l, mu_v, azimuth }));
        }
    }
    pairs
}

/// The largest departure from reciprocity over some pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reciprocity {
    /// |f(l, v) - f(v, l)| over their mean, of the worst channel: 0 if reciprocal, 2 if light goes one way only.
    pub departure: f64,
    /// Where.
    pub at: Pair,
}

/// The largest departure from reciprocity of a surface over `pairs`, the first of equal ones; none of no pairs.
///
/// # Errors
/// A value that is not finite.
pub fn reciprocity(surface: &Surface, pairs: &[Pair]) -> Result<Option<Reciprocity>, SurfaceError> {
    let mut worst: Option<Reciprocity> = None;
    for pair in pairs {
        let [l, v] = pair.directions();
        let (there, back) = (surface.evaluate(l, v), surface.evaluate(v, l));
        for (a, b) in there.iter().zip(&back) {
            if !(a.is_finite() && b.is_finite()) {
                let alpha = surface.material().alpha;
                return Err(SurfaceError::NotFinite { what: "BRDF", alpha, mu: pair.mu_v });
            }
            // where both are 0 nothing departs
            let mean = 0.5 * (a + b).abs();
            let departure = if mean > 0.0 { (a - b).abs() / mean } else { 0.0 };
            if worst.is_none_or(|worst| departure > worst.departure) {
                worst = Some(Reciprocity { departure, at: *pair });
            }
        }
    }
    Ok(worst)
}
