//! Coefficients that have come out as nothing: set to exactly 0, and told, so that the author drops
//! their terms.

use super::constraint_check::{self, ConstraintCheck};
use lobefit_fit::{Constraint, FitError, Fitted, Samples};
use lobefit_shade::{Domain, Hypothesis};

/// A coefficient whose whole effect on every sample is below this part of the largest error is
/// rounding of the solver.
const NOTHING: f64 = 1e-6;

/// Beside an error that is itself rounding, so is an effect below this part of the targets: a
/// fortieth of an f32's last place.
const ROUNDING: f64 = 1e-9;

/// Coefficients that obey the constraints, at as many places as can be had.
pub(super) struct Obedient {
    pub fitted: Fitted,
    pub coefficients: Vec<f32>,
    /// The same in f64.
    pub exact: Vec<f64>,
    pub kept: Vec<ConstraintCheck>,
}

/// The same with 0 in the place of coefficients that do nothing, one by one, as long as constraints
/// are kept that were before.
pub(super) fn cleared(
    found: Obedient,
    hypothesis: &Hypothesis,
    samples: &Samples,
    finer: &[Constraint],
    domain: &Domain,
) -> Result<Obedient, FitError> {
    let tape = hypothesis.tape();
    let size = samples.target.iter().fold(0.0_f64, |top, t| top.max(t.abs()));
    let least = (NOTHING * found.fitted.max).max(ROUNDING * size);
    let values = |p: &[f64]| -> Result<Vec<f64>, FitError> {
        let values = tape.evaluate(&samples.inputs, p)?;
        Ok(values.iter().zip(&samples.scale).map(|(v, s)| v * s).collect())
    };
    let before = values(&found.exact)?;
    let mut found = found;
    for index in 0..found.exact.len() {
        let mut exact = found.exact.clone();
        exact[index] = 0.0;
        let same = |(a, b): (&f64, &f64)| (a - b).abs() <= least;
        if !values(&exact)?.iter().zip(&before).all(same) {
            continue;
        }
        // Where a constraint has no value with 0, 0 is no choice.
        let Ok(kept) = constraint_check::kept(finer, &found.fitted.constraints, tape, &exact, domain) else {
            continue;
        };
        let equal = constraint_check::equations_hold(finer, &found.fitted.constraints, tape, &exact)?;
        if equal && kept.iter().zip(&found.kept).all(|(now, then)| now.is_kept() || !then.is_kept()) {
            found.coefficients[index] = 0.0;
            found = Obedient { exact, kept, ..found };
        }
    }
    Ok(found)
}

/// One sentence for each coefficient that is 0, but for those of which `fitted` says already that
/// they do not matter.
pub(super) fn notes(hypothesis: &Hypothesis, coefficients: &[f32], fitted: &Fitted) -> Vec<String> {
    let zero = hypothesis.parameters().iter().zip(coefficients).filter(|(_, value)| **value == 0.0);
    zero.filter(|(parameter, _)| !fitted.is_idle(&parameter.name))
        .map(|(parameter, _)| {
            format!(
                "`{}` is 0: drop it from the formula; its operations are counted, and computed, for nothing",
                parameter.name
            )
        })
        .collect()
}
