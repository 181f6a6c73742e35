//! Scenes to plans: merging, ranges, what is left out and why.

use lobefit::data::Pick;
use lobefit::effects::catalogue;
use lobefit::effects::demand::Job;
use lobefit::effects::reflection::FitJob;
use lobefit::effects::table::TableJob;
use lobefit::plan::{Plan, plan};
use lobefit::scene::{Norm, Scene};

fn scene(text: &str) -> Scene {
    Scene::from_json(text.as_bytes(), "test").unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A scene of metals, each given as name, roughness and wants.
fn metals(materials: &[(&str, &str, &str)]) -> Scene {
    let list: Vec<String> = materials
        .iter()
        .map(|(name, roughness, wants)| {
            format!(r#"{{"name":"{name}","kind":"metal","f0":1,"roughness":{roughness},"wants":{wants}}}"#)
        })
        .collect();
    scene(&format!(r#"{{"schema_version":1,"materials":[{}]}}"#, list.join(",")))
}

/// The tables of two axes that a scene wants.
fn tables(scene: &Scene) -> Vec<TableJob> {
    let plan = plan(scene);
    let jobs = plan.jobs("reflection").iter().filter(|job| job.name != "normalisation");
    jobs.map(|job| TableJob::of(scene, job).expect("a job of tables")).collect()
}

/// The job of fits of the normalisation.
fn fits(plan: &Plan) -> Option<&Job> {
    plan.jobs("reflection").iter().find(|job| job.name == "normalisation")
}

/// What is integrated is found wrong when it is: reading and planning cost nothing, whatever the
/// kernel.
#[test]
fn reading_a_scene_integrates_nothing() {
    let mut paths = vec![std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene")];
    while let Some(path) = paths.pop() {
        if path.is_dir() {
            paths.extend(path.read_dir().expect("a folder").map(|entry| entry.expect("an entry").path()));
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        // A word of scenes, and the ends of a domain.
        let text = text.replace("lobefit_truth::quantity::footprint::RHO[", "");
        let found = text.lines().find(|line| line.contains("lobefit_truth::integrate"));
        assert_eq!(found, None, "{path:?}");
    }
    // Every fetch is saturated, which the bake says.
    let saturated = r#"{"name":"p","roughness":1,"rho":[2,4]}"#;
    let scene = scene(&format!(r#"{{"schema_version":1,"materials":[],"probes":[{saturated}]}}"#));
    assert_eq!(plan(&scene).effects.len(), 1);
}

/// Another quantity of the same lobe is no wish for Fresnel's term.
#[test]
fn who_wants_other_things_is_not_said_to_want_fresnels_term() {
    let scene = metals(&[("lit", "[0.2, 0.9]", r#"{"widened": {"mean_length": [0.8, 1]}}"#)]);
    let plan = plan(&scene);
    assert!(
        reason(&plan, "reflection").ends_with(": `lit` wants other things alone"),
        "{}",
        reason(&plan, "reflection")
    );
}

fn reason<'a>(plan: &'a Plan, effect: &str) -> &'a str {
    &plan.left_out.iter().find(|l| l.effect == effect).expect("left out").reason
}

#[test]
fn the_built_in_scene_calls_for_two_tables_a_fit_and_the_path_tracers_workload() {
    let scene = Scene::built_in().unwrap();
    let plan = plan(&scene);
    assert!(tables(&scene).iter().all(|t| t.region.roughness == [0.02, 1.0]));
    let fit = fits(&plan).unwrap();
    assert_eq!((fit.ranges["roughness"], fit.ranges["mu"]), ([0.02, 1.0], [0.01, 1.0]));
    assert_eq!((fit.goals.max_ops, fit.goals.max_error), (Some(24), Some(0.0105)));
    assert!(FitJob::of(&scene, fit).average);
    assert_eq!(fit.goals.norms, [Norm::Max]);
    assert_eq!(fit.promises.len(), 1);
    let by: Vec<&str> = fit.promises[0].by.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(by, ["rough metal", "rough dielectric"]);
    let effects: Vec<&str> = plan.effects.iter().map(|e| e.effect).collect();
    assert_eq!(effects, ["reflection", "anisotropy", "glass", "diffuse-coupling", "parallax"]);
    let jobs = ["reflection", "anisotropy", "glass"].map(|effect| plan.jobs(effect)).concat();
    let names: Vec<&str> =
        jobs.iter().flat_map(|job| job.name.split(' ')).filter(|name| *name != "normalisation").collect();
    assert_eq!(
        names,
        [
            "ggx-dfg-correlated-32x32",
            "ggx-dfg-correlated-64x64-split-sum",
            "ggx-aniso-correlated-64x64x32",
            "ggx-aniso-azimuth-correlated-64x16x16",
            "ggx-glass-outside-correlated-128x128x32",
            "ggx-glass-inside-correlated-128x128x32",
        ]
    );
    assert_eq!(plan.effects[0].bytes, 32 * 32 * 2 + 64 * 64 * 2 * 2);
    assert_eq!(plan.effects[0].because.len(), 2);
    let [coupling] = plan.jobs("diffuse-coupling") else { panic!("{plan:?}") };
    assert_eq!(coupling.name, "coupling-normalised");
    assert_eq!((coupling.ranges["roughness"], coupling.ranges["mu"]), ([0.02, 1.0], [0.01, 1.0]));
    let f0 = coupling.ranges["f0"];
    assert!(f0[0] == f0[1] && (f0[0] - 0.04).abs() < 1e-12, "{f0:?}");
    assert_eq!((coupling.goals.max_ops, coupling.promises[0].max_error), (Some(19), 0.007));
}

/// What a material asks for and does not get is said where another gets it, too.
#[test]
fn materials_that_get_nothing_of_an_effect_of_others_are_named() {
    let material = |name: &str, more: &str| {
        format!(
            r#"{{"name":"{name}","kind":"dielectric","f0":0.04,"roughness":[0.2,0.8],{more},"wants":{{"fit":{{}}}}}}"#
        )
    };
    let all = [
        material("a", r#""base":{"albedo":0.5}"#),
        material("b", r#""base":{"albedo":0.5,"roughness":0.5}"#),
        material("c", r#""sheen":{"roughness":0}"#),
        material("d", r#""sheen":{"roughness":0.5}"#),
        material("e", r#""distribution":"beckmann","base":{"roughness":0.5}"#),
    ];
    let plan_of = |materials: &[String]| {
        plan(&scene(&format!(r#"{{"schema_version":1,"materials":[{}]}}"#, materials.join(","))))
    };
    let both = plan_of(&all);
    let of = |effect: &str| both.effects.iter().find(|called| called.effect == effect).expect("called");
    assert_eq!((of("diffuse-coupling").because.len(), of("sheen").because.len()), (2, 1));
    assert!(
        of("diffuse-coupling")
            .because
            .iter()
            .any(|why| why.starts_with("b: dielectric with a rough diffuse base"))
    );
    let why = "`e` has a rough base below Beckmann's lobe, for which this version has no factor";
    assert_eq!(reason(&both, "diffuse-coupling"), why);
    assert_eq!(reason(&both, "sheen"), "the sheen of `c` stays below alpha 0.0001, which is smooth");
    let served = plan_of(&[all[0].clone(), all[3].clone()]);
    assert!(served.left_out.iter().all(|left| !["diffuse-coupling", "sheen"].contains(&left.effect)));
}

#[test]
fn every_effect_is_either_planned_or_left_out() {
    for text in [r#"{"schema_version":1,"materials":[]}"#, include_str!("../../src/scene/default.json")] {
        let plan = plan(&scene(text));
        let mut names: Vec<&str> = plan.effects.iter().map(|e| e.effect).collect();
        names.extend(plan.left_out.iter().map(|l| l.effect));
        names.sort();
        let mut all: Vec<&str> = catalogue().iter().map(|effect| effect.name()).collect();
        all.sort();
        assert_eq!(names, all);
        assert!(plan.left_out.iter().all(|l| !l.reason.is_empty()));
    }
}

#[test]
fn a_scene_without_rough_speculars_plans_nothing_and_says_why() {
    let empty = plan(&scene(r#"{"schema_version":1,"materials":[]}"#));
    assert!(empty.is_empty());
    assert_eq!(reason(&empty, "reflection"), "no material has a lobe");
    let smooth = plan(&scene(include_str!("../../examples/mirrors.json")));
    assert!(smooth.is_empty());
    let one = plan(&metals(&[("m", "0", "{\"fit\":{}}")]));
    let why = reason(&one, "reflection");
    assert!(why.ends_with(": `m` stays below alpha 0.0001, which is smooth"), "{why}");
    let why = reason(&smooth, "reflection");
    assert!(why.contains("`mirror`, `window`") && why.contains("smooth"), "{why}");
    // Nor does a smooth one vanish beside a rough one.
    let both = plan(&metals(&[("m", "0", "{\"fit\":{}}"), ("r", "0.5", "{\"fit\":{}}")]));
    assert_eq!(reason(&both, "reflection"), "`m` stays below alpha 0.0001, which is smooth");
}

#[test]
fn a_fit_alone_plans_no_table_and_a_table_alone_no_fit() {
    let scene = metals(&[("m", "0.5", r#"{"fit":{}}"#)]);
    let fit = plan(&scene);
    assert!(tables(&scene).is_empty() && fits(&fit).is_some());
    assert_eq!(fit.effects[0].bytes, 0);
    let scene = metals(&[("m", "[0.1,0.5]", r#"{"tables":[{}]}"#)]);
    assert!(fits(&plan(&scene)).is_none() && tables(&scene).len() == 1);
}

#[test]
fn a_plan_says_what_no_formula_keeps() {
    let said = |want: &str| {
        let plan = plan(&metals(&[("m", "[0.05,1]", &format!(r#"{{"fit":{{{want}}}}}"#))]));
        plan.effects[0].jobs[0].said()
    };
    let none = said(r#""max_ops":3"#);
    assert!(
        none.ends_with("; no formula has so few, and `bake` fails: the cheapest takes 5 operations"),
        "{none}"
    );
    let few = said(r#""max_ops":8,"max_error":0.01"#);
    assert!(few.ends_with("8 operations reach 0.082, 18 reach 0.00972"), "{few}");
    let table = said(r#""max_error":0.0001"#);
    assert!(
        table.ends_with("and no formula less: `bake` fails, and names the table that keeps it"),
        "{table}"
    );
    let grazing = metals(&[("m", "[0.05,1]", r#"{"fit":{"max_ops":8,"max_error":0.01}}"#)]);
    let grazing = plan(&Scene { mu: [0.001, 1.0], ..grazing });
    let unknown = grazing.effects[0].jobs[0].said();
    assert!(unknown.ends_with("up to 8 operations, max"), "{unknown}");
    let kept = said(r#""max_ops":18,"max_error":0.01"#);
    assert!(kept.ends_with("up to 18 operations, max"), "{kept}");
}

#[test]
fn equal_tables_merge_over_the_hull_with_the_strictest_limit() {
    let table = |e: &str| format!(r#"{{"tables":[{{"size":[16,8]{e}}}]}}"#);
    let scene = metals(&[
        ("a", "[0.3,0.4]", &table(r#","max_error":0.1"#)),
        ("b", "[0.1,0.2]", &table(r#","max_error":0.01"#)),
        ("c", "0.9", &table("")),
        ("smooth", "0", &table(r#","max_error":1e-9"#)),
        (
            "other",
            "[0.5,0.7]",
            r#"{"tables":[{"size":[16,8],"format":"f32","layout":"plain","serves":"split-sum"}]}"#,
        ),
    ]);
    let (tables, plan) = (tables(&scene), plan(&scene));
    assert_eq!(tables.len(), 2);
    let merged = &tables[0];
    assert_eq!(merged.want.size, Some(vec![16, 8]));
    assert_eq!(merged.region.roughness, [0.1, 0.9]);
    assert_eq!(merged.want.max_error, Some(0.01));
    let names: Vec<&str> = plan.jobs("reflection")[0].demands.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names, ["a", "b", "c"]);
    assert_eq!(merged.limited_by, "b (materials[1].wants.tables[0].max_error)");
    assert_eq!(tables[1].names.concat(), "ggx-dfg-correlated-16x8-f32-plain-split-sum");
    assert_eq!(tables[1].want.max_error, None);
}

#[test]
fn an_open_size_has_a_limit() {
    let scene = metals(&[
        ("a", "[0.1,1]", r#"{"tables":[{}]}"#),
        ("b", "[0.1,1]", r#"{"tables":[{"serves":"split-sum"}]}"#),
    ]);
    let (tables, plan) = (tables(&scene), plan(&scene));
    assert_eq!(tables[0].names.concat(), "ggx-dfg-correlated-auto");
    assert_eq!(tables[0].want.size, None);
    assert_eq!(tables[0].want.max_error, Some(1e-3));
    assert_eq!(tables[1].want.max_error, Some(3e-3));
    let bytes: Vec<_> = plan.effects[0].jobs.iter().map(|j| (j.bytes, j.bytes_at_most)).collect();
    assert_eq!(bytes, [(128 * 128 * 2, true), (128 * 128 * 2 * 2, true)]);
    assert!(plan.effects[0].bytes_at_most);
}

#[test]
fn a_single_roughness_is_told_with_the_range_of_its_job() {
    let because =
        |roughness: &str| plan(&metals(&[("m", roughness, r#"{"fit":{}}"#)])).effects[0].because[0].clone();
    for (given, told) in [
        ("0.5", "(roughness 0.5)"),
        ("0.3", "(roughness 0.3)"),
        ("1", "(roughness 1)"),
        ("[0.5,0.502]", "(roughness 0.5 to 0.502, widened to 0.496 to 0.506)"),
        ("[0.1,0.7]", "(roughness 0.1 to 0.7)"),
    ] {
        assert!(because(given).contains(told), "{}", because(given));
    }
}

#[test]
fn fits_merge_and_keep_each_promise() {
    let mut scene = metals(&[
        ("a", "[0.3,0.4]", r#"{"fit":{"max_ops":8,"max_error":0.05,"norms":["rms"]}}"#),
        ("b", "[0.5,0.6]", r#"{"fit":{"max_ops":20,"max_error":0.0105,"norms":["max"],"average":true}}"#),
        ("c", "0.35", r#"{"fit":{"max_ops":8,"max_error":0.05,"norms":["rms"],"hypotheses":["x.wgsl"]}}"#),
    ]);
    let best = plan(&scene);
    let fit = fits(&best).unwrap();
    let promises: Vec<_> = fit.promises.iter().map(|p| (p.max_ops, p.max_error, p.by.len())).collect();
    assert_eq!(promises, [(Some(20), 0.0105, 1)], "one function, one promise");
    let merging = best.effects[0].jobs[0].merging.as_deref();
    assert_eq!(
        merging,
        Some(
            "max_ops 8 of `a` and 1 more and 20 of `b` became 20; max_error 0.05 of `a` and 1 more and 0.0105 of `b` became 0.0105"
        )
    );
    scene.output.pick = Pick::All;
    let plan = plan(&scene);
    let fit = fits(&plan).unwrap();
    assert_eq!(fit.ranges["roughness"], [0.3, 0.6]);
    assert_eq!((fit.goals.max_ops, fit.goals.max_error), (Some(20), Some(0.0105)));
    assert_eq!(fit.goals.norms, [Norm::Max, Norm::Rms]);
    let wants = FitJob::of(&scene, fit);
    assert!(wants.average && wants.hypotheses == ["x.wgsl"], "{wants:?}");
    let names = |by: &[(String, String)]| by.iter().map(|(n, _)| n.as_str()).collect::<Vec<_>>().join(" ");
    let promises: Vec<_> = fit.promises.iter().map(|p| (p.max_ops, p.max_error, names(&p.by))).collect();
    assert_eq!(promises, [(Some(8), 0.05, "a c".into()), (Some(20), 0.0105, "b".into())]);
    let wanted: Vec<String> = fit.promises.iter().map(|p| p.wanted_by()).collect();
    let both = "a (materials[0].wants.fit.max_error), c (materials[2].wants.fit.max_error)";
    assert_eq!(wanted, [both, "b (materials[1].wants.fit.max_error)"]);
    let unlimited = lobefit::plan::plan(&metals(&[
        ("a", "0.5", r#"{"fit":{"max_ops":8}}"#),
        ("b", "0.5", r#"{"fit":{}}"#),
    ]));
    assert_eq!(fits(&unlimited).unwrap().goals.max_ops, None);
}

#[test]
fn ranges_begin_where_rough_begins_and_one_value_stays_one() {
    let range = |roughness: &str| {
        let plan = plan(&metals(&[("m", roughness, r#"{"fit":{}}"#)]));
        fits(&plan).map(|fit| fit.ranges["roughness"])
    };
    assert_eq!(range("[0,1]"), Some([0.01, 1.0]));
    assert_eq!(range("[0.02,1]"), Some([0.02, 1.0]));
    assert_eq!(range("0.0099"), None);
    assert_eq!(range("[0,0.01]"), Some([0.01, 0.01]));
    assert_eq!(range("1"), Some([1.0, 1.0]));
    assert_eq!(range("0.5"), Some([0.5, 0.5]));
    let [lo, hi] = range("[0.5,0.502]").unwrap();
    assert!(lo < 0.5 && hi > 0.502 && (hi - lo - 0.01).abs() < 1e-12, "{lo} {hi}");
}

#[test]
fn the_hash_is_of_the_meaning() {
    let base = scene(
        r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","ior":1.5,"roughness":0.5}]}"#,
    );
    let same = scene(
        r#"{ "materials" : [ {"roughness":[5e-1,0.5],"wants":{"fit":{"norms":["max"]},"tables":[{"format":"f16"}]},
            "kind":"dielectric","ior":1.50,"name":"\u006d"} ], "alpha":"roughness^2","schema_version":1,"probes":[],"pick":"best","reports":true}"#,
    );
    let other = scene(
        r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","ior":1.5000000000000002,"roughness":0.5}]}"#,
    );
    assert_eq!(base.hash().unwrap(), same.hash().unwrap());
    assert_ne!(base.hash().unwrap(), other.hash().unwrap());
    assert_eq!(base.hash().unwrap().len(), 64);
}

#[test]
fn numbers_are_read_to_the_nearest_f64() {
    // 17 digits beside a tie: a reader that is one ulp off would show.
    let m = scene(
        r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":[0.12345678901234566,1e-320,1.0],"roughness":1}]}"#,
    );
    assert_eq!(m.materials[0].f0, Some([0.12345678901234566, 1e-320, 1.0]));
}
