//! What accuracy costs: the error of E against the number of integrand evaluations, for Monte
//! Carlo, scrambled Sobol points and the quadrature, with the setting of the path tracer of the
//! sources.

use multiversion::multiversion;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::integrate::monte_carlo::{self, Draw, Points, Run};
use crate::integrate::reflection::{Effort, TOLERANCE, Work, albedo_work, reflection};
use crate::integrate::{IntegrateError, PanelRule};
use crate::optics::{Smith, ggx};
use lobefit_math::lanes::{self, F8, LANES};

/// Error against evaluations at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// What the point is: `easy`, `hard`.
    pub name: String,
    /// GGX width.
    pub alpha: f64,
    /// Cosine of the view.
    pub mu: f64,
    /// One curve per integrator.
    pub series: Vec<Series>,
    /// Ten million samples summed in f32.
    pub sources: Sources,
}

/// One integrator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// (integrand evaluations, error): for the random ones the standard error,
    /// else |value - truth|.
    pub points: Vec<(f64, f64)>,
}

/// The setting of the path tracer at this point: 500 000 dispatches of 20 samples, each mean added
/// to an f32.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sources {
    /// Samples.
    pub samples: f64,
    /// Standard error of the mean.
    pub noise: f64,
    /// What the f32 running sum adds: |f32 result - f64 mean of the same samples|.
    pub bias: f64,
}

/// The points of the study: a rough lobe seen well, and a smooth one at grazing, where the path
/// tracer's running sum is at its worst.
pub const POINTS: [(&str, f64, f64); 2] = [("easy", 0.5, 0.7), ("hard", 0.016, 0.11)];

/// The integrators that sample: name, point set, what is drawn.
pub const SAMPLERS: [(&str, Points, Draw); 7] = [
    ("Monte Carlo, uniform lights", Points::Random, Draw::UniformLight),
    ("Monte Carlo, cosine-weighted lights", Points::Random, Draw::CosineLight),
    ("Monte Carlo, normals by D cos", Points::Random, Draw::Normal),
    ("Monte Carlo, visible normals", Points::Random, Draw::VisibleNormal),
    ("stratified, visible normals", Points::Stratified, Draw::VisibleNormal),
    ("scrambled Sobol, normals by D cos", Points::Sobol, Draw::Normal),
    ("scrambled Sobol, visible normals", Points::Sobol, Draw::VisibleNormal),
];

/// Largest power of two of samples drawn.
const LOG2_SAMPLES: u32 = 17;

/// Dispatches of the path tracer's accumulation, and samples of each.
const DISPATCHES: u32 = 500_000;
const PER_DISPATCH: u32 = 20;

/// A rounding floor: an error of 0 cannot be drawn on a logarithmic axis.
const FLOOR: f64 = 1e-16;

/// The studies of all [`POINTS`], in order.
pub fn studies(smith: Smith) -> Result<Vec<Study>, IntegrateError> {
    let study = |(name, alpha, mu): (&str, f64, f64)| -> Result<Study, IntegrateError> {
        let truth = reflection(smith, alpha, mu, TOLERANCE)?.e;
        let mut series = Vec::new();
        for (name, points, draw) in SAMPLERS {
            series.push(Series { name: name.into(), points: sampled(smith, alpha, mu, points, draw)? });
        }
        series.extend(quadrature(smith, alpha, mu, truth));
        Ok(Study { name: name.into(), alpha, mu, series, sources: sources(smith, alpha, mu) })
    };
    POINTS.into_par_iter().map(study).collect()
}

fn sampled(
    smith: Smith,
    alpha: f64,
    mu: f64,
    points: Points,
    draw: Draw,
) -> Result<Vec<(f64, f64)>, IntegrateError> {
    let at = |log2: u32| {
        let run = Run { samples: 1 << log2, seed: 1, points, draw };
        let value = monte_carlo::reflection(smith, alpha, mu, run)?;
        Ok((run.samples as f64, value.e.standard_error))
    };
    (6..=LOG2_SAMPLES).map(at).collect()
}

/// Gauss nodes over the whole range of the outer variable, rising.
const WHOLE: [usize; 6] = [8, 16, 24, 32, 40, 48];

fn quadrature(smith: Smith, alpha: f64, mu: f64, truth: f64) -> [Series; 2] {
    let point = |work: Work| (work.evaluations as f64, (work.value - truth).abs().max(FLOOR));
    let whole = WHOLE.map(|n| point(albedo_work(smith, alpha, mu, &PanelRule::new(n), false)));
    let graded = [0, 1].map(|i| point(albedo_work(smith, alpha, mu, &Effort::ladder()[i].outer, true)));
    [
        Series { name: "quadrature, one panel".into(), points: whole.to_vec() },
        Series { name: "quadrature, graded panels (as shipped)".into(), points: graded.to_vec() },
    ]
}

/// Samples of two dispatches, in lanes.
type Pair = [F8; 2 * PER_DISPATCH as usize / LANES];

fn sources(smith: Smith, alpha: f64, mu: f64) -> Sources {
    let mut random = Pcg64::seed_from_u64(10);
    let (mut running, mut sum, mut squares) = (0.0_f32, 0.0_f64, 0.0_f64);
    for _ in 0..DISPATCHES / 2 {
        let mut drawn = [Pair::default(); 2];
        for block in 0..drawn[0].len() {
            for lane in 0..LANES {
                (drawn[0][block][lane], drawn[1][block][lane]) = (random.random(), random.random());
            }
        }
        let weights = weights(smith, alpha, mu, &drawn);
        for dispatch in weights.as_flattened().chunks(PER_DISPATCH as usize) {
            let total: f64 = dispatch.iter().sum();
            running += (total / f64::from(PER_DISPATCH)) as f32;
            sum += total;
            squares += dispatch.iter().map(|w| w * w).sum::<f64>();
        }
    }
    let samples = f64::from(DISPATCHES) * f64::from(PER_DISPATCH);
    let mean = sum / samples;
    Sources {
        samples,
        noise: ((squares / samples - mean * mean).max(0.0) / samples).sqrt(),
        bias: (f64::from(running) / f64::from(DISPATCHES) - mean).abs(),
    }
}

/// Shadowing of the lights mirrored about visible normals, 0 below the horizon:
/// `ggx::visible_normal` and `ggx::mirror` of an isotropic lobe, of which the light's height alone
/// is wanted.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn weights(smith: Smith, alpha: f64, mu: f64, [azimuth, height]: &[Pair; 2]) -> Pair {
    let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
    let length = ggx::stretched_length(alpha, mu);
    let (view_x, view_z) = (alpha * sine / length, mu / length);
    let mut out = Pair::default();
    for (out, (azimuth, height)) in out.iter_mut().zip(azimuth.iter().zip(height)) {
        let (sines, cosines) = lanes::sincos_turns(azimuth);
        for i in 0..LANES {
            let z = (1.0 - height[i]) * (1.0 + view_z) - view_z;
            let cap = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
            let normal_x = alpha * (cap * cosines[i] + view_x);
            let (normal_y, normal_z) = (alpha * (cap * sines[i]), z + view_z);
            let square = normal_x * normal_x + normal_y * normal_y + normal_z * normal_z;
            let light = 2.0 * (sine * normal_x + mu * normal_z) * normal_z / square - mu;
            let weight = ggx::lit_given_visible(smith, alpha, mu, light.clamp(1e-5, 1.0));
            out[i] = if light > 1e-5 { weight } else { 0.0 };
        }
    }
    out
}
