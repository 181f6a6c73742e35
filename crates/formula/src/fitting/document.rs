//! What is written of a fitting: a page, a document for machines, code.

use serde::Serialize;
use serde_json::{Value, json};

use super::CatalogueFit;
use super::{Certified, Demand, Fitting, FittingError, Job, Proof, catalogue, pictures, printed, words};
use crate::report::{self, FitCard, FitPage};
use lobefit::approximate::target::{Target, TargetError};
use lobefit::data::Certificate;
use lobefit::emit::header::Recipe;
use lobefit::emit::manifest::{FitEntry, SCHEMA_VERSION};
use lobefit::report::Origin;
use lobefit::store::Files;
use lobefit_fit::Gap;
use lobefit_shade::Precision;
use lobefit_shade::code::Language;

/// Tool and version.
pub(crate) const TOOL: &str = concat!("lobefit ", env!("CARGO_PKG_VERSION"));

/// The document for machines: `fits[]` as in a bake's manifest, each with all certificates and what
/// the solver did.
///
/// # Errors
/// Values that JSON does not have.
pub fn document(job: &Job, fitting: &Fitting) -> Result<Vec<u8>, FittingError> {
    let name = job.hypothesis.name();
    let fits: Vec<Value> =
        fitting.fits.iter().map(|fit| entry(job, fitting, fit)).collect::<Result<_, _>>()?;
    let include = |l: &Language| json!({"language": l.name(), "file": code_file(name, *l)});
    let document = json!({
        "schema_version": SCHEMA_VERSION,
        "tool": TOOL,
        "command": job.command,
        "recipe": recipe(job).hash,
        "fits": fits,
        "catalogue": fitting.catalogue.iter().map(CatalogueFit::entry).collect::<Vec<_>>(),
        "includes": job.languages.iter().map(include).collect::<Vec<_>>(),
        "reports": [{"file": format!("{name}.html")}, {"file": format!("{name}.json")}],
    });
    let mut bytes = serde_json::to_vec_pretty(&document)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Every file of a fitting: `NAME.html`, `NAME.json` and the code in each language.
///
/// # Errors
/// Data that the page refuses; a formula that a language cannot print.
pub fn files(job: &Job, fitting: &Fitting) -> Result<Files, FittingError> {
    let name = job.hypothesis.name();
    let mut files = Files::new();
    files.insert(format!("{name}.html"), report::fit_page(&page(job, fitting)?)?.into_bytes());
    files.insert(format!("{name}.json"), document(job, fitting)?);
    for language in &job.languages {
        let text = printed::file(*language, job, fitting, &recipe(job))?;
        files.insert(code_file(name, *language), text.into_bytes());
    }
    Ok(files)
}

fn code_file(name: &str, language: Language) -> String {
    format!("{name}.{}", language.extension())
}

/// What makes the files again: the hash covers the tool's version, the command and the formula.
fn recipe(job: &Job) -> Recipe {
    Recipe {
        command: job.command.clone(),
        tool: TOOL.into(),
        scene: String::new(),
        hash: hash(&[&job.command, job.hypothesis.source()]),
    }
}

/// A hash of the tool's version and texts.
pub(crate) fn hash(texts: &[&str]) -> String {
    let mut hasher = blake3::Hasher::new();
    for text in [&[TOOL], texts].concat() {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}

/// The manifest's entry of a fit, and what is known beyond it.
fn entry(job: &Job, fitting: &Fitting, fit: &Certified) -> Result<Value, FittingError> {
    let target = &fitting.target;
    let mut entry = match FitEntry::new("", target.alpha_map.name(), &fit.approximation) {
        Some(entry) => as_object(&entry)?,
        None => serde_json::Map::new(),
    };
    // An effect is a scene's.
    entry.remove("effect");
    let certificate = |(precision, certificate): &(Precision, Result<Certificate, _>)| match certificate {
        Ok(certificate) => as_object(certificate).map(Value::Object),
        Err(error) => Ok(failed(*precision, error)),
    };
    let certificates: Vec<Value> = fit.certificates.iter().map(certificate).collect::<Result<_, _>>()?;
    let held = fit.kept.iter().map(|kept| {
        let held = &kept.held;
        json!({
            "name": held.name, "worst": held.worst, "tolerance": held.tolerance, "points": held.points, "proven": kept.proven,
        })
    });
    let more = json!({
        "certificates": certificates,
        "constraints": held.collect::<Vec<_>>(),
        "words": target.words(),
        "weight": job.weight,
        "truth_error": target.truth_error(),
        "solver": solver(fit),
        "regular": regular(&fit.proof),
        "notes": fit.notes,
        "problems": fit.problems,
    });
    if let Value::Object(more) = more {
        entry.extend(more);
    }
    Ok(Value::Object(entry))
}

/// As JSON, floats in the digits of their type.
pub(crate) fn as_object(value: &impl Serialize) -> Result<serde_json::Map<String, Value>, serde_json::Error> {
    serde_json::from_str(&serde_json::to_string(value)?)
}

fn failed(precision: Precision, error: &TargetError) -> Value {
    json!({"precision": precision.name(), "error": error.to_string()})
}

fn regular(proof: &Proof) -> Value {
    match proof {
        Proof::Regular => json!({"proven": true}),
        Proof::NotProven(error) => json!({"proven": false, "reason": error.to_string()}),
    }
}

fn solver(fit: &Certified) -> Value {
    let fitted = &fit.fitted;
    let (kind, gap) = match fitted.gap {
        Gap::Global(gap) => ("global", Some(gap)),
        Gap::Local(gap) => ("local", Some(gap)),
        Gap::Unknown => ("unknown", None),
    };
    let stage = |s: &lobefit_fit::Stage| {
        let [method, end, ..] = words::stage(s, !fitted.constraints.is_empty());
        json!({"method": method, "end": end, "max": s.max, "rms": s.rms})
    };
    json!({
        "converged": fitted.termination.is_converged(),
        "termination": words::end(fitted),
        "second_order": fitted.second_order.name(),
        "optimality": kind,
        "gap": gap.filter(|gap| gap.is_finite()),
        "bound": fitted.bound,
        "value": fitted.value,
        "weighted": fit.weighted.map(|w| json!({"max": w.max, "rms": w.rms, "points": w.points})),
        "rank": fitted.rank,
        "undetermined": fitted.undetermined,
        "evaluations": fitted.evaluations,
        "stages": fitted.stages.iter().map(stage).collect::<Vec<_>>(),
    })
}

fn page(job: &Job, fitting: &Fitting) -> Result<FitPage, FittingError> {
    let fits = fitting.fits.iter().map(|fit| card(job, fitting, fit));
    Ok(FitPage {
        origin: Origin {
            scene: String::new(),
            recipe: recipe(job).hash,
            tool: env!("CARGO_PKG_VERSION").into(),
            command: job.command.clone(),
            pages: Vec::new(),
        },
        name: job.hypothesis.name().into(),
        asked: asked(job, fitting),
        hypothesis: job.hypothesis.source().into(),
        used_as: fitting.target.used_as,
        fits: fits.collect::<Result<_, _>>()?,
    })
}

/// What a target is, as names and values.
pub(crate) fn of_target(target: &Target) -> Vec<(String, String)> {
    let used_as = format!("{}, judged by the {}", target.used_as.name, target.used_as.metric);
    let smith = target.variant.smith.map_or_else(String::new, |smith| format!("smith: {}; ", smith.name()));
    let conventions = format!("{smith}alpha = {}", target.alpha_map.name());
    let mut rows = vec![
        ("Quantity".to_string(), format!("{}, column {}", target.quantity.name(), target.column)),
        ("Used as".into(), used_as),
        ("Conventions".into(), conventions),
    ];
    rows.extend(target.words().into_iter().map(|(input, word)| (input.to_string(), word.to_string())));
    let domain = target.ranges();
    let domain: Vec<String> =
        domain.iter().map(|(name, [low, high])| format!("{name} {low} to {high}")).collect();
    rows.push(("Domain".into(), domain.join(", ")));
    rows.push(("Truth".into(), format!("within {}", words::figure(target.truth_error()))));
    rows
}

fn asked(job: &Job, fitting: &Fitting) -> Vec<(String, String)> {
    let mut rows = of_target(&fitting.target);
    let goals: Vec<String> = job.goals.iter().map(|goal| words::minimised(*goal)).collect();
    rows.push(("Minimised".into(), goals.join("; ")));
    rows.extend(job.weight.iter().map(|weight| ("Weight".to_string(), weight.clone())));
    let demands: Vec<String> = job.demands.iter().map(Demand::words).collect();
    if !demands.is_empty() {
        rows.push(("Constraints".into(), demands.join("; ")));
    }
    rows
}

fn card(job: &Job, fitting: &Fitting, fit: &Certified) -> Result<FitCard, FittingError> {
    let certificates = fit.certificates.iter().filter_map(|(_, c)| c.as_ref().ok().cloned());
    let parameters = fit.hypothesis.parameters().iter().zip(&fit.coefficients);
    let code = job
        .languages
        .iter()
        .map(|language| Ok((language.title().to_string(), printed::function(*language, job, fitting, fit)?)));
    Ok(FitCard {
        name: fit.approximation.name.clone(),
        facts: facts(job, fitting, fit),
        ops: fit.approximation.cost.ops,
        coefficients: parameters.map(|(p, value)| (p.name.clone(), p.start, *value)).collect(),
        certificates: certificates.collect(),
        stages: fit
            .fitted
            .stages
            .iter()
            .map(|s| words::stage(s, !fit.fitted.constraints.is_empty()))
            .collect(),
        slices: pictures::slices(fit, &fitting.target)?,
        code: code.collect::<Result<_, FittingError>>()?,
    })
}

fn facts(job: &Job, fitting: &Fitting, fit: &Certified) -> Vec<(String, String)> {
    let (fitted, weight) = (&fit.fitted, job.weight.as_deref());
    let minimised = words::minimised(fit.goal) + &words::weighted(weight, fit.goal);
    let mut rows = vec![("Minimised".to_string(), minimised)];
    let error = weight.zip(fit.weighted.as_ref());
    rows.extend(error.map(|(weight, error)| ("Weighted error".into(), words::weighted_error(weight, error))));
    rows.push(("Ended as".into(), words::end(fitted)));
    rows.push(("Optimality".into(), words::optimality(fitted, weight.is_some())));
    let parameters = fitted.undetermined.iter().chain(&fit.notes);
    rows.extend(parameters.map(|text| ("Parameters".to_string(), text.clone())));
    rows.push(match &fit.proof {
        Proof::Regular => (
            "Regular".into(),
            "proven by interval arithmetic over the whole domain: every divisor keeps its sign, no root of a negative number, no \
             overflow"
                .into(),
        ),
        Proof::NotProven(error) => ("Regular".into(), format!("not proven: {error}")),
    });
    rows.extend(fit.kept.iter().map(|kept| ("Constraint".to_string(), words::constraint(kept))));
    let a = &fit.approximation;
    let beside = catalogue::beside(&fitting.catalogue, a.cost.ops, a.certificate.max_abs);
    rows.extend(beside.map(|text| ("Catalogue".into(), text)));
    let files: Vec<String> =
        job.languages.iter().map(|language| code_file(job.hypothesis.name(), *language)).collect();
    let emitted = if files.is_empty() { String::new() } else { format!("{}; ", files.join(", ")) };
    rows.push(("Emitted".into(), emitted + catalogue::by_scene(&fitting.target)));
    rows
}
