//! The effect diffuse-coupling: from the scene to the bytes, and nothing of it where the scene does
//! not ask.

use crate::baked_support::{assert_promised, shared};
use crate::emit_support;

use std::sync::LazyLock;

use emit_support::compilers::includes_in_cpp;
use emit_support::languages::compile;
use emit_support::programs::{compile_library, run};
use lobefit::approximate::Fit;
use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::data::Smith;
use lobefit::plan::{Plan, plan};
use lobefit::scene::Scene;
use lobefit_shade::code::Language;
use lobefit_truth::integrate::Estimate;
use lobefit_truth::integrate::reflection::{TOLERANCE, reflection};
use lobefit_truth::quantity::COUPLING;
use lobefit_truth::quantity::coupling::{Specular, Split, factor};
use serde_json::{Value, json};

fn scene(materials: &str) -> Scene {
    let json =
        format!(r#"{{"schema_version": 1, "name": "test", "pick": "all", "materials": [{materials}]}}"#);
    Scene::from_json(json.as_bytes(), "test.json").expect("a scene")
}

/// A dielectric that wants the smallest table and has this base.
fn dielectric(name: &str, f0: &str, base: &str) -> String {
    format!(
        r#"{{"name": "{name}", "kind": "dielectric", "f0": {f0}, "roughness": [0.1, 1], "base": {base},
            "wants": {{"tables":[{{"size": [2, 2], "layout": "plain"}}]}}}}"#
    )
}

fn baked(scene: &Scene) -> Baked {
    let only = vec!["diffuse-coupling".to_string()];
    let selection = Selection { only, ..shared() };
    bake(scene, &plan(scene), &[], selection, &Silent).expect("a bake")
}

fn manifest(baked: &Baked) -> Value {
    serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest")
}

/// One dielectric for each kind of lobe: the bake that the furnace looks at too.
fn all() -> &'static Baked {
    &crate::furnace_coupling::BAKED
}

/// Its factors.
fn factors() -> impl Iterator<Item = &'static Fit> {
    all().fits.iter().filter(|f| f.emitted && f.approximation.used_as == COUPLING)
}

/// f0 of the certificate.
fn f0_of(fit: &Fit) -> [f32; 2] {
    fit.approximation.certificate.domain["f0"].map(|x| x as f32)
}

/// A fit at one point.
fn value(fit: &Fit, roughness: f32, mu: f32, f0: f32) -> f64 {
    let column = |name: &String| match name.as_str() {
        "roughness" => vec![roughness],
        "alpha" => vec![roughness * roughness],
        "mu" => vec![mu],
        _ => vec![f0],
    };
    let inputs: Vec<Vec<f32>> = fit.hypothesis.inputs().iter().map(column).collect();
    f64::from(fit.hypothesis.tape().evaluate(&inputs, &fit.coefficients()).expect("finite")[0])
}

/// Points per side of the lattice that certificates are held to.
const SIDE: u8 = 30;

/// Roughness and mu of the lattice with the integrals there.
static LATTICE: LazyLock<Vec<([f32; 2], Split)>> = LazyLock::new(|| {
    let at = |i: u8, low: f32| {
        let t = f32::from(i) / f32::from(SIDE);
        (low + (1.0 - low) * t * t).min(1.0)
    };
    let split = |r: f32, mu: f32| {
        let lobe = reflection(Smith::Correlated, f64::from(r * r), f64::from(mu), TOLERANCE);
        Split::of(&lobe.expect("in the domain"))
    };
    let point = |i: u8, j: u8| ([at(i, 0.01), at(j, 0.01)], split(at(i, 0.01), at(j, 0.01)));
    (0..=SIDE).flat_map(|i| (0..=SIDE).map(move |j| point(i, j))).collect()
});

/// The kind of lobe that a fit is for, by its name.
fn specular(fit: &Fit) -> Specular {
    let of = |s: &Specular| fit.approximation.name.starts_with(&format!("coupling_{}_", s.name()));
    Specular::ALL.into_iter().find(of).expect("a kind of lobe")
}

#[test]
fn factors_are_fitted_certified_and_emitted_in_every_language() {
    let (baked, manifest) = (all(), manifest(all()));
    let fits = manifest["fits"].as_array().expect("a list");
    for s in Specular::ALL {
        let of: Vec<&Value> = fits.iter().filter(|f| f["specular"] == s.name()).collect();
        assert!(of.len() >= 4, "{}: {}", s.name(), of.len());
        for fit in &of {
            let words = ["effect", "quantity", "column", "use", "source"]
                .map(|key| fit[key].as_str().expect("a word"));
            assert_eq!(words, ["diffuse-coupling", "diffuse-coupling", "factor", "coupling", "fitted"]);
            let domain = &fit["certificate"]["domain"];
            assert_eq!(
                [&domain["roughness"], &domain["mu"], &domain["f0"]],
                [
                    &json!([0.01, 1.0]),
                    &json!([0.01, 1.0]),
                    &json!(if s == Specular::Normalised { [0.04, 0.04] } else { [0.02, 0.08] })
                ]
            );
            let [here, any] = [&fit["certificate"]["max_abs"], &fit["any_f0"]["max_abs"]]
                .map(|x| x.as_f64().expect("a number"));
            assert!(any >= here && fit["any_f0"]["looked_at"] == "every f0", "{fit}");
        }
        for include in manifest["includes"].as_array().expect("a list") {
            let text =
                String::from_utf8_lossy(&baked.files[include["file"].as_str().expect("a file")]).into_owned();
            for name in ["coupling_exact", "coupled"].map(|start| format!("diffuse_{start}_{}(", s.name())) {
                assert!(text.contains(&name), "{name} in {include}");
            }
            for fit in &of {
                let name = format!("{}(", fit["function"].as_str().expect("a name"));
                assert!(text.contains(&name), "{name} in {include}");
            }
        }
    }
    assert_eq!(manifest["includes"].as_array().map(Vec::len), Some(6));
    let effects = manifest["effects"].as_array().expect("a list");
    let effect = effects.iter().find(|e| e["effect"] == "diffuse-coupling").expect("the effect");
    assert_eq!(effect["because"].as_array().map(Vec::len), Some(3));
    let left_out = manifest["fits_left_out"].as_array().into_iter().flatten();
    let of_bases: Vec<&Value> = left_out.filter(|l| l["effect"] == "diffuse-coupling").collect();
    assert!(of_bases.is_empty(), "{of_bases:?}");
    let page = String::from_utf8_lossy(&baked.files["reports/diffuse-coupling.html"]).into_owned();
    for shown in [
        "coupling_pesce",
        "coupling_gltf",
        "coupling_single_karis",
        "coupling_compensated_24",
        "coupling_table_64x64",
        "1 − Fresnel",
    ] {
        assert!(page.contains(shown), "{shown}");
    }
}

/// Certificates bound the error on a lattice and are reached somewhere near; so are the bounds over
/// all f0.
#[test]
fn certificates_of_the_factors_hold() {
    let manifest = manifest(all());
    for fit in factors() {
        let (specular, name) = (specular(fit), &fit.approximation.name);
        let (mut worst, mut anywhere) = (0.0_f64, 0.0_f64);
        for ([r, mu], split) in LATTICE.iter() {
            let error =
                |f0: f32| (value(fit, *r, *mu, f0) - factor(split, f64::from(f0), specular).value).abs();
            worst = f0_of(fit).map(error).into_iter().fold(worst, f64::max);
            anywhere = [0.0, 0.25, 0.5, 0.75, 1.0].map(error).into_iter().fold(anywhere, f64::max);
        }
        let stated = fit.approximation.certificate.max_abs;
        assert!(worst <= stated * 1.0001 && worst > 0.5 * stated, "{name}: {worst} of {stated}");
        let entry = manifest["fits"]
            .as_array()
            .expect("a list")
            .iter()
            .find(|f| f["name"] == *name)
            .expect("the entry");
        let any = entry["any_f0"]["max_abs"].as_f64().expect("a number");
        assert!(anywhere <= 1.01 * any && anywhere > 0.5 * any, "{name}: {anywhere} of {any}");
    }
}

/// What every factor under a normalised lobe promises: no light at f0 = 1; 1 - f0 at normal
/// incidence, where the form says so; never more light for a larger f0, and none below a lobe that
/// takes all.
#[test]
fn limits_and_monotony_of_the_emitted_factors() {
    let mut exact = 0;
    for fit in factors() {
        let (kind, name) = (specular(fit), &fit.approximation.name);
        let doc = fit.hypothesis.doc().join(" ");
        let stated = fit.approximation.certificate.max_abs;
        for i in 0..=20_u8 {
            let r = 0.01 + 0.99 * f32::from(i) / 20.0;
            for j in 0..=20_u8 {
                let mu = (0.01 + 0.99 * f32::from(j) / 20.0).min(1.0);
                if kind != Specular::Single {
                    let none = value(fit, r, mu, 1.0);
                    assert!(none.abs() <= 1e-6, "{name}: {none} left at f0 = 1, roughness {r}, mu {mu}");
                }
                let over: Vec<f64> =
                    (0..=8_u8).map(|k| value(fit, r, mu, 0.02 + 0.06 * f32::from(k) / 8.0)).collect();
                assert!(
                    over.windows(2).all(|w| w[1] <= w[0] + 1e-6),
                    "{name} rises with f0 at roughness {r}, mu {mu}: {over:?}"
                );
                assert!(over.iter().all(|f| (0.0..=1.0 + stated).contains(f)), "{name}: {over:?}");
            }
            if doc.contains("At mu = 1 the factor is 1 - f0") {
                exact += 1;
                for f0 in [0.02_f32, 0.08] {
                    assert!(
                        (value(fit, r, 1.0, f0) - f64::from(1.0 - f0)).abs() < 1e-6,
                        "{name} at {r} {f0}"
                    );
                }
            }
        }
    }
    assert!(exact >= 21, "{exact}: no form says that it is exact at normal incidence");
}

fn include(language: Language) -> String {
    String::from_utf8(all().files[&format!("fits/lobefit.{}", language.extension())].clone()).expect("text")
}

/// Factors under every kind of lobe, the exact ones and the materials: compilers take the files
/// without a word.
#[test]
fn compilers_take_the_files() {
    compile_library(&include(Language::Rust));
    includes_in_cpp(&include(Language::C));
    for language in [Language::Hlsl, Language::Glsl] {
        assert!(compile(language, &include(language)).is_none_or(|functions| functions >= 20));
    }
    let wgsl = include(Language::Wgsl);
    let module =
        naga::front::wgsl::parse_str(&wgsl).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&wgsl)));
    let flags = naga::valid::ValidationFlags::all();
    naga::valid::Validator::new(flags, naga::valid::Capabilities::empty())
        .validate(&module)
        .expect("valid WGSL");
}

/// The emitted factors of E and B are the truth's, with its limits: a mirror leaves
/// (1 - f0)(1 - (1 - mu)^5), f0 = 1 nothing but what a bare lobe loses, and at mu = 1, where B is
/// small, 1 - f0 times what is not lost.
#[test]
fn emitted_factors_of_e_and_b_are_exact() {
    let mirror = |mu: f32| {
        let x = 1.0 - f64::from(mu);
        (1.0, x * x * x * x * x)
    };
    let lobe = |alpha: f64, mu: f64| {
        let lobe = reflection(Smith::Correlated, alpha, mu, TOLERANCE).expect("in the domain");
        (lobe.e, lobe.b)
    };
    let pairs = [
        mirror(0.0),
        mirror(0.3),
        mirror(1.0),
        lobe(0.25, 0.01),
        lobe(0.25, 1.0),
        lobe(1.0, 1.0),
        lobe(1.0, 0.4),
    ];
    let points: Vec<[f32; 3]> = [0.0_f32, 0.04, 0.5, 1.0]
        .iter()
        .flat_map(|f0| pairs.map(|(e, b)| [*f0, e as f32, b as f32]))
        .collect();
    let calls: String = Specular::ALL
        .map(|s| format!("        out.push(lobefit::diffuse_coupling_exact_{}(f0, e, b));\n", s.name()))
        .concat();
    let body = format!("    for &[f0, e, b] in &points {{\n{calls}    }}\n");
    let bytes: Vec<u8> = points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let found = run(&include(Language::Rust), 3, &body, &bytes);
    for ([f0, e, b], found) in points.iter().map(|p| p.map(f64::from)).zip(found.chunks_exact(3)) {
        let with = |value| Estimate { value, error: 0.0 };
        let split = Split { e: with(e), a: with(e - b), loss: with(1.0 - e) };
        for (s, found) in Specular::ALL.into_iter().zip(found) {
            let expected = factor(&split, f0, s).value;
            assert!(
                (f64::from(*found) - expected).abs() < 1e-6,
                "{} at {f0} {e} {b}: {found}, {expected}",
                s.name()
            );
            if e == 1.0 {
                assert!((expected - (1.0 - f0) * (1.0 - b)).abs() < 1e-15);
            }
            if f0 == 1.0 {
                assert!((expected - if s == Specular::Single { 1.0 - e } else { 0.0 }).abs() < 1e-15);
            }
        }
    }
}

/// Ours beat the published comparison's bars: 0.102 with 7 operations and 0.019 with 15 under a
/// normalised lobe, 0.072 and 0.016 (with 39) at f0 = 0.02 under a bare one; and a factor of seven
/// operations is not below 0 for it, which costs it a fifth of its accuracy.
#[test]
fn ours_beat_the_bars() {
    let best = |s: Specular, ops: u32| {
        let of = factors().filter(|f| specular(f) == s && f.approximation.cost.ops <= ops);
        of.map(|f| f.approximation.certificate.max_abs).fold(f64::INFINITY, f64::min)
    };
    for (s, ops, bar) in [
        (Specular::Normalised, 7, 0.09),
        (Specular::Normalised, 8, 0.066),
        (Specular::Normalised, 15, 0.014),
        (Specular::Normalised, 19, 0.0075),
        (Specular::Single, 7, 0.0719),
        (Specular::Single, 30, 0.0075),
        (Specular::Compensated, 7, 0.0725),
        (Specular::Compensated, 32, 0.0075),
    ] {
        assert!(best(s, ops) < bar, "{} {ops}: {}", s.name(), best(s, ops));
    }
    assert_promised("tests/emitted/coupling.rs", factors());
    let of_others = |f: &&Fit| !f.emitted && f.approximation.used_as == COUPLING;
    assert!(all().fits.iter().filter(of_others).count() >= 8);
}

fn left_out(plan: &Plan) -> &str {
    let left = plan.left_out.iter().find(|l| l.effect == "diffuse-coupling").expect("left out");
    &left.reason
}

#[test]
fn without_a_base_there_is_nothing_of_it() {
    let of = |material: &str| plan(&scene(&format!(r#"{{"name": "m", {material}}}"#)));
    for (material, reason) in [
        (r#""kind": "metal", "f0": 1, "roughness": 0.5"#, "no material is a dielectric with a diffuse base"),
        (
            r#""kind": "dielectric", "ior": 1.5, "roughness": 0.5"#,
            "no material is a dielectric with a diffuse base: `m` has no `base`",
        ),
        (
            r#""kind": "dielectric", "ior": 1.5, "roughness": 0.5, "base": {"albedo": 0}"#,
            "no dielectric with a diffuse base calls for it: `m` has a black base, which sends back nothing",
        ),
        (
            r#""kind": "dielectric", "ior": 1.5, "roughness": 0.005, "base": {}"#,
            "no dielectric with a diffuse base calls for it: `m` stays below alpha 0.0001, which is smooth: there the factor is \
             (1 - f0)(1 - (1 - mu)^5)",
        ),
    ] {
        let plan = of(material);
        assert!(plan.jobs("diffuse-coupling").is_empty());
        assert_eq!(left_out(&plan), reason);
    }
    // Scenes without a base have the hash that they had before there were bases.
    let plain = scene(r#"{"name": "m", "kind": "dielectric", "ior": 1.5, "roughness": 0.5}"#);
    let normal = serde_json::to_string(&plain).expect("JSON");
    assert!(!normal.contains("base"), "{normal}");
}

#[test]
fn a_base_that_makes_no_sense_is_refused_with_its_field() {
    for (kind, base, expected) in [
        ("\"dielectric\", \"ior\": 1.5", r#"{"albedo": 1.5}"#, "base.albedo: 1.5 is outside [0, 1]"),
        (
            "\"dielectric\", \"ior\": 1.5",
            r#"{"specular": "kelemen"}"#,
            "base.specular: unknown variant `kelemen`",
        ),
        ("\"dielectric\", \"ior\": 1.5", r#"{"norms": []}"#, "norms: the list is empty"),
        ("\"dielectric\", \"ior\": 1.5", r#"{"roughness": 2}"#, "base.roughness: 2 is outside [0, 1]"),
        ("\"dielectric\", \"ior\": 1.5", "0.5", "an object that describes a diffuse base"),
        ("\"metal\", \"f0\": 1", "{}", "`base` is for dielectrics; leave it out of a metal"),
        ("\"glass\", \"ior\": 1.5", "{}", "`base` is for dielectrics; leave it out of glass"),
    ] {
        let json = format!(
            r#"{{"schema_version": 1, "pick": "all", "materials": [{{"name": "m", "kind": {kind}, "roughness": 1, "base": {base}}}]}}"#
        );
        let error = Scene::from_json(json.as_bytes(), "s.json").expect_err("refused").to_string();
        assert!(error.contains(expected) && error.contains("materials[0]"), "{base}: {error}");
    }
}

/// One job for all bases under one kind of lobe: the hull of their ranges, every norm, the most
/// operations, each promise by itself.
#[test]
fn bases_are_planned_together() {
    let materials = [
        dielectric("a", "0.02", r#"{"max_ops": 8, "max_error": 0.09, "norms": ["max"]}"#),
        dielectric("b", "[0.04, 0.05, 0.03]", r#"{"albedo": [0, 0, 0.5], "max_ops": 15, "norms": ["rms"]}"#)
            .replace("[0.1, 1]", "[0.05, 0.6]"),
        dielectric("c", "0.2", r#"{"specular": "single"}"#),
        dielectric("d", "0.9", r#"{"albedo": 0}"#),
    ];
    let plan = plan(&scene(&materials.join(",")));
    let [single, normalised] = plan.jobs("diffuse-coupling") else { panic!("{plan:?}") };
    assert_eq!((single.name.as_str(), single.ranges["f0"]), ("coupling-single", [0.2, 0.2]));
    assert_eq!(single.goals.max_ops, None);
    assert_eq!(
        (normalised.name.as_str(), normalised.ranges["f0"], normalised.goals.max_ops),
        ("coupling-normalised", [0.02, 0.05], Some(15))
    );
    assert_eq!(
        (normalised.ranges["roughness"], normalised.goals.norms.len(), normalised.promises.len()),
        ([0.05, 1.0], 2, 1)
    );
    let effect = plan.effects.iter().find(|e| e.effect == "diffuse-coupling").expect("the effect");
    assert_eq!((effect.because.len(), effect.jobs.len(), effect.expected_error), (3, 2, None));
    assert_eq!(effect.ranges["f0"], [0.02, 0.2]);
}

#[test]
fn a_promise_on_the_factor_is_kept_or_told() {
    let with = |limit: &str| {
        let base = format!(r#"{{"max_ops": 8, "max_error": {limit}, "norms": ["max"]}}"#);
        baked(&scene(&dielectric("m", "0.04", &base)))
    };
    assert!(with("0.09").broken.is_empty());
    let broken = with("0.01").broken;
    assert!(
        broken.len() == 1
            && broken[0].starts_with(
                "coupling under a normalised lobe: the best is coupling_normalised_8 with error "
            )
            && broken[0].contains("m (materials[0].base.max_error)"),
        "{broken:?}"
    );
}
