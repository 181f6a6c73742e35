//! What is written of a fitting: a page, a document for machines, code.

use serde::Serialize;
use serde_json::{Value, json};

use super::CatalogueFit;
use super::{Certified, Fitting, FittingError, Job, Proof, page, printed, words};
use lobefit::approximate::target::{Target, TargetError};
use lobefit::data::Certificate;
use lobefit::emit::header::Recipe;
use lobefit::emit::manifest::{FitEntry, SCHEMA_VERSION};
use lobefit::report::{Origin, html};
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
    files.insert(format!("{name}.html"), html(&page::page(job, fitting)?).into_bytes());
    files.insert(format!("{name}.json"), document(job, fitting)?);
    for language in &job.languages {
        let text = printed::file(*language, job, fitting, &recipe(job))?;
        files.insert(code_file(name, *language), text.into_bytes());
    }
    Ok(files)
}

pub(super) fn code_file(name: &str, language: Language) -> String {
    format!("{name}.{}", language.extension())
}

/// What makes the files again: the hash covers the tool's version, the command and the formula.
pub(super) fn recipe(job: &Job) -> Recipe {
    Recipe {
        command: job.command.clone(),
        tool: TOOL.into(),
        scene: String::new(),
        hash: hash(&[&job.command, job.hypothesis.source()]),
    }
}

/// What made the page of a fitting or of a search by a name; its scene is empty.
pub(crate) fn origin(name: &str, command: &str, recipe: String) -> Origin {
    let origin = Origin {
        scene: String::new(),
        recipe,
        tool: env!("CARGO_PKG_VERSION").into(),
        command: command.into(),
        pages: Vec::new(),
    };
    origin.with_figures(&format!("{name}.json"))
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
