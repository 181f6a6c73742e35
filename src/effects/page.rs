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

/// The most accurate emitted fit.
pub fn best(fits: &[Fit]) -> Option<&Fit> {
    let error = |fit: &Fit| fit.approximation.certificate.max_abs;
    fits.iter().filter(|f| f.emitted).min_by(|a, b| error(a).total_cmp(&error(b)))
}

/// The largest error of the most accurate emitted fit.
pub fn smallest_error(fits: &[Fit]) -> Option<f64> {
    best(fits).map(|fit| fit.approximation.certificate.max_abs)
}
