//! `lobefit cost`: what it measures, what it writes, and what it says where there is nothing to
//! measure.

use crate::common;

use common::{lobefit, names, stderr};
use serde_json::Value;

/// Formulas of three operations over a narrow range, and lookups of either lobe.
const SCENE: &str = r#"{"schema_version": 1, "pick": "all", "materials": [{"name": "m", "kind": "metal", "f0": 0.9,
  "roughness": [0.5, 0.6], "wants": {"fit": {"norms": ["max"], "max_ops": 7}}}],
  "probes": [{"name": "p", "norms": ["max"], "max_ops": 9,
    "lookups": [{"taps": 3}, {"lobe": "fitted"}, {"taps": 3, "lobe": "fitted"}]}]}"#;

/// A scene that calls for no effect.
const SMOOTH: &[u8] = include_bytes!("../../examples/mirrors.json");

fn positive(values: &Value) {
    let values = values.as_array().expect("a list");
    assert!(!values.is_empty());
    assert!(values.iter().all(|v| v.as_f64().is_some_and(|x| x > 0.0)), "{values:?}");
}

#[test]
fn it_writes_positive_times_beside_a_bake_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.json"), SCENE).expect("written");
    let reports = folder.path().join("out/reports");
    let run = |verb: &str, options: &[&str]| {
        let output = lobefit(folder.path(), &[&[verb, "scene.json"], options].concat(), b"");
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{verb}");
        output.stdout
    };
    let printed = run("cost", &["--out", "out", "--json"]);
    assert_eq!(names(&folder.path().join("out")), ["reports"]);
    assert_eq!(names(&reports), ["timings.html", "timings.json"]);
    assert_eq!(std::fs::read(reports.join("timings.json")).expect("written"), printed);
    let times: Value = serde_json::from_slice(&printed).expect("one JSON document");
    let points = times["points"].as_array().expect("a list");
    assert!(points.len() >= 2, "an easy and a hard point");
    for series in points.iter().flat_map(|p| p["series"].as_array().expect("a list")) {
        positive(&series["seconds"]);
        positive(&series["error"]);
        assert_eq!(series["seconds"].as_array().map(Vec::len), series["error"].as_array().map(Vec::len));
    }
    let evaluations = times["evaluations"].as_array().expect("a list");
    assert!(evaluations.len() >= 12, "the published formulas at least");
    for one in evaluations {
        positive(&serde_json::json!([one["nanoseconds"], one["max_error"]]));
    }

    let lookups = times["lookups"].as_array().expect("a list");
    assert_eq!(
        lookups.iter().filter(|one| one["lookup"].to_string().contains("of the fitted lobe")).count(),
        2
    );
    positive(&lookups.iter().map(|one| one["nanoseconds"].clone()).collect());

    assert!(run("bake", &["--out", "out", "--quiet"]).is_empty());
    assert!(run("cost", &["--out", "out", "--quiet"]).is_empty());
    assert!(names(&reports).contains(&"timings.json".to_string()), "the bake leaves the timings");
    let text = String::from_utf8(run("check", &["--against", "out"])).expect("text");
    assert!(text.contains("follow from their recipe"), "{text}");
}

#[test]
fn a_scene_without_rough_speculars_is_not_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |options: &[&str]| {
        let output = lobefit(folder.path(), &[&["cost", "-", "--out", "out"], options].concat(), SMOOTH);
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{options:?}");
        assert!(names(folder.path()).is_empty(), "{options:?}: nothing is written");
        output.stdout
    };
    let text = String::from_utf8(run(&[])).expect("text");
    assert!(text.contains("nothing to measure, nothing written"), "{text}");
    assert!(run(&["--quiet"]).is_empty());
    for options in [&["--json"][..], &["--quiet", "--json"]] {
        let times: Value = serde_json::from_slice(&run(options)).expect("one JSON document");
        for key in ["points", "evaluations"] {
            assert_eq!(times[key], serde_json::json!([]), "{key}");
        }
        assert!(
            times["origin"].is_object() && times["device"].is_string() && times["schema_version"].is_u64()
        );
    }
}
