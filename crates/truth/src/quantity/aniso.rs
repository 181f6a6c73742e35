//! `ggx-reflection-aniso`: E and loss of the anisotropic GGX lobe.

use super::{Choice, Fresnel, Input, MU, Quantity, Variant};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, aniso};

/// `ggx-reflection-aniso`: the directional albedo at an azimuth of the view, or its mean over the
/// azimuth.
#[derive(Clone, Copy, Debug)]
pub struct GgxReflectionAniso;

/// Widths along the tangent and across it.
const WIDTHS: [f64; 2] = [0.0, aniso::ALPHA[1]];

/// Azimuth of the view from the alpha_x axis, radians.
const PHI: Input = Input {
    optional: true,
    ..Input::new("phi", [f64::MIN, f64::MAX]).usually([0.0, std::f64::consts::FRAC_PI_2])
};

/// A width; fits begin where lobes are as wide as in published comparisons.
const fn width(name: &'static str) -> Input {
    Input::new(name, WIDTHS).usually([0.02, 1.0])
}

/// An optional input.
fn given(x: f64) -> Option<f64> {
    (!x.is_nan()).then_some(x)
}

impl Quantity for GgxReflectionAniso {
    fn name(&self) -> &'static str {
        "ggx-reflection-aniso"
    }

    fn inputs(&self) -> &'static [Input] {
        const { &[width("alpha_x"), width("alpha_y"), MU, PHI] }
    }

    fn outputs(&self) -> &'static [&'static str] {
        &["E", "loss", "error"]
    }

    fn choices(&self) -> &'static [Choice] {
        &[Choice::Smith]
    }

    fn tolerance(&self, _: &Variant) -> f64 {
        aniso::TOLERANCE
    }

    fn smallest_alpha(&self) -> f64 {
        aniso::ALPHA[0]
    }

    fn fresnel(&self) -> Option<Fresnel> {
        Some(Fresnel::One)
    }

    fn remark(&self) -> &'static str {
        "without phi: the mean over it"
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let v = aniso::aniso(smith, [x[0], x[1]], x[2], given(x[3]), tolerance)?;
        Ok(vec![v.e, v.loss, v.error])
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        Ok(monte_carlo::aniso(smith, [x[0], x[1]], x[2], given(x[3]), run)?.to_vec())
    }
}
