//! The independent second opinion: Monte Carlo over directions. It shares with the quadrature the
//! definition of Schlick's weight and nothing else: not the azimuth integral, not its variables,
//! not its form of the shadowing.
//!
//! The estimator draws visible normals by spherical caps, mirrors the view about each and averages
//! G2/G1(v) of the lights above the horizon. Its standard error comes from independently scrambled
//! replicas.

mod lobes;

pub use lobes::{aniso, aniso_glass, coat, glass, sobol};
pub(crate) use lobes::{check_positive, glass_of, refract, shadowing};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::IntegrateError;
use super::reflection::check_inputs;
use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Ggx};
use crate::optics::fresnel;
use crate::optics::ggx::{self, Vec3};
use lobefit_math::sobol::{DIMENSIONS, Sobol};
use lobefit_math::sum;

/// Independent replicas of an estimate.
pub const REPLICAS: usize = 32;

/// Most samples of one estimate: the Sobol index has 32 bits.
pub const MOST_SAMPLES: u64 = 1 << 32;

/// What drives the estimator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Independent random numbers (PCG).
    Random,
    /// Owen-scrambled Sobol points.
    Sobol,
}

/// Which direction is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Draw {
    /// Visible normals.
    VisibleNormal,
    /// Lights uniform over the hemisphere.
    UniformLight,
}

/// Settings of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Samples in all, shared evenly over [`REPLICAS`] replicas (rounded up).
    pub samples: u64,
    /// Seed of the scrambles or of the random numbers.
    pub seed: u64,
    /// Point set.
    pub points: Points,
    /// Directions drawn.
    pub draw: Draw,
}

/// One value with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Mean over all samples.
    pub value: f64,
    /// Standard error of the mean, from the spread of the replicas.
    pub standard_error: f64,
}

/// `ggx-reflection` by Monte Carlo: E, A, B, loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledReflection {
    /// Directional albedo.
    pub e: Sampled,
    /// Schlick's scale.
    pub a: Sampled,
    /// Schlick's bias.
    pub b: Sampled,
    /// 1 - E.
    pub loss: Sampled,
}

/// Sums of one sample or of many: E, B and loss.
type Weights = [f64; 3];

/// Estimates `ggx-reflection` at alpha in [1e-7, 1], mu in (0, 1].
pub fn reflection(smith: Smith, alpha: f64, mu: f64, run: Run) -> Result<SampledReflection, IntegrateError> {
    reflection_of("ggx-reflection", smith, Ggx(alpha), mu, run)
}

/// [`reflection`] of any distribution of normals, as the quantity of a name.
pub fn reflection_of<D: Distribution>(
    quantity: &'static str,
    smith: Smith,
    lobe: D,
    mu: f64,
    run: Run,
) -> Result<SampledReflection, IntegrateError> {
    check(quantity, lobe.alpha(), mu, run)?;
    let means = replicas(run, |x| sample(smith, lobe, mu, run.draw, x));
    Ok(SampledReflection {
        e: column(&means, run.samples, |w| w[0]),
        a: column(&means, run.samples, |w| w[0] - w[1]),
        b: column(&means, run.samples, |w| w[1]),
        loss: column(&means, run.samples, |w| w[2]),
    })
}

/// Estimates `ggx-average` at alpha in [1e-7, 1]: E_avg and its loss. The third coordinate draws
/// the cosine, mu^2 uniform.
pub fn average(smith: Smith, alpha: f64, run: Run) -> Result<(Sampled, Sampled), IntegrateError> {
    check("ggx-average", alpha, 1.0, run)?;
    let means = replicas(run, |x| sample(smith, Ggx(alpha), x[2].sqrt(), run.draw, x));
    Ok((column(&means, run.samples, |w| w[0]), column(&means, run.samples, |w| w[2])))
}

fn check(quantity: &'static str, alpha: f64, mu: f64, run: Run) -> Result<(), IntegrateError> {
    check_inputs(quantity, alpha, mu)?;
    for (input, value) in [("alpha", alpha), ("mu", mu)] {
        if value == 0.0 {
            let domain = "is a limit that Monte Carlo cannot sample; use quadrature";
            return Err(IntegrateError::Domain { quantity, input, value, domain });
        }
    }
    check_samples(run)
}

pub(crate) fn check_samples(run: Run) -> Result<(), IntegrateError> {
    if run.samples < REPLICAS as u64 || run.samples > MOST_SAMPLES {
        let must = "samples must be between 32 (one a replica) and 2^32";
        return Err(IntegrateError::Option { option: "samples", value: run.samples.to_string(), must });
    }
    Ok(())
}

/// The draws of one replica.
pub(crate) struct Draws {
    points: Points,
    sobol: Sobol,
    random: Pcg64,
    index: u32,
}

impl Draws {
    fn new(points: Points, seed: [u32; DIMENSIONS]) -> Draws {
        let random = Pcg64::seed_from_u64(u64::from(seed[0]) << 32 | u64::from(seed[1]));
        Draws { points, sobol: Sobol::new(seed), random, index: 0 }
    }

    /// The next point.
    pub(crate) fn next(&mut self) -> [f64; DIMENSIONS] {
        let index = self.index;
        self.index = index.wrapping_add(1);
        match self.points {
            Points::Random => self.random.random(),
            Points::Sobol => [0, 1, 2].map(|d| self.sobol.coordinate(index, d)),
        }
    }
}

/// What a function makes of the samples of each replica, of which it gets the number, in order,
/// whatever thread computes which.
pub(crate) fn of_replicas<T: Send>(run: Run, f: impl Fn(u64, Draws) -> T + Sync) -> Vec<T> {
    let each = run.samples.div_ceil(REPLICAS as u64);
    let mut seeds = Pcg64::seed_from_u64(run.seed);
    let seeds: Vec<[u32; DIMENSIONS]> = (0..REPLICAS).map(|_| seeds.random()).collect();
    seeds.par_iter().map(|seed| f(each, Draws::new(run.points, *seed))).collect()
}

/// Means of the replicas.
pub(crate) fn replicas(run: Run, f: impl Fn([f64; DIMENSIONS]) -> Weights + Sync) -> Vec<Weights> {
    of_replicas(run, |each, draws| mean(each, draws, &f))
}

/// Mean of one replica: blocks of 4096 samples, their means summed pairwise.
fn mean(samples: u64, mut draws: Draws, f: &impl Fn([f64; DIMENSIONS]) -> Weights) -> Weights {
    const BLOCK: u64 = 4096;
    let mut blocks: [Vec<f64>; 3] = Default::default();
    let mut from = 0;
    while from < samples {
        let to = (from + BLOCK).min(samples);
        let mut total = [0.0; 3];
        for _ in from..to {
            for (sum, w) in total.iter_mut().zip(f(draws.next())) {
                *sum += w;
            }
        }
        for (block, sum) in blocks.iter_mut().zip(total) {
            block.push(sum);
        }
        from = to;
    }
    blocks.map(|block| sum::pairwise(&block) / samples as f64)
}

/// Mean and standard error over the replicas. An event of weight 1 that is rarer than one in N
/// samples is likely not seen at all, and then the spread says nothing of it: 1/N is added in
/// square.
pub(crate) fn column(means: &[Weights], samples: u64, f: impl Fn(&Weights) -> f64) -> Sampled {
    let values: Vec<f64> = means.iter().map(f).collect();
    let (spread, unseen) = (sum::standard_error(&values), 1.0 / samples as f64);
    Sampled { value: sum::mean(&values), standard_error: (spread * spread + unseen * unseen).sqrt() }
}

/// Weights of one sample: kept light, the same times (1 - v.h)^5, lost light.
fn sample<D: Distribution>(smith: Smith, lobe: D, mu: f64, draw: Draw, x: [f64; DIMENSIONS]) -> Weights {
    let view = [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
    match draw {
        Draw::VisibleNormal if D::MATCHED => by_visible_normal(smith, lobe, view, x),
        _ => by_uniform_light(smith, lobe, view, x),
    }
}

fn by_visible_normal<D: Distribution>(smith: Smith, lobe: D, view: Vec3, x: [f64; DIMENSIONS]) -> Weights {
    let normal = lobe.visible_normal(view, x[0], x[1]);
    let (light, cosine) = ggx::mirror(view, normal);
    if light[2] <= 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let (of_view, of_light) = (lobe.lambda(view[2]), lobe.lambda(light[2].min(1.0)));
    let kept = smith.lit_given_visible(of_view, of_light);
    let lost = smith.shadowed_given_visible(of_view, of_light);
    [kept, kept * fresnel::schlick_weight(1.0 - cosine.min(1.0)), lost]
}

/// 2 pi f cos of a light uniform over the hemisphere; the textbook estimator, with the textbook's
/// variance.
fn by_uniform_light<D: Distribution>(smith: Smith, lobe: D, view: Vec3, x: [f64; DIMENSIONS]) -> Weights {
    let mu_l = x[1].max(f64::MIN_POSITIVE);
    let sine = ((1.0 - mu_l) * (1.0 + mu_l)).sqrt();
    let (sin_azimuth, cos_azimuth) = lobefit_math::ops::sincos(2.0 * std::f64::consts::PI * x[0]);
    let light = [sine * cos_azimuth, sine * sin_azimuth, mu_l];
    let sum = [light[0] + view[0], light[1] + view[1], light[2] + view[2]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    let half = [sum[0] / length, sum[1] / length, sum[2] / length];
    let (of_view, of_light) = (lobe.lambda(view[2]), lobe.lambda(mu_l));
    let g2 = match smith {
        Smith::Correlated => 1.0 / (1.0 + of_view + of_light),
        Smith::Separable => 1.0 / ((1.0 + of_view) * (1.0 + of_light)),
    };
    // 2 pi f cos = 2 pi D G2/(4 mu_v)
    let kept = 0.5 * std::f64::consts::PI * lobe.density(half) * g2 / view[2];
    [kept, kept * fresnel::schlick_weight(1.0 - 0.5 * length), 1.0 - kept]
}
