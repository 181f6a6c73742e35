//! From the best forms to the frontier: solved on all samples, written, proven to have no pole.

use rayon::prelude::*;

use super::Found;
use super::beam::Entry;
use super::draft::{Draft, Part};
use super::score::{Data, Known};
use super::space::{SearchSamples, Space};
use super::write::write;
use crate::fit::{
    Domain, FitError, Hypothesis, Norm, Options, Samples, optimise, prove_regular, residual_range,
};

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
    best(solved.into_iter().flatten().collect(), &space.name, space.max_ops)
}

/// What no cheaper or equal one beats.
pub(super) fn best(mut found: Vec<Found>, name: &str, max_ops: u32) -> Result<Vec<Found>, FitError> {
    found.sort_by(|a, b| a.ops.cmp(&b.ops).then(a.max.total_cmp(&b.max)));
    let mut best = f64::INFINITY;
    found.retain(|f| {
        let better = f.max < best;
        best = best.min(f.max);
        better
    });
    if found.is_empty() {
        let message = format!("{name}: no form of at most {max_ops} operations was found; allow more");
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
    let Some(part) = Part::new(space, &entry.form, &score) else { return Ok(None) };
    let written = write(space, &entry.form, &part.layout, part.negative);
    let draft = Draft::new(&space.name, &space.title, &[part], written);
    let columns = |name: &str| column(space, samples, name);
    finished(&draft, &columns, samples, space.domain.as_ref(), bound)
}

/// A drafted formula measured on samples, its helpers' constants polished; none where it has a pole.
pub(super) fn finished(
    draft: &Draft,
    columns: &dyn Fn(&str) -> Vec<f64>,
    samples: &SearchSamples,
    domain: Option<&Domain>,
    bound: f64,
) -> Result<Option<Found>, FitError> {
    let hypothesis = draft.hypothesis(&draft.values)?;
    let inputs = hypothesis.inputs().iter().map(|name| columns(name)).collect();
    let all = Samples { inputs, scale: samples.scale.clone(), target: samples.target.clone() };
    let mut found = measured(domain, hypothesis, &all, bound)?;
    if draft.constants > 0 {
        // The linear programs have left the helpers' constants where they were.
        let options = Options { starts: 1, ..Options::new(Norm::Max) };
        let polished = optimise(&draft.hypothesis(&draft.values)?, &all, &[], &options);
        let polished = polished.ok().filter(|p| p.coefficients.iter().all(|c| c.is_finite()));
        if let Some(polished) = polished {
            let other = measured(domain, draft.hypothesis(&polished.coefficients)?, &all, 0.0)?;
            found = found.into_iter().chain(other).reduce(|a, b| if b.max < a.max { b } else { a });
        }
        found.iter_mut().for_each(|f| f.bound = 0.0);
    }
    Ok(found)
}

/// A formula with its errors at its starting coefficients; none where it has a pole.
fn measured(
    domain: Option<&Domain>,
    hypothesis: Hypothesis,
    samples: &Samples,
    bound: f64,
) -> Result<Option<Found>, FitError> {
    let regular = |domain: &Domain| prove_regular(hypothesis.tape(), &hypothesis.starts(), domain).is_ok();
    if !domain.is_none_or(regular) {
        return Ok(None);
    }
    let Some((max, rms)) = residual_range(&hypothesis, samples)? else { return Ok(None) };
    let ops = hypothesis.tape().cost_ops();
    Ok(Some(Found { hypothesis, ops, max, rms, bound }))
}

/// The column of an argument; one that is no power of an axis is 0.
pub(super) fn column(space: &Space, samples: &SearchSamples, name: &str) -> Vec<f64> {
    for (axis, column) in space.axes.iter().zip(&samples.axes) {
        if let Some((_, power)) = axis.arguments.iter().find(|(argument, _)| argument == name) {
            return column.iter().map(|x| (0..*power).fold(1.0, |p, _| p * x)).collect();
        }
    }
    vec![0.0; samples.len()]
}
