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
    // What another measurement left is replaced.
    std::fs::create_dir_all(&reports).expect("a folder");
    for name in ["timings.html", "timings.json"] {
        std::fs::write(reports.join(name), "older").expect("written");
    }
    let printed = run("cost", &["--out", "out", "--json"]);
    assert_eq!(names(&folder.path().join("out")), ["reports"]);
    assert_eq!(names(&reports), ["timings.html", "timings.json"]);
    assert_eq!(std::fs::read(reports.join("timings.json")).expect("written"), printed);
    assert_ne!(std::fs::read(reports.join("timings.html")).expect("written"), b"older");
    let times: Value = serde_json::from_slice(&printed).expect("one JSON document");
    let evaluations = times["evaluations"].as_array().expect("a list");
    assert!(evaluations.len() >= 12, "the published formulas at least");
    for one in evaluations {
        positive(&serde_json::json!([one["nanoseconds"], one["max_error"]]));
    }

    // Each effect has a bake by itself beside that of both.
    let alone = times["effects"]["alone"].as_array().expect("a list");
    let effects: Vec<&str> = alone.iter().filter_map(|one| one["effect"].as_str()).collect();
    assert_eq!(effects, ["reflection", "parallax"]);
    positive(
        &alone.iter().map(|one| one["seconds"].clone()).chain([times["effects"]["all"].clone()]).collect(),
    );

    let lookups = times["lookups"].as_array().expect("a list");
    assert_eq!(
        lookups.iter().filter(|one| one["lookup"].to_string().contains("of the fitted lobe")).count(),
        2
    );
    positive(&lookups.iter().map(|one| one["nanoseconds"].clone()).collect());

    std::fs::write(folder.path().join("scene.json"), SMOOTH).expect("written");
    assert!(run("bake", &["--out", "out", "--quiet"]).is_empty());
    assert_eq!(std::fs::read(reports.join("timings.json")).expect("the bake leaves the timings"), printed);
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
        assert_eq!(times["evaluations"], serde_json::json!([]));
        assert!(
            times["origin"].is_object() && times["device"].is_string() && times["schema_version"].is_u64()
        );
    }
}

/// Runs `cost` on the scene with limits: its exit code, what it says, and what it prints as JSON.
fn limited(limits: &[&str]) -> (Option<i32>, String, Value) {
    const LIMITED: &[u8] = br#"{"schema_version": 1, "materials": [{"name": "m", "kind": "metal", "f0": 0.9,
      "roughness": [0.3, 1], "wants": {"tables": [{"size": [16, 16]}], "fit": {"max_error": 0.5}}}]}"#;
    let folder = tempfile::tempdir().expect("a folder");
    let output = lobefit(folder.path(), &[&["cost", "-", "--json"], limits].concat(), LIMITED);
    assert!(names(folder.path()).is_empty(), "{limits:?}: nothing is written");
    (output.status.code(), stderr(&output), serde_json::from_slice(&output.stdout).unwrap_or_default())
}

/// The call of a function among what is to be shipped.
fn shipped<'a>(found: &'a Value, function: &str) -> Option<&'a Value> {
    found["ship"].as_array().expect("a list").iter().find(|of| of["function"] == function)
}

/// A coat and the lobe below it call the same function, each with a roughness of its own.
#[test]
fn each_layer_has_its_functions() {
    const COATED: &[u8] =
        br#"{"schema_version": 1, "materials": [{"name": "m", "kind": "dielectric", "ior": 1.5,
      "roughness": [0.3, 0.8], "base": {"albedo": 0.5}, "coat": {"roughness": 0.2, "ior": 1.6},
      "wants": {"exact_fresnel": {}}}]}"#;
    let folder = tempfile::tempdir().expect("a folder");
    let output = lobefit(folder.path(), &["cost", "-", "--json", "--max-error", "0.05"], COATED);
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let ship = found["ship"].as_array().expect("a list");
    let layers = ship.iter().filter(|of| of["function"] == "ggx_dielectric_albedo").map(|of| &of["layer"]);
    let layers: Vec<&Value> = layers.collect();
    assert!(layers.len() == 2 && layers.contains(&&Value::from("coat")), "{layers:?}");
}

const FORMULA: &str = "ggx_energy_compensation_rgb";

#[test]
fn limits_say_what_to_ship_with_the_line_that_calls_it() {
    let (code, said, found) = limited(&["--max-error", "0.02", "--max-bytes", "4096"]);
    assert_eq!((code, said.as_str(), &found["unkept"]), (Some(0), "", &serde_json::json!([])));
    let table = shipped(&found, "ggx_albedo").expect("a table");
    let bytes = table["cost"]["bytes"].as_u64().expect("bytes");
    assert!(bytes <= 4096 && table["max_error"].as_f64().expect("an error") <= 0.02);
    let formula = shipped(&found, FORMULA).expect("a formula");
    assert_eq!(formula["snippet"], "let value = ggx_energy_compensation_rgb(roughness, n_dot_v, f0);");
    assert!(formula["code"].as_str().expect("code").contains("fn ggx_energy_compensation(roughness: f32"));
    let error = formula["max_error"].as_f64().expect("an error");
    assert_eq!(formula["field"], format!("materials[0].wants.fit: \"max_error\": {error}"));
    let size = "materials[0].wants.tables[0]: \"size\": [";
    assert!(table["field"].as_str().expect("a field").starts_with(size), "{table}");
    // The two are of one purpose, of which the function is recommended, as `bake` has it.
    assert_eq!(table["purpose"], formula["purpose"]);
    assert_eq!([&table["recommended"], &formula["recommended"]], [&Value::Bool(false), &Value::Bool(true)]);
    // With room alone the most accurate table is taken, and by a stricter limit a dearer formula.
    let (_, _, large) = limited(&["--max-bytes", "4096"]);
    let large = shipped(&large, "ggx_albedo").expect("a table");
    assert!(large["cost"]["bytes"].as_u64() > Some(bytes) && large["cost"]["bytes"].as_u64() <= Some(4096));
    let (_, _, strict) = limited(&["--max-error", "0.012", "--language", "hlsl"]);
    let strict = shipped(&strict, FORMULA).expect("a formula");
    assert!(strict["cost"]["ops"].as_u64() > formula["cost"]["ops"].as_u64());
    assert!(strict["snippet"].as_str().expect("a line").starts_with("float3 value = "), "{strict}");
}

#[test]
fn a_budget_is_counted_in_operations_or_by_the_model_of_a_vendor() {
    let (code, _, within) = limited(&["--budget", "20"]);
    let formula = shipped(&within, FORMULA).expect("a formula").clone();
    assert_eq!(
        (code, formula["cost"]["ops"].as_u64() <= Some(20), formula.get("price")),
        (Some(0), true, None)
    );
    let (code, said, dear) = limited(&["--budget", "20", "--vendor", "Intel"]);
    assert_eq!((code, shipped(&dear, "ggx_albedo")), (Some(1), None), "the arithmetic of a table costs more");
    let unkept = dear["unkept"].to_string();
    assert!(unkept.contains("ggx_albedo (m) is the nearest to the limits: Intel cost of "), "{unkept}");
    assert_eq!(said, "");
    let price = shipped(&dear, FORMULA).map(|of| of["price"].as_f64().expect("a price"));
    assert!(price.is_none_or(|price| price <= 20.0), "{price:?}");
    let (_, _, roomy) = limited(&["--budget", "100", "--vendor", "intel"]);
    let roomy = shipped(&roomy, FORMULA).expect("a formula");
    let price = roomy["price"].as_f64().expect("a price");
    assert!(price > 20.0 && price <= 100.0, "{price}");
    assert_eq!(dear["unit"], "cycles of a wave");
    // Beside a vendor's cost operations stand as ever; a formula that is called for more is said to be.
    let two = br#"{"schema_version": 1, "materials": [{"name": "m", "kind": "metal", "f0": 0.6, "roughness": [0.3, 1], "wants": {"fit": {}}},
      {"name": "d", "kind": "dielectric", "ior": 1.5, "roughness": [0.3, 1], "wants": {"fit": {}}}]}"#;
    let folder = tempfile::tempdir().expect("a folder");
    for (options, columns, dearer) in [
        (&["--budget", "100", "--vendor", "intel"][..], "operations  Intel cost  fetches", true),
        (&["--budget", "16"], "operations  fetches", true),
        (&["--max-error", "0.02"], "operations  fetches", false),
    ] {
        let output = lobefit(folder.path(), &[&["cost", "-"], options].concat(), two);
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.lines().next().is_some_and(|header| header.contains(columns)), "{text}");
        let held = "the budget holds for ggx_energy_compensation_rgb, which costs more than ggx_energy_compensation of";
        assert_eq!(text.contains(held), dearer, "{text}");
    }
    // What a scene picks by, `bake` prints.
    let priced =
        br#"{"schema_version": 1, "cost": "intel", "reports": false, "languages": ["wgsl"], "materials": [
      {"name": "m", "kind": "metal", "f0": 0.6, "roughness": 0.5, "wants": {"fit": {}}}]}"#;
    let output = lobefit(folder.path(), &["bake", "-"], priced);
    let text = String::from_utf8_lossy(&output.stdout);
    let header = text.lines().next().expect("a header");
    assert!(header.contains("operations  Intel cost  fetches"), "{text} {}", stderr(&output));
    // Tables whose sizes a limit on the error would leave open: every job is shipped, or said to be beyond.
    let sized = br#"{"schema_version": 1, "materials": [
      {"name": "a", "kind": "metal", "f0": 0.6, "roughness": [0.3, 1], "wants": {"tables": [{"size": [8, 8], "layout": "plain"}]}},
      {"name": "b", "kind": "metal", "f0": 0.6, "roughness": [0.3, 1], "wants": {"tables": [{"size": [16, 16], "layout": "plain"}]}},
      {"name": "c", "kind": "metal", "f0": 0.6, "roughness": [0.3, 1], "wants": {"fit": {"max_ops": 9}}}]}"#;
    let output = lobefit(folder.path(), &["cost", "-", "--budget", "1000"], sized);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("ggx_energy_compensation_rgb") && text.contains("16"), "{text}");
    let output = lobefit(folder.path(), &["cost", "-", "--budget", "2", "-q"], sized);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    // A function beside the normalisation that no formula gives is not passed over.
    let blend = br#"{"schema_version": 1, "materials": [{"name": "m", "kind": "dielectric", "ior": 1.5,
      "roughness": [0.3, 1], "wants": {"fit": {"blend": true}}}]}"#;
    let folder = tempfile::tempdir().expect("a folder");
    let output = lobefit(folder.path(), &["cost", "-", "--budget", "8"], blend);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("ggx_directional_albedo: no formula is within the limits: ggx_blend_11 "),
        "{said}"
    );
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("ggx_energy_compensation("), "what is within the limits is shipped: {text}");
    // The advice of an error that nothing keeps is the least there is.
    let output = lobefit(folder.path(), &["cost", "-", "--max-error", "1e-9"], blend);
    let said = stderr(&output);
    assert!(said.contains("raise max_error to 0.0") && said.contains(", which ggx_"), "{said}");
}

#[test]
fn what_nothing_keeps_names_the_nearest() {
    let folder = tempfile::tempdir().expect("a folder");
    let (code, _, found) = limited(&["--budget", "5", "--max-error", "0.01"]);
    assert_eq!((code, shipped(&found, FORMULA)), (Some(1), None));
    let unkept = found["unkept"].to_string();
    assert!(unkept.contains(" keeps it: error ") && unkept.contains("operations"), "{unkept}");
    for (words, part) in [
        (&["cost", "--vendor", "amd"][..], "required"),
        (&["cost", "--budget", "0"], "above 0"),
        (&["cost", "--max-error", "0.1", "--gpu"], "cannot be used with"),
        (&["cost", "--max-error", "0.1", "--language", "cuda"], "no such language"),
        (&["cost", "x.json", "--page", "reports/gpu/x.json"], "leave the scene out"),
    ] {
        let output = lobefit(folder.path(), words, b"");
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        assert!(stderr(&output).contains(part), "{words:?}: {}", stderr(&output));
    }
}

/// Of lookups of a probe the one within a budget is the most accurate, though all have the error of one
/// width.
#[test]
fn a_budget_takes_the_most_accurate_lookup_within_it() {
    let probe = br#"{"schema_version": 1, "materials": [], "probes": [{"name": "hall", "roughness": [0.3, 0.6], "rho": [0.5, 2],
      "mips": {"map": "log", "count": 7}, "lookups": [{"hit": true}, {"edges": "sharp"}, {}]}]}"#;
    let folder = tempfile::tempdir().expect("a folder");
    for (budget, name) in [("30", "hit_log_7"), ("100", "box_sharp_1_log_7"), ("200", "box_smooth_1_log_7")] {
        let output = lobefit(folder.path(), &["cost", "-", "--budget", budget], probe);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let found: Vec<&str> = text.lines().filter(|line| line.starts_with("parallax_lookup_")).collect();
        assert!(
            found.len() == 1 && found[0].starts_with(&format!("parallax_lookup_{name}")),
            "{budget}: {text}"
        );
    }
}
