//! A grid of roughness and mu: what the pictures of approximations are drawn over.

use super::BakeError;
use super::demand::Span;
use crate::approximate::{Fit, FitStageError, Region};
use crate::report::{Field, FitCurve, Ruler};
use lobefit_truth::points::Points;

/// Side of the maps' grids.
const MAP: usize = 64;

/// Cosines of a curve.
pub const COSINES: usize = 64;

/// Fewest of the wanted roughnesses that a range must hold; a narrower range is divided evenly
/// instead.
const FEWEST: usize = 3;

/// A grid, roughness along rows.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Ruler of roughness.
    pub roughness: Ruler,
    /// Ruler of mu.
    pub mu: Ruler,
    /// Its points.
    pub points: Points,
}

impl Grid {
    /// Over two rulers.
    pub fn new(region: &Region, roughness: Ruler, mu: Ruler) -> Grid {
        let mut points = Points::default();
        for m in &mu.values {
            for r in &roughness.values {
                region.push(&mut points, *r, *m);
            }
        }
        Grid { roughness, mu, points }
    }

    /// The grid of maps: even in roughness, mu quadratically denser towards grazing.
    pub fn map(region: &Region) -> Grid {
        Grid::new(region, even(region, MAP), grazing(region, MAP))
    }

    /// The grid of curves over mu, at the wanted roughnesses that lie in the region.
    pub fn curves(region: &Region, wanted: &[f64]) -> Grid {
        Grid::new(region, chosen(region, wanted), grazing(region, COSINES))
    }

    /// This grid, with inputs that have one value each.
    pub fn at(self, inputs: &[(&'static str, f64)]) -> Grid {
        Grid { points: at(self.points, inputs), ..self }
    }

    /// A formula at every point, for one f0.
    ///
    /// # Errors
    /// A formula of other inputs.
    pub fn values(&self, fit: &Fit, f0: f64) -> Result<Vec<f64>, BakeError> {
        let values = fit.values_for(&self.points, f0 as f32).map_err(FitStageError::from)?;
        Ok(values.into_iter().map(f64::from).collect())
    }

    /// A field over the grid, roughness along x and mu along y.
    pub fn field(&self, name: &str, signed: bool, values: impl Iterator<Item = f64>) -> Field {
        Field {
            name: name.into(),
            unit: String::new(),
            signed,
            x: self.roughness.clone(),
            y: self.mu.clone(),
            values: values.map(|v| v as f32).collect(),
        }
    }

    /// Values at every point as one list over mu for each roughness.
    pub fn by_roughness(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let columns = self.roughness.values.len();
        (0..columns).map(|k| values.iter().skip(k).step_by(columns).copied().collect()).collect()
    }

    /// A truth and its fit over mu, one for each roughness.
    pub fn lines(&self, truth: &[f64], fit: &[f64]) -> Vec<FitCurve> {
        let pairs = self.by_roughness(truth).into_iter().zip(self.by_roughness(fit));
        let curve = |(roughness, (truth, fit)): (&f64, (Vec<f64>, Vec<f64>))| FitCurve {
            roughness: *roughness,
            mu: self.mu.values.clone(),
            truth,
            fit,
        };
        self.roughness.values.iter().zip(pairs).map(curve).collect()
    }
}

/// `n` even roughnesses of a region; of one roughness, to both sides of it.
pub fn even(region: &Region, n: usize) -> Ruler {
    let [low, high] = Span::roughness(region.roughness, region.alpha_map).widened();
    Ruler::even("roughness", low, high, n)
}

/// What is to be said of the maps of a region of one roughness; nothing of another.
pub fn beside_text(region: &Region) -> String {
    let [low, high] = region.roughness;
    if low < high {
        return String::new();
    }
    format!("The fits are of roughness {low} alone; maps go a little to both sides of it.")
}

/// `n` cosines of a region, quadratically denser towards grazing.
pub fn grazing(region: &Region, n: usize) -> Ruler {
    let [low, high] = region.mu;
    let at = |i: usize| {
        let t = i as f64 / (n - 1) as f64;
        low + (high - low) * t * t
    };
    Ruler { name: "mu".into(), values: (0..n).map(at).collect() }
}

/// The wanted roughnesses that lie in the region, or an even division of a range that holds too
/// few; of one roughness, that.
pub fn chosen(region: &Region, wanted: &[f64]) -> Ruler {
    let [low, high] = region.roughness;
    let values: Vec<f64> = wanted.iter().copied().filter(|r| (low..=high).contains(r)).collect();
    if low == high {
        Ruler { name: "roughness".into(), values: vec![low] }
    } else if values.len() < FEWEST {
        Ruler::even("roughness", low, high, 5)
    } else {
        Ruler { name: "roughness".into(), values }
    }
}

/// Points with inputs that have one value each.
pub fn at(points: Points, inputs: &[(&'static str, f64)]) -> Points {
    inputs.iter().fold(points, |points, (input, value)| {
        let count = points.len();
        points.with(input, vec![f64::from(*value as f32); count])
    })
}

/// Where the other inputs stand in a picture: ` at ior 1.5`.
pub fn at_text(shown: &[(&str, f64)]) -> String {
    let at: Vec<String> = shown.iter().map(|(input, value)| format!("{input} {value}")).collect();
    if at.is_empty() { String::new() } else { format!(" at {}", at.join(", ")) }
}
