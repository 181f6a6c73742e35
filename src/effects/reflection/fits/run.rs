//! The whole of a fit job: which hypotheses, in which norms, and what becomes of those that cannot be relied on.

use rayon::prelude::*;

use super::blend::blends;
use super::one::{fit_one, published};
use super::saturate::saturate;
use super::{Dropped, Fit, FitSet, FitSpec, FitStageError};
use crate::approximate::{Counter, Entry, kept};
use crate::data::{AlphaMap, Norm};
use crate::effects::reflection::RIVALS;
use crate::effects::reflection::catalogue::{AVERAGES, NORMALISATIONS, SEEDS};
use crate::effects::reflection::samples::{AverageData, Data, FitData};
use lobefit_shade::{Hypothesis, ShadeError};

/// Fits and measures everything that the spec asks for: ours in the catalogue's order, the user's, the source's published formulas, and
/// the rivals for comparison. Counts the truths that it needs. A hypothesis of the catalogue that does not converge, or has a
/// pole, in this region is dropped with the reason; one of the user's is an error.
pub fn fit_all(spec: &FitSpec, counter: &Counter) -> Result<FitSet, FitStageError> {
    // Parse first: a hypothesis that is refused must not cost a bake.
    let own = parse(&NORMALISATIONS)?;
    let user: Vec<Hypothesis> =
        spec.hypotheses.iter().map(|(f, s)| Hypothesis::parse(f, s)).collect::<Result<_, _>>()?;
    for hypothesis in &user {
        check_inputs(hypothesis)?;
    }
    let data = FitData::new(spec.smith, &spec.region, counter)?;
    let affordable = |h: &Hypothesis| spec.max_ops.is_none_or(|most| h.tape().cost_ops() <= most);
    let mut dropped = Vec::new();
    let jobs = |hypotheses: Vec<Hypothesis>| -> Vec<(Hypothesis, Norm)> {
        let affordable = hypotheses.into_iter().filter(&affordable);
        affordable.flat_map(|h| spec.norms.iter().map(move |norm| (h.clone(), *norm))).collect()
    };
    dropped.extend(user.iter().filter(|h| !affordable(h)).map(|h| too_dear(h, spec.max_ops)));
    let mut fits = reliable(spec, &jobs(own), &data, &mut dropped)?;
    fits.extend(each(&jobs(user), |(hypothesis, norm)| fit_one(spec, hypothesis, *norm, &data))?);
    // One saturating form per normalisation: of its minimax fit if there is one.
    let norm = if spec.norms.contains(&Norm::Max) { Norm::Max } else { Norm::Rms };
    let saturating: Vec<&Fit> = fits.iter().filter(|f| f.norm() == norm.name()).collect();
    let saturating = each(&saturating, |fit| saturate(spec, fit, &data))?;
    let (saturating, dear): (Vec<Fit>, Vec<Fit>) =
        saturating.into_iter().partition(|f| affordable(&f.hypothesis));
    dropped.extend(dear.iter().map(|f| too_dear(&f.hypothesis, spec.max_ops)));
    fits.extend(saturating);
    if spec.average {
        let averages = parse(&AVERAGES)?;
        dropped.extend(averages.iter().filter(|h| !affordable(h)).map(|h| too_dear(h, spec.max_ops)));
        let averages = jobs(averages);
        let data = AverageData::new(spec.smith, &spec.region, counter)?;
        fits.extend(reliable(spec, &averages, &data, &mut dropped)?);
    }
    // A formula that takes roughness means alpha = roughness^2; under another map it would be judged on a misreading.
    let squared = spec.region.alpha_map == AlphaMap::RoughnessSquared;
    let means_it = |entry: &&Entry| squared || !entry.takes("roughness");
    if spec.blend {
        let set = blends(spec, means_it, counter)?;
        fits.extend(set.fits);
        dropped.extend(set.dropped);
    }
    let comparable = |entries: &'static [Entry]| -> Vec<&Entry> { entries.iter().filter(means_it).collect() };
    fits.extend(each(&comparable(&SEEDS), |entry| published(spec, entry, true, &data))?);
    fits.extend(each(&comparable(&RIVALS), |entry| published(spec, entry, false, &data))?);
    Ok(FitSet { fits, dropped })
}

fn parse(entries: &[Entry]) -> Result<Vec<Hypothesis>, ShadeError> {
    entries.iter().map(|entry| Hypothesis::parse(entry.file, entry.source)).collect()
}

/// The arguments that a normalisation may have.
const INPUTS: [&str; 3] = ["roughness", "alpha", "mu"];

fn check_inputs(hypothesis: &Hypothesis) -> Result<(), FitStageError> {
    let unknown = |input: &&String| !INPUTS.contains(&input.as_str());
    match hypothesis.inputs().iter().find(unknown) {
        None if hypothesis.inputs().is_empty() => {
            let (hypothesis, known) = (hypothesis.file().to_string(), "roughness, alpha, mu");
            Err(FitStageError::NoInputs { hypothesis, known })
        }
        None => Ok(()),
        Some(input) => Err(FitStageError::Input {
            hypothesis: hypothesis.file().to_string(),
            input: input.clone(),
            known: "roughness, alpha, mu",
        }),
    }
}

/// A formula that was asked for and costs more than the scene allows.
fn too_dear(hypothesis: &Hypothesis, most: Option<u32>) -> Dropped {
    let (ops, most) = (hypothesis.tape().cost_ops(), most.unwrap_or(u32::MAX));
    Dropped {
        hypothesis: hypothesis.name().to_string(),
        norm: "any",
        reason: format!("{}: {ops} operations, max_ops is {most}", hypothesis.file()),
    }
}

/// The fits of the catalogue that can be relied on; the others are noted.
fn reliable(
    spec: &FitSpec,
    jobs: &[(Hypothesis, Norm)],
    data: &dyn Data,
    dropped: &mut Vec<Dropped>,
) -> Result<Vec<Fit>, FitStageError> {
    let results = jobs.par_iter().map(|(hypothesis, norm)| fit_one(spec, hypothesis, *norm, data)).collect();
    kept(jobs, results, dropped)
}

/// In parallel, results in order.
fn each<T: Sync>(
    jobs: &[T],
    f: impl Fn(&T) -> Result<Fit, FitStageError> + Sync + Send,
) -> Result<Vec<Fit>, FitStageError> {
    let results: Vec<Result<Fit, FitStageError>> = jobs.par_iter().map(f).collect();
    results.into_iter().collect()
}
