//! From the best forms to the frontier: solved on all samples, written, proven to have no pole.

use rayon::prelude::*;

use super::Found;
use super::beam::{Entry, usable};
use super::form::Form;
use super::score::{Data, Known, Score};
use super::space::{SearchSamples, Space};
use super::write::{layout, write};
use crate::fit::{FitError, Hypothesis, Norm, Options, Samples, optimise, prove_regular, residual_range};

/// Forms of each cost that are solved on all samples.
const FINALISTS: usize = 4;

/// The frontier of the beam's forms.
pub(super) fn frontier(
    space: &Space,
    samples: &SearchSamples,
    levels: Vec<Vec<Entry>>,
) -> Result<Vec<Found>, FitError> {
    let data = Data::new(space, samples);
    let finalists: Vec<Entry> = levels.into_iter().flat_map(|l| l.into_iter().take(FINALISTS)).collect();
    let solved: Vec<Option<Found>> =
        finalists.par_iter().map(|entry| solve(space, samples, &data, entry)).collect::<Result<_, _>>()?;
    let mut found: Vec<Found> = solved.into_iter().flatten().collect();
    found.sort_by(|a, b| a.ops.cmp(&b.ops).then(a.max.total_cmp(&b.max)));
    let mut best = f64::INFINITY;
    found.retain(|f| {
        let better = f.max < best;
        best = best.min(f.max);
        better
    });
    if found.is_empty() {
        let message =
            format!("{}: no form of at most {} operations was found; allow more", space.name, space.max_ops);
        return Err(FitError::Solver { message });
    }
    Ok(found)
}

/// A form solved on all samples; none if it has a pole there or in the domain.
fn solve(
    space: &Space,
    samples: &SearchSamples,
    data: &Data,
    entry: &Entry,
) -> Result<Option<Found>, FitError> {
    let known = Known { form: &entry.form, coefficients: &entry.score.coefficients };
    let Some((score, bound)) = data.prove(&entry.form, &known) else { return Ok(None) };
    let Some(draft) = Draft::new(space, &entry.form, &score) else { return Ok(None) };
    let hypothesis = draft.hypothesis(&draft.values)?;
    let inputs = hypothesis.inputs().iter().map(|name| column(space, samples, name)).collect();
    let all = Samples { inputs, scale: samples.scale.clone(), target: samples.target.clone() };
    let mut found = measured(space, hypothesis, &all, bound)?;
    if draft.constants > 0 {
        // The linear programs have left the helpers' constants where they were.
        let options = Options { starts: 1, ..Options::new(Norm::Max) };
        let polished = optimise(&draft.hypothesis(&draft.values)?, &all, &[], &options);
        let polished = polished.ok().filter(|p| p.coefficients.iter().all(|c| c.is_finite()));
        if let Some(polished) = polished {
            let other = measured(space, draft.hypothesis(&polished.coefficients)?, &all, 0.0)?;
            found = found.into_iter().chain(other).reduce(|a, b| if b.max < a.max { b } else { a });
        }
        found.iter_mut().for_each(|f| f.bound = 0.0);
    }
    Ok(found)
}

/// A formula with its errors at its starting coefficients; none where it has a pole.
fn measured(
    space: &Space,
    hypothesis: Hypothesis,
    samples: &Samples,
    bound: f64,
) -> Result<Option<Found>, FitError> {
    let regular = |domain| prove_regular(hypothesis.tape(), &hypothesis.starts(), domain).is_ok();
    if !space.domain.as_ref().is_none_or(regular) {
        return Ok(None);
    }
    let Some((max, rms)) = residual_range(&hypothesis, samples)? else { return Ok(None) };
    let ops = hypothesis.tape().cost_ops();
    Ok(Some(Found { hypothesis, ops, max, rms, bound }))
}

/// The column of an argument.
fn column(space: &Space, samples: &SearchSamples, name: &str) -> Vec<f64> {
    for (axis, column) in space.axes.iter().zip(&samples.axes) {
        if let Some((_, power)) = axis.arguments.iter().find(|(argument, _)| argument == name) {
            return column.iter().map(|x| (0..*power).fold(1.0, |p, _| p * x)).collect();
        }
    }
    Vec::new()
}

/// A form as text, but for the values of its parameters.
struct Draft {
    name: String,
    parameters: Vec<String>,
    /// The parameters at the optimum.
    values: Vec<f64>,
    /// How many of them, the last ones, are constants of helpers.
    constants: usize,
    function: String,
}

impl Draft {
    /// None if no coefficient can be divided by.
    fn new(space: &Space, form: &Form, score: &Score) -> Option<Draft> {
        let layout = layout(space, form, |k| usable(form, score, k))?;
        let below = form.under.len();
        let all = if below == 0 { &score.coefficients[1..] } else { &score.coefficients };
        let factor = match layout.unit {
            Some(unit) => all[unit],
            None => score.coefficients[0],
        };
        // A unit in P may turn the sign of P; Q stays positive, and the quotient is subtracted.
        let negative = layout.unit.is_some() && factor < 0.0;
        let scaled: Vec<f64> = (0..all.len())
            .map(|k| if negative && k < below { -all[k] / factor } else { all[k] / factor })
            .collect();
        let written = write(space, form, &layout, negative);
        let constants = written.constants.iter().map(|k| form.helpers[*k].constant());
        let values = written.order.iter().map(|k| scaled[*k]).chain(constants).collect();
        let name = format!("{}{}", space.name, layout.ops);
        let body = written.graph.text(written.result, &written.arguments, &written.names);
        let reads = |argument: &&String| {
            body.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == *argument)
        };
        let arguments: Vec<String> =
            written.arguments.iter().filter(reads).map(|a| format!("{a}: f32")).collect();
        let title = if space.title.is_empty() { String::new() } else { format!("/// {}\n", space.title) };
        let kind = if below == 0 { "polynomial" } else { "quotient" };
        let helped = if form.helpers.is_empty() { String::new() } else { format!(" with {}", helped(form)) };
        let function = format!(
            "{title}/// A {kind} of {} operations{helped}.\nfn {name}({}) -> f32 {{\n{body}}}\n",
            layout.ops,
            arguments.join(", ")
        );
        Some(Draft { name, parameters: written.names, values, constants: written.constants.len(), function })
    }

    /// The hypothesis that starts at these values.
    fn hypothesis(&self, values: &[f64]) -> Result<Hypothesis, FitError> {
        let declare =
            |(name, value): (&String, &f64)| format!("override {name}: f32 = {:?};\n", *value as f32);
        let declared: String = self.parameters.iter().zip(values).map(declare).collect();
        Hypothesis::parse(&format!("{}.wgsl", self.name), &format!("{declared}\n{}", self.function))
    }
}

/// The helpers of a form in words.
fn helped(form: &Form) -> String {
    form.helpers.iter().map(|h| h.kind.words()).collect::<Vec<_>>().join(" and ")
}
