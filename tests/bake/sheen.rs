//! The effect sheen, and fits of f0 A + B: from the scene to the bytes, and nothing of them where
//! the scene does not ask.

use std::sync::LazyLock;

use crate::baked_support::{assert_promised, bake_scene, shared};
use lobefit::approximate::Fit;
use lobefit::bake::{Baked, BakedTable, Selection, Silent, bake};
use lobefit::data::{Smith, Use};
use lobefit::effects::reflection::FitJob;
use lobefit::emit::call::{Call, callers};
use lobefit::plan::{Plan, plan};
use lobefit::scene::Scene;
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::reflection::{TOLERANCE, reflection};
use lobefit_truth::quantity::sheen::albedo;
use lobefit_truth::quantity::{EstevezKulla, Quantity, Variant};
use serde_json::{Value, json};

fn scene(material: &str) -> Scene {
    scene_with("", material)
}

fn scene_with(more: &str, material: &str) -> Scene {
    let json = format!(
        r#"{{"schema_version": 1, "name": "test", "pick": "all", {more} "materials": [{{"name": "m", {material}}}]}}"#
    );
    Scene::from_json(json.as_bytes(), "test.json").expect("a scene")
}

fn baked(material: &str) -> Baked {
    of(&scene(material))
}

/// The fits alone, for a test of these: neither pages nor more than one language.
fn plain(material: &str) -> Baked {
    of(&scene_with(r#""reports": false, "languages": ["wgsl"],"#, material))
}

fn of(scene: &Scene) -> Baked {
    bake_scene(scene).expect("a bake")
}

fn manifest(baked: &Baked) -> Value {
    serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest")
}

/// Materials that call the same stand together, with what takes the value of a call, and of functions that
/// stand for one another the one to take.
#[test]
fn who_calls_what_is_a_row_for_all_that_call_the_same() {
    let metal = |name: &str| {
        format!(
            r#"{{"name": "{name}", "kind": "metal", "f0": 0.9, "roughness": 0.5, "wants": {{"fit": {{"max_ops": 8}}}}}}"#
        )
    };
    let satin = |name: &str| format!(r#"{{"name": "{name}", {SATIN}}}"#);
    let materials = [metal("steel"), satin("silk"), metal("gold"), satin("velvet")].join(",");
    let json = format!(
        r#"{{"schema_version": 1, "pick": "frontier", "reports": false, "languages": ["wgsl"], "materials": [{materials}]}}"#
    );
    let baked = of(&Scene::from_json(json.as_bytes(), "test.json").expect("a scene"));
    let found = callers(&baked.calls);
    let names: Vec<&[&str]> = found.iter().map(|row| &row.names[..]).collect();
    assert_eq!(names, [["steel", "gold"], ["silk", "velvet"]]);
    let [metals, satins] = &found[..] else { panic!("{found:?}") };
    let several = baked.calls.iter().filter(|call| call.of == "steel").count();
    assert!(several > 1 && metals.calls.len() == 1, "{several} {metals:?}");
    let [first, others] = [metals.calls[0].split(" (or ").next(), metals.calls[0].split(" (or ").nth(1)];
    let preferred = baked.calls.iter().find(|call| call.of == "steel" && call.recommended);
    assert_eq!(first, preferred.map(|call| call.function.as_str()), "{metals:?}");
    assert_eq!(Some(&metals.cost), preferred.map(|call| &call.cost), "{metals:?}");
    assert_eq!(others.map(|list| list.split(", ").count()), Some(several - 1), "{metals:?}");
    assert!(
        satins.calls.len() == 1 && satins.calls[0].ends_with(" of the sheen then sheen_base_scale as e_v"),
        "{satins:?}"
    );
    let sheen = baked.calls.iter().find(|call| call.of == "silk" && call.then.is_some()).expect("a sheen");
    assert_eq!(sheen.around[0].arguments, ["sheen_color", "e_v", "e_l"], "{sheen:?}");
}

/// What the lobe of a dielectric is multiplied with follows its base; of an albedo in a table as of a fit.
#[test]
fn the_lobe_above_a_base_is_what_the_base_is_made_for() {
    let wants = r#""roughness": 0.5, "wants": {"fit": {"max_ops": 8}, "tables": [{"size": [8, 8]}, {"size": [8, 8], "serves": "split-sum"}]}"#;
    let dielectric = |specular: &str| {
        let base = format!(r#""base": {{"albedo": 0.5, "specular": "{specular}"}}"#);
        format!(r#"{{"name": "{specular}", "kind": "dielectric", "f0": 0.04, {base}, {wants}}}"#)
    };
    let metal = format!(r#"{{"name": "metal", "kind": "metal", "f0": 0.9, {wants}}}"#);
    let others = ["normalised", "compensated", "single"].map(dielectric).join(",");
    let brushed = r#"{"name": "brushed", "kind": "metal", "f0": 0.9, "anisotropy": 0.5, "roughness": 0.5, "wants": {"fit": {}}}"#;
    let json = format!(
        r#"{{"schema_version": 1, "reports": false, "languages": ["wgsl"], "materials": [{metal}, {others}, {brushed}]}}"#
    );
    let scene = Scene::from_json(json.as_bytes(), "test.json").expect("a scene");
    let selection = Selection { only: vec!["reflection".into()], ..shared() };
    let baked = bake(&scene, &plan(&scene), &[], selection, &Silent).expect("a bake");
    let found = callers(&baked.calls);
    let coloured = "ggx_energy_compensation_rgb then f*N (or ggx_albedo then ggx_compensate_reflection as e)";
    let expected: [(&[&str], &str); 4] = [
        (&["metal", "compensated"], coloured),
        (&["normalised"], "ggx_energy_compensation then f*N (or ggx_albedo then f/E)"),
        (&["single"], "ggx_albedo"),
        (&["brushed"], "ggx_energy_compensation_rgb then f*N, anisotropy left out"),
    ];
    // The metal's two tables are two files, and its compensation one of the two that may be taken.
    let metal: Vec<&Call> =
        baked.calls.iter().filter(|call| call.of == "metal" && call.recommended).collect();
    let bytes = metal.iter().map(|call| call.cost.bytes).sum::<u64>();
    assert!(metal.len() == 2 && found[0].cost.bytes == bytes, "{metal:?}");
    let found: Vec<(&[&str], &str)> = found.iter().map(|row| (&row.names[..], &row.calls[0][..])).collect();
    assert_eq!(found, expected);
    let mut tables = baked.calls.iter().filter(|call| call.function == "ggx_dfg");
    let is_split = |call: &Call| call.recommended && call.then.as_deref() == Some("f0*A + B");
    assert!(tables.all(is_split), "one compensation of a lobe: {:?}", baked.calls);
}

/// A smooth specular lobe, so that the sheen is all there is.
const SATIN: &str =
    r#""kind": "dielectric", "ior": 1.5, "roughness": 0, "sheen": {"roughness": [0.3, 1], "norms": ["max"]}"#;

/// Its bake, for the tests that look at it.
static SATIN_BAKED: LazyLock<Baked> = LazyLock::new(|| baked(SATIN));

#[test]
fn a_sheen_is_fitted_certified_and_emitted_in_every_language() {
    let baked = &*SATIN_BAKED;
    let manifest = manifest(baked);
    let fits = manifest["fits"].as_array().expect("a list");
    assert!(fits.len() >= 3 && fits.iter().all(|f| f["effect"] == "sheen"), "{fits:?}");
    for fit in fits {
        let words = ["quantity", "column", "use", "source"].map(|key| fit[key].as_str().expect("a word"));
        assert_eq!(words, ["sheen-charlie", "E", "value", "fitted"]);
        let domain = &fit["certificate"]["domain"];
        assert_eq!((&domain["roughness"], &domain["mu"]), (&json!([0.3, 1.0]), &json!([0.01, 1.0])));
    }
    let name = "fn charlie_e_16(";
    for include in manifest["includes"].as_array().expect("a list") {
        let text = &baked.files[include["file"].as_str().expect("a file")];
        assert!(String::from_utf8_lossy(text).contains(name.trim_start_matches("fn ")), "{include}");
    }
    let effect = &manifest["effects"][0];
    assert_eq!(effect["effect"], "sheen");
    assert!(
        effect["because"][0].as_str().expect("words").contains("m: dielectric with a sheen layer"),
        "{effect}"
    );
    assert!(
        baked.files.contains_key("reports/sheen.html")
            && !baked.files.contains_key("reports/reflection.html")
    );
    let page = String::from_utf8_lossy(&baked.files["reports/sheen.html"]).into_owned();
    assert!(page.contains("charlie_e_threejs") && page.contains("charlie_e_16"), "beside the published");
}

/// Holds every certificate beside the errors at points of a lattice from the least roughness.
fn hold(baked: &Baked, least: f32, n: u8, albedo: impl Fn(f64, f64) -> f64) {
    let at = |i: u8| f32::from(i) / f32::from(n);
    let places: Vec<[f32; 2]> = (0..=n)
        .flat_map(|i| (0..=n).map(move |j| [least + (1.0 - least) * at(i), 0.01 + 0.99 * at(j)]))
        .map(|place| place.map(|x| x.min(1.0)))
        .collect();
    let truth = |[r, mu]: &[f32; 2]| albedo(f64::from(r * r), f64::from(*mu));
    let truths: Vec<f64> = places.iter().map(truth).collect();
    for fit in &baked.fits {
        let column = |name: &String| {
            let of = |[r, mu]: &[f32; 2]| match name.as_str() {
                "roughness" => *r,
                "alpha" => r * r,
                _ => *mu,
            };
            places.iter().map(of).collect::<Vec<f32>>()
        };
        let inputs: Vec<Vec<f32>> = fit.hypothesis.inputs().iter().map(column).collect();
        let values = fit.hypothesis.tape().evaluate(&inputs, &fit.coefficients()).expect("finite");
        let errors = values.iter().zip(&truths).map(|(value, truth)| (f64::from(*value) - truth).abs());
        let (worst, stated) = (errors.fold(0.0, f64::max), fit.approximation.certificate.max_abs);
        let name = &fit.approximation.name;
        assert!(worst <= stated * 1.0001 && worst > 0.5 * stated, "{name}: {worst} of {stated}");
    }
}

/// The certificate bounds the error at points of a lattice, and a published formula has its own.
#[test]
fn certificates_of_the_sheen_hold() {
    let baked = &*SATIN_BAKED;
    hold(baked, 0.3, 60, albedo);
    let sheens = baked.fits.iter().filter(|fit| fit.approximation.quantity == "sheen-charlie");
    assert_promised("tests/bake/sheen.rs::certificates_of_the_sheen_hold", sheens);
    let of = |name: &str| {
        let fit = baked.fits.iter().find(|f| f.approximation.name == name).expect("the fit");
        fit.approximation.certificate.max_abs
    };
    assert!(4.0 * of("charlie_e_16") < of("charlie_e_threejs"));
}

fn left_out(plan: &Plan) -> &str {
    let sheen = plan.left_out.iter().find(|l| l.effect == "sheen").expect("left out");
    &sheen.reason
}

#[test]
fn without_a_sheen_there_is_nothing_of_it() {
    let without = plan(&scene(r#""kind": "metal", "f0": 1, "roughness": 0.5"#));
    assert!(without.jobs("sheen").is_empty());
    assert_eq!(left_out(&without), "no material has a sheen layer");
    let smooth = plan(&scene(r#""kind": "metal", "f0": 1, "roughness": 0.5, "sheen": {"roughness": 0.005}"#));
    assert!(smooth.jobs("sheen").is_empty());
    assert_eq!(
        left_out(&smooth),
        "no sheen is rough: the sheen of `m` stays below alpha 0.0001, which is smooth"
    );
    // Default scenes have the hash that they had before there were sheens.
    let plain = scene(r#""kind": "metal", "f0": 1, "roughness": 0.5"#);
    let normal = serde_json::to_string(&plain).expect("JSON");
    assert!(!normal.contains("sheen") && !normal.contains("blend"), "{normal}");
}

#[test]
fn a_sheen_that_makes_no_sense_is_refused_with_its_field() {
    for (sheen, expected) in [
        (r#"{}"#, "missing field `roughness`"),
        (r#"{"roughness": 1.5}"#, "sheen.roughness"),
        (r#"{"roughness": [0.1, 1], "norms": []}"#, "norms: the list is empty"),
        (r#"{"roughness": 1, "alpha": 1}"#, "alpha"),
        (r#"{"roughness": 1, "tables": [{"serves": "split-sum"}]}"#, "sheen.tables[0].serves"),
        (r#"{"roughness": 1, "tables": [{"layout": "azimuth"}]}"#, "sheen.tables[0].layout"),
        (
            r#"{"roughness": 1, "tables": [{"size": [8, 8]}, {"size": [8, 8]}]}"#,
            "sheen.tables[1]: it has the layout, size, format and use of tables[0]",
        ),
        (r#"0.5"#, "an object that describes a sheen layer"),
        (
            r#"{"roughness": 1, "tables": [{}, {"layout": "area-lights"}]}"#,
            "sheen.tables[1].layout: this version fits transformed cosines to sheens of `neubelt`",
        ),
    ] {
        let json = format!(
            r#"{{"schema_version": 1, "sheen_visibility": "estevez-kulla", "materials": [{{"name": "m", "kind": "metal", "f0": 1, "roughness": 1, "sheen": {sheen}}}]}}"#
        );
        let error = Scene::from_json(json.as_bytes(), "s.json").expect_err("refused").to_string();
        assert!(error.contains(expected) && error.contains("materials[0]"), "{sheen}: {error}");
    }
}

#[test]
fn a_promise_on_the_sheen_is_kept_or_told() {
    let with = |limit: &str| format!("{}, \"max_error\": {limit}}}", &SATIN[..SATIN.len() - 1]);
    let kept = plain(&with("0.05"));
    assert!(kept.broken.is_empty(), "{:?}", kept.broken);
    let broken = plain(&with("1e-6")).broken;
    assert!(
        broken.len() == 1
            && broken[0].starts_with("sheen: the best is ")
            && broken[0].contains("materials[0].sheen.max_error"),
        "{broken:?}"
    );
}

/// The bilinear lookup of a plain table, by hand.
fn fetched(held: &BakedTable, [columns, rows]: [usize; 2], [u, v]: [f64; 2]) -> f64 {
    let texels = &held.table().expect("a table").channels[0].texels;
    let at = |u: f64, n: usize| {
        let x = (u * n as f64 - 0.5).clamp(0.0, (n - 1) as f64);
        (x.floor() as usize, (x.floor() as usize + 1).min(n - 1), x.fract())
    };
    let ((x0, x1, s), (y0, y1, t)) = (at(u, columns), at(v, rows));
    let row = |y: usize| (1.0 - s) * texels[y * columns + x0] + s * texels[y * columns + x1];
    (1.0 - t) * row(y0) + t * row(y1)
}

/// A renderer that shadows the lobe as its authors do gets fits and tables of that, under names of their own.
#[test]
fn the_visibility_is_the_renderer_s() {
    let text = include_str!("../../examples/satin.json");
    let of = |text: &str| self::of(&Scene::from_json(text.as_bytes(), "satin.json").expect("a scene"));
    let baked = of(text);
    let truth =
        |alpha: f64, mu: f64| EstevezKulla.at(&Variant::default(), &[alpha, mu], 1e-5).expect("a truth")[0];
    let known: Vec<[String; 2]> = baked
        .fits
        .iter()
        .map(|fit| [&fit.approximation.quantity, &fit.approximation.name].map(Clone::clone))
        .collect();
    assert!(
        known.len() == 6
            && known
                .iter()
                .all(|[quantity, name]| quantity == "sheen-estevez-kulla"
                    && name.starts_with("estevez_kulla_e_")),
        "{known:?}"
    );
    hold(&baked, 0.1, 40, truth);
    let test = "tests/bake/sheen.rs::the_visibility_is_the_renderer_s";
    assert_promised(test, baked.fits.iter());
    let [held] = &baked.tables[..] else { panic!("one table") };
    let mut worst = 0.0_f64;
    for i in 0..=45 {
        for j in 0..=38 {
            let (r, mu) = (0.1 + 0.02 * f64::from(i), 0.05 + 0.025 * f64::from(j));
            worst = worst.max((fetched(held, [64, 64], [mu, r]) - truth(r * r, mu)).abs());
        }
    }
    let stated = held.errors.lookup.max;
    assert!(worst <= stated * 1.0001 && worst > 0.3 * stated, "{worst} of {stated}");
    assert_eq!(manifest(&baked)["tables"][0]["quantity"], "sheen-estevez-kulla");
    let code = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
    assert!(code.contains("Charlie sheen lobe, the shadowing of Estevez and Kulla"), "{code}");
    // The table of the other one is of the same name and size: what is kept of it is not taken for this.
    let other = of(&text.replace(r#""sheen_visibility": "estevez-kulla","#, ""));
    let [first, second] =
        [&baked, &other].map(|baked| &baked.tables[0].table().expect("a table").channels[0].texels);
    assert!(first.iter().zip(second).any(|(a, b)| (a - b).abs() > 0.1));
    // Scenes that do not say it have the hash that they had.
    assert!(!serde_json::to_string(&scene(SATIN)).expect("JSON").contains("visibility"));
    let page = include_str!("../../docs/scene.md");
    for fit in baked.fits.iter().map(|fit| &fit.approximation) {
        let certificate = &fit.certificate;
        let [max, rms] =
            [certificate.max_abs, certificate.rms].map(|error| lobefit_shade::round_up(error, 4));
        let row = format!("| `{}` | {} | {max} | {rms} |", fit.name, fit.cost.ops);
        println!("{row}");
        assert!(page.contains(&row), "docs/scene.md has no row {row}");
    }
}

/// A plain table is what engines read today: texel centres, E itself. Its certificate bounds the
/// lookup, read here by hand, and a limit that it does not keep names its field.
#[test]
fn a_table_of_the_sheen_drops_in_with_its_certificate() {
    let with = |sheen: &str| {
        format!(
            r#""kind": "dielectric", "ior": 1.5, "roughness": 0, "sheen": {{"roughness": [0.2, 1], {sheen}}}"#
        )
    };
    let table = r#"{"layout": "plain", "size": [16, 12], "format": "f32", "n_dot_v": [0.1, 1]"#;
    let baked = plain(&with(&format!(r#""max_ops": 9, "tables": [{table}}}]"#)));
    let [held] = &baked.tables[..] else { panic!("one table") };
    let fetch = |roughness: f64, mu: f64| fetched(held, [16, 12], [mu, roughness]);
    let mut worst = 0.0_f64;
    for i in 0..=80 {
        for j in 0..=90 {
            let (r, mu) = (0.2 + 0.01 * f64::from(i), 0.1 + 0.01 * f64::from(j));
            worst = worst.max((fetch(r, mu) - albedo(r * r, mu)).abs());
        }
    }
    let stated = held.errors.lookup.max;
    assert!(worst <= stated * 1.0001 && worst > 0.5 * stated, "{worst} of {stated}");
    let manifest = manifest(&baked);
    assert_eq!(manifest["tables"][0]["quantity"], "sheen-charlie");
    let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
    assert!(text.contains("fn sheen_lookup(") && text.contains("fn sheen_base_scale("), "{text}");
    // Its axes run over [0, 1], as engines read them: where it counts is said.
    let counts = "Use it for n_dot_v in [0.1, 1], roughness in [0.2, 1]";
    assert!(text.contains(counts), "{text}");
    // Half as many texels a side more keep this limit: no more is measured to say what does.
    let broken = plain(&with(&format!(r#""tables": [{table}, "max_error": {}}}]"#, 0.9 * stated))).broken;
    assert!(
        broken.len() == 1 && broken[0].contains("m (materials[0].sheen.tables[0].max_error)"),
        "{broken:?}"
    );
}

const BLEND: &str = r#""kind": "metal", "f0": 1, "roughness": [0.02, 1], "wants": {"fit": {"norms": ["max"], "blend": true}}"#;

#[test]
fn blends_are_fitted_for_every_f0() {
    let baked = plain(BLEND);
    let blends: Vec<&Fit> =
        baked.fits.iter().filter(|f| f.approximation.used_as == Use::F0_BLEND && f.emitted).collect();
    assert!(blends.len() >= 3, "{}", blends.len());
    for fit in &blends {
        let coefficients = fit.coefficients();
        for (alpha, mu, f0) in
            [(0.0625_f32, 0.1_f32, 0.04_f32), (0.25, 0.5, 0.3), (1.0, 0.9, 1.0), (0.49, 0.02, 0.0)]
        {
            let of = |name: &String| match name.as_str() {
                "roughness" => vec![alpha.sqrt()],
                "alpha" => vec![alpha],
                "mu" => vec![mu],
                _ => vec![f0],
            };
            let inputs: Vec<Vec<f32>> = fit.hypothesis.inputs().iter().map(of).collect();
            let value = f64::from(fit.hypothesis.tape().evaluate(&inputs, &coefficients).expect("finite")[0]);
            let truth =
                reflection(Smith::Correlated, f64::from(alpha), f64::from(mu), TOLERANCE).expect("a truth");
            let error = (value - (f64::from(f0) * truth.a + truth.b)).abs();
            let stated = fit.approximation.certificate.max_abs;
            assert!(
                error <= stated * 1.0001,
                "{} at {alpha} {mu} {f0}: {error} of {stated}",
                fit.approximation.name
            );
        }
    }
    let blended = |fit: &&Fit| fit.approximation.used_as == Use::F0_BLEND;
    assert_promised("tests/bake/sheen.rs::blends_are_fitted_for_every_f0", baked.fits.iter().filter(blended));
    let best = blends.iter().map(|f| f.approximation.certificate.max_abs).fold(f64::INFINITY, f64::min);
    let published = baked.fits.iter().filter(|f| f.approximation.used_as == Use::F0_BLEND && !f.emitted);
    let best_published = published.map(|f| f.approximation.certificate.max_abs).fold(f64::INFINITY, f64::min);
    assert!(best < 0.02 && 2.0 * best < best_published, "{best} of ours, {best_published} of others");
    let manifest = manifest(&baked);
    let entry = manifest["fits"].as_array().expect("a list").iter().find(|f| f["name"] == "ggx_blend_30");
    let entry = entry.expect("the entry");
    assert_eq!(entry["use"], "f0-blend");
    assert_eq!(entry["inputs"], json!(["roughness", "alpha", "mu", "f0"]));
    assert_eq!(entry["certificate"]["domain"]["f0"], json!([0.0, 1.0]));
    let text = String::from_utf8_lossy(&baked.files["fits/lobefit.wgsl"]).into_owned();
    assert!(text.contains("of f0 A + B, at the worst f0"), "the header says what error it is");
    let parsed =
        Hypothesis::parse(blends[0].hypothesis.file(), blends[0].hypothesis.source()).expect("parses");
    assert_eq!(parsed.inputs().last().map(String::as_str), Some("f0"));
}

/// One job for all sheens: the hull of their ranges, every norm, the largest number of operations,
/// each promise by itself.
#[test]
fn sheens_are_planned_together() {
    let scene = Scene::from_json(include_bytes!("../../examples/cloth.json"), "cloth.json").expect("a scene");
    let plan = plan(&scene);
    let [job] = plan.jobs("sheen") else { panic!("{plan:?}") };
    assert_eq!((job.ranges["roughness"], job.ranges["mu"]), ([0.1, 1.0], [0.01, 1.0]));
    assert_eq!((job.goals.max_ops, job.goals.norms.len()), (None, 1));
    assert_eq!((job.promises.len(), job.promises[0].max_error), (1, 0.06));
    let effect = plan.effects.iter().find(|e| e.effect == "sheen").expect("the effect");
    assert_eq!(effect.because.len(), 2);
    assert_eq!(effect.expected_error, Some(0.06));
    let fit = plan.jobs("reflection").last().expect("fits");
    assert!(FitJob::of(&scene, fit).blend);
}
