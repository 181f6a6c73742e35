//! Scale and target at points: what a formula is fitted on and measured against.

use super::f0::{self, Choice};
use super::points::{self, Points};
use super::truth::Truth;
use super::{Target, TargetError};
use crate::data::{AlphaMap, Use};
use lobefit_fit::{FitError, Samples};
use lobefit_shade::ShadeError;
use lobefit_truth::integrate::coupling::Specular;

/// Points with the residual `scale f - target` of the use.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// The points, f0 among their columns where it is an input.
    pub points: Points,
    /// Factor of the formula's value.
    pub scale: Vec<f64>,
    /// What the product should be.
    pub target: Vec<f64>,
}

impl Sampled {
    /// The columns of the inputs named, as a shader has them.
    ///
    /// # Errors
    /// An input that the target does not have.
    pub fn inputs(&self, function: &str, names: &[String]) -> Result<Vec<Vec<f32>>, ShadeError> {
        let column = |name: &String| {
            self.points.column(name).map(<[f32]>::to_vec).ok_or_else(|| ShadeError::UnknownInput {
                function: function.into(),
                input: name.clone(),
                given: self.points.columns.iter().map(|c| c.0.clone()).collect::<Vec<_>>().join(", "),
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

impl Target {
    /// The map that makes alpha, where alpha is an input.
    fn map(&self) -> Option<AlphaMap> {
        self.has_alpha().then_some(self.alpha_map)
    }

    /// Samples for a mean square: a uniform lattice of cell centres.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn even(&self) -> Result<Sampled, TargetError> {
        let points = points::even(&self.axes, self.map(), self.effort());
        self.spread(points, Choice::Even)
    }

    /// Samples for the largest error: a lattice with the edges, and the layer mu ~ alpha.
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn edged(&self) -> Result<Sampled, TargetError> {
        let points = points::with_edges(&self.axes, self.map(), self.effort());
        self.spread(points, Choice::Edged)
    }

    /// Points to certify at, none of them a sample but for some on the faces of the box; the first `uniform` are for means.
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn measured(&self) -> Result<Sampled, TargetError> {
        let points = points::measured(&self.axes, self.map(), self.effort());
        let (points, truth) = self.open(points)?;
        let Some(span) = &self.f0 else { return Ok(self.used(points, &truth, &[None])) };
        let mean: Vec<Option<f64>> =
            f0::values(span, self.affine, Choice::MeasuredMean).into_iter().map(Some).collect();
        let all: Vec<Option<f64>> =
            f0::values(span, self.affine, Choice::Measured).into_iter().map(Some).collect();
        let (first, first_truth) = head(&points, &truth);
        let mut sampled = self.used(first, &first_truth, &mean);
        sampled.points.uniform = sampled.points.len();
        sampled.extend(self.used(points, &truth, &all));
        Ok(sampled)
    }

    /// Samples at places of the axes, in order, for each of the values of f0 in turn (ignored where it is no input).
    ///
    /// # Errors
    /// As [`Target::even`].
    pub fn at(&self, places: &[Vec<f64>], f0: &[f64]) -> Result<Sampled, TargetError> {
        let points = Points::of(&self.axes, self.map(), places);
        let truth = self.truth(&points)?;
        Ok(match self.f0 {
            Some(_) => self.used(points, &truth, &f0.iter().copied().map(Some).collect::<Vec<_>>()),
            None => self.used(points, &truth, &[None]),
        })
    }

    fn spread(&self, points: Points, choice: Choice) -> Result<Sampled, TargetError> {
        let (points, truth) = self.open(points)?;
        let f0 = self.f0.as_ref().map(|span| f0::values(span, self.affine, choice));
        let f0 = f0.map_or(vec![None], |values| values.into_iter().map(Some).collect());
        Ok(self.used(points, &truth, &f0))
    }

    /// The points with their truth; without those where a fetch is saturated, of which no formula is to blame.
    fn open(&self, points: Points) -> Result<(Points, Truth), TargetError> {
        let truth = self.truth(&points)?;
        let Truth::Adjusted(widths) = &truth else { return Ok((points, truth)) };
        let open: Vec<bool> = widths.iter().map(|(_, saturated)| !saturated).collect();
        if !open.contains(&true) {
            return Err(self.all_saturated());
        }
        let kept = Truth::Adjusted(widths.iter().copied().filter(|(_, saturated)| !saturated).collect());
        Ok((points.kept(&open), kept))
    }

    /// The use of the truth at every point, for each f0 in turn.
    fn used(&self, points: Points, truth: &Truth, f0: &[Option<f64>]) -> Sampled {
        let mut all = Sampled { points: Points::default(), scale: Vec::new(), target: Vec::new() };
        for value in f0 {
            let mut points = points.clone();
            let value = value.map(|x| x as f32);
            points.columns.extend(value.map(|x| ("f0".to_string(), vec![x; points.len()])));
            let values = self.values(truth, f64::from(value.unwrap_or(1.0)));
            let ones = vec![1.0; values.len()];
            let (scale, target) = match self.used_as {
                Use::Normalisation => (values, ones),
                Use::Parallax => (values.into_iter().map(|width| 1.0 / width).collect(), ones),
                _ => (ones, values),
            };
            let sampled = Sampled { points, scale, target };
            if all.points.columns.is_empty() { all = sampled } else { all.extend(sampled) }
        }
        all
    }

    /// The values that the use is about.
    fn values(&self, truth: &Truth, f0: f64) -> Vec<f64> {
        let (e, b) = match truth {
            Truth::Column(values) => return values.clone(),
            Truth::Adjusted(widths) => return widths.iter().map(|(width, _)| *width).collect(),
            Truth::Split(e, b) => (e, b),
        };
        let specular = self.variant.specular;
        let value = |(e, b): (&f64, &f64)| {
            // A/E, the share of the lobe that f0 scales
            let share = 1.0 - b / e;
            let left = 1.0 - f0;
            match specular {
                None => f0 * e + left * b,
                Some(Specular::Single) => 1.0 - (f0 * e + left * b),
                Some(Specular::Normalised) => left * share,
                // 1 - spec with the factor 1 + f0 (1/E - 1)
                Some(Specular::Compensated) => left * (share + (1.0 - e) * (1.0 - left * share)),
            }
        };
        e.iter().zip(b).map(value).collect()
    }
}

impl Sampled {
    fn extend(&mut self, more: Sampled) {
        for ((_, column), (_, rest)) in self.points.columns.iter_mut().zip(more.points.columns) {
            column.extend(rest);
        }
        self.scale.extend(more.scale);
        self.target.extend(more.target);
    }
}

/// The uniform points and their truth.
fn head(points: &Points, truth: &Truth) -> (Points, Truth) {
    let n = points.uniform;
    let columns = points.columns.iter().map(|(name, column)| (name.clone(), column[..n].to_vec())).collect();
    let truth = match truth {
        Truth::Column(values) => Truth::Column(values[..n].to_vec()),
        Truth::Split(e, b) => Truth::Split(e[..n].to_vec(), b[..n].to_vec()),
        Truth::Adjusted(widths) => Truth::Adjusted(widths[..n].to_vec()),
    };
    (Points { columns, uniform: n }, truth)
}
