//! From the best forms to the frontier: solved on all samples, written, proven to have no pole.

use rayon::prelude::*;

use super::Found;
use super::beam::Entry;
use super::draft::{Draft, Part};
use super::score::{Data, Known};
use super::space::{SearchSamples, Space};
use super::write::write;
use crate::{FitError, Norm, Options, Samples, optimise, residual_range};
use lobefit_shade::{Domain, Hypothesis, prove_regular};

/// Forms of each cost that are solved on all samples.
const FINALISTS: usize = 4;

/// The best forms of every cost of a beam, those without the helpers that were admitted among them:
/// solved on samples of what is put into the space's link and measured on samples of the value.
pub(super) fn solved(
    space: &Space,
    linked: &SearchSamples,
    samples: &SearchSamples,
    levels: Vec<Vec<Entry>>,
) -> Result<Vec<Found>, FitError> {
    let data = Data::new(space, linked);
    let finalists: Vec<Entry> = levels.into_iter().flat_map(|level| finalists(space, level)).collect();
    let solved: Vec<Option<Found>> =
        finalists.par_iter().map(|entry| solve(space, samples, &data, entry)).collect::<Result<_, _>>()?;
    Ok(solved.into_iter().flatten().collect())
}

/// The best of a cost, and the best of those without admitted helpers.
fn finalists(space: &Space, level: Vec<Entry>) -> Vec<Entry> {
    let count = space.finalists(FINALISTS);
    let bare = |e: &Entry| e.form.helpers.iter().all(|h| !space.admitted.contains(&h.kind));
    let (mut first, rest): (Vec<Entry>, Vec<Entry>) = (level.iter().take(count).cloned().collect(), level);
    let missing = count.saturating_sub(first.iter().filter(|e| bare(e)).count());
    first.extend(rest.into_iter().skip(count).filter(bare).take(missing));
    first
}

/// What no cheaper or equal one beats.
pub(super) fn best(mut found: Vec<Found>, space: &Space, max_ops: u32) -> Result<Vec<Found>, FitError> {
    found.sort_by(|a, b| {
        let [first, second] = [a, b].map(|f| space.price(&f.hypothesis));
        first.total_cmp(&second).then(a.max.total_cmp(&b.max))
    });
    let mut best = f64::INFINITY;
    found.retain(|f| {
        let better = f.max < best;
        best = best.min(f.max);
        better
    });
    if found.is_empty() {
        let name = &space.name;
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
    let draft = Draft::new(&space.name, &space.title, space.link, &[part], written);
    let columns = |name: &str| column(space, samples, name);
    // What is proven for the link's argument is not for its value.
    let bound = if space.link.is_some() { 0.0 } else { bound };
    let polished = draft.constants > 0 || space.link.is_some();
    finished(&draft, &columns, samples, space.domain.as_ref(), bound, polished)
}

/// A drafted formula measured on samples, its constants polished if asked for; none where it has a
/// pole.
pub(super) fn finished(
    draft: &Draft,
    columns: &dyn Fn(&str) -> Vec<f64>,
    samples: &SearchSamples,
    domain: Option<&Domain>,
    bound: f64,
    polish: bool,
) -> Result<Option<Found>, FitError> {
    let hypothesis = draft.hypothesis(&draft.values)?;
    let inputs = hypothesis.inputs().iter().map(|name| columns(name)).collect();
    let all = Samples { inputs, scale: samples.scale.clone(), target: samples.target.clone() };
    let mut found = measured(domain, hypothesis, &all, bound)?;
    if polish {
        // The linear programs have left the helpers' constants where they were, and took a link for
        // its tangent.
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
