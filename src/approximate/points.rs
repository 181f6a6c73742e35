//! Points of a region: lattices to fit on, and others to measure at, which share no point but the
//! corners of the region.

use super::Region;
use crate::data::{Place, shortest};
use lobefit_math::chebyshev;
use lobefit_math::sobol::Sobol;
use lobefit_truth::points::Points;

/// Points walked along each edge of the region.
const EDGE: usize = 1 << 12;

/// 2^log2 scrambled Sobol points uniform in (roughness, mu), half as many uniform in roughness and
/// in the homogeneous coordinate sqrt(mu (1+alpha)/(mu+alpha)), and all four edges with their
/// corners.
pub fn certification(region: &Region, log2: u32) -> Points {
    let mut points = Points::default();
    let uniform = Sobol::new([0x9e37_79b9, 0x7f4a_7c15, 0]);
    for i in 0..1_u32 << log2 {
        let mu = lerp(region.mu, uniform.coordinate(i, 1));
        region.push(&mut points, lerp(region.roughness, uniform.coordinate(i, 0)), mu);
    }
    points.uniform = points.len();
    let layer = Sobol::new([0x2545_f491, 0x4f6c_dd1d, 0]);
    for i in 0..1_u32 << (log2 - 1) {
        let roughness = lerp(region.roughness, layer.coordinate(i, 0));
        region.push_layer(&mut points, roughness, layer.coordinate(i, 1));
    }
    for i in 0..=EDGE {
        let t = i as f64 / EDGE as f64;
        for end in [0.0, 1.0] {
            region.push(&mut points, lerp(region.roughness, end), lerp(region.mu, t));
            region.push_layer(&mut points, lerp(region.roughness, end), t);
            region.push(&mut points, lerp(region.roughness, t), lerp(region.mu, end));
        }
    }
    points
}

/// Point `i` by input name, each in the shortest decimal that reads back to its f32.
pub fn place(points: &Points, i: usize) -> Place {
    points.columns().map(|(name, column)| (name.to_string(), shortest(column[i] as f32))).collect()
}

impl Region {
    /// Adds a point as a shader has it, rounded to the nearest f32 (at an edge of the region it may
    /// lie outside by half an ulp): alpha is computed from the f32 roughness in f32.
    pub fn push(&self, points: &mut Points, roughness: f64, mu: f64) {
        let roughness = roughness as f32;
        let alpha = f64::from(self.alpha_map.alpha_f32(roughness));
        points.push([("roughness", f64::from(roughness)), ("alpha", alpha), ("mu", f64::from(mu as f32))]);
    }

    /// Adds the point at fraction `t` of the region's range of the homogeneous coordinate.
    pub fn push_layer(&self, points: &mut Points, roughness: f64, t: f64) {
        self.push(points, roughness, layer_mu(self.mu, self.alpha_map.alpha(roughness), t));
    }
}

/// The value at a part `t` of a range; both ends are exact.
pub(crate) fn lerp(range: [f64; 2], t: f64) -> f64 {
    if t == 1.0 { range[1] } else { range[0] + (range[1] - range[0]) * t }
}

/// Smallest alpha of the layer mu ~ alpha: below it nothing is left of it.
const SMALLEST: f64 = 1e-7;

/// mu at a part `t` of its range in the homogeneous coordinate u = sqrt(mu
/// (1 + alpha)/(mu + alpha)), in which the layer mu ~ alpha is as wide as the rest.
pub(crate) fn layer_mu(mu: [f64; 2], alpha: f64, t: f64) -> f64 {
    let alpha = alpha.max(SMALLEST);
    let u = lerp(mu.map(|mu| (mu * (1.0 + alpha) / (mu + alpha)).sqrt()), t);
    (alpha * u * u / ((1.0 - u * u) + alpha)).clamp(mu[0], mu[1])
}

/// Centres of n x n equal cells: their mean square is the midpoint rule of the uniform RMS.
pub(crate) fn uniform(region: &Region, n: usize) -> Points {
    let mut points = Points::default();
    for j in 0..n {
        for i in 0..n {
            let centre = |k: usize, [low, high]: [f64; 2]| low + (high - low) * (k as f64 + 0.5) / n as f64;
            region.push(&mut points, centre(j, region.roughness), centre(i, region.mu));
        }
    }
    points.uniform = points.len();
    points
}

/// A lattice of about n x n points with the edges, denser towards them: half of its columns uniform
/// in mu, half in the homogeneous coordinate.
pub(crate) fn edged(region: &Region, n: usize) -> Points {
    let mut points = Points::default();
    let half = (n / 2).max(2);
    let nodes = |[low, high]: [f64; 2], n: usize| chebyshev::nodes(low, high, n);
    for roughness in nodes(region.roughness, n) {
        for mu in nodes(region.mu, half) {
            region.push(&mut points, roughness, mu);
        }
        for i in 0..half {
            region.push_layer(&mut points, roughness, (i as f64 + 0.5) / half as f64);
        }
    }
    points
}
