//! Charlie sheen over alpha and mu: a value takes so little that every point of a verdict is integrated; conventions are tried on cubics.

use super::solid::{Knots, along};
use super::{Lobe, Once, Truth, Values, once};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit_math::ops;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, SheenCharlie, Variant};

/// Least alpha that is judged: below it E at grazing view has no bound.
const LEAST_ALPHA: f64 = 1e-4;

/// Error of a value, relative to E, which is at most 40 here.
const BOUND: f64 = 4e-10;

struct Sheen {
    lobes: Vec<Lobe>,
    /// Knots of alpha and of mu, and the values at them, alpha fastest.
    knots: [Knots; 2],
    values: &'static Values,
}

/// The values at the knots.
static KEPT: Once<Values> = Once::new();

/// E at every combination.
fn integrated(alphas: &[f64], mus: &[f64]) -> Result<Values, AuditError> {
    let inside =
        |values: &[f64], least: f64| values.iter().map(|x| x.clamp(least, 1.0)).collect::<Vec<f64>>();
    let (alphas, mus) = (inside(alphas, SheenCharlie.smallest_alpha()), inside(mus, 0.0));
    let (points, variant) = (Points::product(&[("alpha", &alphas), ("mu", &mus)]), Variant::default());
    let tolerance = SheenCharlie.tolerance_of_many(&variant);
    let [e] = SheenCharlie.truth(&variant, &points, &["E"], tolerance)?.arrays();
    Ok(e.into_iter().map(|e| [e, 0.0]).collect())
}

/// `sheen-charlie`: E.
pub(crate) fn sheen() -> Result<impl Truth, AuditError> {
    let knots = [
        Knots { coordinate: ops::log, input: ops::exp, range: [LEAST_ALPHA, 1.0], count: 96 },
        Knots { coordinate: f64::sqrt, input: |u| u * u, range: [0.0, 1.0], count: 128 },
    ];
    let values = once(&KEPT, || integrated(&knots[0].inputs(), &knots[1].inputs()))?;
    Ok(Sheen { lobes: vec![Lobe { smith: None, side: None }], knots, values })
}

impl Truth for Sheen {
    fn quantity(&self) -> &'static str {
        "sheen-charlie"
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
        let rows = along(&self.knots[1], at[1], self.knots[0].count, self.values);
        Ok(along(&self.knots[0], at[0], 1, &rows))
    }

    fn exact(&self, _: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        integrated(at[0], at[1])
    }

    fn bound(&self) -> f64 {
        BOUND
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quick_values_are_near() {
        let truth = sheen().unwrap();
        let (alphas, mus) = ([1.3e-4, 0.004, 0.07, 0.31, 0.98], [0.0, 0.0007, 0.033, 0.41, 0.97]);
        let (quick, exact) =
            (truth.quick(0, &[&alphas, &mus]).unwrap(), truth.exact(0, &[&alphas, &mus]).unwrap());
        for (q, e) in quick.iter().zip(&exact) {
            assert!((q[0] - e[0]).abs() < 2e-3 * e[0].max(1.0), "{q:?} {e:?}");
        }
    }
}
