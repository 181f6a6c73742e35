//! What a scene gets: for each job one function by its role, those on the frontier, or all.

use std::sync::LazyLock;

use crate::baked_support::bake_scene;
use lobefit::bake::Baked;
use lobefit::data::Vendor;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit_shade::tape::Half;
use lobefit_shade::{Hypothesis, Source, Tape};
use serde_json::Value;

fn baked(fields: &str, materials: &str) -> Baked {
    baked_with(false, fields, materials)
}

/// The same, with pages or without.
fn baked_with(reports: bool, fields: &str, materials: &str) -> Baked {
    let text = format!(
        r#"{{"schema_version": 1, "name": "test", "reports": {reports}, {fields} "materials": [{materials}]}}"#
    );
    let scene = Scene::from_json(text.as_bytes(), "test.json").unwrap_or_else(|e| panic!("{e}\n{text}"));
    bake_scene(&scene).expect("a bake")
}

fn metal(name: &str, fit: &str) -> String {
    format!(
        r#"{{"name": "{name}", "kind": "metal", "f0": 0.9, "roughness": [0.1, 1], "wants": {{"fit": {fit}}}}}"#
    )
}

fn manifest(baked: &Baked) -> Value {
    serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest")
}

/// Names of the functions of an include file.
fn functions(baked: &Baked) -> Vec<String> {
    let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
    let names = text.lines().filter_map(|line| line.strip_prefix("fn "));
    names.map(|line| line[..line.find('(').expect("arguments")].to_string()).collect()
}

/// Operations and largest errors of the emitted fits, as the manifest has them.
fn emitted(baked: &Baked) -> Vec<(u64, f64)> {
    let manifest = manifest(baked);
    let fits = manifest["fits"].as_array().expect("a list").clone();
    let figures = |fit: &Value| {
        let error = fit["certificate"]["max_abs"].as_f64().expect("an error");
        (fit["cost"]["ops"].as_u64().expect("operations"), error)
    };
    fits.iter().map(figures).collect()
}

/// The bake of every formula for a metal.
static EVERY: LazyLock<Baked> =
    LazyLock::new(|| baked(r#""pick": "all", "languages": ["wgsl"],"#, &metal("m", "{}")));

/// The bake of one function for a metal, within 0.03.
static STEEL: LazyLock<Baked> =
    LazyLock::new(|| baked(r#""languages": ["wgsl"],"#, &metal("steel", r#"{"max_error": 0.03}"#)));

#[test]
fn a_metal_gets_one_function_and_its_form_for_colours() {
    let baked = &*STEEL;
    assert_eq!(baked.files.keys().collect::<Vec<_>>(), ["fits/lobefit.wgsl", "manifest.json"]);
    assert_eq!(functions(baked), ["ggx_energy_compensation", "ggx_energy_compensation_rgb"]);
    let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
    assert!(text.contains("fn ggx_energy_compensation(roughness: f32, n_dot_v: f32) -> f32 {"), "{text}");
    assert!(text.contains("_rgb(roughness: f32, n_dot_v: f32, f0: vec3<f32>) -> vec3<f32> {"), "{text}");
    assert!(text.lines().count() < 60, "a page: {} lines", text.lines().count());
    let manifest = manifest(baked);
    let call = &manifest["calls"][0];
    assert_eq!((&call["of"], &call["function"]), (&"steel".into(), &"ggx_energy_compensation_rgb".into()));
    let (ops, error) = emitted(baked)[0];
    assert!(error <= 0.03, "{error}");
    assert_eq!(
        call["cost"]["ops"].as_u64(),
        Some(ops + 4),
        "three channels: a difference and three sums of products"
    );
}

#[test]
fn the_best_is_the_cheapest_of_all_that_keeps_the_error_or_the_most_accurate_within_the_budget() {
    let every = emitted(&EVERY);
    for limit in [0.2, 0.05, 0.0151] {
        let best = emitted(&baked("", &metal("m", &format!(r#"{{"max_error": {limit}}}"#))));
        let cheapest = every.iter().filter(|(_, error)| *error <= limit).map(|(ops, _)| *ops).min();
        assert_eq!((best.len(), Some(best[0].0)), (1, cheapest), "{limit}: {best:?}");
        assert!(best[0].1 <= limit);
    }
    for budget in [7_u64, 16] {
        let best = emitted(&baked("", &metal("m", &format!(r#"{{"max_ops": {budget}}}"#))));
        let affordable = every.iter().filter(|(ops, _)| ops + 4 <= budget).map(|(_, error)| *error);
        let least = affordable.reduce(f64::min).expect("a formula");
        assert_eq!((best.len(), best[0].1), (1, least), "{budget}: the budget covers the form for colours");
    }
    let dielectric = r#"{"name": "d", "kind": "dielectric", "ior": 1.5, "roughness": [0.1, 1], "wants": {"fit": {"max_ops": 13}}}"#;
    let alone = baked("", dielectric);
    let least = every.iter().filter(|(ops, _)| *ops <= 13).map(|(_, e)| *e).reduce(f64::min);
    assert_eq!(Some(emitted(&alone)[0].1), least, "a dielectric calls N itself");
    assert_eq!(functions(&alone), ["ggx_energy_compensation"]);
}

#[test]
fn the_frontier_is_what_none_beats_and_its_names_say_the_cost() {
    let every = emitted(&EVERY);
    let scene = baked(r#""pick": "frontier","#, &metal("m", "{}"));
    let frontier = emitted(&scene);
    for (ops, error) in &frontier {
        assert!(
            !every.iter().any(|(o, e)| o <= ops && e <= error && (o, e) != (ops, error)),
            "{ops} {error}"
        );
        assert!(functions(&scene).contains(&format!("ggx_energy_compensation_{ops}")));
    }
    let beaten = |(ops, error): &(u64, f64)| frontier.iter().any(|(o, e)| o <= ops && e <= error);
    assert!(every.iter().all(beaten), "{frontier:?}");
}

#[test]
fn functions_take_the_arguments_that_are_asked_for() {
    let text = |arguments: &str| {
        let fields = format!(r#""arguments": "{arguments}", "languages": ["c"],"#);
        // The formula of 8 operations has both roughness and alpha.
        let baked = baked(&fields, &metal("m", r#"{"max_ops": 12}"#));
        String::from_utf8_lossy(&baked.files["fits/lobefit.h"]).into_owned()
    };
    assert!(text("roughness").contains("(float roughness, float n_dot_v)"));
    let of_alpha = text("alpha");
    assert!(
        of_alpha.contains("(float alpha, float n_dot_v)") && of_alpha.contains("roughness = sqrtf(alpha)")
    );
    assert!(text("both").contains("(float roughness, float alpha, float n_dot_v)"));
}

/// In half precision the error is that of f16, or that of f32 where it is larger: compilers may keep
/// that.
#[test]
fn half_precision_is_picked_and_certified_in_f16() {
    let wide = emitted(&STEEL);
    let scene = baked(r#""precision": "f16","#, &metal("m", r#"{"max_error": 0.03}"#));
    let manifest = manifest(&scene);
    let [fit] = manifest["fits"].as_array().expect("fits").as_slice() else { panic!("{manifest}") };
    let (certificate, half) = (&fit["certificate"], &fit["half"]);
    let error = |value: &Value| value["max_abs"].as_f64().expect("an error");
    assert!(error(certificate) <= 0.03 && error(certificate) >= error(half), "{certificate} {half}");
    assert!(fit["cost"]["ops"].as_u64() >= Some(wide[0].0), "f16 gives nothing away");
    let text = |file: &str| String::from_utf8_lossy(&scene.files[file]).into_owned();
    let heads = [
        ("fits/lobefit.wgsl", "\nenable f16;\n"),
        ("fits/lobefit.wgsl", "fn ggx_energy_compensation(roughness: f16, n_dot_v: f16) -> f16 {"),
        (
            "fits/lobefit.wgsl",
            "fn ggx_energy_compensation_pair(roughness: vec2<f16>, n_dot_v: vec2<f16>) -> vec2<f16> {",
        ),
        ("fits/lobefit.wgsl", "_rgb(roughness: f16, n_dot_v: f16, f0: vec3<f16>) -> vec3<f16> {"),
        (
            "fits/lobefit.hlsl",
            "min16float ggx_energy_compensation(min16float roughness, min16float n_dot_v) {",
        ),
        ("fits/lobefit.glsl", "mediump float ggx_energy_compensation(mediump float roughness,"),
        ("fits/lobefit.metal", "inline half ggx_energy_compensation(half roughness, half n_dot_v) {"),
        ("fits/lobefit.h", "static inline float ggx_energy_compensation(float roughness, float n_dot_v) {"),
    ];
    for (file, head) in heads {
        assert!(text(file).contains(head), "{file}: {head}\n{}", text(file));
    }
    assert_eq!(fit["pair"], "ggx_energy_compensation_pair");
    assert!(!text("fits/lobefit.h").contains("_pair("), "C has no half precision");
}

/// Every formula that is not refused in half precision is finite at points of its own, and within
/// its certificate but for what 2^20 other points find.
#[test]
fn formulas_in_half_precision_are_finite_over_their_domain_or_refused_with_the_place() {
    let text = String::from_utf8_lossy(&EVERY.files["fits/lobefit.wgsl"]).into_owned();
    let source = Source::parse("lobefit.wgsl", &text).expect("the include file");
    let (mut measured, mut refused) = (0, 0);
    for fit in manifest(&EVERY)["fits"].as_array().expect("fits") {
        let tape = source.tape(fit["function"].as_str().expect("a name"), 0).expect("a tape");
        let names: Vec<&str> = tape.inputs().iter().map(String::as_str).collect();
        let columns = half_columns(&names, &fit["certificate"]["domain"]);
        let value = |tape: &Tape| tape.evaluate(&columns, &[]).expect("values");
        let finite = value(&tape).iter().chain(&value(&tape.contracted())).all(|x| x.to_f32().is_finite());
        if fit["half"]["refused"].is_null() {
            assert!(finite, "{}", fit["function"]);
            measured += 1;
        } else {
            assert!(!fit["half"]["at"].as_object().expect("a place").is_empty(), "{fit}");
            refused += 1;
        }
    }
    assert!(measured > 10, "{measured} measured, {refused} refused");
}

/// 2^20 points of a certificate's domain, each input by the root of a prime, rounded to f16.
fn half_columns(names: &[&str], domain: &serde_json::Value) -> Vec<Vec<Half>> {
    let column = |(name, prime): (&&str, u32)| -> Vec<Half> {
        let name = if *name == "n_dot_v" { "mu" } else { name };
        let end = |k: usize| domain[name][k].as_f64().unwrap_or_else(|| panic!("{name} in {domain}"));
        let ([low, high], step) = ([end(0), end(1)], f64::from(prime).sqrt());
        let value = |i: u32| low + (high - low) * (f64::from(i) * step).fract();
        (0..1 << 20).map(|i| Half::nearest(value(i) as f32)).collect()
    };
    names.iter().zip([2, 3, 5, 7]).map(column).collect()
}

#[test]
fn a_promise_that_nothing_keeps_names_what_does() {
    let baked = baked("", &metal("steel", r#"{"max_ops": 12, "max_error": 0.016}"#));
    let [broken] = baked.broken.as_slice() else { panic!("{:?}", baked.broken) };
    for part in ["materials[0].wants.fit.max_error", "keeps it: error", "operations", "keeps it: a table"] {
        assert!(broken.contains(part), "`{part}` in {broken}");
    }
}

/// What is said to keep an error has the operations of the call that keeps it.
#[test]
fn the_nearest_costs_what_is_said() {
    let unkept = baked("", &metal("steel", r#"{"max_error": 1e-9}"#));
    let (_, said) = unkept.broken[0].split_once("raise max_error to ").expect("the nearest");
    let (error, rest) = said.split_once(", which ").expect("its error");
    let kept = baked("", &metal("steel", &format!(r#"{{"max_error": {error}}}"#)));
    let call = kept.calls.iter().find(|call| call.function.ends_with("_rgb")).expect("a function");
    let words = format!("{} has with {} operations", call.name, call.cost.ops);
    assert!(kept.broken.is_empty() && rest.starts_with(&words), "`{words}` in {rest}");
}

/// What a plan says of goals that differ.
fn merging(materials: &str) -> Option<String> {
    let text = format!(r#"{{"schema_version": 1, "materials": [{materials}]}}"#);
    let scene = Scene::from_json(text.as_bytes(), "test.json").expect("a scene");
    plan(&scene).effects[0].jobs[0].merging.clone()
}

#[test]
fn budgets_of_several_materials_become_one_and_that_is_said() {
    let materials = [
        metal("a", r#"{"max_ops": 5, "max_error": 0.3}"#),
        metal("b", r#"{"max_ops": 20, "max_error": 0.03}"#),
    ]
    .join(",");
    let baked = baked("", &materials);
    assert!(baked.broken.is_empty() && emitted(&baked).len() == 1, "{:?}", baked.broken);
    assert_eq!(
        merging(&materials).as_deref(),
        Some("max_ops 5 of `a` and 20 of `b` became 20; max_error 0.3 of `a` and 0.03 of `b` became 0.03")
    );
}

/// A formula for one channel may take a budget whole that a call for three shares with what it does beside.
#[test]
fn a_merged_budget_says_which_call_takes_more() {
    let plastic = metal("plastic", r#"{"max_ops": 17}"#).replace("metal", "dielectric");
    let plastic = plastic.replace("\"f0\": 0.9", "\"ior\": 1.5");
    let materials = format!("{},{plastic}", metal("steel", r#"{"max_ops": 16}"#));
    assert_eq!(
        merging(&materials).as_deref(),
        Some("max_ops 16 of `steel` and 17 of `plastic` became 17, and a call of `steel` takes up to 21")
    );
}

/// A budget without an error asks for the most accurate within it, whatever another material puts up with,
/// and whatever the other's call takes beside the formula.
#[test]
fn a_budget_alone_is_no_less_accurate_beside_others() {
    let lenient = metal("a", r#"{"max_ops": 17, "max_error": 0.3}"#);
    let exact = metal("b", r#"{"max_ops": 12}"#);
    let plain = exact.replace("metal", "dielectric").replace("\"f0\": 0.9", "\"ior\": 1.5");
    for (own, ops) in [(exact, 8), (plain, 12)] {
        let [alone, both] = [own.clone(), [lenient.clone(), own].join(",")].map(|m| emitted(&baked("", &m)));
        let ([alone], [both]) = (&alone[..], &both[..]) else { panic!("a function each") };
        assert!(alone.0 == ops && both.1 <= alone.1, "{alone:?} {both:?}");
    }
}

/// A base whose material has a reflectance for each channel evaluates its factor for each.
#[test]
fn a_budget_of_a_base_covers_three_channels() {
    let base = |f0: &str| {
        let text = format!(
            r#"{{"name": "b", "kind": "dielectric", "f0": {f0}, "roughness": [0.4, 0.6], "base": {{"max_ops": 30}}, "wants": {{"fit": {{"max_ops": 8}}}}}}"#
        );
        let baked = baked(r#""languages": ["wgsl"],"#, &text);
        let call = baked.calls.iter().find(|call| call.function == "diffuse_coupling").expect("a factor");
        (call.cost.ops, call.around.iter().map(|around| around.function.clone()).collect::<Vec<_>>())
    };
    let [(grey, both), (coloured, tinted)] = [base("0.04"), base("[0.02, 0.04, 0.08]")];
    assert!(coloured.is_multiple_of(3) && coloured <= 30 && grey > coloured / 3, "{grey} {coloured}");
    let names = ["diffuse_coupled_normalised", "diffuse_coupled_normalised_rgb"];
    assert!(both == names && tinted == names[1..], "{both:?} {tinted:?}");
}

/// Without pages no formula is fitted beyond the cheapest that keeps the limit: what is emitted is
/// what a bake with pages emits.
#[test]
fn pages_change_no_function() {
    let steel = metal("steel", r#"{"max_error": 0.08, "norms": ["max", "rms"]}"#);
    let plastic = r#"{"name": "plastic", "kind": "dielectric", "ior": 1.5, "roughness": [0.3, 0.6],
        "base": {"albedo": 0.5, "max_error": 0.05}, "wants": {"fit": {}}}"#;
    let [shown, hidden] = [true, false].map(|reports| {
        let baked = baked_with(reports, r#""languages": ["wgsl"],"#, &format!("{steel}, {plastic}"));
        let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
        // The head has the command and the recipe; a coupling is looked at where any fit of the job errs
        // most.
        let lines = text.lines().skip(2).filter(|line| !line.contains("the largest found at"));
        lines.map(String::from).collect::<Vec<_>>()
    });
    assert!(hidden.iter().any(|line| line.starts_with("fn diffuse_coupling")), "{hidden:?}");
    assert_eq!(shown, hidden);
}

/// The form for three channels counts against the budgets of metals, which alone call it: scenes
/// pass together that pass apart.
#[test]
fn budgets_cover_what_their_materials_call() {
    let plain = metal("b", r#"{"max_ops": 15, "max_error": 0.0105}"#).replace("metal", "dielectric");
    let plain = plain.replace("\"f0\": 0.9", "\"ior\": 1.5");
    for budget in [14, 16] {
        let both = [metal("a", &format!(r#"{{"max_ops": {budget}, "max_error": 0.3}}"#)), plain.clone()];
        let baked = baked(r#""languages": ["wgsl"],"#, &both.join(","));
        assert!(baked.broken.is_empty(), "{budget}: {:?}", baked.broken);
        assert_eq!(emitted(&baked)[0].0, 14);
        let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
        assert!(text.contains("/// 18 operations, 14 for N"), "{text}");
    }
    let equal = metal("a", r#"{"max_ops": 15, "max_error": 0.0105}"#);
    let broken = baked("", &[equal, plain].join(",")).broken;
    assert!(broken[0].contains("with 18 operations"), "a metal's own budget holds: {broken:?}");
}

#[test]
fn outputs_that_are_no_words_are_refused() {
    for (fields, part) in [
        (r#""languages": [],"#, "languages: the list is empty"),
        (r#""languages": ["wgsl", "wgsl"],"#, "languages[1]: `wgsl` is there twice"),
        (r#""languages": ["cuda"],"#, "languages[0]: unknown language `cuda`"),
        (r#""pick": "worst","#, "pick: unknown variant `worst`"),
        (r#""arguments": "mu","#, "arguments: unknown variant `mu`"),
        (r#""reports": 0,"#, "reports: "),
    ] {
        let text = format!(r#"{{"schema_version": 1, {fields} "materials": []}}"#);
        let error = Scene::from_json(text.as_bytes(), "test.json").expect_err(fields).to_string();
        assert!(error.contains(part), "`{part}` in {error}");
    }
}

/// Functions of tables are named by role whatever their size, layout and Smith form; the first of a
/// role has its name, others append what tells them apart. They take the width as the scene asks.
#[test]
fn functions_of_tables_are_named_by_role() {
    let wants = r#"{"tables": [{"size": [8, 8]}, {"size": [12, 8], "serves": "split-sum"},
        {"size": [16, 16], "layout": "plain", "format": "f32"}]}"#;
    let material =
        format!(r#"{{"name": "m", "kind": "metal", "f0": 0.9, "roughness": [0.3, 1], "wants": {wants}}}"#);
    for (smith, arguments, given) in [
        ("correlated", "roughness", &["roughness", "n_dot_v"][..]),
        ("separable", "alpha", &["alpha", "n_dot_v"]),
        ("separable", "both", &["roughness", "alpha", "n_dot_v"]),
    ] {
        let fields = format!(r#""smith": "{smith}", "arguments": "{arguments}", "languages": ["wgsl"],"#);
        let baked = baked(&fields, &material);
        let stems = ["ggx_albedo", "ggx_dfg", "ggx_albedo_16x16_f32_plain"];
        let three = |stem: &&str| [format!("{stem}_uv"), format!("{stem}_decode"), stem.to_string()];
        let of_tables = functions(&baked).into_iter().filter(|name| !name.starts_with("ggx_compensate"));
        assert_eq!(of_tables.collect::<Vec<_>>(), stems.iter().flat_map(three).collect::<Vec<_>>());
        let manifest = manifest(&baked);
        for (table, stem) in manifest["tables"].as_array().expect("a list").iter().zip(stems) {
            assert_eq!((&table["function"], &table["inputs"]), (&stem.into(), &given.into()));
        }
        let called =
            manifest["calls"].as_array().expect("a list").iter().map(|call| call["function"].clone());
        assert_eq!(called.collect::<Vec<_>>(), stems);
        let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
        let declared: Vec<String> = given.iter().map(|name| format!("{name}: f32")).collect();
        assert!(
            text.contains(&format!("linear_clamp: sampler, {}) -> vec3<f32>", declared.join(", "))),
            "{text}"
        );
    }
}

/// Both sides of glass share what they have in common.
#[test]
fn both_sides_of_glass_have_one_function_of_coordinates() {
    let material = r#"{"name": "g", "kind": "glass", "ior": [1.3, 1.6], "roughness": [0.3, 1], "wants": {"tables": [{"size": [8, 8, 4]}]}}"#;
    let baked = baked(r#""languages": ["wgsl"],"#, material);
    let names = ["_uvw", "_decode", "_outside", "_inside"].map(|part| format!("ggx_glass_albedo{part}"));
    let of_tables = functions(&baked).into_iter().filter(|name| !name.starts_with("ggx_compensate"));
    assert_eq!(of_tables.collect::<Vec<_>>(), names);
    let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
    assert!(text.contains("G2 = 1/(1 + Lambda_v + Lambda_l) in both lobes"), "{text}");
}

/// A size that the bake chooses may be a size that another table asks for.
#[test]
fn a_chosen_size_does_not_take_the_name_of_another_table() {
    let wants = r#"{"tables": [{"size": [8, 8], "format": "f32"}, {"max_error": 0.5}, {"size": [16, 16]}]}"#;
    let material =
        format!(r#"{{"name": "m", "kind": "metal", "f0": 0.9, "roughness": [0.3, 1], "wants": {wants}}}"#);
    let baked = baked(r#""languages": ["wgsl"],"#, &material);
    let manifest = manifest(&baked);
    let tables = manifest["tables"].as_array().expect("a list").iter();
    let named: Vec<(&str, &str)> = tables
        .map(|t| (t["name"].as_str().expect("a name"), t["function"].as_str().expect("a name")))
        .collect();
    let wanted = [
        ("ggx-dfg-correlated-8x8-f32", "ggx_albedo"),
        ("ggx-dfg-correlated-16x16-auto", "ggx_albedo_16x16_auto"),
        ("ggx-dfg-correlated-16x16", "ggx_albedo_16x16"),
    ];
    assert_eq!(named, wanted);
}

/// The names of the functions that a manifest recommends to a material, in the order of its calls.
fn recommended(manifest: &Value, of: &str) -> Vec<String> {
    let calls = manifest["calls"].as_array().expect("a list").iter();
    let own = calls.filter(|call| call["of"] == of && call["recommended"] == true);
    own.map(|call| call["function"].as_str().expect("a name").to_string()).collect()
}

/// One rule: of several functions the one is recommended that `best` emits alone, and every output
/// names it as the material calls it.
#[test]
fn what_best_emits_is_recommended_of_several() {
    let both = |fit: &str| {
        let plain = metal("d", fit).replace("metal", "dielectric");
        [metal("m", fit), plain].join(",")
    };
    // A limit alone wants every formula of the catalogue: one pick of several is enough there.
    for (fit, picks) in [
        (r#"{"max_ops": 10}"#, &["best", "frontier", "all"][..]),
        (r#"{"max_ops": 14, "max_error": 0.1, "norms": ["max", "rms"]}"#, &["best", "all"]),
        (r#"{"max_error": 0.03, "norms": ["rms"]}"#, &["best", "frontier"]),
    ] {
        let name = |manifest: &Value, function: &str| {
            let fits = manifest["fits"].as_array().expect("a list");
            let own = fits.iter().find(|fit| fit["function"] == function || fit["rgb"] == function);
            own.expect("its entry")["name"].clone()
        };
        let mut wanted = None;
        for pick in picks {
            let fields = format!(r#""pick": "{pick}", "languages": ["wgsl"],"#);
            let baked = baked(&fields, &both(fit));
            let manifest = manifest(&baked);
            let [of_metal, of_plain] = ["m", "d"].map(|of| recommended(&manifest, of));
            assert_eq!((of_metal.len(), of_plain.len()), (1, 1), "{pick} {fit}");
            assert_eq!(of_metal[0], format!("{}_rgb", of_plain[0]), "{pick} {fit}");
            let found = name(&manifest, &of_plain[0]);
            assert_eq!(*wanted.get_or_insert(found.clone()), found, "{pick} {fit}");
            let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
            let line = format!("// Recommended: {}, {}:\n", of_metal[0], of_plain[0]);
            let has_choice = manifest["calls"].as_array().expect("a list").len() > 2;
            assert_eq!(text.contains(&line), has_choice, "{pick} {fit}");
        }
    }
}

/// Of several tables the most accurate is recommended, to a material that has asked for it; a
/// function is recommended before a table of the same.
#[test]
fn each_material_has_its_recommended_table() {
    let wants = |sizes: &str| format!(r#"{{"tables": [{sizes}]}}"#);
    let material = |name: &str, wants: &str| {
        format!(
            r#"{{"name": "{name}", "kind": "metal", "f0": 0.9, "roughness": [0.3, 1], "wants": {wants}}}"#
        )
    };
    let (small, large) = (r#"{"size": [8, 8]}"#, r#"{"size": [16, 16]}"#);
    let both = material("both", &wants(&format!("{small}, {large}")));
    let fit = material("fit", &format!(r#"{{"tables": [{small}], "fit": {{"max_ops": 20}}}}"#));
    let tables = manifest(&baked("", &[material("one", &wants(small)), both].join(",")));
    assert_eq!(recommended(&tables, "one"), ["ggx_albedo"]);
    assert_eq!(recommended(&tables, "both"), ["ggx_albedo_16x16"]);
    let manifest = manifest(&baked("", &fit));
    assert_eq!(recommended(&manifest, "fit"), ["ggx_energy_compensation_rgb"]);
    let purposes: Vec<&Value> =
        manifest["calls"].as_array().expect("a list").iter().map(|c| &c["purpose"]).collect();
    assert_eq!(purposes, ["ggx_energy_compensation", "ggx_energy_compensation"]);
}

/// On Adreno GPUs the long formula with a short chain is cheaper than those of fewer operations that
/// keep the same error.
#[test]
fn formulas_are_picked_for_the_gpus_of_a_vendor() {
    let of = |cost: &str| {
        let scene = baked(
            &format!(r#""cost": "{cost}", "languages": ["wgsl"],"#),
            &metal("m", r#"{"max_error": 0.012}"#),
        );
        let fit = manifest(&scene)["fits"][0].clone();
        assert!(fit["certificate"]["max_abs"].as_f64().expect("an error") <= 0.012);
        fit["name"].as_str().expect("a name").to_string()
    };
    let model = Vendor::Adreno.model().expect("a model");
    let price = |name: &str| {
        let text = std::fs::read_to_string(format!("fits/hypotheses/{name}.wgsl")).expect("a formula");
        model.cost(Hypothesis::parse("f.wgsl", &text).expect("a formula").tape())
    };
    let (neutral, adreno) = (of("neutral"), of("adreno"));
    assert!(price(&adreno) < price(&neutral), "{adreno} {neutral}");
    let frontier = baked(r#""cost": "intel", "pick": "frontier", "languages": ["wgsl"],"#, &metal("m", "{}"));
    let names = functions(&frontier);
    let once: std::collections::BTreeSet<&String> = names.iter().collect();
    assert_eq!(once.len(), names.len(), "{names:?}");
}
