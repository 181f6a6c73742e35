//! Fits of this effect: hypotheses to coefficients, proven regular and measured in f32 as emitted.

use rayon::prelude::*;

use super::catalogue::{AVERAGES, Entry, NORMALISATIONS, RIVALS, SEEDS};
use super::samples::{AverageData, Data, FitData};
use super::{Counter, PointSet, Region};
use crate::data::{
    AlphaMap, Approximation, Certificate, Cost, Form, Formula, Norm, Place, Smith, Source, Use,
};
use crate::fit::{
    Domain, FitError, Hypothesis, Options, Termination, measure_first, optimise, prove_regular, round_to_f32,
    round_up,
};
use crate::integrate::IntegrateError;

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSpec {
    /// Shadowing form.
    pub smith: Smith,
    /// Where the fits must hold.
    pub region: Region,
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// Errors to minimise.
    pub norms: Vec<Norm>,
    /// Also fit the average albedo.
    pub average: bool,
    /// The user's hypotheses: file name and WGSL source.
    pub hypotheses: Vec<(String, String)>,
}

/// A formula with coefficients, measured.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The formula as an approximation.
    pub approximation: Approximation,
    /// The hypothesis that it is an instance of.
    pub hypothesis: Hypothesis,
    /// How the search ended; none for published constants.
    pub termination: Option<Termination>,
    /// Whether it is emitted, or only reported for comparison.
    pub emitted: bool,
    /// The function that a saturating form calls.
    pub wraps: Option<String>,
}

/// A hypothesis without a fit: one of the catalogue whose search did not converge in this region or into which a pole moves, or
/// one of the user's that costs more than the scene allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// Hypothesis.
    pub hypothesis: String,
    /// Norm that was minimised.
    pub norm: &'static str,
    /// Why, in words.
    pub reason: String,
}

/// Everything that a fit job gives.
#[derive(Clone, Debug)]
pub struct FitSet {
    /// Fits and published formulas.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue without a fit.
    pub dropped: Vec<Dropped>,
}

/// Why there is no fit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitStageError {
    /// The hypothesis, its domain or its data.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// The search did not end in a minimum.
    #[error("{hypothesis}, norm {norm}: the search ended as {termination:?}: no coefficients to rely on")]
    NotConverged {
        /// File of the hypothesis.
        hypothesis: String,
        /// Norm that was minimised.
        norm: &'static str,
        /// How the search ended.
        termination: Termination,
    },
    /// The hypothesis asks for an input that this effect does not have.
    #[error("{hypothesis}: argument `{input}` is not one of {known}")]
    Input {
        /// File of the hypothesis.
        hypothesis: String,
        /// The argument.
        input: String,
        /// The inputs there are.
        known: &'static str,
    },
}

/// Fits and measures everything that the spec asks for: ours by rising cost, the user's, the source's published formulas, and
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
    let saturating: Vec<&Fit> = fits.iter().filter(|f| f.norm() == Norm::Max.name()).collect();
    let saturating = each(&saturating, |fit| saturate(spec, fit, &data))?;
    fits.extend(saturating.into_iter().filter(|f| affordable(&f.hypothesis)));
    if spec.average {
        let averages = jobs(parse(&AVERAGES)?);
        let data = AverageData::new(spec.smith, &spec.region, counter)?;
        fits.extend(reliable(spec, &averages, &data, &mut dropped)?);
    }
    fits.extend(published(spec, &SEEDS, true, &data)?);
    fits.extend(published(spec, &RIVALS, false, &data)?);
    Ok(FitSet { fits, dropped })
}

impl Fit {
    /// The norm that its coefficients minimise: `max`, `rms` or `published`.
    pub fn norm(&self) -> &str {
        match &self.approximation.form {
            Form::Formula(formula) => &formula.norm,
            Form::Table(_) => "",
        }
    }

    /// Its coefficients, in order.
    pub fn coefficients(&self) -> Vec<f32> {
        match &self.approximation.form {
            Form::Formula(formula) => formula.coefficients.iter().map(|(_, value)| *value).collect(),
            Form::Table(_) => Vec::new(),
        }
    }

    /// Its values in f32 at the points of a set; f0 = 1.
    pub fn values(&self, points: &PointSet) -> Result<Vec<f32>, FitError> {
        let inputs: Vec<Vec<f32>> = self.hypothesis.inputs().iter().map(|name| points.column(name)).collect();
        self.hypothesis.tape().evaluate(&inputs, &self.coefficients())
    }
}

fn parse(entries: &[Entry]) -> Result<Vec<Hypothesis>, FitError> {
    entries.iter().map(|entry| Hypothesis::parse(entry.file, entry.source)).collect()
}

/// The arguments that a normalisation may have.
const INPUTS: [&str; 3] = ["roughness", "alpha", "mu"];

fn check_inputs(hypothesis: &Hypothesis) -> Result<(), FitStageError> {
    match hypothesis.inputs().iter().find(|input| !INPUTS.contains(&input.as_str())) {
        None => Ok(()),
        Some(input) => Err(FitStageError::Input {
            hypothesis: hypothesis.file().to_string(),
            input: input.clone(),
            known: "roughness, alpha, mu",
        }),
    }
}

/// A hypothesis of the user's that costs more than the scene allows.
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
    let results: Vec<Result<Fit, FitStageError>> =
        jobs.par_iter().map(|(hypothesis, norm)| fit_one(spec, hypothesis, *norm, data)).collect();
    let mut fits = Vec::new();
    for ((hypothesis, norm), result) in jobs.iter().zip(results) {
        match result {
            Ok(fit) => fits.push(fit),
            Err(
                error @ (FitStageError::NotConverged { .. } | FitStageError::Fit(FitError::Irregular { .. })),
            ) => dropped.push(Dropped {
                hypothesis: hypothesis.name().to_string(),
                norm: norm.name(),
                reason: error.to_string(),
            }),
            Err(error) => return Err(error),
        }
    }
    Ok(fits)
}

/// In parallel, results in order.
fn each<T: Sync>(
    jobs: &[T],
    f: impl Fn(&T) -> Result<Fit, FitStageError> + Sync + Send,
) -> Result<Vec<Fit>, FitStageError> {
    let results: Vec<Result<Fit, FitStageError>> = jobs.par_iter().map(f).collect();
    results.into_iter().collect()
}

/// The box of inputs, alpha following from roughness.
fn domain(region: &Region) -> Result<Domain, FitError> {
    let power = match region.alpha_map {
        AlphaMap::Roughness => 1,
        AlphaMap::RoughnessSquared => 2,
        AlphaMap::RoughnessFourth => 4,
    };
    let ([r0, r1], [m0, m1]) = (region.roughness, region.mu);
    Domain::new(&[("roughness", r0, r1), ("mu", m0, m1)])?.with_derived("alpha", "roughness", power)
}

fn fit_one(
    spec: &FitSpec,
    hypothesis: &Hypothesis,
    norm: Norm,
    data: &dyn Data,
) -> Result<Fit, FitStageError> {
    let domain = domain(&spec.region)?;
    let fitted = optimise(hypothesis, &data.samples(hypothesis, norm)?, &Options::new(norm));
    // Where the search cannot even start, the proof knows the place in the source that is at fault.
    let fitted = fitted.map_err(|error| {
        prove_regular(hypothesis.tape(), &hypothesis.starts(), &domain).err().unwrap_or(error)
    })?;
    if !fitted.termination.is_converged() {
        let (hypothesis, norm) = (hypothesis.file().to_string(), norm.name());
        return Err(FitStageError::NotConverged { hypothesis, norm, termination: fitted.termination });
    }
    let coefficients = round_to_f32(&fitted.coefficients)?;
    let exact: Vec<f64> = coefficients.iter().map(|c| f64::from(*c)).collect();
    prove_regular(hypothesis.tape(), &exact, &domain)?;
    let hypothesis = named_for(hypothesis, norm)?;
    let form = formula(&hypothesis, &coefficients, norm.name());
    let name = hypothesis.name().to_string();
    let approximation = certified(spec, name, &hypothesis, form, Source::Fitted, data)?;
    Ok(Fit { approximation, hypothesis, termination: Some(fitted.termination), emitted: true, wraps: None })
}

/// The minimax fit bears its hypothesis' name; the least squares fit has `_rms` appended, so that both can be emitted.
fn named_for(hypothesis: &Hypothesis, norm: Norm) -> Result<Hypothesis, FitError> {
    match norm {
        Norm::Max => Ok(hypothesis.clone()),
        Norm::Rms => {
            let name = hypothesis.name();
            let source = hypothesis.source().replace(&format!("fn {name}("), &format!("fn {name}_rms("));
            Hypothesis::parse(hypothesis.file(), &source)
        }
    }
}

fn published(
    spec: &FitSpec,
    entries: &[Entry],
    emitted: bool,
    data: &FitData,
) -> Result<Vec<Fit>, FitStageError> {
    let comparable = |entry: &&Entry| {
        // A formula that takes roughness means alpha = roughness^2; under another map it would be judged on a misreading.
        spec.region.alpha_map == AlphaMap::RoughnessSquared || !entry.source.contains("(roughness: f32")
    };
    let entries: Vec<&Entry> = entries.iter().filter(comparable).collect();
    each(&entries, |entry| {
        let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
        let source = Source::Published(entry.publication.unwrap_or_default().to_string());
        let form = formula(&hypothesis, &[], "published");
        let name = hypothesis.name().to_string();
        let approximation = certified(spec, name, &hypothesis, form, source, data)?;
        let affordable = spec.max_ops.is_none_or(|most| approximation.cost.ops <= most);
        Ok(Fit { approximation, hypothesis, termination: None, emitted: emitted && affordable, wraps: None })
    })
}

/// 1 + f0 (N - 1), which is exact where f0 = 1 wherever N is. With F the furnace error of N, its relative error against
/// 1 + f0 (1/E - 1) is F f0/(E + f0 (1 - E)) <= F for every f0 in [0, 1], so N's certificate stands for it.
fn saturate(spec: &FitSpec, fit: &Fit, data: &FitData) -> Result<Fit, FitStageError> {
    let (inner, inputs) = (fit.hypothesis.name(), fit.hypothesis.inputs());
    let declared: Vec<String> = inputs.iter().map(|input| format!("{input}: f32")).collect();
    let source = format!(
        "{}\n/// Saturating compensation 1 + f0 (N - 1): a metal gains colour as light scatters more than once.\n\
         fn {inner}_saturating({}, f0: f32) -> f32 {{\n    return 1.0 + f0 * ({inner}({}) - 1.0);\n}}\n",
        fit.hypothesis.source(),
        declared.join(", "),
        inputs.join(", "),
    );
    let hypothesis = Hypothesis::parse(fit.hypothesis.file(), &source)?;
    let Form::Formula(form) = &fit.approximation.form else {
        return Ok(fit.clone());
    };
    let mut form = form.clone();
    form.inputs = hypothesis.inputs().to_vec();
    let name = hypothesis.name().to_string();
    let approximation = certified(spec, name, &hypothesis, form, Source::Fitted, data)?;
    Ok(Fit {
        approximation,
        hypothesis,
        termination: fit.termination,
        emitted: true,
        wraps: Some(inner.to_string()),
    })
}

fn formula(hypothesis: &Hypothesis, coefficients: &[f32], norm: &str) -> Formula {
    let names = hypothesis.parameters().iter().map(|p| p.name.clone());
    Formula {
        hypothesis: hypothesis.file().trim_end_matches(".wgsl").to_string(),
        inputs: hypothesis.inputs().to_vec(),
        coefficients: names.zip(coefficients.iter().copied()).collect(),
        norm: norm.to_string(),
    }
}

/// Measures a formula at points that it was not fitted on, in f32 as emitted.
fn certified(
    spec: &FitSpec,
    name: String,
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
        name,
        quantity: quantity.into(),
        column: column.into(),
        used_as,
        smith: spec.smith,
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

/// The use of the normalisations.
pub(super) const NORMALISATION: (&str, &str, Use) = ("ggx-reflection", "E", Use::Normalisation);

/// The use of the averages.
pub(super) const AVERAGE: (&str, &str, Use) = ("ggx-average", "E_avg", Use::Value);
