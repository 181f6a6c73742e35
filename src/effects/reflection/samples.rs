//! What fits are made on and measured at: sets of points that have nothing in common but the corners of the region.

use rayon::prelude::*;

use super::{Counter, Field, PointSet, Region, certification};
use crate::data::{Norm, Smith, Use};
use lobefit_fit::{FitError, Samples};
use lobefit_math::chebyshev::{self, Chebyshev};
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::reflection::{TOLERANCE, average};

/// 2^20 uniform points, half as many in the layer mu ~ alpha, and the edges.
const LOG2_POINTS: u32 = 20;

/// Samples per axis of the grids that fits are made on.
const GRID: usize = 96;

/// The use of the normalisations.
const NORMALISATION: (&str, &str, Use) = ("ggx-reflection", "E", Use::Normalisation);

/// The use of the averages.
const AVERAGE: (&str, &str, Use) = ("ggx-average", "E_avg", Use::Value);

/// Data of one kind of fit.
pub(super) trait Data: Sync {
    /// What a hypothesis is fitted on.
    fn samples(&self, hypothesis: &Hypothesis, norm: Norm) -> Result<Samples, FitError>;
    /// Where it is measured.
    fn points(&self) -> &PointSet;
    /// Scale and target at those points.
    fn truth(&self) -> (&[f64], &[f64]);
    /// Quantity, column and use.
    fn use_of(&self) -> (&'static str, &'static str, Use);
    /// The inputs that a place is told by.
    fn places(&self, inputs: &[String]) -> Vec<String> {
        let mut names: Vec<String> = ["alpha", "mu", "roughness"].map(String::from).to_vec();
        names.extend(inputs.iter().filter(|i| i.as_str() == "f0").cloned());
        names
    }
}

/// Furnace data: scale E, target 1.
pub(super) struct FitData {
    /// Grid for least squares, uniform in roughness and mu.
    uniform: (PointSet, Field),
    /// Grid for minimax: uniform and layer columns with the edges.
    edged: (PointSet, Field),
    points: PointSet,
    truth: Field,
    ones: Vec<f64>,
}

impl FitData {
    /// Integrates E on the grids and at the points of measurement.
    pub fn new(smith: Smith, region: &Region, counter: &Counter) -> Result<FitData, IntegrateError> {
        let with_truth = |points: PointSet| {
            let field = Field::albedo(smith, &points, counter);
            (points, field)
        };
        let (points, truth) = with_truth(certification(region, LOG2_POINTS));
        let ones = vec![1.0; points.len()];
        Ok(FitData {
            uniform: with_truth(uniform(region, GRID)),
            edged: with_truth(edged(region, GRID)),
            points,
            truth,
            ones,
        })
    }
}

impl Data for FitData {
    fn samples(&self, hypothesis: &Hypothesis, norm: Norm) -> Result<Samples, FitError> {
        let (points, field) = match norm {
            Norm::Rms => &self.uniform,
            Norm::Max => &self.edged,
        };
        let wide = |column: Vec<f32>| column.into_iter().map(f64::from).collect();
        Ok(Samples {
            inputs: hypothesis.inputs().iter().map(|name| wide(points.column(name))).collect(),
            scale: field.e.clone(),
            target: vec![1.0; points.len()],
        })
    }

    fn points(&self) -> &PointSet {
        &self.points
    }

    fn truth(&self) -> (&[f64], &[f64]) {
        (&self.truth.e, &self.ones)
    }

    fn use_of(&self) -> (&'static str, &'static str, Use) {
        NORMALISATION
    }
}

/// Centres of n x n equal cells: their mean square is the midpoint rule of the uniform RMS.
pub(in crate::effects) fn uniform(region: &Region, n: usize) -> PointSet {
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
pub(in crate::effects) fn edged(region: &Region, n: usize) -> PointSet {
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

/// Data of the average: scale 1, target E_avg(alpha).
pub(super) struct AverageData {
    /// Grid for least squares, uniform in roughness.
    uniform: (PointSet, Vec<f64>),
    /// Grid for minimax, with the ends and denser towards them.
    edged: (PointSet, Vec<f64>),
    points: PointSet,
    truth: Vec<f64>,
    ones: Vec<f64>,
}

/// Nodes of the interpolant of E_avg over ln(alpha), in which it is analytic: within 1e-9 for alpha in [1e-4, 1] (tested below).
const AVERAGE_NODES: usize = 48;

/// Samples that the average is fitted on.
const AVERAGE_GRID: usize = 257;

/// Smallest alpha of the interpolant; E_avg is 1 within 1e-13 below.
const AVERAGE_SMALLEST: f64 = 1e-7;

impl AverageData {
    /// Integrates E_avg at the nodes of an interpolant, and evaluates that at the points.
    pub fn new(smith: Smith, region: &Region, counter: &Counter) -> Result<AverageData, IntegrateError> {
        let [low, high] = region.roughness;
        let truth = interpolant(smith, region, counter)?;
        let with_truth = |mut points: PointSet| {
            points.mu = vec![1.0; points.len()];
            let values = points.alpha.par_iter().map(|a| truth(f64::from(*a))).collect();
            (points, values)
        };
        let grid = |roughnesses: Vec<f64>| {
            let mut points = PointSet::default();
            roughnesses.into_iter().for_each(|roughness| points.push(region, roughness, 1.0));
            with_truth(points)
        };
        let centre = |i: usize| low + (high - low) * (i as f64 + 0.5) / AVERAGE_GRID as f64;
        let uniform = grid((0..AVERAGE_GRID).map(centre).collect());
        let edged = grid(chebyshev::nodes(low, high, AVERAGE_GRID));
        let (points, truth) = with_truth(certification(region, LOG2_POINTS));
        let ones = vec![1.0; points.len()];
        Ok(AverageData { uniform, edged, points, truth, ones })
    }
}

/// E_avg of a width within the region, by interpolation.
pub(in crate::effects) fn interpolant(
    smith: Smith,
    region: &Region,
    counter: &Counter,
) -> Result<impl Fn(f64) -> f64 + Sync + use<>, IntegrateError> {
    let [low, high] = region.alpha().map(|a| lobefit_math::ops::log(a.max(AVERAGE_SMALLEST)));
    let nodes = chebyshev::nodes(low, high, AVERAGE_NODES);
    counter.add(nodes.len());
    let value = |x: &f64| average(smith, lobefit_math::ops::exp(*x).min(1.0), TOLERANCE).map(|v| v.e_avg);
    let values: Vec<Result<f64, IntegrateError>> = nodes.par_iter().map(value).collect();
    let interpolant = Chebyshev::new(low, high, values.into_iter().collect::<Result<_, _>>()?);
    Ok(move |alpha: f64| interpolant.at(lobefit_math::ops::log(alpha.max(AVERAGE_SMALLEST)).clamp(low, high)))
}

impl Data for AverageData {
    fn samples(&self, hypothesis: &Hypothesis, norm: Norm) -> Result<Samples, FitError> {
        let (points, values) = match norm {
            Norm::Rms => &self.uniform,
            Norm::Max => &self.edged,
        };
        let wide = |column: Vec<f32>| column.into_iter().map(f64::from).collect();
        Ok(Samples {
            inputs: hypothesis.inputs().iter().map(|name| wide(points.column(name))).collect(),
            scale: vec![1.0; values.len()],
            target: values.clone(),
        })
    }

    fn points(&self) -> &PointSet {
        &self.points
    }

    fn truth(&self) -> (&[f64], &[f64]) {
        (&self.ones, &self.truth)
    }

    fn use_of(&self) -> (&'static str, &'static str, Use) {
        AVERAGE
    }

    fn places(&self, _: &[String]) -> Vec<String> {
        ["alpha", "roughness"].map(String::from).to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AlphaMap;

    #[test]
    fn the_interpolant_of_the_average_is_within_its_bound() {
        for (smith, alpha_map) in
            [(Smith::Correlated, AlphaMap::RoughnessSquared), (Smith::Separable, AlphaMap::Roughness)]
        {
            let region = Region { roughness: [1e-2, 1.0], mu: [0.01, 1.0], alpha_map };
            let truth = interpolant(smith, &region, &Counter::default()).expect("in the domain");
            let [low, high] = region.alpha();
            for i in 0..200 {
                let t = (f64::from(i) + 0.37) / 200.0;
                let alpha = lobefit_math::ops::pow(low, 1.0 - t) * lobefit_math::ops::pow(high, t);
                let exact = average(smith, alpha, TOLERANCE).expect("in the domain").e_avg;
                assert!((truth(alpha) - exact).abs() < 1e-9, "{smith:?} {alpha}: {} {exact}", truth(alpha));
            }
        }
    }
}
