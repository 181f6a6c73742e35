//! Scenes of anisotropic materials and of glass to plans: defaults, names, merging, what is left
//! out and why.

use crate::common;

use common::{lobefit, stderr};
use lobefit::data::{AlphaMap, Container, Smith, TexelFormat};
use lobefit::effects::table::{SliceAxis, Slices, TableJob};
use lobefit::plan::{Plan, plan};
use lobefit::scene::{Layout, Lobe, Scene};
use serde_json::{Value, json};

fn scene(text: &str) -> Scene {
    Scene::from_json(text.as_bytes(), "test").unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A scene with these materials, each given by its fields.
fn of(materials: &[&str]) -> Scene {
    let list: Vec<String> = materials.iter().map(|fields| format!("{{{fields}}}")).collect();
    scene(&format!(r#"{{"schema_version":1,"materials":[{}]}}"#, list.join(",")))
}

/// An anisotropic metal with a comma before the rest of its fields.
fn brushed(name: &str, rest: &str) -> String {
    format!(r#""name":"{name}","kind":"metal","f0":1,"roughness":[0.2,0.6],"anisotropy":[0.3,0.5]{rest}"#)
}

fn glass(name: &str, rest: &str) -> String {
    format!(r#""name":"{name}","kind":"glass","ior":[1.2,1.6],"roughness":[0.2,0.6]{rest}"#)
}

fn tables(list: &str) -> String {
    format!(r#","wants":{{"tables":[{list}]}}"#)
}

fn table_names(job: &TableJob) -> Vec<&str> {
    job.names.iter().map(String::as_str).collect()
}

/// The jobs of tables with slices, those of anisotropic lobes first.
fn sliced(scene: &Scene) -> Vec<TableJob> {
    let plan = plan(scene);
    let jobs = [plan.jobs("anisotropy"), plan.jobs("glass")].concat();
    TableJob::all(scene, &jobs).expect("jobs of tables")
}

fn reason<'a>(plan: &'a Plan, effect: &str) -> &'a str {
    &plan.left_out.iter().find(|l| l.effect == effect).expect("left out").reason
}

fn called_for(plan: &Plan) -> Vec<&'static str> {
    plan.effects.iter().map(|e| e.effect).collect()
}

#[test]
fn without_wants_an_anisotropic_material_and_glass_want_one_optimised_table() {
    let scene = of(&[&brushed("b", ""), &glass("g", "")]);
    assert_eq!(scene.materials[0].lobe(), Lobe::Anisotropic);
    assert_eq!((scene.materials[1].lobe(), scene.materials[1].f0), (Lobe::Glass, None));
    let plan = plan(&scene);
    assert_eq!(called_for(&plan), ["anisotropy", "glass"]);
    assert!(plan.jobs("reflection").is_empty() && !plan.is_empty());
    let jobs = sliced(&scene);
    let [brushed, glass] = &jobs[..] else { panic!("{jobs:?}") };
    assert_eq!(table_names(brushed), ["ggx-aniso-correlated-64x64x8"]);
    assert_eq!((brushed.want.size.clone(), brushed.want.layout), (Some(vec![64, 64, 8]), Layout::Optimised));
    assert_eq!((brushed.want.format, brushed.want.max_error), (TexelFormat::F16, None));
    assert_eq!(
        (brushed.region.roughness, brushed.region.slices),
        ([0.2, 0.6], Some(Slices { axis: SliceAxis::Anisotropy, range: [0.3, 0.5] }))
    );
    let sides = ["outside", "inside"].map(|side| format!("ggx-glass-{side}-correlated-128x128x16"));
    assert_eq!(table_names(glass), sides);
    assert_eq!(
        (glass.want.size.clone(), glass.region.slices),
        (Some(vec![128, 128, 16]), Some(Slices { axis: SliceAxis::Ior, range: [1.2, 1.6] }))
    );
    assert_eq!((glass.smith, glass.region.alpha_map), (Smith::Correlated, AlphaMap::RoughnessSquared));
    let bytes: Vec<u64> = plan.effects.iter().map(|e| e.bytes).collect();
    assert_eq!(bytes, [64 * 64 * 8 * 2, 2 * 128 * 128 * 16 * 2]);
}

#[test]
fn names_say_what_tells_tables_apart() {
    let all = r#"{"layout":"path-tracer"},{"format":"f32","size":[8,16,4]}"#;
    let azimuth = format!(r#"{{"layout":"azimuth"}},{all}"#);
    let jobs = sliced(&of(&[&brushed("b", &tables(&azimuth)), &glass("g", &tables(all))]));
    let found: Vec<&str> = jobs.iter().flat_map(table_names).collect();
    assert_eq!(
        found,
        [
            "ggx-aniso-azimuth-correlated-64x16x8",
            "path-tracer-reflection-separable-64x64x32",
            "ggx-aniso-correlated-8x16x4-f32",
            "path-tracer-glass-outside-separable-128x128x32",
            "path-tracer-glass-inside-separable-128x128x32",
            "ggx-glass-outside-correlated-8x16x4-f32",
            "ggx-glass-inside-correlated-8x16x4-f32",
        ]
    );
    let limits: Vec<Option<f64>> = jobs.iter().map(|job| job.want.max_error).collect();
    assert_eq!(limits, [None; 5], "where the default size is one, nothing is promised by default");
}

#[test]
fn a_limit_alone_keeps_the_default_size_and_a_size_alone_sets_no_limit() {
    let job = |table: &str| sliced(&of(&[&brushed("b", &tables(table))]))[0].clone();
    let limit = job(r#"{"max_error":0.1}"#);
    assert_eq!((limit.want.size.clone(), limit.want.max_error), (Some(vec![64, 64, 32]), Some(0.1)));
    let size = job(r#"{"layout":"azimuth","size":[16,8,4]}"#);
    assert_eq!((size.want.size.clone(), size.want.max_error), (Some(vec![16, 8, 4]), None));
}

/// Materials of one index of refraction take as few slices as there may be, if the scene leaves
/// them open, and indices that lie close together few; another material may share the table.
#[test]
fn close_values_take_few_slices() {
    let glass = |name: &str, ior: &str, more: &str| glass(name, more).replace("[1.2,1.6]", ior);
    let sizes = |materials: &[&str]| -> Vec<_> {
        sliced(&of(materials)).iter().map(|job| job.want.size.clone().expect("a size")).collect()
    };
    let both = tables(r#"{},{"size":[8,8,8]}"#);
    let one = [128, 128, 1];
    assert_eq!(sizes(&[&glass("a", "1.505", &both)]), [one.to_vec(), vec![8, 8, 8]]);
    let two = tables(r#"{"size":[64,32]}"#);
    assert_eq!(sizes(&[&glass("a", "1.03", &two)]), [vec![64, 32, 1]]);
    let limited = tables(r#"{"max_error":0.01}"#);
    assert_eq!(sizes(&[&glass("a", "[1.45,1.55]", &limited)]), [vec![128, 128, 32]], "as accurate as can be");
    let decimal = tables(r#"{"size":[8.0,8e0,8]}"#);
    assert_eq!(sizes(&[&glass("a", "1.505", &decimal)]), [vec![8, 8, 8]], "whole, with a decimal point");
    assert_eq!(sizes(&[&glass("a", "1.5", ""), &glass("b", "1.5", "")]), [one]);
    assert_eq!(sizes(&[&glass("a", "1.5", ""), &glass("b", "1.33", "")]), [vec![128, 128, 8]]);
    assert_eq!(sizes(&[&glass("a", "1.5", ""), &glass("b", "[1.1,1.2]", "")]), [vec![128, 128, 32]]);
    for (ior, slices) in [("[2.37,2.43]", 4), ("[1.45,1.55]", 4), ("[1.3,1.7]", 16), ("[1.05,1.06]", 32)] {
        assert_eq!(sizes(&[&glass("a", ior, "")]), [vec![128, 128, slices]], "{ior}");
    }
    for (anisotropy, slices) in
        [("0.5", 1), ("[0.1,0.3]", 4), ("[0.4,0.6]", 8), ("[0,0.5]", 16), ("[0,1]", 32)]
    {
        let brushed = brushed("b", "").replace("[0.3,0.5]", anisotropy);
        assert_eq!(sizes(&[&brushed]), [vec![64, 64, slices]], "{anisotropy}");
    }
    // Materials that call for no such table leave the others alone.
    let path_tracer = tables(r#"{"layout":"path-tracer"}"#);
    let smooth = glass("c", "2", "").replace("[0.2,0.6]", "0");
    assert_eq!(
        sizes(&[&glass("a", "1.5", ""), &glass("b", "1.33", &path_tracer), &smooth])[0],
        [128, 128, 1]
    );
    let both = sliced(&of(&[&glass("a", "1.505", &both)]));
    let [one, several] = [0, 1].map(|i: usize| both[i].region.slices.expect("slices").range);
    assert_eq!((one, several), ([1.505; 2], [1.5, 1.51]), "in the digits that a person would write");
}

#[test]
fn the_path_tracers_tables_are_separable_and_alpha_is_roughness_whatever_the_scene_says() {
    let table = tables(r#"{"layout":"path-tracer"},{}"#);
    let text = format!(
        r#"{{"schema_version":1,"smith":"correlated","alpha":"roughness^4","materials":[{{{}}},{{{}}}]}}"#,
        brushed("b", &table),
        glass("g", &table)
    );
    for jobs in sliced(&scene(&text)).chunks(2) {
        assert_eq!((jobs[0].smith, jobs[0].region.alpha_map), (Smith::Separable, AlphaMap::Roughness));
        assert_eq!((jobs[1].smith, jobs[1].region.alpha_map), (Smith::Correlated, AlphaMap::RoughnessFourth));
    }
    // Rows begin at alpha = 4e-4 in each map.
    let wide = brushed("b", &table).replace("[0.2,0.6]", "[0,1]");
    let jobs = sliced(&of(&[&wide]));
    assert_eq!((jobs[0].region.roughness, jobs[1].region.roughness), ([4e-4, 1.0], [2e-2, 1.0]));
}

#[test]
fn equal_tables_merge_over_the_hull_with_the_strictest_limit() {
    let limit = |e: &str| tables(&format!(r#"{{"layout":"path-tracer"}},{{"max_error":{e}}}"#));
    let wide = glass("c", &limit("0.05")).replace("[1.2,1.6]", "2").replace("[0.2,0.6]", "[0.5,0.9]");
    let smooth = glass("smooth", &limit("1e-9")).replace("[0.2,0.6]", "0");
    let scene = of(&[&glass("a", &limit("0.1")), &brushed("b", ""), &wide, &smooth]);
    let (plan, jobs) = (plan(&scene), sliced(&scene));
    let names: Vec<Vec<&str>> = jobs.iter().map(table_names).collect();
    assert_eq!(names.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2, 2]);
    let merged = &jobs[2];
    assert_eq!(
        (merged.region.roughness, merged.region.slices),
        ([0.2, 0.9], Some(Slices { axis: SliceAxis::Ior, range: [1.2, 2.0] }))
    );
    let materials: Vec<&str> = plan.jobs("glass")[1].demands.iter().map(|d| d.name.as_str()).collect();
    assert_eq!((merged.want.max_error, &materials[..]), (Some(0.05), &["a", "c"][..]));
    assert_eq!(merged.limited_by, "c (materials[2].wants.tables[1].max_error)");
    assert_eq!(jobs[1].limited_by, "");
    assert_eq!(plan.effects[1].because.len(), 2);
}

#[test]
fn spans_of_a_point_are_widened_inside_what_the_layout_reaches() {
    let spans = |ior: &str, layout: &str| {
        let size = if layout == "optimised" { r#","size":[8,8,4]"# } else { "" };
        let table = tables(&format!(r#"{{"layout":"{layout}"{size}}}"#));
        sliced(&of(&[&glass("g", &table).replace("[1.2,1.6]", ior)]))[0].region.slices.expect("slices").range
    };
    assert_eq!(spans("1", "optimised"), [1.0, 1.01]);
    assert_eq!(spans("3", "optimised"), [2.99, 3.0]);
    assert_eq!(spans("2", "path-tracer"), [1.99, 2.0]);
    let [lo, hi] = spans("2", "optimised");
    assert!(lo < 2.0 && hi > 2.0 && (hi - lo - 0.01).abs() < 1e-12, "{lo} {hi}");
    let solid = tables(r#"{"size":[8,8,4]}"#);
    let scene = of(&[&brushed("b", &solid).replace("[0.3,0.5]", "1")]);
    let (one, jobs) = (plan(&scene), sliced(&scene));
    assert_eq!(jobs[0].region.slices, Some(Slices { axis: SliceAxis::Anisotropy, range: [0.99, 1.0] }));
    assert!(one.effects[0].because[0].contains("anisotropy 1, widened to 0.99 to 1)"), "{one:?}");
}

/// What a plan says of the rows is what its jobs do.
#[test]
fn the_reason_tells_where_rows_begin() {
    let because = |roughness: &str, more: &str| {
        let material = brushed("b", &tables(more)).replace("[0.2,0.6]", roughness);
        plan(&of(&[&material])).effects[0].because[0].clone()
    };
    for (roughness, told) in [
        ("0.3", "(roughness 0.3, widened to 0.295 to 0.305; "),
        ("[0.2,0.6]", "(roughness 0.2 to 0.6; "),
        ("[0,1]", "(roughness 0.01 to 1, in rows from 0.02 on, to which a lookup below clamps; "),
        (
            "[0.012,0.015]",
            "(roughness 0.012 to 0.015, all below the rows, which begin at 0.02: every lookup clamps, and is not judged; ",
        ),
    ] {
        let because = because(roughness, "{}");
        assert!(because.contains(told), "{because}");
    }
    let alone = because("[0,1]", r#"{"layout":"path-tracer"}"#);
    assert!(alone.contains("(roughness 0.0001 to 1, in rows from 0.0004 on, "), "{alone}");
    let limited = |name: &str| brushed(name, &tables(r#"{"max_error":0.002}"#));
    let below = of(&[&limited("b").replace("[0.2,0.6]", "[0.012,0.015]"), &limited("c")]);
    let jobs = sliced(&below);
    assert_eq!(jobs[0].unjudged_by.as_deref().expect("one"), "b (materials[0].wants.tables[0].max_error)");
    assert_eq!(sliced(&of(&[&limited("c")]))[0].unjudged_by, None);
}

#[test]
fn an_anisotropic_material_calls_for_reflection_only_with_a_table_or_fits_of_it() {
    let with = |wants: &str| plan(&of(&[&brushed("b", &format!(r#","wants":{{{wants}}}"#))]));
    let both = with(r#""tables":[{"layout":"homogeneous"},{}]"#);
    assert_eq!(called_for(&both), ["reflection", "anisotropy"]);
    let fits = with(r#""fit":{}"#);
    assert_eq!(called_for(&fits), ["reflection"]);
    assert_eq!(reason(&fits, "anisotropy"), "no anisotropic material calls for it: `b` wants no table of it");
    let jobs = with(r#""tables":[{}]"#);
    assert_eq!(
        reason(&jobs, "reflection"),
        "no material wants a table or fits of a lobe that only reflects: `b` is anisotropic and wants tables of that"
    );
}

#[test]
fn an_anisotropy_of_zero_is_none() {
    let plain = of(&[&brushed("b", "").replace(r#","anisotropy":[0.3,0.5]"#, "")]);
    let zero = of(&[&brushed("b", "").replace("[0.3,0.5]", "0")]);
    assert_eq!(plain, zero);
    assert_eq!(zero.materials[0].lobe(), Lobe::Isotropic);
    assert_eq!(called_for(&plan(&zero)), ["reflection"]);
    assert_eq!(reason(&plan(&zero), "anisotropy"), "no material is anisotropic");
}

#[test]
fn smooth_glass_and_smooth_anisotropic_materials_call_for_nothing_and_the_plan_says_why() {
    let smooth = |fields: String| fields.replace("[0.2,0.6]", "[0,0.005]");
    let plan = plan(&of(&[&smooth(glass("window", "")), &smooth(brushed("mirror", ""))]));
    assert!(plan.is_empty());
    let stays = "stays below alpha 0.0001, which is smooth";
    assert_eq!(reason(&plan, "glass"), format!("no glass is rough: `window` {stays}"));
    let why = format!("no anisotropic material calls for it: `mirror` {stays}");
    assert_eq!(reason(&plan, "anisotropy"), why);
    let why =
        "no material has a rough specular lobe: `window`, `mirror` stay below alpha 0.0001, which is smooth";
    assert_eq!(reason(&plan, "reflection"), why);
    let rough = lobefit::plan::plan(&of(&[&glass("a", ""), &glass("b", ""), &smooth(glass("c", ""))]));
    assert_eq!(
        reason(&rough, "reflection"),
        format!(
            "no material wants a table or fits of a lobe that only reflects: `a`, `b` transmit light; `c` {stays}"
        )
    );
}

#[test]
fn formats_are_a_set_and_the_hash_of_a_scene_without_the_new_fields_stays() {
    let with = |formats: &str| scene(&format!(r#"{{"schema_version":1,{formats}"materials":[]}}"#));
    assert_eq!(with("").formats, [Container::Exr]);
    let all = with(r#""formats":["raw","npy","ktx2","dds","exr"],"#);
    assert_eq!(all.formats, Container::ALL);
    assert_eq!(all.hash().unwrap(), with(r#""formats":["exr","dds","ktx2","npy","raw"],"#).hash().unwrap());
    assert_ne!(all.hash().unwrap(), with("").hash().unwrap());
    assert_eq!(with(r#""formats":["exr"],"#).hash().unwrap(), with("").hash().unwrap());
    assert_eq!(
        with("").hash().unwrap(),
        blake3::hash(
            br#"{"name":"scene","smith":"correlated","alpha":"roughness^2","mu":[0.01,1.0],"materials":[]}"#
        )
        .to_hex()
        .as_str()
    );
    let ior = |ior: &str| of(&[&glass("g", "").replace("[1.2,1.6]", ior)]).hash().unwrap();
    assert_eq!(ior("1.5"), ior("[1.5,1.5]"));
    assert_ne!(ior("1.5"), ior("[1.5,1.6]"));
}

#[test]
fn the_json_of_a_plan_has_the_fields_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let scene: &[u8] = include_bytes!("../../examples/brushed-metal.json");
    let output = lobefit(folder.path(), &["plan", "-", "--json"], scene);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let plan: Value = serde_json::from_slice(&output.stdout).unwrap();
    let effect = &plan["effects"][0];
    assert_eq!((&effect["effect"], plan["effects"].as_array().unwrap().len()), (&json!("anisotropy"), 1));
    let because = effect["because"][0].as_str().unwrap();
    let lobe =
        "brushed aluminium: metal with a rough anisotropic lobe (roughness 0.15 to 1; anisotropy 0 to 1)";
    assert!(because.starts_with(lobe), "{because}");
    assert!(
        because.ends_with(" wants tables in the optimised, azimuth and path-tracer layouts"),
        "{because}"
    );
    assert_eq!(effect["ranges"]["anisotropy"], json!([0.0, 1.0]));
    assert_eq!(effect["ranges"]["roughness"], json!([0.15, 1.0]));
    assert_eq!(effect["ranges"]["phi"], json!([0.0, std::f64::consts::FRAC_PI_2]));
    assert_eq!(effect["bytes"], json!(2 * 64 * 64 * 32 * 2 + 64 * 16 * 16 * 4 * 4));
    // The table in the path tracer's layout has no limit.
    assert_eq!(effect["expected_error"], json!(null));
    assert_eq!(effect["jobs"][0]["expected_error"], json!(0.002));
    assert!(effect["seconds"].as_f64().unwrap() > 0.0);
    assert!(effect["approximation"].as_str().unwrap().contains("table 64x64x32 f16, optimised layout"));
    let left = plan["left_out"].as_array().unwrap();
    assert_eq!((left.len(), &left[0]["effect"]), (18, &json!("reflection")));
}

#[test]
fn the_path_tracers_glass_has_no_limit_and_two_tables_of_each_layout() {
    let plan = plan(&scene(include_str!("../../examples/frosted-glass.json")));
    let effect = &plan.effects[0];
    assert_eq!((effect.effect, effect.jobs.len(), effect.expected_error), ("glass", 4, None));
    assert_eq!(effect.ranges["ior"], [1.0, 2.0]);
    assert_eq!(effect.bytes, 2 * 128 * 128 * 32 * (2 + 4));
    let path_tracer = &effect.jobs[2].approximation;
    assert!(path_tracer.contains("path-tracer layout (separable Smith, alpha = roughness)"), "{path_tracer}");
    assert!(path_tracer.ends_with("of glass for rays from outside"), "{path_tracer}");
}
