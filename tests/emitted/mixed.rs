//! Metals in part: the emitted mix is that of the finished lobes; mixing f0 first lacks what is stated.

use std::sync::LazyLock;

use crate::emit_support::example::{baked, compiled, function, text};
use lobefit::bake::Baked;
use lobefit::data::Smith;
use lobefit::emit::call::{How, callers};
use lobefit::scene::Scene;
use lobefit_shade::Source;
use lobefit_shade::code::Language;
use lobefit_truth::integrate::reflection::reflection;

const SCENE: &str = include_str!("../../examples/rust.json");

static RUST: LazyLock<Baked> = LazyLock::new(|| baked(SCENE));

/// The albedo of a lobe with the compensation of a metal.
fn compensated(f0: f64, [e, a, b]: [f64; 3]) -> f64 {
    (f0 * a + b) * (1.0 + f0 * (1.0 / e - 1.0))
}

/// Of the dielectric, as `specular` multiplies it.
fn below(specular: &str, f0: f64, truth: [f64; 3]) -> f64 {
    let [e, a, b] = truth;
    match specular {
        "normalised" => (f0 * a + b) / e,
        "compensated" => compensated(f0, truth),
        _ => f0 * a + b,
    }
}

/// Schlick's term is linear, so that two values of it tell the function's A and B: with those of the truth it
/// sends back what the two finished lobes do, within the error of N.
#[test]
fn the_mix_is_that_of_the_finished_lobes_and_the_shortcut_lacks_what_is_stated() {
    for (specular, metal) in [("normalised", 0.58), ("compensated", 1.0), ("single", 0.58)] {
        let json = SCENE.replace(r#""f0": 0.04 },"#, &format!(r#""f0": 0.04, "specular": "{specular}" }},"#));
        let json = if metal == 1.0 { json.replace("[0.56, 0.57, 0.58]", "1") } else { json };
        let own = if specular == "normalised" {
            None
        } else {
            Some(baked(&json.replacen('{', r#"{"languages": ["wgsl"], "reports": false,"#, 1)))
        };
        let rust = own.as_ref().unwrap_or(&RUST);
        let name = format!("ggx_mixed_{specular}");
        let text = text(rust, Language::Wgsl);
        let source = Source::parse("lobefit.wgsl", &text).expect("it parses");
        let [mixed, n] = [name.as_str(), "ggx_energy_compensation"].map(|name| function(&source, name));
        let call =
            rust.calls.iter().find(|call| call.of == "iron" && call.function == "ggx_energy_compensation");
        let call = call.expect("a call");
        let stated = call.max_error;
        let (mut shortcut, mut worst) = (0.0_f64, 0.0_f64);
        for i in 0..=20 {
            for j in 0..=40 {
                let (roughness, mu) = (0.1 + 0.045 * f64::from(i), 0.01 + 0.02475 * f64::from(j));
                let truth = reflection(Smith::Correlated, roughness * roughness, mu, 1e-8).expect("a truth");
                let truth = [truth.e, truth.a, truth.b];
                let n = n(&[("roughness", roughness), ("n_dot_v", mu)]);
                for metalness in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let at = |schlick: f64| {
                        let given = [
                            ("metalness", metalness),
                            ("dielectric_f0", 0.04),
                            ("metal_f0", metal),
                            ("schlick", schlick),
                            ("n", n),
                        ];
                        mixed(&given)
                    };
                    let [of_f0, of_one] = [at(0.0), at(1.0)];
                    let [_, a, b] = truth;
                    // The term's weights sum to E = A + B: those of 1 - (1 - x)^5 are A.
                    let found = of_f0 * a + of_one * b;
                    let both = below(specular, 0.04, truth) * (1.0 - metalness)
                        + compensated(metal, truth) * metalness;
                    worst = worst.max((found / both - 1.0).abs());
                    // The shortcut, beside lobes that are compensated alike, of the channel that is farthest.
                    let alike =
                        compensated(0.04, truth) * (1.0 - metalness) + compensated(metal, truth) * metalness;
                    shortcut = shortcut.max(alike - compensated(0.04 + metalness * (metal - 0.04), truth));
                }
            }
        }
        assert!(worst <= stated * 1.001 && worst > 0.2 * stated, "{specular}: {worst} of {stated}");
        let said = text
            .split("up to ")
            .find(|rest| rest.contains(" of the light of a white"))
            .expect("the comment says it");
        let said: f64 = said.split_whitespace().next().and_then(|word| word.parse().ok()).expect("a number");
        println!("{specular}: {shortcut}, {said} stated");
        assert!(shortcut <= said && shortcut > 0.99 * said, "{specular}: {shortcut} of {said}");
        assert!(include_str!("../../docs/scene.md").contains(&format!(" up to {said} ")), "{said}");
        let [around] = &call.around[..] else { panic!("{call:?}") };
        assert_eq!(
            (around.function.as_str(), around.how, around.value.as_deref()),
            (name.as_str(), How::TakesValue, Some("n"))
        );
        assert_eq!(call.then.as_deref(), Some(name.as_str()));
    }
}

#[test]
fn compilers_take_the_files_and_calls_are_worded() {
    compiled(&RUST);
    let worded = callers(&RUST.calls);
    assert_eq!(worded[0].calls, ["ggx_energy_compensation then ggx_mixed_normalised as n"]);
    assert!(!text(&RUST, Language::Wgsl).contains("compensation_rgb("), "the metal's own form is nobody's");
}

#[test]
fn a_mix_that_makes_no_sense_is_refused_with_its_field() {
    for (material, expected) in [
        (
            r#""kind": "dielectric", "f0": 0.04, "mixed": {}"#,
            "`mixed` is for metals; leave it out of a dielectric",
        ),
        (
            r#""kind": "metal", "f0": 0.9, "mixed": {}, "wants": {"tables": [{"size": [8, 8]}]}"#,
            "mixed: what mixes takes the value of a function",
        ),
        (
            r#""kind": "metal", "f0": 0.9, "distribution": "beckmann", "mixed": {}"#,
            "mixed: it is of the distribution `ggx`",
        ),
        (r#""kind": "metal", "f0": 0.9, "mixed": {"metalness": [0.5, 2]}"#, "mixed.metalness"),
        (r#""kind": "metal", "f0": 0.9, "mixed": 1"#, "an object that describes a mixed dielectric"),
    ] {
        let json =
            format!(r#"{{"schema_version": 1, "materials": [{{"name": "m", "roughness": 1, {material}}}]}}"#);
        let error = Scene::from_json(json.as_bytes(), "s.json").expect_err("refused").to_string();
        assert!(error.contains(expected) && error.contains("materials[0]"), "{material}: {error}");
    }
}
