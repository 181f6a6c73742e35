//! The two tables of a lobe, as engines read them.

use crate::LtcError;
use crate::fit::fitted;
use crate::lobe::{Lobe, View};
use crate::polygon::sphere_share;
use lobefit_shade::Real;
use lobefit_shade::tape::Half;
use rayon::prelude::*;

/// Texels along both axes of the tables that engines ship.
pub const SIDE: usize = 64;

/// Bytes of both textures, of which a value takes `each`.
pub fn bytes(side: usize, each: u64) -> u64 {
    8 * (side * side) as u64 * each
}

/// The side that is stated, or the first half, quarter, ... of which both textures are within so many bytes;
/// as stated where
/// no half is that small.
pub fn side_within(stated: usize, each: u64, most: u64) -> usize {
    let mut halves = std::iter::successors(Some(stated), |n| Some(n / 2).filter(|n| *n > 1));
    halves.find(|n| bytes(*n, each) <= most).unwrap_or(stated)
}

/// The tables: matrices, and E, B, 0 and the share of a sphere divided by the length. Texel (i, k)
/// is of roughness i/(n - 1) with alpha = roughness^2, and of mu = 1 - (k/(n - 1))^2; the sphere's,
/// of the cosine 2 i/(n - 1) - 1 and the length k/(n - 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Texels along both axes.
    pub side: usize,
    /// m11, m31, m13, m33 of each texel, roughness fastest.
    pub matrices: Vec<[f64; 4]>,
    /// The second texture.
    pub amplitudes: Vec<[f64; 4]>,
}

/// Value of a node.
fn node(i: usize, side: usize) -> f64 {
    i as f64 / (side - 1) as f64
}

/// What a lookup computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lookup {
    /// Numbers that are exact.
    Exact,
    /// Weights of texels that are multiples of 2^-8, as of many texture units.
    Coarse,
    /// Inputs, texture coordinates and the texel that is fetched rounded to f16.
    Half,
}

impl Pair {
    /// Refuses values that are no numbers.
    ///
    /// # Errors
    /// The first of them, with its place.
    pub fn check(&self) -> Result<(), LtcError> {
        let names = [["m11", "m31", "m13", "m33"], ["E", "B", "the third channel", "the share of a sphere"]];
        for (texels, names) in [&self.matrices, &self.amplitudes].into_iter().zip(names) {
            for (t, texel) in texels.iter().enumerate() {
                let Some(k) = texel.iter().position(|value| !value.is_finite()) else { continue };
                let (roughness, root) = (node(t % self.side, self.side), node(t / self.side, self.side));
                let (what, value, mu) = (names[k], texel[k], 1.0 - root * root);
                return Err(LtcError::NotFinite { what, value, roughness, mu });
            }
        }
        Ok(())
    }

    /// The tables of a lobe: E and B by texels that a lookup between them is best with, and the matrices
    /// for each roughness from the isotropic matrix of mu = 1 on to grazing,
    /// each search starts at its neighbour's matrix. `alpha` is that of a roughness.
    ///
    /// # Errors
    /// A truth that cannot be integrated, a search that fails.
    pub fn fitted(lobe: Lobe, side: usize, alpha: impl Fn(f64) -> f64 + Sync) -> Result<Pair, LtcError> {
        // Texels, and half way between them.
        let fine = 2 * side - 1;
        let place = |t: usize| {
            let root = node(t / fine, fine);
            [lobe.within(alpha(node(t % fine, fine))), 1.0 - root * root]
        };
        let albedos = lobe.albedo(&(0..fine * fine).map(place).collect::<Vec<_>>())?;
        let row = |i: usize| -> Result<Vec<[f64; 4]>, LtcError> {
            let mut matrix = lobe.first(place(2 * i)[0]);
            let one = |k: usize| {
                let at = 2 * (k * fine + i);
                let view = View::of(lobe, place(at), albedos[at][0]);
                matrix = fitted(&view, &lobe.starts(matrix))?;
                Ok(matrix.texel())
            };
            (0..side).map(one).collect()
        };
        let rows: Vec<Vec<[f64; 4]>> = (0..side).into_par_iter().map(row).collect::<Result<_, _>>()?;
        let matrices = (0..side * side).map(|t| rows[t % side][t / side]).collect();
        let [e, b] = [0, 1].map(|column| relaxed(side, |t| albedos[t][column]));
        let texel = |t: usize| [e[t], b[t], 0.0, sphere(t % side, t / side, side)];
        Ok(Pair { side, matrices, amplitudes: (0..side * side).map(texel).collect() })
    }

    /// The pair as texels are stored.
    pub fn stored(&self, stored: impl Fn(f64) -> f64) -> Pair {
        let all = |texels: &[[f64; 4]]| texels.iter().map(|texel| texel.map(&stored)).collect();
        Pair { side: self.side, matrices: all(&self.matrices), amplitudes: all(&self.amplitudes) }
    }

    /// The matrix and the second texel at a place, by the bilinear lookup between texels.
    pub fn at(&self, roughness: f64, mu: f64, lookup: Lookup) -> [[f64; 4]; 2] {
        let texels = [&self.matrices, &self.amplitudes];
        if lookup == Lookup::Half {
            let place = self.place_in_half(roughness, mu);
            return texels.map(|texels| {
                Pair::between(self.side, texels, place, lookup)
                    .map(|x| Half::nearest(x as f32).to_f32().into())
            });
        }
        let place = [roughness, (1.0 - mu).max(0.0).sqrt()];
        texels.map(|texels| Pair::between(self.side, texels, place, lookup))
    }

    /// The place in the unit square by texture coordinates in f16.
    fn place_in_half(&self, roughness: f64, mu: f64) -> [f64; 2] {
        let [roughness, mu] = [roughness, mu].map(|x| Half::nearest(x as f32));
        let n = self.side as f64;
        let [scale, offset] = [(n - 1.0) / n, 0.5 / n].map(|x| Half::nearest(x as f32));
        [roughness, (Half::ONE - mu).root()].map(|at| {
            let coordinate = f64::from((at * scale + offset).to_f32());
            (coordinate * n - 0.5) / (n - 1.0)
        })
    }

    /// The lookup in a texture at a place in the unit square, whose ends are texels.
    pub(crate) fn between(side: usize, texels: &[[f64; 4]], place: [f64; 2], lookup: Lookup) -> [f64; 4] {
        let last = (side - 1) as f64;
        let [(i, u), (k, v)] = place.map(|at| {
            let at = (at * last).clamp(0.0, last);
            let floor = at.floor().min(last - 1.0);
            let weight = at - floor;
            (floor as usize, if lookup == Lookup::Coarse { (weight * 256.0).round() / 256.0 } else { weight })
        });
        let t = |i: usize, k: usize| texels[k * side + i];
        let mix = |a: [f64; 4], b: [f64; 4], t: f64| -> [f64; 4] {
            std::array::from_fn(|c| a[c] + t * (b[c] - a[c]))
        };
        mix(mix(t(i, k), t(i + 1, k), u), mix(t(i, k + 1), t(i + 1, k + 1), u), v)
    }
}

/// Rounds after which the largest error stands still, and the part of a correction that is made in one.
const ROUNDS: usize = 40;
const STEP: f64 = 0.6;

/// Texels whose bilinear lookup is off by as much above as below about each of them: at it and half
/// way to its neighbours. `truth` is of the places of a grid twice as fine.
fn relaxed(side: usize, truth: impl Fn(usize) -> f64) -> Vec<f64> {
    let fine = 2 * side - 1;
    let mut texels: Vec<f64> = (0..side * side).map(|t| truth(2 * (t / side * fine + t % side))).collect();
    for _ in 0..ROUNDS {
        let lookup = |x: usize, y: usize| {
            let at = |x: usize, y: usize| texels[y * side + x];
            let ends = |x: usize| [x / 2, x.div_ceil(2)];
            let ([a, b], [c, d]) = (ends(x), ends(y));
            0.25 * (at(a, c) + at(b, c) + at(a, d) + at(b, d))
        };
        let errors: Vec<f64> = (0..fine * fine).map(|t| lookup(t % fine, t / fine) - truth(t)).collect();
        let errors = &errors;
        let about = |i: usize| (2 * i).saturating_sub(1)..=(2 * i + 1).min(fine - 1);
        let moved = |t: usize| {
            let near = about(t / side).flat_map(|y| about(t % side).map(move |x| errors[y * fine + x]));
            let [low, high] = near.fold([f64::INFINITY, -f64::INFINITY], |[l, h], e| [l.min(e), h.max(e)]);
            texels[t] - STEP * 0.5 * (low + high)
        };
        texels = (0..side * side).map(moved).collect();
    }
    texels
}

/// The share of a sphere over the length of its vector.
fn sphere(i: usize, k: usize, side: usize) -> f64 {
    let (cosine, length) = (2.0 * node(i, side) - 1.0, node(k, side));
    if length == 0.0 { cosine.max(0.0) } else { sphere_share(cosine, length) / length }
}
