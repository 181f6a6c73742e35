//! The measured error of a formula.

use super::{FitSpec, FitStageError};
use crate::approximate::Region;
use crate::data::{Approximation, Certificate, Cost, Form, Formula, Place, Source};
use crate::effects::reflection::samples::Data;
use lobefit_shade::{Hypothesis, measure_first, round_up};

/// Measures a formula at points that it was not fitted on, in f32 as emitted.
pub fn certified(
    spec: &FitSpec,
    hypothesis: &Hypothesis,
    form: Formula,
    source: Source,
    data: &dyn Data,
) -> Result<Approximation, FitStageError> {
    let coefficients: Vec<f32> = form.coefficients.iter().map(|(_, value)| *value).collect();
    let points = data.points();
    let (scale, target) = data.truth();
    let inputs: Vec<Vec<f32>> = hypothesis.inputs().iter().map(|name| points.column(name)).collect();
    let (all, uniform) =
        measure_first(hypothesis.tape(), &coefficients, &inputs, scale, target, points.uniform)?;
    let place = points.place(all.worst);
    let at: Place =
        data.places(hypothesis.inputs()).into_iter().map(|n| (n.clone(), place_value(&place, &n))).collect();
    let certificate = Certificate {
        max_abs: round_up(all.max_abs, 4),
        max_rel: round_up(all.max_rel, 4),
        rms: uniform.rms,
        mean: uniform.mean,
        domain: at.keys().map(|input| (input.clone(), range(&spec.region, input))).collect(),
        at,
        precision: "f32".into(),
        points: all.points as u64,
    };
    let (quantity, column, used_as) = data.use_of();
    Ok(Approximation {
        name: hypothesis.name().to_string(),
        quantity: quantity.into(),
        column: column.into(),
        used_as,
        smith: Some(spec.smith),
        source,
        form: Form::Formula(form),
        certificate,
        cost: Cost { ops: hypothesis.tape().cost_ops(), fetches: 0, bytes: 0 },
    })
}

/// A coordinate of a place; f0 is 1 wherever a saturating form is measured.
fn place_value(place: &Place, input: &str) -> f64 {
    place.get(input).copied().unwrap_or(1.0)
}

fn range(region: &Region, input: &str) -> [f64; 2] {
    match input {
        "roughness" => region.roughness,
        "alpha" => region.alpha(),
        "mu" => region.mu,
        _ => [1.0, 1.0],
    }
}
