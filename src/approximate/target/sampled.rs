//! Scale and target at points: what a formula is fitted on and measured against.

use super::f0::{self, Choice};
use super::points;
use super::{Span, Target, TargetError};
use crate::approximate::Memo;
use crate::data::{AlphaMap, Place};
use lobefit_fit::{FitError, Samples};
use lobefit_shade::ShadeError;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Parts, Truth};

/// Points with the residual `scale f - target` of the use.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// The points, f0 among their columns where it is an input.
    pub points: Points,
    /// Factor of the formula's value.
    pub scale: Vec<f64>,
    /// What the product should be.
    pub target: Vec<f64>,
    /// Integrals that the truth took, or evaluations of integrands.
    pub integrals: u64,
}

impl Sampled {
    /// The columns of the inputs named, as a shader has them.
    ///
    /// # Errors
    /// An input that the target does not have.
    pub fn inputs(&self, function: &str, names: &[String]) -> Result<Vec<Vec<f32>>, ShadeError> {
        let column = |name: &String| {
            self.points.column_f32(name).ok_or_else(|| ShadeError::UnknownInput {
                function: function.into(),
                input: name.clone(),
                given: self.points.columns().map(|(name, _)| name).collect::<Vec<_>>().join(", "),
            })
        };
        names.iter().map(column).collect()
    }

    /// The same in f64, as a fit takes them; weights, where given, multiply scale and target.
    ///
    /// # Errors
    /// As [`Sampled::inputs`].
    pub fn samples(
        &self,
        function: &str,
        names: &[String],
        weights: Option<&[f64]>,
    ) -> Result<Samples, FitError> {
        let wide = |column: Vec<f32>| column.into_iter().map(f64::from).collect();
        let weighted = |values: &[f64]| match weights {
            Some(weights) => values.iter().zip(weights).map(|(v, w)| v * w).collect(),
            None => values.to_vec(),
        };
        Ok(Samples {
            inputs: self.inputs(function, names)?.into_iter().map(wide).collect(),
            scale: weighted(&self.scale),
            target: weighted(&self.target),
        })
    }

    /// What the formula itself should be at every point.
    pub fn ideal(&self) -> Vec<f64> {
        self.target.iter().zip(&self.scale).map(|(t, s)| t / s).collect()
    }
}

/// Axes that points do not fill.
const DEEP: usize = 3;

impl Target {
    /// The map that makes alpha, where alpha is an input.
    fn map(&self) -> Option<AlphaMap> {
        self.has_alpha().then_some(self.alpha_map)
    }

    /// Samples for a mean square: a uniform lattice of cell centres.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn even(&self, memo: &Memo) -> Result<Sampled, TargetError> {
        let points = points::even(&self.axes, self.map(), self.effort());
        self.spread(points, Choice::Even, memo)
    }

    /// Samples for the largest error: a lattice with the edges, and the layer mu ~ alpha.
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn edged(&self, memo: &Memo) -> Result<Sampled, TargetError> {
        let points = points::with_edges(&self.axes, self.map(), self.effort());
        self.spread(points, Choice::Edged, memo)
    }

    /// Points to certify at, none of them a sample but for some on the faces of the box; the first
    /// `uniform` are for means.
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn measured(&self, memo: &Memo) -> Result<Sampled, TargetError> {
        let points = points::measured(&self.axes, self.map(), self.effort());
        let (points, truth) = self.open(points, memo)?;
        let Some(span) = &self.f0 else { return Ok(self.used(points, &truth, &[None])) };
        let mean: Vec<Option<f64>> =
            f0::values(span, self.affine, Choice::MeasuredMean).into_iter().map(Some).collect();
        let all: Vec<Option<f64>> =
            f0::values(span, self.affine, Choice::Measured).into_iter().map(Some).collect();
        let mut sampled = self.used(points.head(), &head(&truth, points.uniform), &mean);
        sampled.points.uniform = sampled.points.len();
        sampled.extend(self.used(points, &truth, &all));
        Ok(sampled)
    }

    /// Samples at places of the axes, in order, for each of the values of f0 in turn (ignored where
    /// it is no input).
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn at(&self, places: &[Vec<f64>], f0: &[f64]) -> Result<Sampled, TargetError> {
        let points = points::of(&self.axes, self.map(), places);
        let truth = self.truth(&points)?;
        Ok(match self.f0 {
            Some(_) => self.used(points, &truth, &f0.iter().copied().map(Some).collect::<Vec<_>>()),
            None => self.used(points, &truth, &[None]),
        })
    }

    /// Whether the largest error lies between the points to certify at: truths are dear, or points have to
    /// fill three axes.
    pub fn is_sparse(&self) -> bool {
        let spanned = self.axes.iter().filter(|axis| axis.is_spanned()).count();
        self.f0.is_none() && (self.is_sought() || (spanned >= DEEP && self.is_moderate()))
    }

    /// `count` points in a box about a place, as wide as this part of each axis, and the place itself.
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn near(
        &self,
        place: &Place,
        (width, count): (f64, usize),
        memo: &Memo,
    ) -> Result<Sampled, TargetError> {
        let mut points = points::near(&self.axes, self.map(), place, (width, count));
        points.uniform = points.len();
        let (points, truth) = self.open(points, memo)?;
        Ok(self.used(points, &truth, &[None]))
    }

    fn spread(&self, points: Points, choice: Choice, memo: &Memo) -> Result<Sampled, TargetError> {
        let (points, truth) = self.open(points, memo)?;
        let f0 = self.f0.as_ref().map(|span| f0::values(span, self.affine, choice));
        let f0 = f0.map_or(vec![None], |values| values.into_iter().map(Some).collect());
        Ok(self.used(points, &truth, &f0))
    }

    /// The points with their truth; without those that no formula can be blamed for.
    fn open(&self, points: Points, memo: &Memo) -> Result<(Points, Truth), TargetError> {
        let truth = self.known(&points, memo)?;
        let Some(excuse) = self.excuse() else { return Ok((points, truth)) };
        let open: Vec<bool> = truth.columns[1].iter().map(|excused| *excused == 0.0).collect();
        if !open.contains(&true) {
            return Err(self.all_excused(excuse));
        }
        let pairs = truth.columns[0].iter().zip(&open);
        let left = pairs.filter(|(_, open)| **open).map(|(value, _)| *value).collect();
        Ok((points.marked(&open), Truth { columns: vec![left], ..truth }))
    }

    /// The use of the truth at every point, for each f0 in turn.
    fn used(&self, points: Points, truth: &Truth, f0: &[Option<f64>]) -> Sampled {
        let of = |value: &Option<f64>| {
            let value = value.map(|x| f64::from(x as f32));
            let points = match value {
                Some(x) => points.clone().with("f0", vec![x; points.len()]),
                None => points.clone(),
            };
            let residual = self.used_as.residual;
            let scaled = self.values(truth, value).into_iter().map(|value| residual.scaled(value));
            let (scale, target) = scaled.map(|[scale, target]| (scale, target)).unzip();
            Sampled { points, scale, target, integrals: 0 }
        };
        let mut all = of(&f0[0]);
        f0[1..].iter().for_each(|value| all.extend(of(value)));
        Sampled { integrals: truth.evaluations, ..all }
    }

    /// The values that the use is about.
    fn values(&self, truth: &Truth, f0: Option<f64>) -> Vec<f64> {
        let first = &truth.columns[0];
        let (Some(over), Some(f0)) = (self.over_f0, f0) else { return first.clone() };
        let pairs = first.iter().zip(&truth.columns[1]);
        pairs.map(|(e, b)| over.form.value(Parts::new(*e, *b), f0)).collect()
    }
}

impl Sampled {
    /// The points by cells of the axes, so many along each; cells without a point are left out.
    pub(in crate::approximate) fn cells(&self, axes: &[Span], along: usize) -> Vec<Sampled> {
        let mut cell = vec![0; self.points.len()];
        for axis in axes {
            let column = self.points.column(&axis.name).unwrap_or_default();
            for (cell, x) in cell.iter_mut().zip(column) {
                *cell = *cell * along + ((axis.part(*x) * along as f64) as usize).min(along - 1);
            }
        }
        let mut inside = vec![Vec::new(); along.pow(axes.len() as u32)];
        for (i, cell) in cell.into_iter().enumerate() {
            inside[cell].push(i);
        }
        inside.iter().filter(|inside| !inside.is_empty()).map(|inside| self.picked(inside)).collect()
    }

    /// The points of these numbers, all of them uniform.
    fn picked(&self, numbers: &[usize]) -> Sampled {
        let of = |values: &[f64]| numbers.iter().map(|i| values[*i]).collect();
        let mut points = self.points.picked(numbers);
        points.uniform = points.len();
        Sampled { points, scale: of(&self.scale), target: of(&self.target), integrals: 0 }
    }

    fn extend(&mut self, more: Sampled) {
        self.points.extend(more.points);
        self.scale.extend(more.scale);
        self.target.extend(more.target);
    }
}

/// The truth of the first points.
fn head(truth: &Truth, count: usize) -> Truth {
    let columns = truth.columns.iter().map(|column| column[..count].to_vec()).collect();
    Truth { columns, error: truth.error, evaluations: 0 }
}
