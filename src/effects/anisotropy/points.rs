//! Points at which the lookups of this effect are measured: every combination of scrambled
//! roughnesses and anisotropies, each roughness with cosines of its own, since neighbours of the
//! truth share their work.

use crate::effects::table::{BuildError, LookupPoints, Point, Region, SliceAxis};
use lobefit_math::sobol::Sobol;

/// Roughnesses, anisotropies, and cosines of each kind: uniform, and in the layer mu ~ alpha.
const COUNT: [usize; 3] = [96, 24, 40];

/// The points of a region with slices: columns fastest, then rows, then slices. Both ends of every
/// range are among them. With `azimuth` each has an azimuth of its own, scrambled over [0, pi/2]
/// with its ends; else all have 0, which nothing reads.
///
/// # Errors
/// A region without slices: a defect of the effect.
pub fn judged(region: &Region, azimuth: bool) -> Result<LookupPoints, BuildError> {
    let range = region.slices()?.range;
    let base = Sobol::new([0x9e37_79b9, 0x7f4a_7c15, 0x1656_67b1]);
    let rows: Vec<Point> = spread(COUNT[0], region.roughness, |i| base.coordinate(i, 0))
        .map(|roughness| {
            let roughness = roughness as f32;
            Point { roughness, alpha: region.alpha_map.alpha_f32(roughness), ..Point::default() }
        })
        .collect();
    let slices: Vec<f32> = spread(COUNT[1], range, |i| base.coordinate(i, 1)).map(|a| a as f32).collect();
    let cosines: Vec<Vec<f32>> =
        rows.iter().enumerate().map(|(row, p)| cosines(region, row as u32, f64::from(p.alpha))).collect();
    // in an order of their own: in that of the cosines, which count along a row too, each
    // azimuth goes with a mu
    let azimuths = Sobol::new([0x27d4_eb2f, 0x85eb_ca6b, 7]).padded(0x68e3_1da4);
    let mut all = Vec::with_capacity(rows.len() * slices.len() * 2 * COUNT[2]);
    for &anisotropy in &slices {
        for (row, cosines) in rows.iter().zip(&cosines) {
            for &mu in cosines {
                let phi = std::f64::consts::FRAC_PI_2 * azimuths.coordinate(all.len() as u32, 0);
                let cosine = lobefit_math::ops::cos(phi);
                let cos2_phi = match all.len() % 16 {
                    _ if !azimuth => 1.0,
                    0 => 0.0,
                    8 => 1.0,
                    _ => (cosine * cosine) as f32,
                };
                all.push(Point { mu, anisotropy, cos2_phi, ..*row });
            }
        }
    }
    let uniform = (0..all.len()).map(|i| i % (2 * COUNT[2]) < COUNT[2]).collect();
    Ok(LookupPoints::of(all, uniform, SliceAxis::Anisotropy, azimuth))
}

/// `n` scrambled values of a range, its ends first.
fn spread(n: usize, range: [f64; 2], at: impl Fn(u32) -> f64) -> impl Iterator<Item = f64> {
    let inner = (0..n as u32 - 2).map(move |i| range[0] + (range[1] - range[0]) * at(i));
    range.into_iter().chain(inner)
}

/// Cosines of a row, the ends of the range among each kind.
fn cosines(region: &Region, row: u32, alpha: f64) -> Vec<f32> {
    let sobol = Sobol::new([
        row.wrapping_mul(0x9e37_79b9) ^ 0x94d0_49bb,
        row.wrapping_mul(0x85eb_ca6b) ^ 0x1b87_3593,
        0,
    ]);
    let uniform = spread(COUNT[2], region.mu, |i| sobol.coordinate(i, 0));
    let ends = region.mu.map(|mu| (mu * (1.0 + alpha) / (mu + alpha)).sqrt());
    let layer = spread(COUNT[2], ends, |i| sobol.coordinate(i, 1));
    let homogeneous = |u: f64| (alpha * u * u / ((1.0 - u * u) + alpha)).clamp(region.mu[0], region.mu[1]);
    uniform.chain(layer.map(homogeneous)).map(|mu| mu as f32).collect()
}
