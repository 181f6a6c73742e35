//! The second opinion on what single scattering leaves out: a random walk on the Smith microsurface
//! (Heitz, Hanika, d'Eon and Dachsbacher, "Multiple-Scattering Microfacet BSDFs with the Smith
//! Model", 2016), GGX, height-correlated, reflection only. It shares with the quadrature the
//! definitions of Lambda and of visible normals, and nothing else.
//!
//! A ray is followed from facet to facet until it leaves (`path`). Every bounce scores the energy
//! that would leave after it, so that each has a value and an error; what leaves after the first is
//! E of single scattering with correlated shadowing. A base below the facets is not simulated: of a
//! dielectric this is the reflected part, all that is refracted counts as absorbed.
//!
//! Paths are drawn in replicas, whose spread gives the standard errors: scrambled Sobol points
//! decide the first facet, a PCG stream per replica all that follows. Replicas run in parallel and
//! are summed in order, so that the result does not depend on the threads.

mod interface;
mod path;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::IntegrateError;
use super::monte_carlo::{MOST_SAMPLES, Sampled};
use super::reflection::SMALLEST_ALPHA;
pub use interface::{escape, through};
use lobefit_math::sobol::{DIMENSIONS, Sobol};
use lobefit_math::sum;
use path::{Path, Tally};

/// Independent replicas of a walk.
pub const REPLICAS: usize = 32;

/// Bounces that have an entry of their own; the last entry holds all that follow.
pub const BOUNCES: usize = 8;

/// Bins of the cosine of the light, equally wide.
pub const BINS: usize = 16;

/// Channels that walk together, each with its own reflectance.
pub const CHANNELS: usize = 3;

/// What to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walks {
    /// Paths in all, shared evenly over [`REPLICAS`] replicas (rounded up).
    pub paths: u64,
    /// Seed of the scrambles and of the streams.
    pub seed: u64,
}

/// What came out, as energy per unit of incoming energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Walked {
    /// All energy that leaves, by channel.
    pub albedo: [Sampled; CHANNELS],
    /// What leaves after more than one bounce.
    pub multiple: [Sampled; CHANNELS],
    /// What leaves after 1, 2, ... bounces, the last entry after that many or more.
    pub bounces: [[Sampled; CHANNELS]; BOUNCES],
    /// What leaves after one bounce by the cosine at which it leaves, in equal bins from grazing to
    /// normal: energy per bin.
    pub single_lights: [[Sampled; CHANNELS]; BINS],
    /// `multiple` in the same bins.
    pub lights: [[Sampled; CHANNELS]; BINS],
}

/// Walks from views whose cosine is in `mu`, a range in (0, 1] that is drawn in proportion to the
/// cosine (a range of one value is that view, [0, 1] the average over the hemisphere), on a surface
/// of alpha in [1e-7, 1], with the reflectance by channel of a facet under the cosine v.m.
///
/// # Errors
/// An input outside its domain; too few or too many paths; a reflectance outside [0, 1] at one of
/// 65 cosines.
pub fn walk(
    alpha: f64,
    mu: [f64; 2],
    walks: Walks,
    reflectance: &(impl Fn(f64) -> [f64; CHANNELS] + Sync),
) -> Result<Walked, IntegrateError> {
    check(alpha, mu, walks, reflectance)?;
    let each = walks.paths.div_ceil(REPLICAS as u64);
    let mut seeds = Pcg64::seed_from_u64(walks.seed);
    let seeds: Vec<([u32; DIMENSIONS], u64)> =
        (0..REPLICAS).map(|_| (seeds.random(), seeds.random())).collect();
    let path = Path { alpha, mu, reflectance };
    let tallies: Vec<Tally> = seeds
        .par_iter()
        .map(|(scramble, stream)| {
            let (sobol, mut random) = (Sobol::new(*scramble), Pcg64::seed_from_u64(*stream));
            let mut tally = Tally::default();
            for index in 0..each {
                let first = [0, 1, 2].map(|d| sobol.coordinate(index as u32, d));
                path.follow(first, &mut random, &mut tally);
            }
            tally.scaled(1.0 / each as f64)
        })
        .collect();
    Ok(walked(&tallies, walks.paths))
}

/// E of single scattering of a white surface: what leaves after one bounce. The walk follows every path to
/// its end all the same.
///
/// # Errors
/// As [`walk`].
pub fn white(alpha: f64, mu: [f64; 2], walks: Walks) -> Result<Sampled, IntegrateError> {
    Ok(walk(alpha, mu, walks, &|_| [1.0; CHANNELS])?.bounces[0][0])
}

/// Means and standard errors over the replicas.
fn walked(tallies: &[Tally], paths: u64) -> Walked {
    let each = |f: &dyn Fn(&Tally, usize) -> f64| {
        std::array::from_fn(|channel| {
            let values: Vec<f64> = tallies.iter().map(|tally| f(tally, channel)).collect();
            let unfinished: Vec<f64> = tallies.iter().map(|tally| tally.unfinished[channel]).collect();
            // rare events that no path met, as in `monte_carlo`, and energy still inside when a
            // path was given up
            let (spread, unseen) = (sum::standard_error(&values), 1.0 / paths as f64);
            let cut = sum::mean(&unfinished);
            let standard_error = (spread * spread + unseen * unseen + cut * cut).sqrt();
            Sampled { value: sum::mean(&values), standard_error }
        })
    };
    let later = |tally: &Tally, c: usize| tally.bounces[1..].iter().map(|bounce| bounce[c]).sum::<f64>();
    Walked {
        albedo: each(&|tally, c| tally.bounces[0][c] + later(tally, c)),
        multiple: each(&later),
        bounces: std::array::from_fn(|n| each(&|tally, c| tally.bounces[n][c])),
        single_lights: std::array::from_fn(|bin| each(&|tally, c| tally.lights[0][bin][c])),
        lights: std::array::from_fn(|bin| each(&|tally, c| tally.lights[1][bin][c])),
    }
}

fn check(
    alpha: f64,
    mu: [f64; 2],
    walks: Walks,
    reflectance: &impl Fn(f64) -> [f64; CHANNELS],
) -> Result<(), IntegrateError> {
    let quantity = "random walk";
    let unit = |name, x: f64| (name, x, (0.0..=1.0).contains(&x), "is outside [0, 1]");
    let inputs = [
        ("alpha", alpha, (SMALLEST_ALPHA..=1.0).contains(&alpha), "is outside [1e-7, 1]"),
        unit("mu", mu[0]),
        unit("mu", mu[1]),
        ("mu", mu[1], mu[1] > 0.0 && mu[0] <= mu[1], "is not above 0 and above the start of its range"),
    ];
    IntegrateError::outside(quantity, inputs)?;
    if walks.paths < REPLICAS as u64 || walks.paths > MOST_SAMPLES {
        let must = "paths must be between 32 (one a replica) and 2^32";
        return Err(IntegrateError::Option { option: "paths", value: walks.paths.to_string(), must });
    }
    let values = (0..=64).flat_map(|i| reflectance(f64::from(i) / 64.0));
    IntegrateError::outside(quantity, values.map(|x| unit("reflectance", x)))
}
