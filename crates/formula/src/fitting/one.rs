//! One fit: searched, rounded, proven regular, measured.

use super::constraint_check::{self, ConstraintCheck};
use super::poles::{Searched, Task, kept_out};
use super::vanished::{self, Obedient};
use super::weight::Weight;
use super::{FittingError, Job, words};
use lobefit::approximate::target::{Sampled, Target, TargetError};
use lobefit::approximate::{self, Memo, Places, closer, named_for, runaways};
use lobefit::data::{Approximation, Certificate, Formula, Source};
use lobefit_fit::{Constraint, FitError, Fitted, Goal, Options, Samples, optimise, round_to_f32};
use lobefit_shade::{Domain, Hypothesis, Precision, ShadeError, prove_regular};

/// Whether a formula has been proven to stay finite in its domain, by interval arithmetic.
#[derive(Clone, Debug, PartialEq)]
pub enum Proof {
    /// No divisor reaches 0 (each keeps its sign), no root of a negative number, nothing overflows.
    Regular,
    /// Not proven: where, and what may happen.
    NotProven(ShadeError),
}

/// What the weighted errors of a fit come to, at points that are spread evenly over the domain
/// whatever the norm is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// Largest magnitude of weight times error.
    pub max: f64,
    /// Root of the mean square of weight times error.
    pub rms: f64,
    /// Number of points.
    pub points: usize,
}

/// A fit with everything that is known of it.
#[derive(Clone, Debug)]
pub struct Certified {
    /// The formula as an approximation, with the certificate of the main arithmetic.
    pub approximation: Approximation,
    /// The formula under the name of this fit.
    pub hypothesis: Hypothesis,
    /// What its coefficients minimise.
    pub goal: Goal,
    /// What the search found.
    pub fitted: Fitted,
    /// Coefficients rounded to f32.
    pub coefficients: Vec<f32>,
    /// Its weighted errors, where errors were weighted.
    pub weighted: Option<Weighted>,
    /// How the constraints hold, in the order of the demands.
    pub kept: Vec<ConstraintCheck>,
    /// Whether it is finite everywhere.
    pub proof: Proof,
    /// Certificates in every arithmetic, or why there is none.
    pub certificates: Vec<(Precision, Result<Certificate, TargetError>)>,
    /// What its author may want to change in the formula, each a sentence.
    pub notes: Vec<String>,
    /// Why it cannot be relied on, each a sentence; none if it can.
    pub problems: Vec<String>,
}

pub(super) fn fit_one(
    job: &Job,
    goal: Goal,
    target: &Target,
    weight: Option<&Weight>,
    constraints: &[Constraint],
    measured: &Sampled,
) -> Result<Certified, FittingError> {
    // The only fit bears its hypothesis' name.
    let hypothesis = match job.goals.len() {
        1 => job.hypothesis.clone(),
        _ => named_for(&job.hypothesis, goal),
    };
    let domain = target.domain()?;
    let samples = samples(&hypothesis, goal, target, weight)?;
    let options = Options { starts: job.starts, ..Options::new(goal) };
    let finer = constraint_check::finer(constraints, &job.demands, target, &hypothesis, measured)?;
    let found = obedient(&hypothesis, &samples, constraints, &finer, &options, &domain)?;
    let task = Task {
        hypothesis: &hypothesis,
        samples: &samples,
        constraints,
        demands: &job.demands,
        options: &options,
        domain: &domain,
    };
    let Searched { found, finer } = kept_out(&task, Searched { found, finer }, target, measured)?;
    if !job.allow_undetermined {
        FittingError::of_rank(&hypothesis, &found.fitted)?;
    }
    let found = vanished::cleared(found, &hypothesis, &samples, &finer, &domain)?;
    let Obedient { fitted, coefficients, exact, kept } = found;
    let weighted = weight.map(|weight| weighted(&hypothesis, &exact, target, weight)).transpose()?;
    let proof =
        prove_regular(hypothesis.tape(), &exact, &domain).map_or_else(Proof::NotProven, |()| Proof::Regular);
    let places = Places { target, measured, memo: &Memo::default() };
    let certificates: Vec<(Precision, Result<Certificate, TargetError>)> =
        job.precisions.iter().map(|p| (*p, closer(&hypothesis, &coefficients, &places, *p))).collect();
    // Without the main certificate there is nothing to tell.
    let main = match &certificates[0].1 {
        Ok(certificate) => certificate.clone(),
        Err(error) => return Err(FittingError::uncertified(&hypothesis, &proof, error)),
    };
    let approximation = approximation(&hypothesis, &coefficients, goal, target, main);
    let mut fit = Certified {
        approximation,
        hypothesis,
        goal,
        fitted,
        coefficients,
        weighted,
        kept,
        proof,
        certificates,
        notes: Vec::new(),
        problems: Vec::new(),
    };
    if fit.fitted.termination.is_converged() {
        fit.notes = vanished::notes(&fit.hypothesis, &fit.coefficients, &fit.fitted);
    }
    fit.problems = problems(&fit, job.limit);
    if !job.allow_undetermined && !fit.fitted.undetermined.is_empty() && !fit.fitted.undetermined_everywhere {
        fit.problems.push(format!(
            "the search ended where {}, though elsewhere every parameter is determined: give other starting values, or a simpler formula",
            fit.fitted.undetermined.join(" and ")
        ));
    }
    Ok(fit)
}

/// Rounds in which places where a constraint was broken are added to it.
const ROUNDS: usize = 6;

/// Searches, looks where the finer constraints are broken, and searches again with these places
/// added.
pub(super) fn obedient(
    hypothesis: &Hypothesis,
    samples: &Samples,
    constraints: &[Constraint],
    finer: &[Constraint],
    options: &Options,
    domain: &Domain,
) -> Result<Obedient, FittingError> {
    let tape = hypothesis.tape();
    let search = |constraints: &[Constraint]| -> Result<Obedient, FitError> {
        let fitted = optimise(hypothesis, samples, constraints, options)?;
        let coefficients = round_to_f32(&fitted.coefficients)?;
        let exact: Vec<f64> = coefficients.iter().map(|c| f64::from(*c)).collect();
        let kept = constraint_check::kept(finer, &fitted.constraints, tape, &exact, domain)?;
        Ok(Obedient { fitted, coefficients, exact, kept })
    };
    // Where the search cannot even start, the proof knows the place in the source that is at fault.
    let mut best = search(constraints).map_err(|error| match error {
        FitError::Shade(ShadeError::NotFinite { .. }) | FitError::Solver { .. } => {
            prove_regular(tape, &hypothesis.starts(), domain).err().map_or(error, FitError::from)
        }
        FitError::Undefined { place, function, value, at } if !tape.is_free_at(&place) => {
            FitError::UndefinedAlways { place, function, value, at }
        }
        error => error,
    })?;
    let mut constraints = constraints.to_vec();
    for _ in 0..ROUNDS {
        if !constraint_check::add_broken(&mut constraints, finer, &best.kept, tape, &best.exact)? {
            break;
        }
        match search(&constraints) {
            Ok(next) => best = next,
            // The fit before stands, and where it breaks a constraint is reported as a problem.
            Err(FitError::Unsatisfiable { .. } | FitError::Solver { .. }) => break,
            Err(error) => return Err(error.into()),
        }
    }
    Ok(best)
}

fn samples(
    hypothesis: &Hypothesis,
    goal: Goal,
    target: &Target,
    weight: Option<&Weight>,
) -> Result<Samples, FittingError> {
    // The values of f0 that stand for all do so for a mean square or a maximum of errors that are
    // affine in it, as they are weighted.
    let mut target = target.clone();
    let squares = !matches!(goal, Goal::Power(p) if p != 2.0);
    target.affine &= squares && !weight.is_some_and(|weight| weight.reads("f0"));
    let sampled = match goal {
        Goal::Max => target.edged(&Memo::default())?,
        Goal::Rms | Goal::Power(_) => target.even(&Memo::default())?,
    };
    let weights = weight.map(|weight| weight.of(&sampled)).transpose()?;
    Ok(sampled.samples(hypothesis.name(), hypothesis.inputs(), weights.as_deref())?)
}

fn weighted(
    hypothesis: &Hypothesis,
    coefficients: &[f64],
    target: &Target,
    weight: &Weight,
) -> Result<Weighted, FittingError> {
    let samples = samples(hypothesis, Goal::Rms, target, Some(weight))?;
    let values = hypothesis.tape().evaluate(&samples.inputs, coefficients)?;
    let errors = values.iter().zip(&samples.scale).zip(&samples.target).map(|((v, s), t)| v * s - t);
    let (max, sum) = errors.fold((0.0_f64, 0.0), |(max, sum), e| (max.max(e.abs()), sum + e * e));
    Ok(Weighted { max, rms: (sum / samples.len() as f64).sqrt(), points: samples.len() })
}

/// The fit as an approximation, under the name of its file alone.
pub(crate) fn approximation(
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    goal: Goal,
    target: &Target,
    certificate: Certificate,
) -> Approximation {
    let form = approximate::formula(hypothesis, coefficients, &words::goal(goal));
    let form = Formula { hypothesis: stem(hypothesis.file()), ..form };
    approximate::approximation(hypothesis, form, target, Source::Fitted, certificate)
}

/// The file's own name without its extension: nothing that is written depends on where the file
/// lies.
pub(super) fn stem(file: &str) -> String {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    name.strip_suffix(".wgsl").unwrap_or(name).to_string()
}

/// Why a fit cannot be relied on.
fn problems(fit: &Certified, limit: Option<f64>) -> Vec<String> {
    let mut problems = Vec::new();
    let termination = fit.fitted.termination;
    if !termination.is_converged() {
        problems.push(format!("not converged: {}", words::end(&fit.fitted)));
    }
    let away = runaways(&fit.hypothesis, &fit.fitted.coefficients);
    problems.extend(away.map(|runaway| runaway.to_string()));
    if let Proof::NotProven(error) = &fit.proof {
        problems.push(format!("not proven finite in its domain: {error}"));
    }
    for (precision, certificate) in &fit.certificates {
        if let Err(error) = certificate {
            problems.push(format!("in {}: {error}", precision.name()));
        }
    }
    for kept in fit.kept.iter().filter(|kept| !kept.is_kept()) {
        problems.push(format!(
            "constraint `{}` is missed by {} at {}, more than rounding accounts for ({}); no constants were found that keep it \
             between the places that they are fitted to",
            kept.held.name,
            words::figure(kept.held.worst),
            kept.at,
            words::figure(kept.held.tolerance)
        ));
    }
    let error = fit.approximation.certificate.max_abs;
    if let Some(limit) = limit.filter(|limit| error > *limit) {
        problems.push(format!("largest error {error} is above the limit {limit}"));
    }
    problems
}
