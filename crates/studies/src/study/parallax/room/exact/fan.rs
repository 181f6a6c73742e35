//! Directions of the lobes of a kernel.

use std::f64::consts::PI;

use super::super::light::Room;
use super::outlook::{LANES, Outlook};
use multiversion::multiversion;

use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, dot, plus, scaled, tangents};
use lobefit_truth::optics::kernel::Kernel;

/// ln of the widths between which directions are tabulated, and steps between them. Below the
/// narrowest the tangents are in proportion to alpha, but for A/(1 - energy) = 1e-10 times the
/// number of directions.
const NARROWEST: f64 = -11.5;
const STEP: f64 = 0.1;
const NODES: usize = 116;

/// The same points, of even energy and azimuth, as directions of the lobe of every width in (0, 1]:
/// the tangent of half the angle over alpha is interpolated by cubics in ln alpha. Directions are
/// off by at most 1e-5 of their sine, by 5e-5 of the kernel `ndf`.
#[derive(Clone, Debug)]
pub struct Fan {
    /// Cosine and sine of the azimuth of each direction.
    azimuths: Vec<[f64; 2]>,
    /// tan(theta/2)/alpha of each direction, by node.
    tangents: Vec<Vec<f64>>,
}

impl Fan {
    /// `count` directions, a scrambled Sobol set of a seed: those of [`Rays`](super::super::Rays).
    pub fn new(kernel: &Kernel, count: u32, seed: u32) -> Fan {
        let points = Sobol::new([seed, seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995, 0]);
        let azimuth = |i: u32| {
            let (sine, cosine) = ops::sincos(2.0 * PI * points.coordinate(i, 1));
            [cosine, sine]
        };
        let energies: Vec<f64> = (0..count).map(|i| points.coordinate(i, 0)).collect();
        let node = |k: usize| {
            let alpha = ops::exp(NARROWEST + STEP * k as f64);
            let lobe = kernel.lobe(alpha);
            energies.iter().map(|&energy| lobe.quantile(energy).sqrt() / alpha).collect()
        };
        Fan { azimuths: (0..count).map(azimuth).collect(), tangents: (0..NODES).map(node).collect() }
    }

    /// How many directions.
    pub fn count(&self) -> usize {
        self.azimuths.len()
    }

    /// Calls `each` with the directions of the lobe of a width, about the axis z, all of the same
    /// weight.
    pub fn directions(&self, alpha: f64, mut each: impl FnMut(Vec3)) {
        let (first, weights) = cubic(ops::log(alpha));
        let tangents = [0, 1, 2, 3].map(|k| &self.tangents[first + k][..]);
        let lobe = Directions { tangents, weights: weights.map(|w| w * alpha), azimuths: &self.azimuths };
        for start in (0..self.count()).step_by(LANES) {
            let [x, y, z] = lobe.batch(start);
            (0..LANES.min(self.count() - start)).for_each(|l| each([x[l], y[l], z[l]]));
        }
    }

    /// Mean radiance of the lobe of a width about `axis` from a place, without the directions below
    /// a surface's `normal` where one is given.
    pub fn lobe(&self, room: &Room, place: Vec3, axis: Vec3, normal: Option<Vec3>, alpha: f64) -> [f64; 3] {
        let [x, y] = tangents(axis);
        let frame = [x, y, axis];
        let outlook = Outlook::new(room, place, frame);
        // all directions are above a normal of no length
        let (normal, above) = match normal {
            Some(normal) => (frame.map(|axis| dot(axis, normal)), 0.0),
            None => ([0.0; 3], -1.0),
        };
        let (first, weights) = cubic(ops::log(alpha));
        let tangents = [0, 1, 2, 3].map(|k| &self.tangents[first + k][..]);
        let lobe = Directions { tangents, weights: weights.map(|w| w * alpha), azimuths: &self.azimuths };
        let (sum, count) = total(&lobe, &outlook, normal, above);
        if count == 0 { [0.0; 3] } else { scaled(sum, 1.0 / f64::from(count)) }
    }
}

/// The directions of one width.
struct Directions<'a> {
    tangents: [&'a [f64]; 4],
    weights: [f64; 4],
    azimuths: &'a [[f64; 2]],
}

impl Directions<'_> {
    /// Coordinates of the directions from `start`; the last again where there are no more.
    #[inline(always)]
    fn batch(&self, start: usize) -> [[f64; LANES]; 3] {
        let last = self.azimuths.len() - 1;
        let [a, b, c, d] = self.weights;
        let [mut x, mut y, mut z] = [[0.0; LANES]; 3];
        for l in 0..LANES {
            let i = (start + l).min(last);
            let t = a * self.tangents[0][i]
                + b * self.tangents[1][i]
                + c * self.tangents[2][i]
                + d * self.tangents[3][i];
            let over = 1.0 / (1.0 + t * t);
            let across = 2.0 * t * over;
            x[l] = across * self.azimuths[i][0];
            y[l] = across * self.azimuths[i][1];
            z[l] = (1.0 - t * t) * over;
        }
        [x, y, z]
    }
}

/// The sum of what is seen in the directions above a normal, and their number. With the
/// instructions that the processor has: nothing is contracted, so that all give the same bits.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
fn total(lobe: &Directions<'_>, outlook: &Outlook<'_>, normal: Vec3, above: f64) -> (Vec3, u32) {
    let (mut sum, mut count) = ([0.0; 3], 0_u32);
    let n = lobe.azimuths.len();
    for start in (0..n).step_by(LANES) {
        let batch = lobe.batch(start);
        let met = outlook.met(&batch);
        for l in 0..LANES.min(n - start) {
            let towards = [batch[0][l], batch[1][l], batch[2][l]];
            if dot(normal, towards) > above {
                sum = plus(sum, outlook.radiance(met.1[l], met.0[l], towards));
                count += 1;
            }
        }
    }
    (sum, count)
}

/// The first of the four nodes about a width, and their weights: Lagrange's cubic.
fn cubic(log: f64) -> (usize, [f64; 4]) {
    let x = ((log - NARROWEST) / STEP).clamp(0.0, (NODES - 1) as f64);
    let first = (x as usize).clamp(1, NODES - 3) - 1;
    let t = x - (first + 1) as f64;
    let weights = [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ];
    (first, weights)
}
