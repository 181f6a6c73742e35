//! Points at which approximations are measured: none that they were fitted on, but for the corners of the region.

use super::Region;
use crate::data::{Place, shortest};
use lobefit_math::chebyshev;
use lobefit_math::sobol::Sobol;

/// Inputs as a shader has them, in f32.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointSet {
    /// Roughness.
    pub roughness: Vec<f32>,
    /// alpha, computed from the f32 roughness in f32.
    pub alpha: Vec<f32>,
    /// Cosine of the view.
    pub mu: Vec<f32>,
    /// The first `uniform` points are uniform in (roughness, mu): RMS and mean are taken over them. The others crowd into the
    /// layer mu ~ alpha and onto the edges, where the largest errors hide.
    pub uniform: usize,
}

/// Points walked along each edge of the region.
const EDGE: usize = 1 << 12;

/// 2^log2 scrambled Sobol points uniform in (roughness, mu), half as many uniform in roughness and in the homogeneous
/// coordinate sqrt(mu (1+alpha)/(mu+alpha)), and all four edges with their corners.
pub fn certification(region: &Region, log2: u32) -> PointSet {
    let mut points = PointSet::default();
    let uniform = Sobol::new([0x9e37_79b9, 0x7f4a_7c15, 0]);
    for i in 0..1_u32 << log2 {
        let mu = lerp(region.mu, uniform.coordinate(i, 1));
        points.push(region, lerp(region.roughness, uniform.coordinate(i, 0)), mu);
    }
    points.uniform = points.len();
    let layer = Sobol::new([0x2545_f491, 0x4f6c_dd1d, 0]);
    for i in 0..1_u32 << (log2 - 1) {
        let roughness = lerp(region.roughness, layer.coordinate(i, 0));
        points.push_layer(region, roughness, layer.coordinate(i, 1));
    }
    for i in 0..=EDGE {
        let t = i as f64 / EDGE as f64;
        for end in [0.0, 1.0] {
            points.push(region, lerp(region.roughness, end), lerp(region.mu, t));
            points.push_layer(region, lerp(region.roughness, end), t);
            points.push(region, lerp(region.roughness, t), lerp(region.mu, end));
        }
    }
    points
}

impl PointSet {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.mu.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.mu.is_empty()
    }

    /// A column of inputs by name; none of an input that the set does not have.
    pub fn column(&self, name: &str) -> Option<&[f32]> {
        match name {
            "roughness" => Some(&self.roughness),
            "alpha" => Some(&self.alpha),
            "mu" => Some(&self.mu),
            _ => None,
        }
    }

    /// Point `i` by input name, each in the shortest decimal that reads back to its f32.
    pub fn place(&self, i: usize) -> Place {
        let inputs = [("alpha", self.alpha[i]), ("mu", self.mu[i]), ("roughness", self.roughness[i])];
        inputs.into_iter().map(|(name, x)| (name.to_string(), shortest(x))).collect()
    }

    /// Adds a point as a shader has it, rounded to the nearest f32 (at an edge of the region that may lie outside by half an ulp).
    pub fn push(&mut self, region: &Region, roughness: f64, mu: f64) {
        let roughness = roughness as f32;
        self.roughness.push(roughness);
        self.alpha.push(region.alpha_map.alpha_f32(roughness));
        self.mu.push(mu as f32);
    }
}

impl PointSet {
    /// Adds the point at fraction `t` of the region's range of the homogeneous coordinate.
    pub fn push_layer(&mut self, region: &Region, roughness: f64, t: f64) {
        self.push(region, roughness, layer_mu(region.mu, region.alpha_map.alpha(roughness), t));
    }
}

/// The value at a part `t` of a range; both ends are exact.
pub(crate) fn lerp(range: [f64; 2], t: f64) -> f64 {
    if t == 1.0 { range[1] } else { range[0] + (range[1] - range[0]) * t }
}

/// Smallest alpha of the layer mu ~ alpha: below it nothing is left of it.
const SMALLEST: f64 = 1e-7;

/// mu at a part `t` of its range in the homogeneous coordinate u = sqrt(mu (1 + alpha)/(mu + alpha)), in which the layer mu ~ alpha
/// is as wide as the rest.
pub(crate) fn layer_mu(mu: [f64; 2], alpha: f64, t: f64) -> f64 {
    let alpha = alpha.max(SMALLEST);
    let u = lerp(mu.map(|mu| (mu * (1.0 + alpha) / (mu + alpha)).sqrt()), t);
    (alpha * u * u / ((1.0 - u * u) + alpha)).clamp(mu[0], mu[1])
}

/// Centres of n x n equal cells: their mean square is the midpoint rule of the uniform RMS.
pub(crate) fn uniform(region: &Region, n: usize) -> PointSet {
    let mut points = PointSet::default();
    for j in 0..n {
        for i in 0..n {
            let centre = |k: usize, [low, high]: [f64; 2]| low + (high - low) * (k as f64 + 0.5) / n as f64;
            points.push(region, centre(j, region.roughness), centre(i, region.mu));
        }
    }
    points.uniform = points.len();
    points
}

/// A lattice of about n x n points with the edges, denser towards them: half of its columns uniform in mu, half in the homogeneous
/// coordinate.
pub(crate) fn edged(region: &Region, n: usize) -> PointSet {
    let mut points = PointSet::default();
    let half = (n / 2).max(2);
    let nodes = |[low, high]: [f64; 2], n: usize| chebyshev::nodes(low, high, n);
    for roughness in nodes(region.roughness, n) {
        for mu in nodes(region.mu, half) {
            points.push(region, roughness, mu);
        }
        for i in 0..half {
            points.push_layer(region, roughness, (i as f64 + 0.5) / half as f64);
        }
    }
    points
}
