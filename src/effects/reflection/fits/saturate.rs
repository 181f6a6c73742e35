//! The saturating variant of a normalisation.

use super::certified::certified;
use super::{Fit, FitSpec, FitStageError};
use crate::data::{Form, Source};
use crate::effects::reflection::samples::FitData;
use lobefit_shade::Hypothesis;

/// 1 + f0 (N - 1), which is exact where f0 = 1 wherever N is. With F the furnace error of N, its relative error against
/// 1 + f0 (1/E - 1) is F f0/(E + f0 (1 - E)) <= F for every f0 in [0, 1], so N's certificate stands for it.
pub fn saturate(spec: &FitSpec, fit: &Fit, data: &FitData) -> Result<Fit, FitStageError> {
    let original = Hypothesis::parse(fit.hypothesis.file(), fit.hypothesis.source())?;
    let (inner, inputs) = (original.name(), original.inputs());
    let declared: Vec<String> = inputs.iter().map(|input| format!("{input}: f32")).collect();
    let source = format!(
        "{}\n/// Saturating compensation 1 + f0 (N - 1): a metal gains colour as light scatters more than once.\n\
         fn {inner}_saturating({}, f0: f32) -> f32 {{\n    return 1.0 + f0 * ({inner}({}) - 1.0);\n}}\n",
        original.source(),
        declared.join(", "),
        inputs.join(", "),
    );
    let name = format!("{}_saturating", fit.hypothesis.name());
    let hypothesis = Hypothesis::parse(original.file(), &source)?.renamed(&name);
    let Form::Formula(form) = &fit.approximation.form else {
        return Ok(fit.clone());
    };
    let mut form = form.clone();
    form.inputs = hypothesis.inputs().to_vec();
    let approximation = certified(spec, &hypothesis, form, Source::Fitted, data)?;
    Ok(Fit {
        approximation,
        hypothesis,
        termination: fit.termination,
        emitted: true,
        wraps: Some(fit.hypothesis.name().to_string()),
        safe: None,
    })
}
