//! From the best forms to the frontier: solved on all samples, written, proven to have no pole.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::Found;
use super::beam::{Entry, usable};
use super::form::Form;
use super::score::{Data, Known, Score};
use super::space::{SearchSamples, Space};
use super::write::{layout, write};
use crate::fit::{FitError, Hypothesis, Samples, prove_regular, residual_range};

/// Forms of each cost that are solved on all samples.
const FINALISTS: usize = 4;

/// The frontier of the beam's forms.
pub(super) fn frontier(
    space: &Space,
    samples: &SearchSamples,
    levels: BTreeMap<u32, Vec<Entry>>,
) -> Result<Vec<Found>, FitError> {
    let data = Data::new(space, samples);
    let finalists: Vec<Entry> = levels.into_values().flat_map(|l| l.into_iter().take(FINALISTS)).collect();
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
    let Some((source, name)) = source(space, &entry.form, &score) else { return Ok(None) };
    let hypothesis = Hypothesis::parse(&format!("{name}.wgsl"), &source)?;
    let starts = hypothesis.starts();
    if let Some(domain) = &space.domain
        && prove_regular(hypothesis.tape(), &starts, domain).is_err()
    {
        return Ok(None);
    }
    let inputs = hypothesis.inputs().iter().map(|name| column(space, samples, name)).collect();
    let all = Samples { inputs, scale: samples.scale.clone(), target: samples.target.clone() };
    let Some((max, rms)) = residual_range(&hypothesis, &all)? else { return Ok(None) };
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

/// WGSL source and name of a form with its coefficients.
fn source(space: &Space, form: &Form, score: &Score) -> Option<(String, String)> {
    let layout = layout(space, form, |k| usable(form, score, k))?;
    let below = form.under.len();
    let all = if below == 0 { &score.coefficients[1..] } else { &score.coefficients };
    let factor = match layout.unit {
        Some(unit) => all[unit],
        None => score.coefficients[0],
    };
    // A unit in P may need the sign of the quotient turned: that of Q must stay positive.
    let negative = layout.unit.is_some() && factor < 0.0;
    let scaled: Vec<f64> = all
        .iter()
        .enumerate()
        .map(|(k, c)| if negative && k < below { -c / factor } else { c / factor })
        .collect();
    let written = write(space, form, &layout, negative);
    let name = format!("{}{}", space.name, layout.ops);
    let constants = written.constants.iter().map(|k| form.helpers[*k].constant());
    let values = written.order.iter().map(|k| scaled[*k]).chain(constants);
    let mut source = String::new();
    for (name, value) in written.names.iter().zip(values) {
        source += &format!("override {name}: f32 = {:?};\n", value as f32);
    }
    let body = written.graph.text(written.result, &written.arguments, &written.names);
    let used =
        |argument: &&String| body.split(|c: char| !c.is_alphanumeric() && c != '_').any(|w| w == *argument);
    let arguments: Vec<String> = written.arguments.iter().filter(used).map(|a| format!("{a}: f32")).collect();
    let title = if space.title.is_empty() { String::new() } else { format!("/// {}\n", space.title) };
    let kind = if below == 0 { "polynomial" } else { "quotient" };
    source += &format!("\n{title}/// A {kind} of {} operations.\n", layout.ops);
    source += &format!("fn {name}({}) -> f32 {{\n{body}}}\n", arguments.join(", "));
    Some((source, name))
}
