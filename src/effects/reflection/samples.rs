//! What fits are made on and measured at: sets of points that have nothing in common but the corners of the region.

use rayon::prelude::*;

use crate::approximate::{Counter, Field, PointSet, Region, average_truth, certification, edged, uniform};
use crate::data::{Norm, Smith, Use};
use lobefit_fit::{FitError, Samples};
use lobefit_math::chebyshev;
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::IntegrateError;

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

/// Samples that the average is fitted on.
const AVERAGE_GRID: usize = 257;

impl AverageData {
    /// Integrates E_avg at the nodes of an interpolant, and evaluates that at the points.
    pub fn new(smith: Smith, region: &Region, counter: &Counter) -> Result<AverageData, IntegrateError> {
        let [low, high] = region.roughness;
        let truth = average_truth(smith, region, counter)?;
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
