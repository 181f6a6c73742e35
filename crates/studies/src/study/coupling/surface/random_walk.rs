//! The random walk beside the lobes, at single views: bounce by bounce, and where the light goes.

use std::f64::consts::PI;

use rayon::prelude::*;
use serde::Serialize;

use super::{Lobe, Material, Surface, SurfaceError};
use lobefit::data::AlphaMap;
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_truth::integrate::walk::{BINS, BOUNCES, Walks, walk};

/// A walk of white facets from one view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BounceRow {
    /// Roughness; alpha is its square.
    pub roughness: f64,
    /// Cosine of the view.
    pub mu: f64,
    /// E of single scattering, height-correlated, by quadrature.
    pub single: f64,
    /// Energy that leaves after 1, 2, ... bounces, the last entry after that many or more.
    pub energy: [f64; BOUNCES],
    /// Standard errors.
    pub standard_error: [f64; BOUNCES],
    /// Energy of two bounces or more by the cosine at which it leaves, in equal bins from grazing
    /// to normal.
    pub lights: Vec<f64>,
    /// Standard errors.
    pub lights_error: Vec<f64>,
    /// The same energy as the lobe of Kulla and Conty spreads it.
    pub kulla_conty: Vec<f64>,
    /// The same energy as a multiplied lobe of single scattering spreads it.
    pub multiplied: Vec<f64>,
    /// Both as densities, to be drawn: cosine of the light, energy per unit of cosine of Kulla and
    /// Conty's lobe and of the multiplied one.
    #[serde(skip)]
    pub densities: Vec<[f64; 3]>,
    /// Part of the energy that Kulla and Conty's lobe would have to move to be the walk's: half the
    /// sum of the differences.
    pub kulla_conty_off: f64,
    /// The same of the multiplied lobe.
    pub multiplied_off: f64,
}

/// Bounces of white facets at every (roughness, mu).
///
/// # Errors
/// A roughness or a cosine out of range; too few paths.
pub fn bounce_table(views: &[(f64, f64)], walks: Walks) -> Result<Vec<BounceRow>, SurfaceError> {
    let rows: Vec<Result<BounceRow, SurfaceError>> =
        views.par_iter().map(|(roughness, mu)| bounces(*roughness, *mu, walks)).collect();
    rows.into_iter().collect()
}

fn bounces(roughness: f64, mu: f64, walks: Walks) -> Result<BounceRow, SurfaceError> {
    let alpha = AlphaMap::RoughnessSquared.alpha(roughness);
    let surface = Surface::new(&Material::metal(alpha, [1.0; 3], Lobe::Single))?;
    let (spread, column) = (Spread::new(&surface, mu), surface.albedos().at(mu));
    let walked = walk(alpha, [mu; 2], walks, &|_| [1.0; 3])?;
    let lights: Vec<f64> = walked.lights.iter().map(|bin| bin[0].value).collect();
    let rule = Gauss::new(16);
    let bins = |density: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let edge = |bin: usize| bin as f64 / BINS as f64;
        (0..BINS).map(|bin| rule.integrate(edge(bin), edge(bin + 1), density)).collect()
    };
    let kulla_conty = bins(&|light| spread.kulla_conty(light));
    let multiplied = bins(&|light| spread.multiplied(light));
    let drawn = (0..=DRAWN).map(|i| i as f64 / DRAWN as f64);
    Ok(BounceRow {
        roughness,
        mu,
        single: column.e,
        energy: walked.bounces.map(|bounce| bounce[0].value),
        standard_error: walked.bounces.map(|bounce| bounce[0].standard_error),
        lights_error: walked.lights.iter().map(|bin| bin[0].standard_error).collect(),
        kulla_conty_off: moved(&kulla_conty, &lights),
        multiplied_off: moved(&multiplied, &lights),
        densities: drawn.map(|l| [l, spread.kulla_conty(l), spread.multiplied(l)]).collect(),
        lights,
        kulla_conty,
        multiplied,
    })
}

/// Steps of the densities that are drawn.
const DRAWN: usize = 64;

/// Where models send the light that single scattering of white facets loses.
struct Spread<'a> {
    surface: &'a Surface,
    mu: f64,
}

impl<'a> Spread<'a> {
    fn new(surface: &'a Surface, mu: f64) -> Spread<'a> {
        Spread { surface, mu }
    }

    /// f_ms cos over a ring of lights: 2 mu_l loss(l) loss(v)/loss_avg.
    fn kulla_conty(&self, light: f64) -> f64 {
        let albedos = self.surface.albedos();
        2.0 * light * albedos.at(light).loss * albedos.at(self.mu).loss / albedos.average.loss
    }

    /// The single lobe over a ring of lights times loss/E. The midpoint rule over half the azimuth,
    /// of a function that is even and periodic and whose peak is alpha wide, has more than six
    /// nodes to that width, which leaves less than 1e-9 of it.
    fn multiplied(&self, light: f64) -> f64 {
        let (surface, column) = (self.surface, self.surface.albedos().at(self.mu));
        let nodes = (20.0 / surface.material().alpha).ceil().max(64.0) as usize;
        let sine = |mu: f64| ((1.0 - mu) * (1.0 + mu)).sqrt();
        let view = [sine(self.mu), 0.0, self.mu];
        let at = |i: usize| {
            let (sin, cos) = ops::sincos(PI * (i as f64 + 0.5) / nodes as f64);
            surface.parts([sine(light) * cos, sine(light) * sin, light], view).specular[0]
        };
        let ring = 2.0 * PI / nodes as f64 * (0..nodes).map(at).sum::<f64>();
        light * ring * column.loss / column.e
    }
}

/// Half the sum of the differences over the sum.
fn moved(x: &[f64], truth: &[f64]) -> f64 {
    let apart: f64 = x.iter().zip(truth).map(|(x, truth)| (x - truth).abs()).sum();
    0.5 * apart / truth.iter().sum::<f64>()
}
