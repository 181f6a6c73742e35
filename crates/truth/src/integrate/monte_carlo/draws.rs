//! Points in the unit cube that drive the estimators, in independent replicas.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::Run;
use lobefit_math::sobol::{DIMENSIONS, Sobol};

/// Independent replicas of an estimate.
pub const REPLICAS: usize = 32;

/// What drives the estimator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Independent random numbers (PCG).
    Random,
    /// One random point in each cell of a square grid over the first two coordinates, and in each
    /// stratum of the third.
    Stratified,
    /// Owen-scrambled Sobol points.
    Sobol,
}

impl Points {
    /// All of them.
    pub const ALL: [Points; 3] = [Points::Random, Points::Stratified, Points::Sobol];

    /// The word for it, as an option and in the names of ways to integrate.
    pub fn name(self) -> &'static str {
        match self {
            Points::Random => "random",
            Points::Stratified => "stratified",
            Points::Sobol => "sobol",
        }
    }
}

/// The draws of one replica.
pub(crate) struct Draws {
    points: Points,
    sobol: Sobol,
    random: Pcg64,
    index: u32,
    strata: Strata,
}

impl Draws {
    fn new(points: Points, seed: [u32; DIMENSIONS], samples: u64) -> Draws {
        let mut random = Pcg64::seed_from_u64(u64::from(seed[0]) << 32 | u64::from(seed[1]));
        let shift = if points == Points::Stratified { random.random() } else { 0.0 };
        Draws { points, sobol: Sobol::new(seed), random, index: 0, strata: Strata::new(samples, shift) }
    }

    /// The next point.
    pub(crate) fn next(&mut self) -> [f64; DIMENSIONS] {
        let index = self.index;
        self.index = index.wrapping_add(1);
        match self.points {
            Points::Random => self.random.random(),
            Points::Stratified => self.strata.at(u64::from(index), self.random.random()),
            Points::Sobol => [0, 1, 2].map(|d| self.sobol.coordinate(index, d)),
        }
    }
}

/// A grid of side^2 cells, the largest that the samples of a replica fill. Samples beyond it lie
/// anywhere: their mean is the integral too, so that the mean of all is unbiased.
///
/// The third coordinate of cell i lies in the stratum (step i + shift) mod side^2: no two cells share
/// one, and as the shift is drawn at random every pair of cell and stratum is as likely, so that
/// functions of all three coordinates stay unbiased. A step near side^2 over the golden ratio keeps
/// strata of neighbouring cells apart.
struct Strata {
    side: u64,
    step: u64,
    shift: u64,
}

impl Strata {
    fn new(samples: u64, shift: f64) -> Strata {
        let side = samples.isqrt().max(1);
        let cells = side * side;
        let golden = (0.618_033_988_749_895 * cells as f64) as u64;
        let step = (golden.max(1)..).find(|step| coprime(*step, cells)).unwrap_or(1);
        Strata { side, step, shift: (shift * cells as f64) as u64 }
    }

    fn at(&self, index: u64, [x, y, z]: [f64; DIMENSIONS]) -> [f64; DIMENSIONS] {
        let (side, cells) = (self.side, self.side * self.side);
        if index >= cells {
            return [x, y, z];
        }
        let inside = |stratum: u64, x: f64, of: u64| ((stratum as f64 + x) / of as f64).min(BELOW_ONE);
        let third = (self.step * index + self.shift) % cells;
        [inside(index % side, x, side), inside(index / side, y, side), inside(third, z, cells)]
    }
}

/// The largest number below 1, which the division by a number of strata may round to 1.
const BELOW_ONE: f64 = 1.0 - 0.5 * f64::EPSILON;

fn coprime(a: u64, b: u64) -> bool {
    let (mut a, mut b) = (a, b);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}

/// What a function makes of the samples of each replica, of which it gets the number, in order,
/// whatever thread computes which.
pub(crate) fn of_replicas<T: Send>(run: Run, f: impl Fn(u64, Draws) -> T + Sync) -> Vec<T> {
    let each = run.samples.div_ceil(REPLICAS as u64);
    let mut seeds = Pcg64::seed_from_u64(run.seed);
    let seeds: Vec<[u32; DIMENSIONS]> = (0..REPLICAS).map(|_| seeds.random()).collect();
    seeds.par_iter().map(|seed| f(each, Draws::new(run.points, *seed, each))).collect()
}
