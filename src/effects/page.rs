//! Parts of the pages of several effects.

use super::BakeError;
use super::selection::Selected;
use crate::approximate::{Dropped, Fit};
use crate::report::{Field, FitCurve, FitFinding, LeftOut};
use lobefit_shade::code::{self, Language};

/// A fit with its formula, curves and map.
///
/// # Errors
/// A formula that cannot be printed.
pub fn fit(
    one: &Selected,
    value: String,
    curves: Vec<FitCurve>,
    error: Field,
) -> Result<FitFinding, BakeError> {
    let fit = one.fit;
    let formula = code::print(Language::Wgsl, &fit.hypothesis, &fit.coefficients(), &[])?;
    Ok(FitFinding {
        name: fit.approximation.name.clone(),
        shown_as: one.because.into(),
        formula: formula.text.trim_end().to_string(),
        value,
        curves,
        error,
    })
}

/// Hypotheses that have no reliable fit in the scene.
pub fn left_out(dropped: &[Dropped]) -> Vec<LeftOut> {
    let fit = |d: &Dropped| LeftOut {
        effect: format!("fit {} ({})", d.hypothesis, d.norm),
        reason: d.reason.clone(),
    };
    dropped.iter().map(fit).collect()
}

/// The largest error of the most accurate emitted fit.
pub fn smallest_error(fits: &[Fit]) -> Option<f64> {
    fits.iter().filter(|f| f.emitted).map(|f| f.approximation.certificate.max_abs).reduce(f64::min)
}
