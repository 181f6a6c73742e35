//! The furnace of whole dielectrics: specular lobe and diffuse base, put together by the emitted
//! code, send back no more light than the certificates allow, and no less.
//!
//! Factors, multipliers of the lobe and the functions that add the base to it are emitted Rust,
//! compiled by rustc and run as a program of its own: that of the committed `fits/lobefit.rs`, and
//! that of a bake with a base under every kind of lobe. The lobe is that of the textbooks,
//! integrated by rules of the tests' own (`furnace_support::half`, `furnace_support::textbook`):
//! nothing of the program's integrators has a part in the energy. Views span the whole domain of
//! the scene, from its smoothest lobe to its roughest, from grazing to facing.
//!
//! A lobe multiplied by N instead of 1/E is off by its albedo times the furnace error of N, and the
//! base by the error of its factor: together no more than the sum of both certificates, to which
//! the error of the test's own rule is added.

use crate::emit_support;
use crate::furnace_support::textbook;
#[path = "../furnace_support/half.rs"]
mod half;

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use crate::baked_support::bake_scene;
use emit_support::{programs, say};
use half::Albedo;
use lobefit::approximate::Fit;
use lobefit::bake::Baked;
use lobefit::data::{Smith, Use};
use lobefit::scene::Scene;
use lobefit_truth::quantity::{COUPLING, Specular};
use serde_json::Value;
use textbook::{Facets, Hemisphere, Vector, direction, schlick};

/// Under every kind of lobe a base, with fits of factors and of normalisations, over the whole
/// range of roughness.
const SCENE: &str = r#"{"schema_version": 1, "name": "test", "pick": "all", "materials": [
    {"name": "single", "kind": "dielectric", "f0": [0.02, 0.05, 0.08], "roughness": [0.01, 1], "base": {"specular": "single", "norms": ["max"]},
     "wants": {"fit": {"max_ops": 10, "norms": ["max"]}}},
    {"name": "normalised", "kind": "dielectric", "f0": 0.04, "roughness": [0.01, 1], "base": {"max_ops": 19},
     "wants": {"fit": {"max_ops": 10, "norms": ["max"]}}},
    {"name": "compensated", "kind": "dielectric", "f0": [0.02, 0.05, 0.08], "roughness": [0.01, 1],
     "base": {"specular": "compensated", "norms": ["max"]},
     "wants": {"fit": {"max_ops": 12, "norms": ["max"]}}}]}"#;

/// Its bake, once for all tests of bases.
pub static BAKED: LazyLock<Baked> = LazyLock::new(|| {
    let scene = Scene::from_json(SCENE.as_bytes(), "furnace.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
});

/// Emitted Rust with the manifest that tells what is in it.
struct Emitted {
    include: String,
    fits: Vec<Value>,
}

impl Emitted {
    fn new(include: &[u8], manifest: &[u8]) -> Emitted {
        let manifest: Value = serde_json::from_slice(manifest).expect("a manifest");
        let fits = manifest["fits"].as_array().expect("a list").clone();
        Emitted { include: String::from_utf8(include.to_vec()).expect("text"), fits }
    }

    fn baked() -> Emitted {
        Emitted::new(&BAKED.files["fits/lobefit.rs"], &BAKED.files["manifest.json"])
    }

    fn committed() -> Emitted {
        let read = |name: &str| {
            fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("a committed file")
        };
        Emitted::new(&read("fits/lobefit.rs"), &read("manifest.json"))
    }

    fn of_use(&self, used_as: &str) -> Vec<&Value> {
        let wanted = |f: &&Value| f["use"] == used_as && f["column"] != "E_avg" && f["smith"] == "correlated";
        self.fits.iter().filter(wanted).collect()
    }
}

fn word<'a>(fit: &'a Value, key: &str) -> &'a str {
    fit[key].as_str().unwrap_or_else(|| panic!("{key} of {fit}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn range(fit: &Value, input: &str) -> [f64; 2] {
    let range = &fit["certificate"]["domain"][input];
    [number(&range[0]), number(&range[1])]
}

fn arguments(fit: &Value) -> Vec<&str> {
    fit["inputs"].as_array().expect("a list").iter().map(|i| i.as_str().expect("a name")).collect()
}

fn call(fit: &Value) -> String {
    format!("lobefit::{}({})", word(fit, "function"), arguments(fit).join(", "))
}

/// Bound on the error of the rule and of f32.
const RULE: f64 = 2e-5;

/// A view of a dielectric.
#[derive(Clone, Copy, Debug)]
struct View {
    roughness: f32,
    mu: f32,
    f0: f32,
}

impl View {
    fn facets(&self) -> (Facets, Vector) {
        let alpha = f64::from(self.roughness * self.roughness);
        (Facets { smith: Smith::Correlated, alpha: [alpha; 2] }, direction(f64::from(self.mu), 0.0))
    }

    /// The bare lobe with its Fresnel factor, times the light's cosine.
    fn lobe(&self, l: Vector) -> f64 {
        let (facets, v) = self.facets();
        let (whole, cosine) = facets.reflected(v, l);
        let f0 = f64::from(self.f0);
        whole * (f0 + (1.0 - f0) * schlick(cosine))
    }

    fn numbers(&self) -> [f32; 4] {
        [self.roughness, self.roughness * self.roughness, self.mu, self.f0]
    }
}

/// Places of a range, of a share of it each, ends included.
fn places<const N: usize>([low, high]: [f64; 2], shares: [f64; N]) -> [f32; N] {
    shares.map(|share| ((low + (high - low) * share) as f32).clamp(low as f32, high as f32))
}

/// Shares of the ranges of roughness and of mu, denser where lobes are smooth and views grazing.
const SMOOTH: [f64; 12] = [0.0, 0.01, 0.02, 0.05, 0.1, 0.16, 0.25, 0.37, 0.5, 0.66, 0.83, 1.0];
const GRAZING: [f64; 11] = [0.0, 0.004, 0.015, 0.04, 0.09, 0.17, 0.28, 0.42, 0.6, 0.8, 1.0];

/// Views over the whole domain of the factors, with the albedos of their lobes.
fn views(factors: &[&Value]) -> Vec<(View, Albedo)> {
    let hull = |input: &str| {
        let ranges = factors.iter().map(|f| range(f, input));
        ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).expect("factors")
    };
    let mut views = Vec::new();
    for roughness in places(hull("roughness"), SMOOTH) {
        for mu in places(hull("mu"), GRAZING) {
            let albedo =
                half::albedo(Smith::Correlated, f64::from(roughness * roughness), f64::from(mu), RULE / 2.0);
            let f0 = places(hull("f0"), [0.0, 0.5, 1.0]);
            views.extend(f0.map(|f0| (View { roughness, mu, f0 }, albedo)));
        }
    }
    views
}

/// Albedo of the bare lobe.
fn bare(view: &View, albedo: &Albedo) -> f64 {
    f64::from(view.f0) * (albedo.e - albedo.b) + albedo.b
}

/// Where a factor stands in for the truth.
fn holds(fit: &Value, view: &View) -> bool {
    let inputs = [("roughness", view.roughness), ("mu", view.mu), ("f0", view.f0)];
    inputs.iter().all(|(name, x)| {
        let [low, high] = range(fit, name).map(|end| end as f32);
        (low..=high).contains(x)
    })
}

/// A factor under a lobe with this multiplier: names, expressions of the program, sum of the
/// certificates.
struct Combination<'a> {
    name: String,
    fit: &'a Value,
    factor: String,
    multiplier: String,
    certificate: f64,
}

fn certificate(fit: &Value) -> f64 {
    number(&fit["certificate"]["max_abs"])
}

fn combinations(emitted: &Emitted) -> Vec<Combination<'_>> {
    let mut all = Vec::new();
    for fit in emitted.of_use("coupling") {
        let with = |by: &str, multiplier: String, more: f64| Combination {
            name: format!("{} under {by}", word(fit, "name")),
            fit,
            factor: call(fit),
            multiplier,
            certificate: certificate(fit) + more,
        };
        if fit["specular"] == "single" {
            all.push(with("a bare lobe", "1.0".into(), 0.0));
            continue;
        }
        for n in emitted.of_use("normalisation") {
            let multiplier = match word(fit, "specular") {
                "compensated" => format!("1.0 + f0 * ({} - 1.0)", call(n)),
                _ => call(n),
            };
            all.push(with(word(n, "name"), multiplier, certificate(n)));
        }
    }
    all
}

/// Factor and multiplier of every combination at every view, by the emitted code.
fn evaluated(include: &str, combinations: &[Combination], views: &[(View, Albedo)]) -> Vec<f32> {
    let puts: String = combinations
        .iter()
        .map(|c| format!("        out.push({});\n        out.push({});\n", c.factor, c.multiplier))
        .collect();
    let body = format!(
        "    for p in &points {{\n        let [roughness, alpha, mu, f0] = *p;\n        let _ = (roughness, alpha, mu, f0);\n{puts}    }}\n"
    );
    let points: Vec<u8> =
        views.iter().flat_map(|(view, _)| view.numbers()).flat_map(f32::to_le_bytes).collect();
    programs::run(include, 4, &body, &points)
}

/// What a furnace found: the largest excess over what the certificates allow, of all combinations
/// and views, with its name; the largest departure from white; and the least light of a base.
struct Furnace {
    excess: f64,
    at: String,
    off: f64,
    least: f64,
    combinations: usize,
}

fn furnace(emitted: &Emitted, include: &str) -> Furnace {
    let (combinations, views) = (combinations(emitted), views(&emitted.of_use("coupling")));
    let values = evaluated(include, &combinations, &views);
    assert_eq!(values.len(), 2 * views.len() * combinations.len());
    let mut found = Furnace {
        excess: f64::NEG_INFINITY,
        at: String::new(),
        off: 0.0,
        least: f64::INFINITY,
        combinations: combinations.len(),
    };
    for ((view, albedo), values) in views.iter().zip(values.chunks_exact(2 * combinations.len())) {
        let lobe = bare(view, albedo);
        for (c, pair) in combinations.iter().zip(values.chunks_exact(2)) {
            if !holds(c.fit, view) {
                continue;
            }
            let [factor, multiplier] = [pair[0], pair[1]].map(f64::from);
            let departure = (lobe * multiplier + factor - 1.0).abs();
            let over = departure - c.certificate - RULE;
            // A value that is not a number is the worst, and stays so.
            if over.is_nan() || over > found.excess {
                (found.excess, found.at) =
                    (over, format!("{} at {view:?}: off {departure}, allowed {}", c.name, c.certificate));
            }
            found.off = found.off.max(departure);
            found.least = if factor.is_nan() { factor } else { found.least.min(factor) };
        }
    }
    found
}

/// The two rules of the tests agree, and with what is known: E = 1 - ln 2 of the roughest lobe seen
/// face on.
#[test]
fn the_tests_rules_agree() {
    let exact = half::albedo(Smith::Correlated, 1.0, 1.0, 1e-9);
    assert!((exact.e - (1.0 - std::f64::consts::LN_2)).abs() < 1e-12, "{exact:?}");
    for (roughness, mu) in [(0.6_f32, 0.3_f32), (0.8, 0.9), (1.0, 0.1)] {
        for smith in [Smith::Correlated, Smith::Separable] {
            let (facets, v) = (View { roughness, mu, f0: 1.0 }).facets();
            let facets = Facets { smith, ..facets };
            let half = half::albedo(smith, facets.alpha[0], f64::from(mu), RULE / 2.0);
            let [e, b] = Hemisphere::new(96, 384).integrate([0.0, 1.0], |l| {
                let (whole, cosine) = facets.reflected(v, l);
                [whole, whole * schlick(cosine)]
            });
            assert!((half.e - e).abs() < RULE && (half.b - b).abs() < RULE, "{half:?} {e} {b}");
        }
    }
}

/// All factors that a bake emits under all lobes that it emits.
#[test]
fn no_emitted_combination_gains_or_loses_more_than_its_certificates() {
    let emitted = Emitted::baked();
    for s in Specular::ALL {
        let of = emitted.of_use("coupling").into_iter().filter(|f| f["specular"] == s.name()).count();
        assert!(of >= 4, "{}: {of} factors", s.name());
    }
    let found = furnace(&emitted, &emitted.include);
    assert!(found.excess <= 0.0, "{}", found.at);
    assert!(found.least >= 0.0, "a base of {}", found.least);
    say(&format!(
        "{} combinations: at most {:.3} off white, every one within its certificates",
        found.combinations, found.off
    ));
}

/// The same of the files that are committed; and the judgement finds code that gives the base a
/// tenth too much.
#[test]
fn the_committed_combinations_keep_their_certificates() {
    let emitted = Emitted::committed();
    let found = furnace(&emitted, &emitted.include);
    assert!(found.excess <= 0.0, "{}", found.at);
    assert!(found.combinations >= 1 && found.least >= 0.0, "{} {}", found.combinations, found.least);
    let spoilt = emitted.include.replace("divisor) * (1.0 - f0)", "divisor) * (1.1 - 1.1 * f0)");
    assert_ne!(emitted.include, spoilt);
    let found = furnace(&emitted, &spoilt);
    assert!(found.excess > 0.01, "{}", found.at);
}

/// Whatever a shader hands them, factors are neither below 0 nor above 1.06 and their errors: where
/// that is promised, which is beyond the domain.
#[test]
fn no_factor_is_negative_where_that_is_promised() {
    for emitted in [Emitted::baked(), Emitted::committed()] {
        let fits = emitted.of_use("coupling");
        let span = |fit: &Value, input: &str| [0, 1].map(|i| number(&fit["safe"][input][i]));
        let inside = |fit: &Value, view: &View| {
            let inputs = [("roughness", view.roughness), ("mu", view.mu), ("f0", view.f0)];
            inputs.iter().all(|(name, x)| {
                let [low, high] = span(fit, name).map(|end| end as f32);
                (low..=high).contains(x)
            })
        };
        let mut views = Vec::new();
        for lowest in [0.0, 0.01, 0.02] {
            for roughness in places([lowest, 1.0], SMOOTH) {
                for mu in places([0.0, 1.0], GRAZING) {
                    views.extend([0.0, 0.04, 0.5, 0.9, 1.0].map(|f0| View { roughness, mu, f0 }));
                }
            }
        }
        let puts: String = fits.iter().map(|fit| format!("        out.push({});\n", call(fit))).collect();
        let body = format!(
            "    for p in &points {{\n        let [roughness, alpha, mu, f0] = *p;\n        let _ = (roughness, alpha, mu, f0);\n{puts}    }}\n"
        );
        let points: Vec<u8> = views.iter().flat_map(View::numbers).flat_map(f32::to_le_bytes).collect();
        let values = programs::run(&emitted.include, 4, &body, &points);
        for (view, values) in views.iter().zip(values.chunks_exact(fits.len())) {
            for (fit, value) in fits.iter().zip(values).filter(|(fit, _)| inside(fit, view)) {
                let above = 1.06 + number(&fit["certificate"]["max_abs"]) as f32;
                assert!((0.0..=above).contains(value), "{}: {value} at {view:?}", word(fit, "name"));
            }
        }
        for fit in fits {
            let promised =
                [span(fit, "mu") == [0.0, 1.0], span(fit, "f0")[1] >= 0.9, span(fit, "roughness")[0] <= 0.02];
            assert!(promised == [true; 3], "{fit}");
        }
    }
}

fn of_use(used_as: Use) -> Vec<&'static Fit> {
    BAKED
        .fits
        .iter()
        .filter(|f| f.emitted && f.approximation.used_as == used_as && f.approximation.column != "E_avg")
        .collect()
}

fn emitted() -> String {
    String::from_utf8(BAKED.files["fits/lobefit.rs"].clone()).expect("text")
}

/// The function that adds the base to the lobe, light by light over the hemisphere, with albedos
/// below white beside it.
#[test]
fn the_emitted_material_integrates_to_white() {
    let rule = Hemisphere::new(48, 192);
    let mut lights: Vec<Vector> = Vec::new();
    let collected = std::cell::RefCell::new(&mut lights);
    rule.integrate([0.0, 1.0], |l| {
        collected.borrow_mut().push(l);
        [0.0]
    });
    let albedo = [1.0_f32, 0.5, 0.0];
    let view = View { roughness: 0.74, mu: 0.6, f0: 0.04 };
    // The lobe as a BRDF, without the cosine of the light, and multiplied exactly.
    let (facets, v) = view.facets();
    let whole = rule.integrate([0.0, 1.0], |l| [facets.reflected(v, l).0])[0];
    let multipliers = Specular::ALL.map(|specular| match specular {
        Specular::Single => 1.0,
        Specular::Normalised => 1.0 / whole,
        Specular::Compensated => 1.0 + f64::from(view.f0) * (1.0 / whole - 1.0),
    });
    let best = Specular::ALL.map(best);
    let calls: String = Specular::ALL
        .iter()
        .zip(&best)
        .zip(["single", "normalised", "compensated"])
        .map(|((specular, best), lobe)| {
            let inputs = best.hypothesis.inputs().join(", ");
            format!(
                "        out.extend(lobefit::diffuse_coupled_{}([{lobe}; 3], {albedo:?}, {inputs}));\n",
                specular.name()
            )
        })
        .collect();
    let body = format!(
        "    for p in &points {{\n        let [roughness, alpha, mu, f0, single, normalised, compensated] = *p;\n{calls}    }}\n"
    );
    let lobes = |l: &Vector| multipliers.map(|by| (by * view.lobe(*l) / l[2]) as f32);
    let points: Vec<u8> = lights
        .iter()
        .flat_map(|l| view.numbers().into_iter().chain(lobes(l)).collect::<Vec<f32>>())
        .flat_map(f32::to_le_bytes)
        .collect();
    let brdf = programs::run(&emitted(), 7, &body, &points);
    for (k, (specular, best)) in Specular::ALL.iter().zip(&best).enumerate() {
        let next = std::cell::Cell::new(3 * k);
        let [white, half, black] = rule.integrate([0.0, 1.0], |l| {
            let i = next.replace(next.get() + 9);
            [0, 1, 2].map(|channel| f64::from(brdf[i + channel]) * l[2])
        });
        let stated = best.approximation.certificate.max_abs + RULE;
        let place = format!("{}: {white} {half} {black}", specular.name());
        assert!((white - 1.0).abs() <= stated, "{place}, certificate {stated}");
        // Half the albedo, half the base's share and half its error.
        assert!(
            (half - black - 0.5 * (white - black)).abs() <= 1e-6 && white > half && half > black,
            "{place}"
        );
        assert!(half < 1.0 && black > 0.0, "{place}");
    }
}

/// The best factor under a lobe: the one that materials are emitted with.
fn best(specular: Specular) -> &'static Fit {
    let start = format!("coupling_{}_", specular.name());
    let of = of_use(COUPLING).into_iter().filter(|f| f.approximation.name.starts_with(&start));
    of.min_by(|a, b| a.approximation.certificate.max_abs.total_cmp(&b.approximation.certificate.max_abs))
        .expect("a factor")
}

/// The figure that a line of the emitted text states.
fn stated(text: &str, before: &str) -> f64 {
    let (_, after) = text.split_once(before).unwrap_or_else(|| panic!("`{before}` is not in the file"));
    after.split([' ', '\n']).next().and_then(|word| word.parse().ok()).expect("a figure")
}

/// The material for path tracers: f(l, v) = f(v, l) to rounding, and white light by light but for
/// the average's own error, which is told; a reflectance per channel is three of one channel each;
/// and where f0 is 1 nothing is left but what the bare lobe loses.
#[test]
fn the_reciprocal_material_is_reciprocal_and_white() {
    let (text, best) = (emitted(), best(Specular::Single));
    let inputs = best.hypothesis.inputs();
    let constants: Vec<&str> = inputs.iter().map(String::as_str).filter(|name| *name != "mu").collect();
    let (all, constants) = (inputs.join(", "), constants.join(", "));
    let swapped = all.replace("mu", "mu_l");
    let (rgb, rgb_constants) =
        (all.replace("f0", "[0.0, f0, 1.0]"), constants.replace("f0", "[0.0, f0, 1.0]"));
    let body = format!(
        "    for p in &points {{
        let [roughness, alpha, mu, f0, mu_l] = *p;
        let average = lobefit::diffuse_coupling_average_single({constants});
        let averages = lobefit::diffuse_coupling_average_single_rgb({rgb_constants});
        out.push(lobefit::{}({all}));
        out.push(lobefit::diffuse_coupled_reciprocal_single([0.0; 3], [1.0, 0.5, 0.0], average, mu_l, {all})[0]);
        out.push(lobefit::diffuse_coupled_reciprocal_single([0.0; 3], [1.0, 0.5, 0.0], average, mu, {swapped})[0]);
        out.extend(lobefit::diffuse_coupled_reciprocal_single_rgb([0.0; 3], [1.0; 3], averages, mu_l, {rgb}));
        out.extend(lobefit::diffuse_coupled_single_rgb([0.0; 3], [1.0; 3], {rgb}));
    }}
",
        best.hypothesis.name(),
    );
    const WIDTH: usize = 9;
    let rule = lobefit_math::gauss::Gauss::new(24);
    let lights: Vec<f32> = rule.nodes.iter().map(|x| (0.5 * (1.0 + x)) as f32).collect();
    let manifest = Emitted::baked();
    let views = views(&manifest.of_use("coupling"));
    let numbers =
        views.iter().flat_map(|(view, _)| lights.iter().flat_map(|l| view.numbers().into_iter().chain([*l])));
    let points: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
    let found = programs::run(&text, 5, &body, &points);
    let entry = manifest.fits.iter().find(|f| f["name"] == best.approximation.name.as_str());
    let any = number(&entry.expect("the entry")["any_f0"]["max_abs"]);
    let told = stated(&text, "what the view's factor alone would, within ");
    assert!(told < 0.01, "{told}");
    for ((view, albedo), of_view) in views.iter().zip(found.chunks_exact(WIDTH * lights.len())) {
        let mut base = 0.0;
        for ((l, w), values) in lights.iter().zip(&rule.weights).zip(of_view.chunks_exact(WIDTH)) {
            let values: Vec<f64> = values.iter().map(|x| f64::from(*x)).collect();
            let (there, back) = (values[1], values[2]);
            assert!(
                (there - back).abs() <= 4.0 * f64::from(f32::EPSILON) * there,
                "{view:?} {l}: {there} {back}"
            );
            assert!(values[4] == there && values.iter().all(|x| *x >= 0.0), "{view:?}: {values:?}");
            assert!((values[7] * std::f64::consts::PI - values[0]).abs() < 1e-6, "{view:?}: {values:?}");
            // f0 = 1: the loss of the bare lobe, as far as the fit knows it there.
            let loss = 1.0 - albedo.e;
            assert!((values[8] * std::f64::consts::PI - loss).abs() <= any + RULE, "{view:?}: {values:?}");
            // pi times the mean of 2 l, over half the range of the rule
            base += std::f64::consts::PI * w * f64::from(*l) * there;
        }
        let factor = f64::from(of_view[0]);
        assert!((base - factor).abs() <= told + RULE, "{view:?}: {base}, factor {factor}");
        let certificate = best.approximation.certificate.max_abs + told + RULE;
        assert!(
            (bare(view, albedo) + base - 1.0).abs() <= certificate,
            "{view:?}: {base}, certificate {certificate}"
        );
    }
}

/// A base whose factor follows from a table of E and B, under a lobe that is divided by the table's
/// E: what both are off is the table's error of f0 A + B over its E.
#[test]
fn a_table_of_e_and_b_makes_an_exact_factor() {
    const TABLE: &str = r#"{"schema_version": 1, "pick": "all", "materials": [
        {"name": "b", "kind": "dielectric", "f0": [0.02, 0.05, 0.08], "roughness": [0.01, 1],
         "base": {"max_ops": 24, "norms": ["max"]},
         "wants": {"tables":[{"size": [32, 32], "format": "f32", "serves": "split-sum"}]}}]}"#;
    let scene = Scene::from_json(TABLE.as_bytes(), "table.json").expect("a scene");
    let baked = bake_scene(&scene).expect("a bake");
    let [made] = &baked.tables[..] else { panic!("{} tables", baked.tables.len()) };
    let table = made.table().expect("a table");
    let pairs = table.channels[0].texels.iter().zip(&table.channels[1].texels);
    let texels: Vec<[f32; 2]> = pairs.map(|(a, b)| [*a as f32, *b as f32]).collect();
    let body = format!(
        "    let texels: &[[f32; 2]] = &{texels:?};
    for p in &points {{
        let [roughness, _, mu, f0] = *p;
        let [e, _, b] = lobefit::{}(texels, roughness, mu);
        out.extend([e, lobefit::diffuse_coupling_exact_normalised(f0, e, b)]);
    }}
",
        made.names.lookup
    );
    let manifest = Emitted::new(&baked.files["fits/lobefit.rs"], &baked.files["manifest.json"]);
    let views = views(&manifest.of_use("coupling"));
    let points: Vec<u8> =
        views.iter().flat_map(|(view, _)| view.numbers()).flat_map(f32::to_le_bytes).collect();
    let found = programs::run(&manifest.include, 4, &body, &points);
    let certificate = made.errors.lookup.max;
    assert!(certificate < 0.01, "{certificate}");
    let mut worst = 0.0_f64;
    for ((view, albedo), pair) in views.iter().zip(found.chunks_exact(2)) {
        let [e, factor] = [pair[0], pair[1]].map(f64::from);
        let off = (bare(view, albedo) / e + factor - 1.0).abs();
        assert!(off <= (certificate + RULE) / e, "{view:?}: off {off}, certificate {certificate}, e {e}");
        worst = worst.max(off);
    }
    say(&format!("a table of E and B: at most {worst:.1e} off white, {certificate:.1e} certified"));
}
