//! The effect of `toy_effect.rs` goes the whole way that those of the catalogue go.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use lobefit::bake::{Baked, Selection, Silent, bake, compare};
use lobefit::effects::catalogue;
use lobefit::plan::{Plan, plan_with};
use lobefit::scene::Scene;
use lobefit_truth::quantity::{Quantity, Variant};
use serde_json::{Value, json};

use crate::toy_effect::{Minnaert, Moon};

fn planned() -> (Scene, Plan) {
    let text = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":0}]}"#;
    let scene = Scene::from_json(text.as_bytes(), "test").expect("a scene");
    let all: Vec<_> = catalogue().iter().copied().chain([&Moon as _]).collect();
    let plan = plan_with(&scene, &all);
    (scene, plan)
}

/// Its bake, for the tests that look at it.
static BAKED: LazyLock<Baked> = LazyLock::new(|| {
    let (scene, plan) = planned();
    bake(&scene, &plan, &[], Selection::default(), &Silent).expect("a bake")
});

#[test]
fn it_takes_less_than_100_lines() {
    let lines = include_str!("toy_effect.rs").lines().count();
    assert!(lines < 100, "{lines}");
}

/// The albedo by the integrator that every quantity has is that of the closed form.
#[test]
fn its_truth_is_the_closed_form() {
    for (alpha, mu) in [(0.05, 1.0), (0.3, 0.01), (0.7, 0.4), (1.0, 0.9)] {
        let variant = Variant::default();
        let found = Minnaert.at(&variant, &[alpha, mu], Minnaert.tolerance(&variant)).expect("integrated");
        let exact = 2.0 * lobefit_math::ops::pow(mu, alpha) / (2.0 + alpha);
        assert!((found[0] - exact).abs() <= found[1].max(1e-12), "{alpha} {mu}: {found:?} {exact}");
    }
}

#[test]
fn it_is_planned_beside_the_others() {
    let (_, plan) = planned();
    let called: Vec<&str> = plan.effects.iter().map(|called| called.effect).collect();
    assert_eq!(called, ["moon"]);
    assert_eq!(plan.effects[0].because, ["m: metal that is drawn as the moon is (roughness 0.3 to 1)"]);
    assert_eq!(plan.left_out.len(), catalogue().len());
}

#[test]
fn it_is_baked_emitted_and_shown() {
    let baked = &*BAKED;
    assert!(baked.broken.is_empty(), "{:?}", baked.broken);
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest");
    let table = &manifest["tables"][0];
    let words = ["effect", "name", "quantity", "use"].map(|key| table[key].as_str().expect("a word"));
    assert_eq!(words, ["moon", "minnaert-16x12", "minnaert", "value"]);
    assert_eq!(
        (&table["smith"], &table["channels"], &table["bytes"]),
        (&Value::Null, &json!(["loss"]), &json!(384))
    );
    let error = table["error"]["lookup"]["max"].as_f64().expect("an error");
    assert!(error > 1e-5 && error < 0.02, "{error}");
    let fit = &manifest["fits"][0];
    assert_eq!((&fit["function"], &fit["smith"]), (&json!("minnaert_albedo"), &Value::Null));
    assert!(baked.files.contains_key("tables/minnaert-16x12.exr"));
    let text = |path: &str| String::from_utf8_lossy(&baked.files[path]).into_owned();
    for extension in ["wgsl", "h", "rs", "hlsl", "glsl", "metal"] {
        let text = text(&format!("fits/lobefit.{extension}"));
        assert!(text.contains("minnaert_lookup(") && text.contains("minnaert_albedo("), "{extension}");
    }
    let page = text("reports/moon.html");
    assert!(page.contains("minnaert-16x12") && page.contains("minnaert_e"), "{page}");
}

#[test]
fn it_is_checked() {
    let (made, mut found) = (&*BAKED, BAKED.files.clone());
    assert!(compare(made, &found, &[], None, &Silent).is_empty());
    found.get_mut("tables/minnaert-16x12.exr").expect("a table").truncate(100);
    let differences = compare(made, &found, &[], None, &Silent);
    assert!(differences.len() == 1 && differences[0].file.ends_with(".exr"), "{differences:?}");
}

/// Texels that lie are found by the promise of the table, at the points where it was measured.
#[test]
fn other_texels_are_measured_again() {
    let made = &BAKED.tables[0];
    let mut channels = made.table().expect("texels").channels.clone();
    assert!(made.measured_again(&channels).expect("a lookup") <= made.errors.lookup.max);
    channels[0].texels[100] += 0.1;
    assert!(made.measured_again(&channels).expect("a lookup") > made.errors.lookup.max);
    let domain: &BTreeMap<String, [f64; 2]> = &made.approximation.certificate.domain;
    assert_eq!(domain["roughness"], [0.3, 1.0]);
}
