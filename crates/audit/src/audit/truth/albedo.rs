//! The albedo of a lobe over alpha and mu that comes in one form: conventions are tried on cubics,
//! and every point of a verdict is integrated.

use super::solid::{Knots, along};
use super::{Lobe, Truth, Values};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit_math::ops;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, Variant};

/// Least alpha that is judged: below it E at grazing view may have no bound.
const LEAST_ALPHA: f64 = 1e-4;

struct Albedo<'a> {
    quantity: &'a dyn Quantity,
    lobes: Vec<Lobe>,
    /// Knots of alpha and of mu, and the values at them, alpha fastest.
    knots: [Knots; 2],
    values: Values,
    bound: f64,
}

/// Whether a quantity is E of alpha and mu, and has no variants.
pub(crate) fn is_albedo(quantity: &dyn Quantity) -> bool {
    let inputs = quantity.inputs().iter().map(|input| input.name);
    inputs.eq(["alpha", "mu"]) && quantity.outputs() == ["E", "error"] && quantity.choices().is_empty()
}

/// E at every combination, and its error.
fn integrated(quantity: &dyn Quantity, alphas: &[f64], mus: &[f64]) -> Result<(Values, f64), AuditError> {
    let inside = |k: usize, values: &[f64]| {
        let [low, high] = quantity.inputs()[k].domain;
        values.iter().map(|x| x.clamp(low, high)).collect::<Vec<f64>>()
    };
    let (alphas, mus) = (inside(0, alphas), inside(1, mus));
    let (points, variant) = (Points::product(&[("alpha", &alphas), ("mu", &mus)]), Variant::default());
    let truth = quantity.truth(&variant, &points, &["E"], quantity.tolerance_of_many(&variant))?;
    let (error, [e]) = (truth.error, truth.arrays());
    Ok((e.into_iter().map(|e| [e, 0.0]).collect(), error))
}

/// The albedo of a quantity of which [`is_albedo`] holds.
pub(crate) fn albedo(quantity: &dyn Quantity) -> Result<impl Truth + '_, AuditError> {
    let knots = [
        Knots { coordinate: ops::log, input: ops::exp, range: [LEAST_ALPHA, 1.0], count: 96 },
        Knots { coordinate: f64::sqrt, input: |u| u * u, range: [0.0, 1.0], count: 128 },
    ];
    let (values, bound) = integrated(quantity, &knots[0].inputs(), &knots[1].inputs())?;
    Ok(Albedo { quantity, lobes: vec![Lobe { smith: None, side: None }], knots, values, bound })
}

impl Truth for Albedo<'_> {
    fn quantity(&self) -> &'static str {
        self.quantity.name()
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Alpha, Input::Mu]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::ALBEDO
    }

    fn range(&self, input: Input) -> [f64; 2] {
        if input == Input::Alpha { [LEAST_ALPHA, 1.0] } else { [0.0, 1.0] }
    }

    fn quick(&self, _: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        let rows = along(&self.knots[1], at[1], self.knots[0].count, &self.values);
        Ok(along(&self.knots[0], at[0], 1, &rows))
    }

    fn exact(&self, _: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        Ok(integrated(self.quantity, at[0], at[1])?.0)
    }

    fn bound(&self) -> f64 {
        self.bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobefit_truth::quantity::SheenCharlie;

    #[test]
    fn quick_values_are_near() {
        let truth = albedo(&SheenCharlie).unwrap();
        let (alphas, mus) = ([1.3e-4, 0.004, 0.07, 0.31, 0.98], [0.0, 0.0007, 0.033, 0.41, 0.97]);
        let (quick, exact) =
            (truth.quick(0, &[&alphas, &mus]).unwrap(), truth.exact(0, &[&alphas, &mus]).unwrap());
        for (q, e) in quick.iter().zip(&exact) {
            assert!((q[0] - e[0]).abs() < 2e-3 * e[0].max(1.0), "{q:?} {e:?}");
        }
    }
}
