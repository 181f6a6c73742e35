//! `ggx-reflection-aniso`: E and loss of the anisotropic GGX lobe.

use rayon::prelude::*;

use super::{Asked, Choice, Facts, Fresnel, Input, MU, Quantity, Trace, Truth, Variant};
use crate::integrate::aniso::fast::{self, Interpolants, Place};
use crate::integrate::monte_carlo::{self, Draw, Run, Sampled};
use crate::integrate::{IntegrateError, Path, aniso};
use crate::optics::Smith;
use crate::points::Points;

/// `ggx-reflection-aniso`: the directional albedo at an azimuth of the view, or its mean over the
/// azimuth.
#[derive(Clone, Copy, Debug)]
pub struct GgxReflectionAniso;

/// Widths along the tangent and across it.
const WIDTHS: [f64; 2] = [0.0, aniso::ALPHA[1]];

/// Azimuth of the view from the alpha_x axis, radians.
pub(super) const PHI: Input = Input {
    optional: true,
    ..Input::new("phi", [f64::MIN, f64::MAX]).usually([0.0, std::f64::consts::FRAC_PI_2])
};

/// The widths; fits begin where lobes are as wide as in published comparisons.
pub(super) const ALPHA_X: Input = Input::new("alpha_x", WIDTHS).usually([0.02, 1.0]).studied([0.5, 0.02]);
pub(super) const ALPHA_Y: Input = Input::new("alpha_y", WIDTHS).usually([0.02, 1.0]).studied([0.25, 0.8]);

/// Finest tolerance of the interpolants, of the mean and at an azimuth: finer than it, the rule of
/// the nodes errs where alpha and mu are both near 1e-4.
const FINEST: [f64; 2] = [1e-6, 1e-5];

/// An optional input.
fn given(x: f64) -> Option<f64> {
    (!x.is_nan()).then_some(x)
}

impl GgxReflectionAniso {
    /// E at points, as [`Quantity::truth`] has it, and the interpolants that it was read off, for
    /// other points between these. There are none where every point was integrated.
    ///
    /// # Errors
    /// As [`Quantity::truth`].
    pub fn interpolated(
        &self,
        smith: Smith,
        points: &Points,
        tolerance: f64,
    ) -> Result<(Truth, Interpolants), IntegrateError> {
        let asked = Asked { variant: &Variant::from(smith), points, outputs: &["E"], tolerance };
        match self.shared(&asked)? {
            Some(both) => Ok(both),
            None => Ok((asked.each(self, &asked.places(self)?)?, Interpolants::default())),
        }
    }

    /// E from interpolants over neighbouring points; beyond their domain every point is integrated.
    fn shared(&self, asked: &Asked) -> Result<Option<(Truth, Interpolants)>, IntegrateError> {
        let columns = asked.inputs(self)?;
        let finest = FINEST[usize::from(columns[3].is_some())];
        if asked.tolerance < finest || asked.outputs != ["E"] {
            return Ok(None);
        }
        let smith = asked.variant.smith(self.name())?;
        let x = |k: usize, i: usize| columns[k].map_or(f64::NAN, |column| column[i]);
        let place = |i: usize| {
            let phi = columns[3].map(|phi| phi[i]);
            Place { alpha: [x(0, i), x(1, i)], mu: x(2, i), phi }
        };
        let places: Vec<Place> = (0..asked.points.len()).map(place).collect();
        let (near, far): (Vec<usize>, Vec<usize>) = (0..places.len()).partition(|i| places[*i].is_covered());
        let covered: Vec<Place> = near.iter().map(|i| places[*i]).collect();
        let many = match fast::many(Path::Best, smith, &covered, asked.tolerance) {
            Err(IntegrateError::Tolerance { .. }) => return Ok(None),
            many => many?,
        };
        let alone = |i: &usize| {
            let Place { alpha, mu, phi } = places[*i];
            aniso::aniso(smith, alpha, mu, phi.and_then(given), asked.tolerance)
        };
        let alone: Vec<aniso::Aniso> = far.par_iter().map(alone).collect::<Result<_, _>>()?;
        let mut e = vec![f64::NAN; places.len()];
        near.iter().zip(many.e).for_each(|(i, value)| e[*i] = value);
        far.iter().zip(&alone).for_each(|(i, value)| e[*i] = value.e);
        let error = alone.iter().fold(many.worst, |worst, value| worst.max(value.error));
        let evaluations = many.evaluations + far.len() as u64;
        Ok(Some((Truth { columns: vec![e], error, evaluations }, many.interpolants)))
    }
}

impl Quantity for GgxReflectionAniso {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "ggx-reflection-aniso",
                inputs: &[ALPHA_X, ALPHA_Y, MU, PHI],
                outputs: &["E", "loss", "error"],
                choices: &[Choice::Smith],
                tolerance: aniso::TOLERANCE,
                smallest_alpha: aniso::ALPHA[0],
                fresnel: Some(Fresnel::One),
                remark: "without phi: the mean over it; the alphas are 0 together",
                draws: &Draw::ALL,
                ..Facts::NONE
            }
        }
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let v = aniso::aniso(smith, [x[0], x[1]], x[2], given(x[3]), tolerance)?;
        Ok(vec![v.e, v.loss, v.error])
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        Ok(self.shared(asked)?.map(|(truth, _)| truth))
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        Ok(monte_carlo::aniso(smith, [x[0], x[1]], x[2], given(x[3]), run)?.to_vec())
    }

    fn traced(&self, variant: &Variant, x: &[f64]) -> Option<Trace<'_>> {
        Some(monte_carlo::traced(variant.smith?, [x[0], x[1]], monte_carlo::view_at(x[2], x[3])))
    }
}
