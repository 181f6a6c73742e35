//! The effect clearcoat: the emitted share in WGSL against sums over facets, what a white base sends back
//! below a coat in a furnace, the files of four languages before their compilers, and the formulas beside
//! what is published.
#![allow(clippy::disallowed_methods)]

use super::dielectric::reflected;
use crate::baked_support::{assert_promised, shared};
use crate::emit_support;

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::sync::LazyLock;

use emit_support::example::{baked, certified, compiled, function, text};
use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::data::Smith;
use lobefit::effects::Effect;
use lobefit::effects::clearcoat::{Clearcoat, HYPOTHESES, PUBLISHED};
use lobefit::emit::call::callers;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit_math::gauss::Gauss;
use lobefit_shade::Source;
use lobefit_shade::code::Language;
use lobefit_truth::quantity::{GgxCoat, Quantity};

const SCENE: &str = include_str!("../../examples/lacquer.json");

/// Every formula of the share over the indices of refraction of the example.
pub(crate) static LACQUER: LazyLock<Baked> = LazyLock::new(|| {
    // Without a lobe below the coat, which has fits of its own.
    let smooth = SCENE.replace(r#""roughness": [0.3, 0.6]"#, r#""roughness": 0"#);
    let json = smooth.replacen('{', r#"{ "pick": "all", "reports": false,"#, 1);
    let scene = Scene::from_json(json.as_bytes(), "scene.json").expect("a scene");
    // Without the fits of the coat's own albedo.
    let selection = Selection { only: vec![Clearcoat.name().into()], ..shared() };
    bake(&scene, &plan(&scene), &[], selection, &Silent).expect("a bake")
});

/// One index of refraction, at the error that the furnace keeps.
const PAINT: &str = r#"{ "schema_version": 1, "name": "paint", "reports": false, "languages": ["wgsl"], "materials": [
    { "name": "coat", "kind": "dielectric", "ior": 1.5, "roughness": 0, "coat": { "roughness": [0.1, 1], "max_error": 0.001 } }] }"#;

/// Cosines of lights and views.
const NODES: usize = 12;

/// 2 int f mu dmu over the hemisphere.
fn average(mut f: impl FnMut(f64) -> f64) -> f64 {
    Gauss::new(NODES).integrate(0.0, 1.0, |mu| 2.0 * mu * f(mu))
}

/// The albedo of a coat's lobe by facets.
fn lobe(roughness: f64, mu: f64, ior: f64) -> f64 {
    reflected(Smith::Correlated, [roughness * roughness, mu, ior], 1 << 11)
}

#[test]
fn the_emitted_share_is_that_of_facets_within_its_promise() {
    let mut places = Vec::new();
    for roughness in [0.05, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0] {
        places.extend([1.1, 1.2, 1.33, 1.5, 1.8, 2.2, 2.5].map(|ior| [roughness, 1.0, ior]));
    }
    let share =
        |[roughness, _, ior]: &[f64; 3]| (1.0 - average(|mu| lobe(*roughness, mu, *ior))) / (ior * ior);
    let truths: Vec<f64> = places.iter().map(share).collect();
    certified(&LACQUER, &HYPOTHESES, (&places, &truths), 5e-4, 0.6);
}

/// A smooth coat, with the least roughness that formulas are fitted over in place of its own, as the
/// header says.
#[test]
fn a_smooth_coat_has_what_is_promised_of_rough_ones() {
    let source = Source::parse("lobefit.wgsl", &text(&LACQUER, Language::Wgsl)).expect("it parses");
    for fit in LACQUER.fits.iter().filter(|fit| fit.emitted) {
        let (name, stated) = (fit.hypothesis.name(), fit.approximation.certificate.max_abs);
        let share = function(&source, name);
        let least = fit.approximation.certificate.domain["roughness"][0];
        for ior in [1.1, 1.3, 1.5, 1.8, 2.1, 2.5] {
            let ior = f64::from(ior as f32);
            let truth = GgxCoat.at(&Smith::Correlated.into(), &[0.0, ior], 1e-6).expect("in the domain")[0];
            let off = share(&[("roughness", least), ("alpha", least * least), ("ior", ior)]) / truth - 1.0;
            assert!(off.abs() <= stated + 1e-5, "{name} {ior}: {off}; stated {stated}");
        }
    }
}

/// The reciprocal base and the coat's own lobe send back all light within 1e-3. The base that is scaled keeps
/// what the lobe leaves, to rounding, and with the emitted albedo within its certificate.
#[test]
fn a_white_base_is_white_below_a_coat() {
    let paint = baked(PAINT);
    let source = Source::parse("lobefit.wgsl", &text(&paint, Language::Wgsl)).expect("it parses");
    let of = |name: &str| function(&source, name);
    let (share, scale, diffuse) = (of("coat_escape"), of("coat_base_scale"), of("coat_diffuse"));
    let albedo = of("ggx_dielectric_albedo");
    let stated = paint.calls.iter().find(|call| call.function == "ggx_dielectric_albedo").expect("a call");
    let mut worst = 0.0_f64;
    for roughness in [0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0] {
        let escape = share(&[("roughness", roughness), ("ior", 1.5)]);
        // The lights are the same for every view.
        let mut lit = Vec::new();
        average(|mu_l| {
            lit.push(lobe(roughness, mu_l, 1.5));
            0.0
        });
        for mu in [0.02, 0.1, 0.3, 0.6, 1.0] {
            let e_v = lobe(roughness, mu, 1.5);
            let mut lights = lit.iter();
            let sent = average(|_| {
                let e_l = *lights.next().expect("a light");
                let given = [("albedo", 1.0), ("ior", 1.5), ("e_v", e_v), ("e_l", e_l), ("escape", escape)];
                PI * diffuse(&given)
            });
            worst = worst.max((e_v + sent - 1.0).abs());
            let kept = scale(&[("albedo", 1.0), ("e_v", e_v), ("escape", escape)]);
            assert!((e_v + kept - 1.0).abs() < 1e-6, "{roughness} {mu}: {kept}");
            let emitted = albedo(&[("roughness", roughness), ("n_dot_v", mu), ("ior", 1.5)]);
            let kept = scale(&[("albedo", 1.0), ("e_v", emitted), ("escape", escape)]);
            assert!((e_v + kept - 1.0).abs() <= stated.max_error + 5e-4, "{roughness} {mu}: {kept}");
            let grey = scale(&[("albedo", 0.5), ("e_v", 0.0), ("escape", escape)]);
            assert!((grey - escape / (1.0 - 0.5 * (1.0 - escape))).abs() < 1e-6, "{roughness}: {grey}");
        }
    }
    println!("{worst:e}");
    assert!(worst < 1e-3, "{worst}");
}

/// A base below a lobe with the exact Fresnel term is scaled as one below a coat is, and takes no factor of
/// Schlick's lobe; a coat on it has calls of its own roughness.
#[test]
fn a_base_below_the_exact_term_is_one_below_a_coat() {
    let json = r#"{ "schema_version": 1, "reports": false, "languages": ["wgsl"], "materials": [
        { "name": "resin", "kind": "dielectric", "ior": 1.5, "roughness": [0.3, 0.6], "base": {},
          "coat": { "roughness": 0.1 }, "wants": { "exact_fresnel": {} } }] }"#;
    let baked = baked(json);
    let called = baked.calls.iter().map(|call| {
        let value = call.around.first().and_then(|around| around.value.as_deref());
        (call.function.as_str(), call.layer.as_deref(), call.then.as_deref(), value)
    });
    let (albedo, share, scale) = ("ggx_dielectric_albedo", "coat_escape", Some("coat_base_scale"));
    let expected = [(albedo, Some("e_v")), (share, Some("escape"))];
    let expected = expected
        .into_iter()
        .flat_map(|(name, value)| [None, Some("coat")].map(|layer| (name, layer, scale, value)));
    assert_eq!(called.collect::<BTreeSet<_>>(), expected.collect::<BTreeSet<_>>());
    let worded = &callers(&baked.calls)[0].calls;
    let coat = "ggx_dielectric_albedo of the coat then coat_base_scale as e_v";
    assert!(worded.iter().any(|call| call == coat), "{worded:?}");
}

#[test]
fn compilers_take_the_files() {
    compiled(&LACQUER);
}

/// The table of docs/scene.md.
#[test]
fn ours_beat_what_is_published() {
    let page = include_str!("../../docs/scene.md");
    let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
    for fit in &LACQUER.fits {
        let a = &fit.approximation;
        let (ops, error) = (a.cost.ops, a.certificate.max_abs);
        let [max, rms] = [error, a.certificate.rms].map(|error| lobefit_shade::round_up(error, 4));
        let row = format!("| `{}` | {ops} | {max} | {rms} |", a.name);
        println!("{row}");
        assert!(page.contains(&row), "docs/scene.md has no row {row}");
        let least = if fit.emitted { &mut ours } else { &mut theirs };
        *least = least.min(error);
    }
    assert_promised("tests/emitted/clearcoat.rs", &LACQUER.fits);
    assert_eq!(LACQUER.fits.len(), HYPOTHESES.len() + PUBLISHED.len());
    assert!(ours < 0.05 * theirs, "{ours} {theirs}");
}

/// The truth on the page.
#[test]
fn the_page_states_the_truth() {
    let page = include_str!("../../docs/scene.md");
    for rough in [0.0, 0.2, 0.4, 0.7, 1.0_f64] {
        let v = GgxCoat.at(&Smith::Correlated.into(), &[rough * rough, 1.5], 1e-6).expect("in the domain");
        let row = format!("| {rough} | {:.3} | {:.3} |", v[0], v[3] / 2.25);
        assert!(page.contains(&row), "docs/scene.md has no row {row}");
    }
}
