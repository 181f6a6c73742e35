//! The default page of an effect: its fits beside the truth over roughness and mu.

use rayon::prelude::*;

use super::BakeError;
use super::context::Context;
use super::grid::Grid;
use super::selection::{Selected, selected};
use crate::approximate::{Dropped, Fit, Region};
use crate::data::Use;
use crate::report::{ApproximationFinding, EffectFinding, Field, Findings, FitCurve, FitFinding, LeftOut};
use lobefit_shade::code::{self, Language};
use lobefit_truth::integrate::IntegrateError;

/// How fits of a value over roughness and mu are shown.
pub struct Shown<'a> {
    /// Name of the value.
    pub value: &'a str,
    /// What to see in the map of the truth.
    pub caption: &'a str,
    /// Roughness of the curves, as far as they lie in the region.
    pub curves: &'a [f64],
    /// The truth at alpha and mu.
    pub truth: fn(f64, f64) -> Result<f64, IntegrateError>,
}

/// The findings of fits of a value.
///
/// # Errors
/// A truth that cannot be integrated; a formula that cannot be printed.
pub fn findings(
    effect: &EffectFinding,
    context: &Context,
    region: &Region,
    (fits, dropped): (&[Fit], &[Dropped]),
    shown: &Shown,
) -> Result<Findings, BakeError> {
    let (map, lines) = (Grid::map(region), Grid::curves(region, shown.curves));
    let (truth, along) = (truths(&map, context, shown)?, truths(&lines, context, shown)?);
    let finding = |one: &Selected| {
        let values = map.values(one.fit, 1.0)?;
        let errors = values.iter().zip(&truth).map(|(value, truth)| value - truth);
        let curves = lines.lines(&along, &lines.values(one.fit, 1.0)?);
        fit(one, shown.value.into(), curves, map.field(shown.value, true, errors))
    };
    Ok(Findings {
        effects: vec![effect.clone()],
        left_out: left_out(dropped),
        truths: vec![map.field(shown.value, false, truth.iter().copied())],
        caption: shown.caption.into(),
        approximations: fits.iter().map(|f| ApproximationFinding::from(&f.approximation)).collect(),
        fits: selected(fits, Use::Value, context).iter().map(finding).collect::<Result<_, BakeError>>()?,
        ..Findings::new(context.origin())
    })
}

fn truths(grid: &Grid, context: &Context, shown: &Shown) -> Result<Vec<f64>, BakeError> {
    let points = &grid.points;
    context.counter.add(points.len());
    let at = |i: usize| (shown.truth)(f64::from(points.alpha[i]), f64::from(points.mu[i].min(1.0)));
    let all: Vec<Result<f64, IntegrateError>> = (0..points.len()).into_par_iter().map(at).collect();
    Ok(all.into_iter().collect::<Result<_, _>>()?)
}

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
