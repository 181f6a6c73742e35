//! The furnace of whole dielectrics: specular lobe and diffuse base, put together by the emitted code, send back no more light than
//! the certificates allow, and no less.
//!
//! Factors, multipliers of the lobe and the function that adds the base to it are the emitted Rust of a bake, compiled by rustc and run
//! as a program of its own. The lobe is that of the textbooks, integrated over all directions by a plain product rule
//! (`furnace_support::textbook`): nothing of the program's own integrators has a part in the energy.
//!
//! A lobe multiplied by N instead of 1/E is off by its albedo times the furnace error of N, and the base by the error of its factor: together no more
//! than the sum of both certificates, to which the error of the test's own rule is added.

#![allow(dead_code, reason = "the shared textbook has lobes that are not needed here")]

use crate::emit_support;
#[path = "../furnace_support/textbook.rs"]
mod textbook;

use std::sync::LazyLock;

use emit_support::{programs, say};
use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::data::{Decode, Smith, Use};
use lobefit::effects::reflection::Fit;
use lobefit::emit::lookup::Readable;
use lobefit::integrate::coupling::Specular;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use textbook::{Facets, Hemisphere, Vector, direction, schlick};

/// Under every kind of lobe a base, with fits of factors and of normalisations; f0 from water to a gem.
const SCENE: &str = r#"{"schema_version": 1, "materials": [
    {"name": "a", "kind": "dielectric", "f0": [0.02, 0.08, 0.2], "roughness": [0.1, 1], "base": {"specular": "single", "norms": ["max"]},
     "wants": {"fit": {"max_ops": 13, "norms": ["max"]}}},
    {"name": "b", "kind": "dielectric", "f0": [0.02, 0.08, 0.2], "roughness": [0.1, 1], "base": {"specular": "normalised", "norms": ["max"]},
     "wants": {"fit": {"max_ops": 13, "norms": ["max"]}}},
    {"name": "c", "kind": "dielectric", "f0": [0.02, 0.08, 0.2], "roughness": [0.1, 1], "base": {"specular": "compensated", "norms": ["max"]},
     "wants": {"fit": {"max_ops": 13, "norms": ["max"]}}}]}"#;

static BAKED: LazyLock<Baked> = LazyLock::new(|| {
    let scene = Scene::from_json(SCENE.as_bytes(), "furnace.json").expect("a scene");
    bake(&scene, &plan(&scene), &[], Selection::default(), &Silent).expect("a bake")
});

/// Bound on the error of the rule, taken twice, and of f32.
const RULE: f64 = 2e-5;
const NODES: [usize; 2] = [96, 480];

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

fn views() -> Vec<View> {
    let mut views = Vec::new();
    for roughness in [0.52_f32, 0.74, 0.97] {
        for mu in [0.11_f32, 0.35, 0.6, 0.93] {
            views.extend([0.02_f32, 0.07, 0.2].map(|f0| View { roughness, mu, f0 }));
        }
    }
    views
}

/// Albedo of the bare lobe, settled.
fn albedo(view: &View) -> f64 {
    let [coarse, fine] = [3, 4].map(|k| {
        let rule = Hemisphere::new(NODES[0] * k / 4, NODES[1] * k / 4);
        rule.integrate([0.0, 1.0], |l| [view.lobe(l)])[0]
    });
    assert!((coarse - fine).abs() <= RULE / 2.0, "the rule at {view:?}: {coarse} {fine}");
    fine
}

fn of_use(used_as: Use) -> Vec<&'static Fit> {
    BAKED
        .fits
        .iter()
        .filter(|f| f.emitted && f.approximation.used_as == used_as && f.approximation.column != "E_avg")
        .collect()
}

fn call(fit: &Fit) -> String {
    let name = &fit.approximation.name;
    let lobefit::data::Form::Formula(formula) = &fit.approximation.form else {
        panic!("{name} is no formula")
    };
    format!("lobefit::{name}({})", formula.inputs.join(", "))
}

/// A factor under a lobe with this multiplier: names, expression of the program, sum of the certificates.
struct Combination {
    name: String,
    factor: String,
    multiplier: String,
    certificate: f64,
}

fn combinations() -> Vec<Combination> {
    let mut all = Vec::new();
    for factor in of_use(Use::Coupling) {
        let name = &factor.approximation.name;
        let own = factor.approximation.certificate.max_abs;
        let with = |by: &str, multiplier: String, certificate: f64| Combination {
            name: format!("{name} under {by}"),
            factor: call(factor),
            multiplier,
            certificate,
        };
        if name.starts_with("coupling_single_") {
            all.push(with("a bare lobe", "1.0".into(), own));
            continue;
        }
        let saturating = name.starts_with("coupling_compensated_");
        for n in of_use(Use::Normalisation).into_iter().filter(|n| n.wraps.is_some() == saturating) {
            all.push(with(&n.approximation.name, call(n), own + n.approximation.certificate.max_abs));
        }
    }
    all
}

/// Factor and multiplier of every combination at every view, by the emitted code.
fn evaluated(include: &str, combinations: &[Combination], views: &[View]) -> Vec<f32> {
    let puts: String = combinations
        .iter()
        .map(|c| format!("        out.push({});\n        out.push({});\n", c.factor, c.multiplier))
        .collect();
    let body = format!(
        "    for p in &points {{\n        let [roughness, alpha, mu, f0] = *p;\n        let _ = (roughness, alpha, mu, f0);\n{puts}    }}\n"
    );
    let points: Vec<u8> = views.iter().flat_map(View::numbers).flat_map(f32::to_le_bytes).collect();
    programs::run(include, 4, &body, &points)
}

/// The largest excess over what the certificates allow, of all combinations and views, with its name; and the largest departure from white.
fn excess(include: &str) -> (f64, String, f64) {
    let (views, combinations) = (views(), combinations());
    let values = evaluated(include, &combinations, &views);
    assert_eq!(values.len(), 2 * views.len() * combinations.len());
    let (mut worst, mut at, mut off) = (f64::NEG_INFINITY, String::new(), 0.0_f64);
    for (view, values) in views.iter().zip(values.chunks_exact(2 * combinations.len())) {
        let lobe = albedo(view);
        for (c, pair) in combinations.iter().zip(values.chunks_exact(2)) {
            let [factor, multiplier] = [pair[0], pair[1]].map(f64::from);
            let departure = (lobe * multiplier + factor - 1.0).abs();
            let over = departure - c.certificate - RULE;
            // A value that is not a number is the worst, and stays so.
            if over.is_nan() || over > worst {
                (worst, at) =
                    (over, format!("{} at {view:?}: off {departure}, allowed {}", c.name, c.certificate));
            }
            off = off.max(departure);
        }
    }
    (worst, at, off)
}

fn emitted() -> String {
    String::from_utf8(BAKED.files["fits/lobefit.rs"].clone()).expect("text")
}

#[test]
fn no_emitted_combination_gains_or_loses_more_than_its_certificates() {
    let combinations = combinations();
    for s in Specular::ALL {
        let of =
            combinations.iter().filter(|c| c.name.starts_with(&format!("coupling_{}_", s.name()))).count();
        assert!(of >= 4, "{}: {of} combinations", s.name());
    }
    let (worst, at, off) = excess(&emitted());
    assert!(worst <= 0.0, "{at}");
    say(&format!(
        "{} combinations: at most {off:.3} off white, every one within its certificates",
        combinations.len()
    ));
}

/// The same judgement finds code that gives the base a tenth too much.
#[test]
fn a_base_that_is_too_bright_is_found() {
    let text = emitted();
    let spoilt = text.replace("(1.0 - f0) * (1.0 - ", "1.1 * (1.0 - f0) * (1.0 - ");
    assert_ne!(text, spoilt);
    let (worst, at, _) = excess(&spoilt);
    assert!(worst > 0.01, "{at}");
}

/// The function that adds the base to the lobe, light by light over the hemisphere, with albedos below white beside it.
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
    for specular in Specular::ALL {
        let start = format!("coupling_{}_", specular.name());
        let of = of_use(Use::Coupling).into_iter().filter(|f| f.approximation.name.starts_with(&start));
        let best = of
            .min_by(|a, b| {
                a.approximation.certificate.max_abs.total_cmp(&b.approximation.certificate.max_abs)
            })
            .expect("a factor");
        let inputs = best.hypothesis.inputs().join(", ");
        let body = format!(
            "    for p in &points {{\n        let [roughness, alpha, mu, f0, lobe] = *p;\n        let _ = (roughness, alpha, mu, f0);
        out.extend(lobefit::diffuse_coupled_{}([lobe; 3], {albedo:?}, {inputs}));\n    }}\n",
            specular.name()
        );
        let view = View { roughness: 0.74, mu: 0.6, f0: 0.07 };
        // The lobe as a BRDF, without the cosine of the light, and multiplied exactly.
        let (facets, v) = view.facets();
        let whole = rule.integrate([0.0, 1.0], |l| [facets.reflected(v, l).0])[0];
        let by = match specular {
            Specular::Single => 1.0,
            Specular::Normalised => 1.0 / whole,
            Specular::Compensated => 1.0 + f64::from(view.f0) * (1.0 / whole - 1.0),
        };
        let lobe = |l: &Vector| (by * view.lobe(*l) / l[2]) as f32;
        let points: Vec<u8> = lights
            .iter()
            .flat_map(|l| view.numbers().into_iter().chain([lobe(l)]).collect::<Vec<f32>>())
            .flat_map(f32::to_le_bytes)
            .collect();
        let brdf = programs::run(&emitted(), 5, &body, &points);
        let next = std::cell::Cell::new(0);
        let [white, half, black] = rule.integrate([0.0, 1.0], |l| {
            let i = next.replace(next.get() + 3);
            [0, 1, 2].map(|k| f64::from(brdf[i + k]) * l[2])
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

/// The material for path tracers: f(l, v) = f(v, l) to rounding, and white light by light but for the average's own error, which is told.
#[test]
fn the_reciprocal_material_is_reciprocal_and_white() {
    const AVERAGE: f64 = 1e-3;
    let of =
        of_use(Use::Coupling).into_iter().filter(|f| f.approximation.name.starts_with("coupling_single_"));
    let best = of
        .min_by(|a, b| a.approximation.certificate.max_abs.total_cmp(&b.approximation.certificate.max_abs))
        .expect("a factor");
    let inputs = best.hypothesis.inputs();
    let constants: Vec<&str> = inputs.iter().map(String::as_str).filter(|name| *name != "mu").collect();
    let swapped: Vec<&str> = inputs.iter().map(|name| if name == "mu" { "mu_l" } else { name }).collect();
    let body = format!(
        "    for p in &points {{
        let [roughness, alpha, mu, f0, mu_l] = *p;
        let average = lobefit::diffuse_coupling_average_single({});
        out.push(lobefit::{}({}));
        out.push(lobefit::diffuse_coupled_reciprocal_single([0.0; 3], [1.0, 0.5, 0.0], average, mu_l, {})[0]);
        out.push(lobefit::diffuse_coupled_reciprocal_single([0.0; 3], [1.0, 0.5, 0.0], average, mu, {})[0]);
    }}
",
        constants.join(", "),
        best.hypothesis.name(),
        inputs.join(", "),
        inputs.join(", "),
        swapped.join(", "),
    );
    let rule = lobefit::math::gauss::Gauss::new(24);
    let lights: Vec<f32> = rule.nodes.iter().map(|x| (0.5 * (1.0 + x)) as f32).collect();
    let views = views();
    let numbers =
        views.iter().flat_map(|view| lights.iter().flat_map(|l| view.numbers().into_iter().chain([*l])));
    let points: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
    let found = programs::run(&emitted(), 5, &body, &points);
    for (view, of_view) in views.iter().zip(found.chunks_exact(3 * lights.len())) {
        let mut base = 0.0;
        for ((l, w), three) in lights.iter().zip(&rule.weights).zip(of_view.chunks_exact(3)) {
            let [_, there, back] = [three[0], three[1], three[2]].map(f64::from);
            assert!(
                (there - back).abs() <= 4.0 * f64::from(f32::EPSILON) * there,
                "{view:?} {l}: {there} {back}"
            );
            // pi times the mean of 2 l, over half the range of the rule
            base += std::f64::consts::PI * w * f64::from(*l) * there;
        }
        let factor = f64::from(of_view[0]);
        assert!((base / factor - 1.0).abs() <= AVERAGE, "{view:?}: {base}, factor {factor}");
        let stated = best.approximation.certificate.max_abs + AVERAGE + RULE;
        assert!((albedo(view) + base - 1.0).abs() <= stated, "{view:?}: {base}, certificate {stated}");
    }
}

/// A base whose factor follows from a table of E and B, under a lobe that is divided by the table's E: what both are off is the table's error of
/// f0 A + B over its E.
#[test]
fn a_table_of_e_and_b_makes_an_exact_factor() {
    let scene = SCENE.replace(
        r#""wants": {"fit": {"max_ops": 13, "norms": ["max"]}}"#,
        r#""wants": {"table": {"size": [16, 16], "format": "f32", "serves": "split-sum"}}"#,
    );
    let scene = Scene::from_json(scene.as_bytes(), "table.json").expect("a scene");
    let baked = bake(&scene, &plan(&scene), &[], Selection::default(), &Silent).expect("a bake");
    let [made] = &baked.tables[..] else { panic!("{} tables", baked.tables.len()) };
    let table = made.table().expect("a table");
    let readable = Readable { table, decode: Decode::of(made.layout, made.serves), header: &[] };
    let pairs = table.channels[0].texels.iter().zip(&table.channels[1].texels);
    let texels: Vec<[f32; 2]> = pairs.map(|(a, b)| [*a as f32, *b as f32]).collect();
    let body = format!(
        "    let texels: &[[f32; 2]] = &{texels:?};
    for p in &points {{
        let [roughness, alpha, mu, f0] = *p;
        let [e, _, b] = lobefit::{}_lookup(texels, roughness, alpha, mu);
        out.extend([e, lobefit::diffuse_coupling_normalised(f0, e, b)]);
    }}
",
        readable.identifier()
    );
    let views = views();
    let points: Vec<u8> = views.iter().flat_map(View::numbers).flat_map(f32::to_le_bytes).collect();
    let include = String::from_utf8(baked.files["fits/lobefit.rs"].clone()).expect("text");
    let found = programs::run(&include, 4, &body, &points);
    let certificate = made.errors.lookup.max;
    assert!(certificate < 0.01, "{certificate}");
    let mut worst = 0.0_f64;
    for (view, pair) in views.iter().zip(found.chunks_exact(2)) {
        let [e, factor] = [pair[0], pair[1]].map(f64::from);
        let off = (albedo(view) / e + factor - 1.0).abs();
        assert!(off <= (certificate + RULE) / e, "{view:?}: off {off}, certificate {certificate}, e {e}");
        worst = worst.max(off);
    }
    say(&format!("a table of E and B: at most {worst:.1e} off white, {certificate:.1e} certified"));
}
