//! The independent second opinion: Monte Carlo over directions. It shares with the quadrature the
//! definition of Schlick's weight and nothing else: not the azimuth integral, not its variables,
//! not its form of the shadowing.
//!
//! The estimator draws visible normals by spherical caps, mirrors the view about each and averages
//! G2/G1(v) of the lights above the horizon; or it draws otherwise (`draw`), from points of several
//! kinds (`draws`). Its standard error comes from independently scrambled replicas.

mod draw;
mod draws;
mod lobes;

pub use draw::Draw;
pub(crate) use draws::{Draws, of_replicas};
pub use draws::{Points, REPLICAS};

pub(crate) use draw::{traced, view};
pub use lobes::{aniso, aniso_glass, coat, glass, sobol};
pub(crate) use lobes::{check_positive, glass_of, refract, shadowing};
pub(crate) use lobes::{traced_glass, view_at};

use super::IntegrateError;
use super::reflection::check_inputs;
use crate::optics::Smith;
use crate::optics::distribution::{Distribution, Ggx};
use lobefit_math::sobol::DIMENSIONS;
use lobefit_math::sum;

/// Most samples of one estimate: the Sobol index has 32 bits.
pub const MOST_SAMPLES: u64 = 1 << 32;

/// What glass may draw.
pub(crate) const GLASS_DRAWS: &[Draw] = &[Draw::Normal, Draw::VisibleNormal];

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
    let means = replicas(run, |x| draw::sample((smith, run.draw), &lobe, draw::view(mu), x));
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
    let means = replicas(run, |x| draw::sample((smith, run.draw), &Ggx(alpha), draw::view(x[2].sqrt()), x));
    Ok((column(&means, run.samples, |w| w[0]), column(&means, run.samples, |w| w[2])))
}

fn check(quantity: &'static str, alpha: f64, mu: f64, run: Run) -> Result<(), IntegrateError> {
    check_inputs(quantity, alpha, mu)?;
    check_positive(quantity, &[("alpha", alpha), ("mu", mu)])?;
    check_samples(run)
}

pub(crate) fn check_samples(run: Run) -> Result<(), IntegrateError> {
    if run.samples < REPLICAS as u64 || run.samples > MOST_SAMPLES {
        let must = "samples must be between 32 (one a replica) and 2^32";
        return Err(IntegrateError::Option { option: "samples", value: run.samples.to_string(), must });
    }
    Ok(())
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
