//! The effect width: the emitted roughness in WGSL against facets of a textbook that are sorted by how
//! far they refract from the mean, the files of four languages before their compilers, and the formulas
//! beside the rule that engines ship; and the emitted roughness of widened lobes against their truth,
//! which `crates/truth/tests/truth/widened.rs` holds to a textbook.
#![allow(clippy::disallowed_methods)]

use crate::baked_support::{assert_promised, shared};
use crate::emit_support;
use crate::furnace_support::textbook::{Vector, dot, fresnel, normalised};

use std::sync::LazyLock;

use emit_support::example::{baked, certified, compiled, function, text};
use lobefit::approximate::Fit;
use lobefit::bake::Baked;
use lobefit::bake::{Selection, Silent, bake};
use lobefit::data::Smith;
use lobefit::effects::width::FITS;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit_math::recurrence::Recurrence;
use lobefit_shade::Source;
use lobefit_shade::code::Language;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, RefractedWidth, Variant};

const SCENE: &str = include_str!("../../examples/panes.json");

/// Every formula over the indices of refraction of the example.
pub(crate) static PANES: LazyLock<Baked> =
    LazyLock::new(|| baked(&SCENE.replacen('{', r#"{ "pick": "all", "reports": false,"#, 1)));

/// Those of the roughness of what is refracted.
fn refracting() -> impl Iterator<Item = &'static Fit> {
    PANES.fits.iter().filter(|fit| fit.approximation.quantity == "refracted-width")
}

/// Every formula of widened lobes over the ranges of the example, without its coat's other effects.
static LANES: LazyLock<Baked> = LazyLock::new(|| {
    let json = include_str!("../../examples/lanes.json");
    let json = json.replacen('{', r#"{ "pick": "all", "reports": false,"#, 1);
    let scene = Scene::from_json(json.as_bytes(), "lanes.json").expect("a scene");
    let selection = Selection { only: vec!["width".into()], ..shared() };
    bake(&scene, &plan(&scene), &[], selection, &Silent).expect("a bake")
});

/// Facets of a lattice.
const FACETS: usize = 1 << 12;

fn refracted(view: Vector, normal: Vector, ior: f64) -> Vector {
    let cosine = dot(view, normal);
    let inside = (1.0 - (1.0 - cosine * cosine) / (ior * ior)).sqrt();
    std::array::from_fn(|i| (cosine / ior - inside) * normal[i] - view[i] / ior)
}

/// Directions about one at which half of the energy is inside: the middle of sorted cosines.
fn middle(mut lights: Vec<(f64, f64)>) -> f64 {
    lights.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut left = 0.5 * lights.iter().map(|(_, energy)| energy).sum::<f64>();
    let found = lights.iter().find(|(_, energy)| {
        left -= energy;
        left <= 0.0
    });
    found.expect("a middle").0
}

/// The cosine of the cone about the refraction at the mean normal with half of the transmitted energy, by
/// facets of D cos (Walter et al. 2007), with height-correlated shadowing.
fn refracts([alpha, mu, ior]: [f64; 3]) -> f64 {
    let view = [(1.0 - mu * mu).sqrt(), 0.0, mu];
    let axis = refracted(view, [0.0, 0.0, 1.0], ior);
    let lambda = |z: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - z * z) / (z * z)).sqrt() - 1.0);
    let light = |i: usize| {
        let u = (i as f64 + 0.5) / FACETS as f64;
        let turn = std::f64::consts::TAU * 0.618_033_988_749_894_9 * i as f64;
        let slope = alpha * (u / (1.0 - u)).sqrt();
        let facet: Vector = normalised([slope * turn.cos(), slope * turn.sin(), 1.0]);
        let cosine = dot(view, facet);
        let light = refracted(view, facet, ior);
        let energy = (1.0 - fresnel(cosine.max(0.0), ior)) * cosine
            / (facet[2] * (1.0 + lambda(mu) + lambda(light[2])));
        (cosine > 0.0 && light[2] < 0.0).then_some((dot(light, axis), energy))
    };
    middle((0..FACETS).filter_map(light).collect())
}

/// The same of the prefiltered lobe of a width.
fn prefilters(alpha: f64) -> f64 {
    let light = |i: usize| {
        let u = (i as f64 + 0.5) / FACETS as f64;
        let square = alpha * alpha * u / (1.0 - u);
        let cosine = (1.0 - square) / (1.0 + square);
        (cosine > 0.0).then_some((cosine, cosine))
    };
    middle((0..FACETS).filter_map(light).collect())
}

/// The roughness by halving.
fn roughness(cosine: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..14 {
        let middle: f64 = 0.5 * (low + high);
        if prefilters(middle * middle) > cosine { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn the_emitted_roughness_is_that_of_the_textbook_within_its_promise() {
    let mut places = Vec::new();
    for roughness in [0.1, 0.25, 0.4, 0.65, 0.9, 1.0] {
        for mu in [0.015, 0.1, 0.3, 0.7, 1.0] {
            places.extend([1.1, 1.25, 1.5, 1.98].map(|ior| [roughness, mu, ior]));
        }
    }
    let truth = |[rough, mu, ior]: &[f64; 3]| roughness(refracts([rough * rough, *mu, *ior]));
    let truths: Vec<f64> = places.iter().map(truth).collect();
    certified(&PANES, FITS[0].own.all, (&places, &truths), 4e-3, 0.5);
}

#[test]
fn compilers_take_the_files() {
    compiled(&PANES);
}

/// Inputs with the ranges of the example.
const INPUTS: [(&str, [f64; 2]); 6] = [
    ("roughness", [0.2, 1.0]),
    ("mu", [0.01, 1.0]),
    ("mean_length", [0.7, 1.0]),
    ("light_radius", [0.0, 0.3]),
    ("coat_roughness", [0.05, 0.5]),
    ("ior", [1.3, 1.7]),
];

#[test]
fn the_emitted_roughness_of_widened_lobes_is_the_truth_within_its_promise() {
    const PLACES: usize = 300;
    let sequence = Recurrence::new(INPUTS.len());
    let column = |(k, (name, [low, high])): (usize, (&'static str, [f64; 2]))| {
        (name, (0..PLACES).map(|i| low + (high - low) * sequence.coordinate(i, k)).collect::<Vec<f64>>())
    };
    let points = Points::new(INPUTS.into_iter().enumerate().map(column));
    let rough = points.column("roughness").expect("a column").to_vec();
    let points = points.with("alpha", rough.iter().map(|r| r * r).collect());
    let source = Source::parse("lobefit.wgsl", &text(&LANES, Language::Wgsl)).expect("it parses");
    for fits in &FITS[1..] {
        let tolerance = fits.quantity.tolerance_of_many(&Variant::default());
        let truth = fits.quantity.truth(&Variant::default(), &points, &[fits.column], tolerance);
        let [truth] = truth.expect("in the domain").arrays();
        let own = |name: &str| fits.own.entries().any(|entry| entry.name() == name);
        let emitted = LANES.fits.iter().filter(|fit| fit.emitted && own(&fit.approximation.name));
        let mut count = 0;
        for fit in emitted {
            let (name, stated) = (fit.hypothesis.name(), fit.approximation.certificate.max_abs);
            let value = function(&source, name);
            let residual = fit.approximation.used_as.residual;
            let error = |i: usize| {
                let mut given: Vec<(&str, f64)> = points.columns().map(|(name, x)| (name, x[i])).collect();
                given.extend(points.column("mu").map(|mu| ("n_dot_v", mu[i])));
                let [scale, target] = residual.scaled(truth[i]);
                (scale * value(&given) - target).abs()
            };
            let worst = (0..PLACES).map(error).fold(0.0, f64::max);
            println!("{name}: {worst:.4} of {stated}");
            assert!(worst <= stated + 2e-3 && worst > 0.2 * stated, "{name}: {worst} of {stated}");
            count += 1;
        }
        assert_eq!(count, fits.own.entries().count(), "{}: a formula has no fit", fits.of);
    }
}

/// The tables of docs/scene.md, and ours beside what engines ship.
#[test]
fn ours_beat_the_rules_for_widened_lobes() {
    let page = include_str!("../../docs/scene.md");
    let mut lacking = Vec::new();
    for fits in &FITS[1..] {
        let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
        for entry in fits.own.entries().chain(fits.published) {
            let fit = LANES.fits.iter().find(|fit| fit.approximation.name == entry.name()).expect("a fit");
            let a = &fit.approximation;
            let error = a.certificate.max_abs;
            let [most, usual] = [error, a.certificate.rms].map(|error| lobefit_shade::round_up(error, 4));
            let row = format!("| `{}` | {} | {most} | {usual} |", a.name, a.cost.ops);
            lacking.extend((!page.contains(&row)).then_some(row));
            let least = if fit.emitted { &mut ours } else { &mut theirs };
            *least = least.min(error);
        }
        assert!(ours < 0.9 * theirs, "{}: {ours} {theirs}", fits.of);
    }
    assert!(lacking.is_empty(), "docs/scene.md has no row {lacking:#?}");
    assert_promised("tests/emitted/width.rs", LANES.fits.iter().chain(refracting()));
    compiled(&LANES);
}

/// The table of docs/scene.md.
#[test]
fn ours_beat_the_rule_that_engines_ship() {
    let page = include_str!("../../docs/scene.md");
    let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
    for fit in refracting() {
        let a = &fit.approximation;
        let (ops, error) = (a.cost.ops, a.certificate.max_abs);
        let row = format!(
            "| `{}` | {ops} | {} | {} |",
            a.name,
            lobefit_shade::round_up(error, 4),
            lobefit_shade::round_up(a.certificate.rms, 4)
        );
        assert!(page.contains(&row), "docs/scene.md has no row {row}");
        let least = if fit.emitted { &mut ours } else { &mut theirs };
        *least = least.min(error);
    }
    assert_eq!(refracting().count(), FITS[0].own.entries().count() + FITS[0].published.len());
    assert!(ours < 0.1 * theirs, "{ours} {theirs}");
}

/// The truth on the page.
#[test]
fn the_page_states_the_truth() {
    let page = include_str!("../../docs/scene.md");
    for rough in [0.2, 0.4, 0.7, 1.0_f64] {
        let truth = |mu: f64| {
            let smith = Smith::Correlated.into();
            RefractedWidth.at(&smith, &[rough * rough, mu, 1.5], 1e-6).expect("in the domain")[0]
        };
        let [face_on, slanted, grazing] = [1.0, 0.3, 0.1].map(truth);
        let ratio = face_on / rough;
        let row = format!("| {rough} | {face_on:.3} | {ratio:.3} | {slanted:.3} | {grazing:.3} | {rough} |");
        assert!(page.contains(&row), "docs/scene.md has no row {row}");
    }
}

/// The page has spheres by the lobe, by ours and by the rules in use, which are off by more.
#[test]
fn the_page_has_spheres_beside_the_rules_in_use() {
    let scene =
        Scene::from_json(SCENE.replacen('{', r#"{ "languages": ["wgsl"],"#, 1).as_bytes(), "panes.json");
    let scene = scene.expect("a scene");
    let selection = Selection { only: vec!["width".into()], ..shared() };
    let baked = bake(&scene, &plan(&scene), &[], selection, &Silent).expect("a bake");
    let page = String::from_utf8(baked.files["reports/width.html"].clone()).expect("text");
    let (_, caption) = page.split_once("Off from the lobe itself").expect("the caption of the spheres");
    // Names may break at their underscores.
    let caption = caption.replace("<wbr>", "");
    let off = |name: &str| -> f64 {
        let (_, after) = caption.split_once(name).unwrap_or_else(|| panic!("no {name}"));
        after.get(1..6).expect("a number").parse().expect("a number")
    };
    let [ours, khronos] = ["refracted_width_14", "refracted_width_khronos"].map(off);
    assert!(khronos > 2.0 * ours && ours > 0.0, "{ours} {khronos}");
}
