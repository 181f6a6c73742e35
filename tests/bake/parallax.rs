//! The effect parallax: from the scene to the bytes, and nothing of it where the scene does not
//! ask.

use std::sync::LazyLock;

use crate::baked_support::bake_scene;
use lobefit::bake::Baked;
use lobefit::effects::parallax::lobes;
use lobefit::plan::{Plan, plan};
use lobefit::scene::Scene;
use lobefit_math::ops;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::PARALLAX;
use lobefit_truth::quantity::footprint::{adjusted, measures};
use serde_json::{Value, json};

fn scene(probes: &str) -> Scene {
    scene_with("", probes)
}

fn scene_with(more: &str, probes: &str) -> Scene {
    let json = format!(
        r#"{{"schema_version": 1, "name": "test", "pick": "all", {more} "materials": [], "probes": [{probes}]}}"#
    );
    Scene::from_json(json.as_bytes(), "test.json").expect("a scene")
}

fn baked(probes: &str) -> Baked {
    let scene = scene(probes);
    bake_scene(&scene).expect("a bake")
}

/// The promises that are not kept, of a bake of the fits alone: neither pages nor more than one language.
fn broken(probes: &str) -> Vec<String> {
    let scene = scene_with(r#""reports": false, "languages": ["wgsl"],"#, probes);
    bake_scene(&scene).expect("a bake").broken
}

fn manifest(baked: &Baked) -> Value {
    serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest")
}

/// A probe whose levels are logarithmic.
static ROOM: LazyLock<Baked> = LazyLock::new(|| {
    baked(r#"{"name": "room", "mips": {"map": "log", "count": 7}, "max_error": 0.045, "norms": ["max"]}"#)
});

#[test]
fn a_probe_is_fitted_certified_and_emitted_in_every_language() {
    let manifest = manifest(&ROOM);
    assert!(ROOM.broken.is_empty(), "{:?}", ROOM.broken);
    let fits = manifest["fits"].as_array().expect("a list");
    assert_eq!(fits.len(), 3);
    for fit in fits {
        let words = ["effect", "quantity", "column", "use", "source", "kernel"];
        let words = words.map(|key| fit[key].as_str().expect("a word"));
        assert_eq!(
            words,
            ["parallax", "parallax-alpha", "alpha_adjusted", "parallax", "fitted", "half-cosine"]
        );
        let domain = &fit["certificate"]["domain"];
        assert_eq!((&domain["roughness"], &domain["rho"]), (&json!([0.1, 1.0]), &json!([0.0625, 8.0])));
        let near = &fit["total_variation"]["nearer"];
        let figure = |key: &str| near[key].as_f64().expect("a number");
        assert!(figure("mean") <= 0.0185 && figure("max") <= 0.045, "{near}");
        assert!(figure("least_mean") <= figure("mean") && figure("least_max") <= figure("max"), "{near}");
    }
    let mips: Vec<&str> =
        manifest["mips"].as_array().expect("a list").iter().filter_map(|m| m["function"].as_str()).collect();
    assert_eq!(
        mips,
        ["parallax_level_log_7", "parallax_roughness_log_7", "parallax_mip_log_7", "parallax_bias_log"]
    );
    let includes = manifest["includes"].as_array().expect("a list");
    assert_eq!(includes.len(), 6);
    for include in includes {
        let text =
            String::from_utf8_lossy(&ROOM.files[include["file"].as_str().expect("a file")]).into_owned();
        let names = fits.iter().filter_map(|fit| fit["function"].as_str()).chain(mips.iter().copied());
        for name in names {
            assert!(text.contains(&format!(" {name}(")), "{include}: {name}");
        }
        let told =
            "for chains prefiltered with the half-cosine lobe D(theta/2) cos(theta), alpha = roughness^2";
        assert_eq!(text.matches(told).count(), 5, "{include}");
        assert!(!text.contains("smith"), "{include}: a footprint has no Smith form");
    }
    let page = String::from_utf8_lossy(&ROOM.files["reports/parallax.html"]).replace("<wbr>", "");
    assert!(
        ["parallax_frostbite", "parallax_godot", "best width", "parallax_mip_log_7", "of the other measures"]
            .iter()
            .all(|x| page.contains(x))
    );
}

/// The certificate bounds the relative error at points of a lattice, where the best width is
/// below 1.
#[test]
fn certificates_of_widths_hold() {
    for fit in &ROOM.fits {
        assert_eq!(fit.approximation.used_as, PARALLAX);
        let mut worst = 0.0_f64;
        for i in 0..=12 {
            for j in 0..=14 {
                let (r, rho) = (0.1 + 0.075 * i as f32, (0.0625 * ops::exp2(0.5 * f64::from(j))) as f32);
                let (r, alpha) = (r.min(1.0), r.min(1.0) * r.min(1.0));
                let truth =
                    adjusted(&Kernel::HalfCosine, f64::from(alpha), f64::from(rho), 1e-6).expect("a truth");
                if truth.saturated {
                    continue;
                }
                let column = |name: &String| match name.as_str() {
                    "roughness" => vec![r],
                    "alpha" => vec![alpha],
                    _ => vec![rho],
                };
                let inputs: Vec<Vec<f32>> = fit.hypothesis.inputs().iter().map(column).collect();
                let found = fit.hypothesis.tape().evaluate(&inputs, &fit.coefficients()).expect("finite")[0];
                worst = worst.max((f64::from(found) / truth.alpha - 1.0).abs());
                let tv = measures(&Kernel::HalfCosine, f64::from(alpha), f64::from(rho), f64::from(found));
                assert!(
                    !fit.emitted || tv.expect("measured").tv <= 0.045,
                    "{} {r} {rho}",
                    fit.hypothesis.name()
                );
            }
        }
        let (name, stated) = (&fit.approximation.name, fit.approximation.certificate.max_rel);
        assert!(worst <= stated * 1.0001 && worst > 0.5 * stated, "{name}: {worst} of {stated}");
    }
}

fn left_out(plan: &Plan) -> &str {
    &plan.left_out.iter().find(|l| l.effect == "parallax").expect("left out").reason
}

#[test]
fn without_a_probe_there_is_nothing_of_it() {
    let none = scene("");
    assert_eq!(left_out(&plan(&none)), "the scene has no probe");
    // Scenes without one have the hash that they had before there were probes.
    assert!(!serde_json::to_string(&none).expect("JSON").contains("probe"));
    let smooth = plan(&scene(r#"{"name": "p", "roughness": 0.005}, {"name": "q", "roughness": [0, 0.009]}"#));
    assert!(smooth.jobs("parallax").is_empty());
    assert_eq!(
        left_out(&smooth),
        "no probe is looked up with a rough lobe: `p` and 1 more stay below alpha 0.0001, which is smooth"
    );
}

/// One job for each lobe: the hull of the ranges, every norm and chain once, the largest number of
/// operations, each promise by itself.
#[test]
fn probes_are_planned_together() {
    let scene = scene(
        r#"{"name": "a", "roughness": [0.2, 0.5], "rho": [0.5, 2], "max_ops": 9, "max_error": 0.05, "norms": ["max"],
            "mips": {"map": "linear", "count": 7}},
           {"name": "b", "kernel": "ndf", "roughness": 0.5, "rho": 1},
           {"name": "c", "roughness": [0.3, 1], "rho": [0.25, 1], "max_ops": 13, "norms": ["rms"],
            "mips": {"map": "linear", "count": 7}}"#,
    );
    let plan = plan(&scene);
    let [ndf, cosine] = plan.jobs("parallax") else { panic!("{plan:?}") };
    assert_eq!((cosine.ranges["roughness"], cosine.ranges["rho"]), ([0.2, 1.0], [0.25, 2.0]));
    assert_eq!((cosine.goals.max_ops, cosine.goals.norms.len(), cosine.promises.len()), (Some(13), 2, 1));
    assert_eq!(lobes(&scene)[1].chains.len(), 1);
    assert_eq!(cosine.promises[0].by[0].1, "probes[0].max_error");
    let (roughness, rho) = (ndf.ranges["roughness"], ndf.ranges["rho"]);
    assert!(roughness[1] - roughness[0] > 0.009 && rho[1] / rho[0] > 1.009, "{ndf:?}");
    let effect = plan.effects.iter().find(|e| e.effect == "parallax").expect("the effect");
    assert_eq!((effect.because.len(), effect.jobs.len()), (3, 2));
}

#[test]
fn a_promise_on_the_total_variation_is_kept_or_told() {
    let broken = broken(r#"{"name": "p", "max_ops": 9, "max_error": 0.04, "norms": ["max"]}"#);
    assert!(
        broken.len() == 1
            && broken[0].contains("the best is parallax_1 with total variation 0.04")
            && broken[0].contains("probes[0].max_error"),
        "{broken:?}"
    );
}

/// The page of the effect lists every lookup as the manifest does.
#[test]
fn lookups_are_on_the_page() {
    let baked = baked(
        r#"{"name": "hall", "max_ops": 9, "norms": ["max"], "mips": {"map": "linear", "count": 7},
            "lookups": [{}, {"planes": 8, "edges": "sharp", "taps": 3}, {"taps": 2, "lobe": "fitted"}]}"#,
    );
    let page = String::from_utf8_lossy(&baked.files["reports/parallax.html"]).replace("<wbr>", "");
    let section = &page[page.find("Lookups through a proxy").expect("a section")..];
    let manifest = manifest(&baked);
    let entries = manifest["lookups"].as_array().expect("lookups");
    let lobes: Vec<&str> = entries.iter().filter_map(|entry| entry["lobe"].as_str()).collect();
    assert_eq!(lobes, ["mirror", "mirror", "fitted"]);
    assert_eq!(
        entries[2]["inputs"],
        serde_json::json!(["place", "normal", "view", "alpha", "low", "high", "probe"])
    );
    for entry in entries {
        let name = entry["function"].as_str().expect("a name");
        let row = &section[section.find(&format!(">{name}<")).expect("a row")..];
        let row = &row[..row.find("</tr>").expect("its end")];
        let proxy = entry["proxy"].as_str().expect("a proxy").replace('_', " ");
        let cost = |key: &str| entry["cost"][key].as_u64().expect("a number").to_string();
        for told in [
            proxy,
            cost("ops"),
            cost("fetches"),
            entry["edges"].as_str().expect("edges").into(),
            entry["lobe"].as_str().expect("a lobe").into(),
        ] {
            assert!(row.contains(&format!(">{told}<")), "{told} in {row}");
        }
        assert!(row.contains(entry["chain"].as_str().expect("a chain")), "{row}");
    }
}

/// Lookups take their width from an emitted fit: without one they are missed aloud, with the probe
/// and the limit.
/// A probe with lookups calls these alone; another one of the same lobe the width and the levels.
#[test]
fn lookups_bring_no_function_that_they_do_not_call() {
    let room = r#"{"name": "room", "mips": {"map": "log", "count": 7}, "lookups": [{}]}"#;
    let functions = |probes: &str| -> Vec<String> {
        let text = format!(
            r#"{{"schema_version": 1, "reports": false, "languages": ["wgsl"], "materials": [], "probes": [{probes}]}}"#
        );
        let scene = Scene::from_json(text.as_bytes(), "test.json").expect("a scene");
        let baked = bake_scene(&scene).expect("a bake");
        let calls = baked.calls.iter().map(|call| format!("{} calls {}", call.of, call.function));
        let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
        let emitted = text.lines().filter_map(|line| line.strip_prefix("fn ")?.split('(').next());
        calls.chain(emitted.map(String::from)).collect()
    };
    let lookup = [
        "room calls parallax_lookup_box_smooth_1_log_7",
        "parallax_meet_box_smooth",
        "parallax_fetch_box_smooth_log_7",
        "parallax_lookup_box_smooth_1_log_7",
    ];
    assert_eq!(functions(room), lookup);
    let linear = functions(&room.replace("log", "linear"));
    assert_eq!(linear[1], "parallax_level_linear_7", "what a lookup calls");
    let both = functions(&format!(r#"{room}, {{"name": "hall"}}"#));
    assert_eq!(both[..2], ["hall calls parallax_width", "room calls parallax_lookup_box_smooth_1_log_7"]);
    assert_eq!(both[2], "parallax_width");
}

#[test]
fn lookups_without_a_fit_are_told() {
    let missed = broken(r#"{"name": "hall", "max_ops": 3, "norms": ["max"], "lookups": [{}, {"taps": 3}]}"#);
    assert!(
        missed.len() == 1
            && missed[0].contains("wanted by hall (probes[0].lookups): raise max_ops, which is 3"),
        "{missed:?}"
    );
    assert_eq!(broken(r#"{"name": "hall", "max_ops": 3, "norms": ["max"]}"#), [""; 0]);
    assert_eq!(broken(r#"{"name": "hall", "max_ops": 9, "norms": ["max"], "lookups": [{}]}"#), [""; 0]);
}

/// The whole domain of the quantity, and next to nothing of it, with every map of roughness.
#[test]
fn ranges_may_be_as_wide_as_the_quantity_and_as_narrow_as_a_point() {
    for (map, probe) in [
        (
            "roughness^2",
            r#"{"name": "p", "roughness": [0, 1], "rho": [1e-6, 1e3], "norms": ["max"], "mips": {"map": "log", "count": 16}}"#,
        ),
        ("roughness", r#"{"name": "p", "kernel": "ndf", "roughness": 0.5, "rho": 1, "norms": ["rms"]}"#),
        ("roughness^4", r#"{"name": "p", "kernel": "half", "roughness": 1, "rho": 1e-6, "norms": ["rms"]}"#),
    ] {
        let json = format!(
            r#"{{"schema_version": 1, "pick": "all", "reports": false, "alpha": "{map}", "materials": [], "probes": [{probe}]}}"#
        );
        let scene = Scene::from_json(json.as_bytes(), "test.json").expect("a scene");
        let baked = bake_scene(&scene);
        let baked = baked.unwrap_or_else(|e| panic!("{map}: {probe}: {e}"));
        let emitted: Vec<f64> = baked
            .fits
            .iter()
            .filter(|fit| fit.emitted)
            .map(|fit| fit.approximation.certificate.max_rel)
            .collect();
        assert!(
            emitted.len() >= 2 && emitted.iter().all(|error| *error < 0.066),
            "{map}: {probe}: {emitted:?}"
        );
    }
}
