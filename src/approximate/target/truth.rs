//! The truth at points: a quantity's column, or the E and B that a use is made of.

use rayon::prelude::*;

use super::points::{Effort, MANY, Points};
use super::spec::{Given, ROUGHNESS};
use super::{Target, TargetError};
use crate::approximate::{AVERAGE_NODES, Counter, Field, PointSet, Region, TRUTH_ERROR, average_truth};
use crate::data::{Smith, Use};
use lobefit_truth::integrate::{IntegrateError, footprint, sheen};
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::{GGX_REFLECTION, Quantity};

/// The truth at points, before its use.
pub(super) enum Truth {
    /// The column.
    Column(Vec<f64>),
    /// E and B of `ggx-reflection`.
    Split(Vec<f64>, Vec<f64>),
    /// The best width of a fetch, and whether it is saturated.
    Adjusted(Vec<(f64, bool)>),
}

/// Smallest alpha and mu of the fast rules ([`Field`]).
const FAST_FROM: f64 = 1e-4;

/// An f32 next to an end of a range may lie outside of it by this part.
const ROUNDING: f64 = 1e-6;

/// Tolerance of quantities whose promise is finer than a fit has use for.
const TOLERANCE: f64 = 1e-6;

/// Points where a truth costs about a microsecond, some ten of them, a hundred, about a millisecond, and more.
const CHEAP: Effort = Effort { lattice: 96 * 96, log2: MANY };
const SPLIT: Effort = Effort { lattice: 96 * 96, log2: 17 };
const SPLIT_CURVED: Effort = Effort { lattice: 48 * 48, log2: 15 };
const MODERATE: Effort = Effort { lattice: 64 * 64, log2: 15 };
const SOUGHT: Effort = Effort { lattice: 40 * 40, log2: 12 };
const DEAR: Effort = Effort { lattice: 1500, log2: 11 };
const INTERPOLATED: Effort = Effort { lattice: 257, log2: MANY };

/// How a truth is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// The vectorised rule for E.
    Albedo,
    /// The vectorised rule for E and B.
    Split,
    /// The interpolant of E_avg.
    Average,
    /// The rule for the albedo of sheen.
    Sheen,
    /// The best width of a fetch.
    Footprint,
    /// [`Quantity::at`].
    Evaluate,
}

impl Target {
    fn way(&self) -> Way {
        let from = |name: &str| self.axes.iter().find(|a| a.name == name).map_or(0.0, |a| a.range[0]);
        let smallest = FAST_FROM * (1.0 - ROUNDING);
        let fast = self.alpha_map.alpha(from(ROUGHNESS)) >= smallest && from("mu") >= smallest;
        match (self.quantity.name(), self.column) {
            ("diffuse-coupling", _) => Way::Split,
            ("ggx-reflection", _) if self.used_as == Use::F0Blend => Way::Split,
            ("ggx-reflection", "E") if fast => Way::Albedo,
            ("ggx-reflection", "A" | "B") if fast => Way::Split,
            ("ggx-average", "E_avg") => Way::Average,
            ("sheen-charlie", _) => Way::Sheen,
            ("parallax-alpha", "alpha_adjusted") => Way::Footprint,
            _ => Way::Evaluate,
        }
    }

    pub(super) fn effort(&self) -> Effort {
        match (self.way(), self.quantity.name()) {
            (Way::Albedo, _) => CHEAP,
            (Way::Split, _) if self.f0.is_none() || self.affine => SPLIT,
            (Way::Split, _) => SPLIT_CURVED,
            (Way::Average, _) => INTERPOLATED,
            (Way::Sheen, _) | (Way::Evaluate, "ggx-reflection") => MODERATE,
            (Way::Footprint, _) => SOUGHT,
            (Way::Evaluate, _) => DEAR,
        }
    }

    /// Whether a truth takes so long that pictures have to do with few.
    pub fn is_dear(&self) -> bool {
        self.effort() == DEAR
    }

    /// Truths that are integrated for so many points.
    pub fn truths(&self, points: usize) -> usize {
        if self.way() == Way::Average { AVERAGE_NODES } else { points }
    }

    /// A bound on the error of the truths.
    pub fn truth_error(&self) -> f64 {
        match self.way() {
            Way::Evaluate => self.tolerance(),
            Way::Albedo | Way::Split | Way::Average | Way::Sheen => TRUTH_ERROR,
            Way::Footprint => footprint::quick_error(self.kernel()),
        }
    }

    /// The truth at points.
    pub(super) fn truth(&self, points: &Points) -> Result<Truth, TargetError> {
        Ok(match self.way() {
            Way::Albedo => Truth::Column(Field::albedo(self.smith(), &set(points), &Counter::default()).e),
            Way::Split => {
                let (e, b) = self.split(points)?;
                match self.column {
                    "A" => Truth::Column(e.iter().zip(&b).map(|(e, b)| e - b).collect()),
                    "B" => Truth::Column(b),
                    _ => Truth::Split(e, b),
                }
            }
            Way::Average => Truth::Column(self.averages(points)?),
            Way::Sheen => Truth::Column(sheen_albedo(points)),
            Way::Footprint => Truth::Adjusted(self.adjusted(points)?),
            Way::Evaluate => Truth::Column(self.evaluated(points)?),
        })
    }

    /// E and B, by the fast rule where it holds.
    fn split(&self, points: &Points) -> Result<(Vec<f64>, Vec<f64>), TargetError> {
        let points = set(points);
        let smallest = (FAST_FROM * (1.0 - ROUNDING)) as f32;
        if points.alpha.iter().chain(&points.mu).all(|x| *x >= smallest) {
            let field = Field::split(self.smith(), &points, &Counter::default());
            return Ok((field.e, field.b));
        }
        let tolerance = GGX_REFLECTION.tolerance(&self.variant).max(TOLERANCE);
        let one = |(alpha, mu): (&f32, &f32)| {
            let values = GGX_REFLECTION.at(&self.variant, &[f64::from(*alpha), f64::from(*mu)], tolerance)?;
            Ok((values[0], values[2]))
        };
        let pairs: Vec<(&f32, &f32)> = points.alpha.iter().zip(&points.mu).collect();
        let both: Vec<Result<(f64, f64), IntegrateError>> = pairs.into_par_iter().map(one).collect();
        Ok(both.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().unzip())
    }

    /// E_avg, from its interpolant over the target's range.
    fn averages(&self, points: &Points) -> Result<Vec<f64>, TargetError> {
        let roughness = self.axes[0].range;
        let region = Region { roughness, mu: [1.0, 1.0], alpha_map: self.alpha_map };
        if !self.axes[0].is_spanned() {
            return self.evaluated(points);
        }
        let truth = average_truth(self.smith(), &region, &Counter::default())?;
        let alpha = points.column("alpha").unwrap_or_default();
        let [low, high] = region.roughness.map(|r| self.alpha_map.alpha_f32(r as f32));
        // An edge may ask for a width beyond the range.
        if alpha.iter().any(|a| *a < low || *a > high) {
            return self.evaluated(points);
        }
        Ok(alpha.par_iter().map(|a| truth(f64::from(*a))).collect())
    }

    /// The shadowing of the quantities of GGX, which all have one.
    fn smith(&self) -> Smith {
        self.variant.smith.unwrap_or_default()
    }

    /// The lobe that a chain is prefiltered with.
    pub fn kernel(&self) -> &Kernel {
        self.variant.kernel()
    }

    /// The largest error of an evaluation.
    fn tolerance(&self) -> f64 {
        self.quantity.tolerance(&self.variant).max(TOLERANCE)
    }

    /// Best widths, and whether they are saturated.
    fn adjusted(&self, points: &Points) -> Result<Vec<(f64, bool)>, TargetError> {
        let [alpha, rho] = ["alpha", "rho"].map(|name| points.column(name).unwrap_or_default());
        let kernel = self.kernel();
        let one = |(alpha, rho): (&f32, &f32)| {
            let inside = f64::from(*rho).clamp(footprint::RHO[0], footprint::RHO[1]);
            footprint::best(kernel, f64::from(*alpha), inside)
        };
        let found: Vec<Result<_, IntegrateError>> = alpha.par_iter().zip(rho).map(one).collect();
        Ok(found.into_iter().collect::<Result<_, _>>()?)
    }

    /// The column by [`Quantity::at`], point by point.
    fn evaluated(&self, points: &Points) -> Result<Vec<f64>, TargetError> {
        let output = self.quantity.outputs().iter().position(|o| *o == self.column).unwrap_or(0);
        let tolerance = self.tolerance();
        let one = |i: usize| {
            let inputs: Vec<f64> = (0..self.given.len()).map(|k| self.input(points, k, i)).collect();
            Ok(self.quantity.at(&self.variant, &inputs, tolerance)?[output])
        };
        let values: Vec<Result<f64, IntegrateError>> = (0..points.len()).into_par_iter().map(one).collect();
        Ok(values.into_iter().collect::<Result<_, _>>()?)
    }

    /// Input `k` of the quantity at point `i`; one that lies outside its domain by the rounding of an f32 alone is taken for the end.
    fn input(&self, points: &Points, k: usize, i: usize) -> f64 {
        let name = self.quantity.inputs()[k].name;
        let value = match self.given[k] {
            Given::Absent => return f64::NAN,
            Given::Axis(_) | Given::Alpha | Given::F0 => {
                points.column(name).map_or(f64::NAN, |column| f64::from(column[i]))
            }
        };
        let [min, max] = self.quantity.inputs()[k].domain;
        let end = value.clamp(min, max);
        if (value - end).abs() <= ROUNDING * end.abs() { end } else { value }
    }
}

/// E of the sheen lobe, within 1e-11 relative.
fn sheen_albedo(points: &Points) -> Vec<f64> {
    let (alpha, mu) = (points.column("alpha").unwrap_or_default(), points.column("mu").unwrap_or_default());
    let pairs: Vec<(&f32, &f32)> = alpha.iter().zip(mu).collect();
    let inside = |alpha: f32| f64::from(alpha).max(sheen::SMALLEST_ALPHA);
    pairs.into_par_iter().map(|(alpha, mu)| sheen::albedo(inside(*alpha), f64::from(*mu))).collect()
}

/// The points as the fields of `ggx-reflection` take them.
fn set(points: &Points) -> PointSet {
    let column = |name: &str| points.column(name).unwrap_or_default().to_vec();
    PointSet {
        roughness: column(ROUGHNESS),
        alpha: column("alpha"),
        mu: column("mu"),
        uniform: points.uniform,
    }
}
