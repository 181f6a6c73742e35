//! Only what the scene calls for: by files, by manifest and by the number of truths integrated.

use crate::baked_support::bake_scene;
use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::plan::plan;
use lobefit::scene::Scene;
use serde_json::Value;

fn baked(materials: &str) -> Baked {
    baked_with("", materials)
}

/// Tables and fits alone, for a test of these: neither pages nor more than one language.
fn plain(materials: &str) -> Baked {
    baked_with(r#""reports": false, "languages": ["wgsl"],"#, materials)
}

fn baked_with(more: &str, materials: &str) -> Baked {
    let json = format!(
        r#"{{"schema_version": 1, "name": "test", "pick": "all", {more} "materials": [{materials}]}}"#
    );
    let scene = Scene::from_json(json.as_bytes(), "test.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
}

/// Nothing of it is known from other tests: what it takes is counted.
fn counted(materials: &str) -> Baked {
    let json =
        format!(r#"{{"schema_version": 1, "name": "test", "pick": "all", "materials": [{materials}]}}"#);
    let scene = Scene::from_json(json.as_bytes(), "test.json").expect("a scene");
    bake(&scene, &plan(&scene), &[], Selection::default(), &Silent).expect("a bake")
}

fn manifest(baked: &Baked) -> Value {
    serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest")
}

fn names(baked: &Baked) -> Vec<&str> {
    baked.files.keys().map(String::as_str).collect()
}

const TABLE: &str = r#"{"tables":[{"size": [16, 16], "serves": "albedo"}]}"#;
const FIT: &str = r#"{"fit": {"max_ops": 7, "norms": ["max"]}}"#;

fn metal(roughness: &str, wants: &str) -> String {
    format!(r#"{{"name": "m", "kind": "metal", "f0": 0.9, "roughness": {roughness}, "wants": {wants}}}"#)
}

#[test]
fn smooth_materials_call_for_nothing() {
    let baked = baked(&metal("0", TABLE));
    assert_eq!(baked.truths, 0, "nothing is integrated");
    assert_eq!(names(&baked), ["manifest.json", "reports/index.html"]);
    let manifest = manifest(&baked);
    let reflection =
        manifest["left_out"].as_array().expect("a list").iter().find(|l| l["effect"] == "reflection");
    let reason = reflection.expect("reflection is left out")["reason"].as_str().expect("a reason");
    assert!(reason.contains("rough"), "{reason}");
    let page = String::from_utf8_lossy(&baked.files["reports/index.html"]).into_owned();
    let page = page.replace("<code>", "`").replace("</code>", "`");
    assert!(page.contains(reason), "the page says why");
}

#[test]
fn a_fit_alone_bakes_no_table_and_the_reverse() {
    let fit = counted(&metal("[0.1, 1]", FIT));
    assert!(fit.tables.is_empty() && names(&fit).iter().all(|n| !n.starts_with("tables/")));
    assert!(names(&fit).contains(&"fits/lobefit.wgsl"));
    let text = String::from_utf8_lossy(&fit.files["fits/lobefit.rs"]).into_owned();
    assert!(!text.contains("_uv(") && !text.contains("ggx_norm_q13") && text.contains("ggx_norm_r3p"));
    assert!(!text.contains("_rms(") && !text.contains("ggx_eavg"), "one norm, no average");

    let table = counted(&metal("[0.1, 1]", TABLE));
    assert!(table.fits.is_empty() && manifest(&table)["fits"].as_array().expect("a list").is_empty());
    let text = String::from_utf8_lossy(&table.files["fits/lobefit.rs"]).into_owned();
    assert!(text.contains("ggx_albedo(") && !text.contains("ggx_norm_n1"));

    let wants = format!("{}, {}", &TABLE[..TABLE.len() - 1], &FIT[1..]);
    let both = counted(&metal("[0.1, 1]", &wants));
    assert!(fit.truths > 0 && table.truths > 0);
    assert!(both.truths <= fit.truths + table.truths, "{} {} {}", both.truths, fit.truths, table.truths);
    assert!(both.truths > fit.truths && both.truths > table.truths);
    assert!(
        table.truths < fit.truths / 3,
        "a table needs no certificate of fits: {} {}",
        table.truths,
        fit.truths
    );
}

#[test]
fn a_roughness_range_narrows_table_and_fit() {
    let wants = format!("{}, {}", &TABLE[..TABLE.len() - 1], &FIT[1..]);
    let (wide, narrow) = (plain(&metal("[0.02, 1]", &wants)), plain(&metal("[0.4, 0.6]", &wants)));
    let manifest = manifest(&narrow);
    assert_eq!(manifest["tables"][0]["axes"][1]["min"], 0.4);
    assert_eq!(manifest["tables"][0]["axes"][1]["max"], 0.6);
    let fits = manifest["fits"].as_array().expect("a list");
    let fit = fits.iter().find(|f| f["name"] == "ggx_norm_r3p").expect("the fit");
    assert_eq!(fit["certificate"]["domain"]["roughness"], serde_json::json!([0.4, 0.6]));
    let error = |b: &Baked, name: &str| {
        b.fits
            .iter()
            .find(|f| f.approximation.name == name)
            .expect("the fit")
            .approximation
            .certificate
            .max_abs
    };
    let (less, more) = (error(&narrow, "ggx_norm_r3p"), error(&wide, "ggx_norm_r3p"));
    assert!(less < 0.8 * more, "less to follow, less error: {less} {more}");
    assert!(narrow.tables[0].errors.lookup.max < wide.tables[0].errors.lookup.max);
}

#[test]
fn an_open_size_is_the_smallest_that_keeps_the_limit() {
    let wants = |limit: &str| {
        format!(r#"{{"tables":[{{"serves": "split-sum", "format": "f32", "max_error": {limit}}}]}}"#)
    };
    let loose = plain(&metal("[0.1, 1]", &wants("0.01")));
    let tight = plain(&metal("[0.1, 1]", &wants("0.002")));
    let size = |b: &Baked| manifest(b)["tables"][0]["axes"][0]["size"].as_u64().expect("a size");
    assert!(size(&loose) == 16 && size(&tight) > 16, "{} {}", size(&loose), size(&tight));
    assert!(tight.broken.is_empty() && tight.tables[0].errors.lookup.max <= 0.002);
}

/// A limit that a table cannot keep ends the bake before the fits, and the message says what keeps
/// it.
#[test]
fn a_limit_of_a_table_fails_before_the_fits_and_names_what_keeps_it() {
    let wants = r#"{"tables":[{"size": [32, 32], "layout": "plain", "max_error": 0.004, "n_dot_v": [0.05, 1]}],
        "fit": {"norms": ["max"]}}"#;
    let said = plain(&metal("[0.3, 1]", wants));
    assert!(said.fits.is_empty(), "nothing is fitted");
    let [text] = &said.broken[..] else { panic!("{:?}", said.broken) };
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].ends_with("exceeds the max_error 0.004 of m (materials[0].wants.tables[0].max_error)"));
    assert!(lines[1].starts_with("worst at "), "{text}");
    for part in [
        "128x128: 32768 bytes, error 0.00",
        "32x32, layout `homogeneous` (another fetch in the shader): 2048 bytes, error 0.00",
    ] {
        let keeps = |line: &&str| line.starts_with(&format!("keeps it: {part}"));
        assert!(lines.iter().any(keeps), "{part}: {text}");
    }
    assert_eq!(
        lines.last(),
        Some(&"keeps it: no `size`: lobefit chooses the smallest square of 16, 32, 64 or 128 that does")
    );
    let nothing = r#"{"tables":[{"size": [8, 8], "max_error": 1e-9}]}"#;
    let said = plain(&metal("[0.3, 1]", nothing)).broken.concat();
    assert!(
        said.contains("\nmeasured, and not within it: 16x16 (0.0") && !said.contains("keeps it"),
        "{said}"
    );
}

/// A layout that keeps a limit in no size is advised the ranges over which it does, and a bake over
/// them keeps it, with the error that the advice states.
#[test]
fn a_limit_that_no_size_keeps_names_ranges_that_keep_it() {
    let wants = |range: &str| {
        format!(r#"{{"tables":[{{"size": [256, 8], "layout": "plain", "max_error": 0.02{range}}}]}}"#)
    };
    let text = plain(&metal("[0.02, 1]", &wants(""))).broken.concat();
    let line = text
        .lines()
        .find(|line| line.starts_with("keeps it over a part: 256x8 over `n_dot_v` "))
        .expect(&text);
    let range = |name: &str| {
        let from = &line[line.find(name).expect(name) + name.len()..];
        &from[..=from.find(']').expect("a range")]
    };
    let narrow =
        plain(&metal(range("`roughness` "), &wants(&format!(r#", "n_dot_v": {}"#, range("`n_dot_v` ")))));
    assert!(narrow.broken.is_empty(), "{line}\n{:?}", narrow.broken);
    let stated: f64 = line.rsplit(' ').next().and_then(|error| error.parse().ok()).expect("an error");
    let made = narrow.tables[0].errors.lookup.max;
    assert!((made / stated - 1.0).abs() < 1e-3, "{made} {stated}");
}

/// Constraints reach beyond the scene's range, where the best coefficients of a formula may leave it
/// without a value: the formula is left out with the reason, and the others are baked.
#[test]
fn a_formula_without_a_value_where_its_constraints_hold_is_left_out() {
    let material = format!(
        r#"{{"name": "m", "kind": "dielectric", "f0": 0.05, "roughness": [0.4, 0.9], "wants": {TABLE},
            "base": {{"albedo": 0.5, "specular": "compensated", "max_ops": 17, "norms": ["max"]}}}}"#
    );
    let baked = baked(&material);
    assert!(baked.broken.is_empty(), "{:?}", baked.broken);
    let left_out = baked.dropped.iter().find(|left| left.hypothesis == "coupling_compensated_17");
    let reason = &left_out.expect("left out").reason;
    assert!(reason.contains("is not a number at roughness = 0"), "{reason}");
    assert!(baked.fits.iter().any(|fit| fit.emitted && fit.approximation.name == "coupling_compensated_7"));
}

/// The cosines over which a table is judged stand in the manifest and above its function.
#[test]
fn a_table_may_state_the_cosines_that_it_is_judged_over() {
    let wants = |range: &str| format!(r#"{{"tables":[{{"size": [16, 16], "layout": "plain"{range}}}]}}"#);
    let narrow =
        baked_with(r#""languages": ["wgsl"],"#, &metal("[0.3, 1]", &wants(r#", "n_dot_v": [0.05, 1]"#)));
    let wide = plain(&metal("[0.3, 1]", &wants("")));
    let domain = |b: &Baked| b.tables[0].approximation.certificate.domain["mu"];
    assert_eq!((domain(&narrow), domain(&wide)), ([0.05, 1.0], [0.001, 1.0]));
    assert!(narrow.tables[0].errors.lookup.max < 0.5 * wide.tables[0].errors.lookup.max);
    let text = String::from_utf8_lossy(&narrow.files["fits/lobefit.wgsl"]).into_owned();
    assert!(text.contains("over n_dot_v [0.05, 1], roughness [0.3, 1]"), "{text}");
    let card = String::from_utf8_lossy(&narrow.files["reports/index.html"]).into_owned();
    assert!(card.contains("Its error is that over n_dot_v 0.05 to 1"), "the card says so");
    let page = |b: &Baked| String::from_utf8_lossy(&b.files["reports/reflection.html"]).into_owned();
    let part = "The part of the domain that the scene spans: roughness 0.3 to 1, ";
    assert!(page(&narrow).contains(part), "the caption speaks of the part that is seen");
    let whole = page(&baked(&metal("[0.1, 1]", r#"{"tables":[{"size": [16, 16], "layout": "plain"}]}"#)));
    assert!(whole.contains("For the GGX lobe: E is 1 for a smooth surface"), "{whole}");
}

#[test]
fn promises_that_are_not_kept_are_told() {
    let table = plain(&metal("[0.1, 1]", r#"{"tables":[{"size": [8, 8], "max_error": 0.001}]}"#));
    assert!(table.broken.len() == 1 && table.broken[0].contains("max_error 0.001"), "{:?}", table.broken);
    let fit = plain(&metal("[0.1, 1]", r#"{"fit": {"max_ops": 3, "max_error": 0.02, "norms": ["max"]}}"#));
    assert!(fit.broken.len() == 1 && fit.broken[0].contains("within 3 operations"), "{:?}", fit.broken);
}
