//! `lobefit fit --search` for formulas of f0: blends and coupling factors, made of two functions.

use crate::common;

use common::{lobefit, stderr};
use serde_json::Value;

/// The frontier of a search: operations, largest error, source.
fn frontier(folder: &std::path::Path, options: &[&str]) -> (Value, Vec<(u64, f64)>) {
    let all = [&["fit", "--search", "--json"][..], options].concat();
    let output = lobefit(folder, &all, b"");
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{options:?}");
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let fits = document["fits"].as_array().expect("a list");
    let figures = |fit: &Value| {
        let ops = fit["cost"]["ops"].as_u64().expect("a number");
        (ops, fit["certificate"]["max_abs"].as_f64().expect("a number"))
    };
    let figures: Vec<(u64, f64)> = fits.iter().map(figures).collect();
    assert!(figures.windows(2).all(|w| w[0].0 < w[1].0 && w[0].1 > w[1].1), "{figures:?}");
    (document, figures)
}

fn best(figures: &[(u64, f64)], ops: u64) -> f64 {
    figures.iter().filter(|f| f.0 <= ops).map(|f| f.1).fold(f64::INFINITY, f64::min)
}

/// Largest errors at 9 and 12 operations of a search no wider than a test can wait for, with the
/// command's own width they are smaller.
#[test]
fn a_blend_is_searched_as_two_functions() {
    let folder = tempfile::tempdir().expect("a folder");
    let options = ["--to", "ggx-reflection", "--use", "f0-blend", "--max-ops", "12", "--width", "3"];
    let (document, figures) = frontier(folder.path(), &[&options[..], &["--out", "two"]].concat());
    assert!(best(&figures, 9) < 0.12 && best(&figures, 12) < 0.09, "{figures:?}");
    assert_eq!(document["anchor"], "1 at roughness = 0 for f0 = 1");
    // A fit of the formula is no worse.
    let last = document["fits"].as_array().expect("a list").last().expect("a form");
    let file = format!("two/{}.wgsl", last["name"].as_str().expect("a name"));
    let arguments = ["fit", &file, "--to", "ggx-reflection", "--use", "f0-blend", "--starts", "1", "--json"];
    let output = lobefit(folder.path(), &arguments, b"");
    let fit: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let (found, fitted) = (&last["certificate"]["max_abs"], &fit["fits"][0]["certificate"]["max_abs"]);
    assert!(fitted.as_f64().expect("a number") <= 1.001 * found.as_f64().expect("a number"), "{fit}");
    assert_eq!(fit["fits"][0]["cost"], last["cost"]);
}

#[test]
fn coupling_factors_are_searched_for_every_specular() {
    let folder = tempfile::tempdir().expect("a folder");
    // Of two functions as blends are, over fewer values: the same for any number of threads.
    let narrow =
        ["--to", "diffuse-coupling", "--fix", "specular=normalised", "--max-ops", "6", "--width", "2"];
    let [one, three] = ["1", "3"].map(|threads| {
        let record = ["--threads", threads, "--record", "found.json"];
        frontier(folder.path(), &[&narrow[..], &record].concat()).0["fits"].clone()
    });
    assert_eq!(one, three);
    // The record has what the page of costs compares.
    let record = std::fs::read(folder.path().join("found.json")).expect("a record");
    let record: Value = serde_json::from_slice(&record).expect("JSON");
    assert_eq!(
        (&record["specular"], &record["domain"]),
        (&"normalised".into(), &one[0]["certificate"]["domain"])
    );
    let found = record["found"].as_array().expect("a list");
    let figures = |of: &Value, ops: &str, error: &str| (of.pointer(ops).cloned(), of.pointer(error).cloned());
    let found: Vec<_> = found.iter().map(|form| figures(form, "/ops", "/max_abs")).collect();
    let fits = one.as_array().expect("a list").iter();
    assert_eq!(found, fits.map(|fit| figures(fit, "/cost/ops", "/certificate/max_abs")).collect::<Vec<_>>());
    // A name that is no record's is refused before the work.
    let output =
        lobefit(folder.path(), &[&["fit", "--search", "--record", "found.txt"][..], &narrow].concat(), b"");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("--record found.txt: a name that ends with .json"),
        "{}",
        stderr(&output)
    );
    let options = ["--to", "diffuse-coupling", "--width", "2"];
    for (specular, ops, bar) in [("single", "8", 0.23), ("normalised", "8", 0.09), ("compensated", "8", 0.28)]
    {
        let fix = format!("specular={specular}");
        let more = ["--fix", &fix, "--max-ops", ops];
        let (_, figures) = frontier(folder.path(), &[&options[..], &more].concat());
        assert!(best(&figures, ops.parse().expect("a number")) < bar, "{specular}: {figures:?}");
    }
}

/// Cloth has no shadowing form: the output names no form.
#[test]
fn what_a_quantity_does_not_have_is_not_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments =
        ["fit", "--search", "--to", "sheen-charlie", "--max-ops", "1", "--width", "1", "--helpers", "none"];
    let output = lobefit(folder.path(), &arguments, b"");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        text.starts_with("sheen-charlie E as value, alpha = roughness^2") && !text.contains("smith"),
        "{text}"
    );
}

#[test]
fn what_formulas_of_f0_cannot_keep_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let blend = ["--to", "ggx-reflection", "--use", "f0-blend", "--max-ops", "6"];
    for (more, words) in [
        (["--exact", "alpha=0"], "fit a formula of the frontier with it"),
        (["--domain", "f0=0.04..0.04"], "fit a formula of your own without f0"),
    ] {
        let output = lobefit(folder.path(), &[&["fit", "--search"][..], &blend, &more].concat(), b"");
        let said = stderr(&output);
        assert_eq!((output.status.code(), said.contains(words)), (Some(2), true), "{more:?}: {said}");
    }
}

/// By a vendor's model the frontier falls in error as it rises in the vendor's cost, each form under
/// a name of its own, and the most accurate is that of the search by operations.
#[test]
fn a_frontier_by_what_a_vendor_pays() {
    let folder = tempfile::tempdir().expect("a folder");
    let small = ["--to", "diffuse-coupling", "--fix", "specular=normalised", "--helpers", "none"];
    let small = [&small[..], &["--max-ops", "7", "--width", "6"]].concat();
    let (_, neutral) = frontier(folder.path(), &small);
    let (document, figures) = frontier(folder.path(), &[&small[..], &["--cost", "intel"]].concat());
    let fits = document["fits"].as_array().expect("a list");
    let number = |fit: &Value, key: &str| fit.pointer(key).and_then(Value::as_f64).expect("a number");
    let points: Vec<[f64; 2]> = fits
        .iter()
        .map(|fit| ["/vendor_cost/price", "/certificate/max_abs"].map(|key| number(fit, key)))
        .collect();
    assert!(points.windows(2).all(|w| w[0][0] < w[1][0] && w[0][1] > w[1][1]), "{points:?}");
    let names: std::collections::BTreeSet<&str> =
        fits.iter().filter_map(|fit| fit["name"].as_str()).collect();
    assert_eq!(names.len(), fits.len());
    assert!(best(&figures, 7) <= best(&neutral, 7), "{figures:?} {neutral:?}");
    assert_eq!(document["fits"][0]["vendor_cost"]["family"], "skl");
    let wrong = [&["fit", "--search"][..], &small, &["--cost", "voodoo"]].concat();
    let output = lobefit(folder.path(), &wrong, b"");
    assert_eq!((output.status.code(), stderr(&output).contains("adreno")), (Some(2), true));
}

/// The output says which helpers were tried first, and says nothing of it where they are given; the
/// catalogue stands beside what is found.
#[test]
fn what_was_tried_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let average = ["--to", "ggx-average:E_avg", "--max-ops", "3"];
    let (document, figures) = frontier(folder.path(), &average);
    let tried = document["tried"].as_array().expect("a list");
    let words: Vec<&str> = tried.iter().map(|t| t["what"].as_str().expect("text")).collect();
    let expected = ["sqrt(roughness)", "exp2(-k roughness)", "exp2(form)", "sqrt(form)", "form squared"];
    assert_eq!(words, expected);
    assert!(tried.iter().all(|t| t["used"] == (t["gain"].as_f64().expect("a number") >= 0.03)), "{tried:?}");
    let (document, bare) = frontier(folder.path(), &[&average[..], &["--helpers", "none"]].concat());
    assert_eq!(document["tried"], serde_json::json!([]));
    assert!(document["command"].as_str().expect("text").contains("--helpers none"), "{document}");
    assert!(best(&figures, 3) <= best(&bare, 3) * 1.0001, "{figures:?} {bare:?}");
    let coupling = ["--to", "diffuse-coupling", "--fix", "specular=normalised", "--helpers", "none"];
    let (document, _) =
        frontier(folder.path(), &[&coupling[..], &["--max-ops", "4", "--width", "2"]].concat());
    let others = document["others"].as_array().expect("a list");
    let published = |name: &str| others.iter().find(|o| o["name"] == name).map(|o| o["published"].clone());
    assert_eq!(published("coupling_normalised_7"), Some(false.into()));
    assert_eq!(published("coupling_normalised_ue5"), Some(true.into()));
    assert_eq!(published("coupling_single_ue5"), None);
    for (helpers, words) in [
        ("reciprocal", "they have no range here"),
        ("auto,root", "auto and none stand alone"),
        ("cosine", "inverse-root"),
    ] {
        let arguments = [&["fit", "--search"][..], &average, &["--helpers", helpers]].concat();
        let output = lobefit(folder.path(), &arguments, b"");
        let said = stderr(&output);
        assert_eq!((output.status.code(), said.contains(words)), (Some(2), true), "{helpers}: {said}");
    }
}
