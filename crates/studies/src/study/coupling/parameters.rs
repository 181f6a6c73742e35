//! What the study covers.

use serde::Serialize;

use super::candidates::{Planned, STARTS};
use super::wanted;
use crate::flip::PIXELS_PER_DEGREE;
use crate::render::{Environment, Settings};
use crate::study::coupling::surface::table::Grid;
use crate::study::coupling::surface::{Fingerprint, Lobe, fingerprint};
use crate::study::{Size, StudyError};
use lobefit::effects::coupling::OWN_SPECULAR;

/// Everything that the recipe covers beside the tool's version.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    /// Specular lobes; the pictures of the first are shown.
    pub lobes: Vec<UnderLobe>,
    /// Starting points of each fit.
    starts: usize,
    pub furnace: Furnace,
    pub lit: Lit,
    surfaces: Measured,
}

/// Whole materials.
#[derive(Clone, Debug, Serialize)]
struct Measured {
    couplings: Vec<String>,
    /// Formulas and values of the lobes and couplings that are part of the program.
    formulas: Vec<Fingerprint>,
    /// Published fits, with their source.
    published: Vec<&'static str>,
    grid: Grid,
    /// Paths of each random walk, and what they begin from.
    paths: u64,
    seed: u64,
}

/// A specular lobe and the couplings under it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct UnderLobe {
    #[serde(serialize_with = "name")]
    pub lobe: Lobe,
    /// What they follow from, formulas of ours with their source.
    #[serde(rename = "couplings", serialize_with = "recipes")]
    pub planned: Vec<Planned>,
}

/// The furnace.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Furnace {
    pub roughness: Vec<f64>,
    /// Those of them that have a column of spheres.
    pub drawn: Vec<f64>,
    pub f0: Vec<f64>,
    /// The dielectric whose spheres are shown under every lobe.
    pub shown_f0: f64,
    /// Cosines of the view, increasing.
    pub mu: Vec<f64>,
}

/// The lit spheres.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Lit {
    pub roughness: Vec<f64>,
    pub f0: Vec<f64>,
    /// Reflectances that the couplings are ranked over.
    pub ranked_f0: Vec<f64>,
    /// What is shown.
    pub shown: Vec<Shown>,
    /// Albedo of the base.
    pub albedo: [f64; 3],
    pub environment: Environment,
    pub settings: Settings,
    /// Exposure of the pictures, in stops.
    pub stops: f64,
    pub pixels_per_degree: f64,
}

/// A lobe and a reflectance whose pictures are shown.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Shown {
    #[serde(serialize_with = "name")]
    pub lobe: Lobe,
    pub f0: f64,
    /// Whether only of a few couplings.
    pub few: bool,
}

impl Lit {
    /// What is shown of a lobe and a reflectance.
    pub fn shown_of(&self, lobe: Lobe, f0: f64) -> Option<Shown> {
        self.shown.iter().copied().find(|shown| shown.lobe == lobe && shown.f0 == f0)
    }
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Result<Parameters, StudyError> {
        let full = size == Size::Full;
        let settings = Settings {
            side: if full { 72 } else { 24 },
            radius: if full { 33.0 } else { 11.0 },
            samples: if full { 96 } else { 16 },
            lamp_samples: if full { 24 } else { 4 },
            background: [0.18; 3],
        };
        let wanted = wanted(size)?;
        let lobes = [Lobe::Normalised, Lobe::Compensated, Lobe::Single];
        let lobes = if full { &lobes[..] } else { &lobes[..1] };
        Ok(Parameters {
            lobes: lobes.iter().map(|&lobe| UnderLobe { lobe, planned: Planned::of(lobe, size) }).collect(),
            starts: STARTS,
            furnace: Furnace {
                roughness: if full {
                    [vec![0.02, 0.05], even(0.1, 1.0, 10)].concat()
                } else {
                    vec![0.3, 0.8, 1.0]
                },
                drawn: if full { even(0.1, 0.9, 9) } else { vec![0.3, 0.8] },
                f0: if full { vec![0.02, 0.04, 0.2, 1.0] } else { vec![0.04, 1.0] },
                shown_f0: 0.04,
                mu: even_squared(if full { 24 } else { 8 }),
            },
            lit: Lit {
                roughness: if full { vec![0.1, 0.3, 0.5, 0.7, 0.9] } else { vec![0.3, 0.8] },
                f0: if full { vec![0.02, 0.04, 0.2, 1.0] } else { vec![0.04] },
                ranked_f0: if full { vec![0.02, 0.04, 0.2] } else { vec![0.04] },
                shown: vec![
                    Shown { lobe: Lobe::Normalised, f0: 0.04, few: false },
                    Shown { lobe: Lobe::Compensated, f0: 0.04, few: true },
                    Shown { lobe: Lobe::Single, f0: 1.0, few: true },
                ],
                albedo: [0.8; 3],
                environment: Environment::afternoon(),
                settings,
                stops: 0.6,
                pixels_per_degree: PIXELS_PER_DEGREE,
            },
            surfaces: Measured {
                couplings: wanted.couplings.iter().map(|c| c.name().to_string()).collect(),
                formulas: fingerprint(&wanted.couplings)?,
                published: OWN_SPECULAR.iter().map(|own| own.entry.source).collect(),
                grid: wanted.grid,
                paths: wanted.walks.paths,
                seed: wanted.walks.seed,
            },
        })
    }
}

/// `n` values from `low` to `high`, of few digits.
fn even(low: f64, high: f64, n: usize) -> Vec<f64> {
    let value = |i: usize| low + (high - low) * (i as f64 / (n - 1) as f64);
    (0..n).map(|i| (1000.0 * value(i)).round() / 1000.0).collect()
}

/// Squares of `n` even steps from 0.1 to 1: dense at grazing views, and from where the fits begin.
fn even_squared(n: usize) -> Vec<f64> {
    let root = |i: usize| 0.1 + 0.9 * (i as f64 / (n - 1) as f64);
    (0..n).map(|i| (10_000.0 * root(i) * root(i)).round() / 10_000.0).collect()
}

fn name<S: serde::Serializer>(lobe: &Lobe, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(lobe.name())
}

fn recipes<S: serde::Serializer>(planned: &[Planned], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(planned.iter().map(Planned::recipe))
}
