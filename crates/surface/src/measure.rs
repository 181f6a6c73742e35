//! Furnace and reciprocity of a surface, measured on the function that a renderer would call.

use std::f64::consts::PI;
use std::sync::OnceLock;

use crate::albedos::FIRST_PANEL;
use crate::{Facet, Parts, Surface, SurfaceError};
use lobefit_math::gauss::Gauss;
use lobefit_math::{ops, panels};
use lobefit_truth::integrate::Estimate;
use lobefit_truth::integrate::reflection::Effort;
use lobefit_truth::integrate::reflection::hemisphere::{Hemisphere, Ring};
use lobefit_truth::optics::ggx::Vec3;

/// Error bound that a furnace measurement must reach.
pub const TOLERANCE: f64 = 1e-6;

/// What a surface sends back to one view in an environment of radiance 1, by channel, with error
/// bounds.
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

/// Most of [`TOLERANCE`] that the specular part may take; the base has what is left.
const SPECULAR: f64 = 0.8 * TOLERANCE;

/// The rules of one view, each finer than the one before: made once and used for every material of
/// that alpha.
#[derive(Clone, Debug)]
pub struct Rules {
    alpha: f64,
    mu: f64,
    rules: [OnceLock<Hemisphere>; 3],
    cosines: [OnceLock<Vec<(f64, f64)>>; 3],
}

/// Nodes of each panel over the cosine, rule by rule.
const NODES: [usize; 3] = [8, 16, 32];

impl Rules {
    /// Rules for surfaces of alpha seen at mu in (0, 1].
    pub fn new(alpha: f64, mu: f64) -> Rules {
        Rules { alpha, mu, rules: [const { OnceLock::new() }; 3], cosines: [const { OnceLock::new() }; 3] }
    }

    fn rule(&self, i: usize) -> &Hemisphere {
        self.rules[i].get_or_init(|| Hemisphere::new(self.alpha, self.mu, &Effort::ladder()[i]))
    }

    /// int f(l, v) n.l dl over the hemisphere of lights, to [`TOLERANCE`].
    ///
    /// # Errors
    /// A rule that does not settle; a value that is not finite.
    pub fn albedo(&self, surface: &Surface) -> Result<Albedo, SurfaceError> {
        self.albedo_over(self.specular(surface)?, surface)
    }

    /// [`Rules::albedo`] of a surface whose specular part is known: surfaces that differ in their
    /// base alone share it.
    ///
    /// # Errors
    /// As [`Rules::albedo`].
    pub fn albedo_over(&self, specular: [Estimate; 3], surface: &Surface) -> Result<Albedo, SurfaceError> {
        let taken = specular.iter().fold(0.0, |worst: f64, x| worst.max(x.error));
        Ok(Albedo { specular, base: self.base(surface, TOLERANCE - taken)? })
    }

    /// The base of [`Rules::albedo`]: over cosines where it knows these alone, over the hemisphere
    /// where it knows the facet.
    ///
    /// # Errors
    /// As [`Rules::albedo`].
    pub fn base(&self, surface: &Surface, tolerance: f64) -> Result<[Estimate; 3], SurfaceError> {
        if surface.knows_facets() {
            self.settled(tolerance, |i| base(surface, self.rule(i)))
        } else {
            self.settled(tolerance, |i| base_over_cosines(surface, self.mu, self.cosines(i)))
        }
    }

    /// Cosines with their weights 2 pi mu dmu: a Gauss rule on each of the panels that the albedos
    /// have, which are graded to grazing.
    fn cosines(&self, i: usize) -> &[(f64, f64)] {
        self.cosines[i].get_or_init(|| {
            let rule = Gauss::new(NODES[i]);
            let cuts = panels::from_zero(1.0, FIRST_PANEL * self.alpha);
            let panel = |cut: &[f64]| {
                let (half, middle) = (0.5 * (cut[1] - cut[0]), 0.5 * (cut[0] + cut[1]));
                let nodes = rule.nodes.iter().zip(&rule.weights);
                let place = |(x, w): (&f64, &f64)| {
                    let mu = middle + half * x;
                    (mu, 2.0 * PI * half * w * mu)
                };
                nodes.map(place).collect::<Vec<_>>()
            };
            cuts.windows(2).flat_map(panel).collect()
        })
    }

    /// The specular part of [`Rules::albedo`].
    ///
    /// # Errors
    /// As [`Rules::albedo`].
    pub fn specular(&self, surface: &Surface) -> Result<[Estimate; 3], SurfaceError> {
        self.settled(SPECULAR, |i| specular(surface, self.rule(i)))
    }

    /// An integral by finer and finer rules, until its bound is within the tolerance.
    fn settled(
        &self,
        tolerance: f64,
        integral: impl Fn(usize) -> [f64; 3],
    ) -> Result<[Estimate; 3], SurfaceError> {
        let (alpha, mu) = (self.alpha, self.mu);
        let finite = |i: usize| {
            let values = integral(i);
            let all = values.iter().all(|x| x.is_finite());
            if all { Ok(values) } else { Err(SurfaceError::NotFinite { what: "furnace", alpha, mu }) }
        };
        let mut coarse = finite(0)?;
        let mut reached = f64::INFINITY;
        for i in 1..self.rules.len() {
            let fine = finite(i)?;
            let found = [0, 1, 2].map(|c| Estimate::from_slow_pair(coarse[c], fine[c], 1.0));
            reached = found.iter().fold(0.0, |worst, x| x.error.max(worst));
            if reached <= tolerance {
                return Ok(found);
            }
            coarse = fine;
        }
        Err(SurfaceError::Refused(format!(
            " at alpha = {alpha:?}, mu = {mu:?}: the furnace is known to {reached:e} only, not to {tolerance:e}"
        )))
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

fn specular(surface: &Surface, hemisphere: &Hemisphere) -> [f64; 3] {
    let view = surface.side(hemisphere.view[2]);
    over_rings(hemisphere, |ring| {
        let light = surface.side(ring.cosine);
        over_lights(ring, |direction| {
            surface.specular(&light, &view, &Facet::between(direction, hemisphere.view))
        })
    })
}

/// A base that knows the facet.
fn base(surface: &Surface, hemisphere: &Hemisphere) -> [f64; 3] {
    let view = surface.side(hemisphere.view[2]);
    over_rings(hemisphere, |ring| {
        let light = surface.side(ring.cosine);
        over_lights(ring, |direction| {
            surface.base(&light, &view, &Facet::between(direction, hemisphere.view))
        })
    })
}

/// A base that knows the cosines alone, any azimuth stands for all.
fn base_over_cosines(surface: &Surface, mu: f64, cosines: &[(f64, f64)]) -> [f64; 3] {
    let at = |mu: f64| [((1.0 - mu) * (1.0 + mu)).max(0.0).sqrt(), 0.0, mu];
    let view = surface.side(mu);
    let mut total = [0.0; 3];
    for (light, weight) in cosines {
        let value = surface.base(&surface.side(*light), &view, &Facet::between(at(*light), at(mu)));
        total = [0, 1, 2].map(|i| total[i] + weight * value[i]);
    }
    total
}

/// Sum over the rings of cosine times f(ring).
fn over_rings(hemisphere: &Hemisphere, f: impl Fn(&Ring) -> [f64; 3]) -> [f64; 3] {
    let mut total = [0.0; 3];
    for ring in &hemisphere.rings {
        let sum = f(ring);
        total = [0, 1, 2].map(|i| total[i] + ring.cosine * sum[i]);
    }
    total
}

/// Sum over the lights of a ring of weight times f(direction).
fn over_lights(ring: &Ring, f: impl Fn(Vec3) -> [f64; 3]) -> [f64; 3] {
    let mut total = [0.0; 3];
    for (direction, weight) in &ring.lights {
        let value = f(*direction);
        total = [0, 1, 2].map(|i| total[i] + weight * value[i]);
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
pub const COSINES: [f64; 12] = [1e-3, 5e-3, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 1.0];

/// Azimuths of the pairs in degrees.
pub const AZIMUTHS: [f64; 6] = [0.0, 45.0, 90.0, 135.0, 170.0, 180.0];

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
    /// |f(l, v) - f(v, l)| over the mean of their sizes, of the worst channel: 0 if reciprocal, at
    /// most 2, where light goes one way only.
    pub departure: f64,
    /// The worst channel.
    pub channel: usize,
    /// Where.
    pub at: Pair,
}

/// The largest departure from reciprocity of a surface over `pairs`, the first of equal ones; none
/// of no pairs.
///
/// # Errors
/// A value that is not finite.
pub fn reciprocity(surface: &Surface, pairs: &[Pair]) -> Result<Option<Reciprocity>, SurfaceError> {
    largest(surface, pairs, |parts| [0, 1, 2].map(|i| parts.specular[i] + parts.base[i]))
}

/// The same of the base alone, which counts 0 without one.
///
/// # Errors
/// As [`reciprocity`].
pub fn base_reciprocity(surface: &Surface, pairs: &[Pair]) -> Result<Option<Reciprocity>, SurfaceError> {
    largest(surface, pairs, |parts| parts.base)
}

fn largest(
    surface: &Surface,
    pairs: &[Pair],
    part: impl Fn(Parts) -> [f64; 3],
) -> Result<Option<Reciprocity>, SurfaceError> {
    let mut worst: Option<Reciprocity> = None;
    for pair in pairs {
        let [l, v] = pair.directions();
        let (there, back) = (part(surface.parts(l, v)), part(surface.parts(v, l)));
        for (channel, (a, b)) in there.iter().zip(&back).enumerate() {
            if !(a.is_finite() && b.is_finite()) {
                let alpha = surface.material().alpha;
                return Err(SurfaceError::NotFinite { what: "BRDF", alpha, mu: pair.mu_v });
            }
            // where both are 0 nothing departs; a formula may be negative where it was not fitted
            let mean = 0.5 * (a.abs() + b.abs());
            let departure = if mean > 0.0 { (a - b).abs() / mean } else { 0.0 };
            if worst.is_none_or(|worst| departure > worst.departure) {
                worst = Some(Reciprocity { departure, channel, at: *pair });
            }
        }
    }
    Ok(worst)
}
