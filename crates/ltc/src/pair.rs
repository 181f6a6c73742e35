//! The two tables of a lobe, as engines read them.

use crate::LtcError;
use crate::fit::fitted;
use crate::lobe::{Lobe, View};
use crate::polygon::sphere_share;
use rayon::prelude::*;

/// Texels along both axes of the tables that engines ship.
pub const SIDE: usize = 64;

/// The tables: matrices, and E, B, 0 and the share of a sphere. Texel (i, k) is of roughness i/(n -
/// 1) with alpha = roughness^2, and of mu = 1 - (k/(n - 1))^2; the sphere's, of the cosine 2 i/(n -
/// 1) - 1 and the length k/(n - 1).
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

impl Pair {
    /// The tables of a lobe: for each roughness from the isotropic matrix of mu = 1 on to grazing,
    /// each search starts at its neighbour's matrix. `alpha` is that of a roughness.
    ///
    /// # Errors
    /// A truth that cannot be integrated, a search that fails.
    pub fn fitted(lobe: Lobe, side: usize, alpha: impl Fn(f64) -> f64 + Sync) -> Result<Pair, LtcError> {
        let row = |i: usize| -> Result<(Vec<[f64; 4]>, Vec<[f64; 4]>), LtcError> {
            let alpha = alpha(node(i, side));
            let width = lobe.within(alpha);
            let mu = |k: usize| 1.0 - node(k, side) * node(k, side);
            let albedos = lobe.albedo(&(0..side).map(|k| [width, mu(k)]).collect::<Vec<_>>())?;
            let mut matrix = lobe.first(width);
            let (mut matrices, mut amplitudes) = (Vec::new(), Vec::new());
            for (k, [e, b]) in albedos.into_iter().enumerate() {
                let view = View::of(lobe, [width, mu(k)], e);
                matrix = fitted(&view, &lobe.starts(matrix))?;
                matrices.push(matrix.texel());
                amplitudes.push([e, b, 0.0, sphere(i, k, side)]);
            }
            Ok((matrices, amplitudes))
        };
        let rows: Vec<_> = (0..side).into_par_iter().map(row).collect::<Result<_, _>>()?;
        let texels = |of: fn(&(Vec<[f64; 4]>, Vec<[f64; 4]>)) -> &Vec<[f64; 4]>| {
            (0..side * side).map(|t| of(&rows[t % side])[t / side]).collect::<Vec<_>>()
        };
        Ok(Pair { side, matrices: texels(|row| &row.0), amplitudes: texels(|row| &row.1) })
    }

    /// The pair as texels are stored.
    pub fn stored(&self, stored: impl Fn(f64) -> f64) -> Pair {
        let all = |texels: &[[f64; 4]]| texels.iter().map(|texel| texel.map(&stored)).collect();
        Pair { side: self.side, matrices: all(&self.matrices), amplitudes: all(&self.amplitudes) }
    }

    /// The matrix and the second texel at a place, by the bilinear lookup between texels, whose
    /// weights are multiples of 2^-8 where `coarse`.
    pub fn at(&self, roughness: f64, mu: f64, coarse: bool) -> [[f64; 4]; 2] {
        let place = [roughness, (1.0 - mu).max(0.0).sqrt()];
        let last = (self.side - 1) as f64;
        let [(i, u), (k, v)] = place.map(|at| {
            let at = (at * last).clamp(0.0, last);
            let floor = at.floor().min(last - 1.0);
            let weight = at - floor;
            (floor as usize, if coarse { (weight * 256.0).round() / 256.0 } else { weight })
        });
        [&self.matrices, &self.amplitudes].map(|texels| {
            let t = |i: usize, k: usize| texels[k * self.side + i];
            let mix = |a: [f64; 4], b: [f64; 4], t: f64| -> [f64; 4] {
                std::array::from_fn(|c| a[c] + t * (b[c] - a[c]))
            };
            mix(mix(t(i, k), t(i + 1, k), u), mix(t(i, k + 1), t(i + 1, k + 1), u), v)
        })
    }
}

/// The share of a sphere over the length of its vector.
fn sphere(i: usize, k: usize, side: usize) -> f64 {
    let (cosine, length) = (2.0 * node(i, side) - 1.0, node(k, side));
    if length == 0.0 { cosine.max(0.0) } else { sphere_share(cosine, length) / length }
}
