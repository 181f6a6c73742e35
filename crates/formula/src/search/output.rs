//! What is printed and written of a search.

use std::fmt::Write;

use serde_json::{Value, json};

use super::{Point, SearchJob, Searched, Tried, page};
use crate::fitting::catalogue::{CatalogueFit, by_scene, ways_out};
use crate::fitting::document::{TOOL, as_object, hash};
use crate::fitting::one::approximation;
use crate::fitting::{FittingError, words};
use lobefit::approximate::target::Target;
use lobefit::data::Approximation;
use lobefit::emit::header::{place, short};
use lobefit::emit::manifest::{FitEntry, SCHEMA_VERSION};
use lobefit::report::html;
use lobefit::report::words::count;
use lobefit::store::Files;
use lobefit::timing::searches::{FoundForm, SearchRecord};
use lobefit_fit::Goal;

/// A table of the frontier, then each formula.
pub fn summary(searched: &Searched, written: bool) -> String {
    let target = &searched.target;
    let exact = match searched.anchor.as_str() {
        "" => String::new(),
        anchor => format!(", each exactly {anchor}"),
    };
    let mut out = format!(
        "{} {} as {}{}, alpha = {}: {} on the frontier{exact}\n",
        target.quantity.name(),
        target.column,
        target.used_as.name,
        words::smith(target),
        target.alpha_map.name(),
        count(searched.points.len(), "form", "forms"),
    );
    // The vendor's cost stands before the errors.
    let price = |price: f64| searched.model.as_ref().map_or_else(String::new, |_| format!("  {price:>7.1}"));
    let family = searched.model.as_ref().map_or_else(String::new, |m| format!("  {:>7}", m.family));
    // Writing to a string cannot fail.
    let _ = writeln!(out, "  {:>5}{family}  {:>10}  {:>10}  worst at", "ops", "max", "rms");
    let row = |ops: u32, cost: f64, [max, rms]: [f64; 2], what: &str| {
        format!("  {ops:>5}{}  {max:>10}  {:>10}  {what}\n", price(cost), short(rms))
    };
    for point in &searched.points {
        let c = &point.certificate;
        out += &row(point.ops, point.price, [c.max_abs, c.rms], &place(&c.at));
    }
    // What costs more than the whole frontier is on the page.
    let most = searched.points.iter().map(|point| point.ops).max().unwrap_or(0);
    for (is_published, head) in [(false, "in the catalogue"), (true, "published")] {
        let of_kind = searched.catalogue.iter().filter(|r| r.published == is_published && r.ops <= most);
        let mut of_kind: Vec<_> = of_kind.collect();
        of_kind.sort_by(|a, b| a.price.total_cmp(&b.price));
        if !of_kind.is_empty() {
            let _ = writeln!(out, "  {head}, for comparison");
        }
        for other in of_kind {
            out += &row(other.ops, other.price, [other.max, other.rms], &other.name);
        }
    }
    if let Some(model) = &searched.model {
        let _ = writeln!(out, "  {}: {}, by a model of {}", model.family, model.unit, model.compiler);
    }
    out += &trials(searched);
    let how = if written { by_scene(target).into() } else { ways_out(target) };
    let _ = writeln!(out, "  emit one: {how}");
    for point in &searched.points {
        let _ = write!(out, "\n{}", file(point));
    }
    out
}

/// What was tried beforehand.
fn trials(searched: &Searched) -> String {
    if searched.tried.is_empty() {
        return String::new();
    }
    let mut out = "  tried beforehand, in narrow searches\n".to_string();
    for tried in &searched.tried {
        let _ = writeln!(out, "    {}: {}", subject(tried), tried.outcome());
    }
    out
}

/// What was tried, and in which function.
pub(super) fn subject(tried: &Tried) -> String {
    match tried.part {
        Some(part) => format!("{} in {part}", tried.words),
        None => tried.words.clone(),
    }
}

/// A formula as it is kept: a hypothesis file.
fn file(point: &Point) -> String {
    let c = &point.certificate;
    format!(
        "// {}: max {}, rms {}, in f32 at {} points.\n{}\n",
        point.hypothesis.name(),
        c.max_abs,
        short(c.rms),
        c.points,
        point.hypothesis.source().trim_end()
    )
}

fn of(point: &Point, searched: &Searched) -> Approximation {
    let constants: Vec<f32> = point.hypothesis.parameters().iter().map(|p| p.start).collect();
    approximation(&point.hypothesis, &constants, Goal::Max, &searched.target, point.certificate.clone())
}

/// The document for machines: `fits[]` as in a bake's manifest, by rising cost.
///
/// # Errors
/// Values that JSON does not have.
pub fn document(job: &SearchJob, searched: &Searched) -> Result<Vec<u8>, FittingError> {
    let entry = |point: &Point| {
        let approximation = of(point, searched);
        let entry = FitEntry::new("", searched.target.alpha_map.name(), &approximation);
        let mut entry = entry.map_or(Ok(serde_json::Map::new()), |entry| as_object(&entry))?;
        entry.remove("effect");
        entry.insert("bound".into(), json!(point.bound));
        if let Some(model) = &searched.model {
            let cost = json!({"family": model.family, "unit": model.unit, "price": point.price});
            entry.insert("vendor_cost".into(), cost);
        }
        entry.insert("file".into(), json!(format!("{}.wgsl", point.hypothesis.name())));
        Ok(Value::Object(entry))
    };
    let fits: Vec<Value> = searched.points.iter().map(entry).collect::<Result<_, serde_json::Error>>()?;
    let tried = |t: &Tried| {
        let (gain, ops, used) = (t.trial.gain, t.trial.ops, t.trial.admitted);
        json!({"what": t.words, "part": t.part, "gain": gain, "ops": ops, "used": used})
    };
    let name = searched.name();
    let document = json!({
        "schema_version": SCHEMA_VERSION,
        "tool": TOOL,
        "command": job.command,
        "recipe": hash(&[&job.command]),
        "anchor": searched.anchor,
        "tried": searched.tried.iter().map(tried).collect::<Vec<_>>(),
        "fits": fits,
        "others": searched.catalogue.iter().map(CatalogueFit::entry).collect::<Vec<_>>(),
        "reports": [{"file": format!("{name}.html")}, {"file": format!("{name}.json")}],
    });
    let mut bytes = serde_json::to_vec_pretty(&document)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// What `lobefit cost --page` shows beside the formulas of this version.
pub fn record(job: &SearchJob, searched: &Searched) -> SearchRecord {
    let Target { quantity, column, used_as, variant, .. } = &searched.target;
    let form = |point: &Point| FoundForm { ops: point.ops, max_abs: point.certificate.max_abs };
    let domain = searched.points.first().map(|point| point.certificate.domain.clone());
    SearchRecord {
        schema_version: SCHEMA_VERSION,
        command: job.command.clone(),
        quantity: quantity.name().into(),
        column: (*column).into(),
        used_as: *used_as,
        specular: variant.specular.map(|specular| specular.name().into()),
        side: variant.side.map(|side| side.name().into()),
        domain: domain.unwrap_or_default(),
        found: searched.points.iter().map(form).collect(),
    }
}

/// Every file: the page, the document, a hypothesis for each point of the frontier.
///
/// # Errors
/// Data that the page refuses.
pub fn files(job: &SearchJob, searched: &Searched) -> Result<Files, FittingError> {
    let name = searched.name();
    let mut files = Files::new();
    files.insert(format!("{name}.html"), html(&page::page(job, searched)?).into_bytes());
    files.insert(format!("{name}.json"), document(job, searched)?);
    for point in &searched.points {
        files.insert(format!("{}.wgsl", point.hypothesis.name()), file(point).into_bytes());
    }
    Ok(files)
}
