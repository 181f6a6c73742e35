//! Parts of the pages of several effects.

use super::BakeError;
use super::context::Context;
use super::grid;
use super::selection::Selected;
use crate::approximate::{Dropped, Fit, FitStageError, Region};
use crate::report::{AverageFinding, AverageFit, Field, FitCurve, FitFinding, LeftOut};
use lobefit_shade::code::{self, Language};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, Variant};

/// Roughnesses of the curves of what has no view.
const ROUGHNESSES: usize = 49;

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

/// A column of a quantity without a view, and its fits, over the roughness of a region in even steps, where
/// other inputs have one value each.
///
/// # Errors
/// A truth that cannot be integrated; a formula of other inputs.
pub fn over_roughness(
    (quantity, column, variant): (&dyn Quantity, &str, Variant),
    (region, shown): (&Region, &[(&'static str, f64)]),
    fits: &[&Fit],
    context: &Context,
) -> Result<AverageFinding, BakeError> {
    let roughness = grid::even(region, ROUGHNESSES);
    let mut points = Points::default();
    roughness.values.iter().for_each(|r| region.push(&mut points, *r, 1.0));
    let points = grid::at(points, shown);
    context.memo.add(points.len());
    let [truth] = quantity.truth(&variant, &points, &[column], quantity.tolerance(&variant))?.arrays();
    let fit = |f: &&Fit| {
        let values = f.values_for(&points, 1.0).map_err(FitStageError::from)?;
        let values = values.into_iter().map(f64::from).collect();
        Ok(AverageFit { name: f.approximation.name.clone(), values })
    };
    let fits = fits.iter().map(fit).collect::<Result<_, BakeError>>()?;
    Ok(AverageFinding { name: column.to_string() + &grid::at_text(shown), truth, fits, roughness })
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
