//! The effect parallax in the hands of others: what is emitted for probes is read, compiled and run
//! in every language.

use crate::emit_support;
use crate::emit_support::{functions, module};

use std::sync::LazyLock;

use crate::baked_support::bake_scene;
use emit_support::compilers::{self, Contraction, includes_in_cpp, loops};
use emit_support::languages::{FAMILY, compile};
use emit_support::programs::{compile_library, run};
use lobefit::bake::Baked;
use lobefit::data::{MipChain, MipMap};
use lobefit::scene::Scene;
use lobefit_math::ops;
use lobefit_shade::Hypothesis;
use lobefit_shade::code::Language;
use serde_json::Value;

/// Probes of all kinds of chains, one of another lobe.
const SCENE: &str = r#"{"schema_version": 1, "name": "test", "pick": "all", "materials": [], "probes": [
    {"name": "a", "mips": {"map": "linear", "count": 7}, "norms": ["max"]},
    {"name": "b", "mips": {"map": "r(2-r)", "count": 5}, "norms": ["max"]},
    {"name": "c", "mips": {"map": "r(1.7-0.7r)", "count": 7}, "norms": ["max"]},
    {"name": "d", "mips": {"map": "log", "count": 8}, "norms": ["max"]},
    {"name": "e", "mips": {"levels": [0, 0.1, 0.25, 0.5, 1]}, "norms": ["max"]},
    {"name": "f", "kernel": "ndf", "mips": {"map": "log", "count": 8}, "norms": ["max"]}]}"#;

static BAKED: LazyLock<Baked> = LazyLock::new(|| {
    let scene = Scene::from_json(SCENE.as_bytes(), "test.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
});

fn text(language: Language) -> String {
    let file = format!("fits/lobefit.{}", language.extension());
    String::from_utf8(BAKED.files[&file].clone()).expect("UTF-8")
}

/// A function of the manifest, read back from the emitted WGSL.
struct Emitted {
    entry: Value,
    inputs: Vec<String>,
    read: Hypothesis,
}

/// Those of fits, then those of levels.
static EMITTED: LazyLock<Vec<Emitted>> = LazyLock::new(|| {
    let manifest: Value = serde_json::from_slice(&BAKED.files["manifest.json"]).expect("JSON");
    let source = text(Language::Wgsl);
    let known = functions(&source);
    let of = |entry: &Value| {
        let name = entry["function"].as_str().expect("a name");
        let read = Hypothesis::parse("lobefit.wgsl", &module(name, &known));
        let read = read.unwrap_or_else(|e| panic!("{name}: {e}"));
        let inputs = entry["inputs"].as_array().expect("inputs").iter();
        let inputs: Vec<String> = inputs.map(|input| input.as_str().expect("a name").into()).collect();
        assert_eq!((read.name(), read.inputs()), (name, inputs.as_slice()));
        Emitted { entry: entry.clone(), inputs, read }
    };
    let lists = ["fits", "mips"].map(|list| manifest[list].as_array().expect("a list").clone());
    lists.iter().flatten().map(of).collect()
});

/// Names of a point's numbers.
const INPUTS: [&str; 4] = ["roughness", "alpha", "rho", "mip"];

/// Points inside every domain and far outside of it: rays, mirrors' walls, levels that no chain
/// has.
static POINTS: LazyLock<Vec<[f32; 4]>> = LazyLock::new(|| {
    let roughness = (0..=40).map(|i| i as f32 / 40.0).chain([0.001, 0.03]);
    let rho = (-20..=10).map(|i| ops::exp(0.5 * f64::from(i) * std::f64::consts::LN_10) as f32 * 1e-2);
    let rho: Vec<f32> = rho.chain([0.0, 1e-6, 0.0625, 0.5, 1.0, 2.0, 8.0, 1e3, 1e30]).collect();
    roughness
        .flat_map(|r| rho.iter().enumerate().map(move |(i, rho)| [r, r * r, *rho, r * 9.0 - (i % 2) as f32]))
        .collect()
});

fn bytes() -> Vec<u8> {
    POINTS.iter().flatten().flat_map(|x| x.to_le_bytes()).collect()
}

impl Emitted {
    fn name(&self) -> &str {
        self.read.name()
    }

    fn values(&self, points: &[[f32; 4]]) -> Vec<f32> {
        let column = |input: &String| {
            let k = INPUTS.iter().position(|name| name == input).expect("an input");
            points.iter().map(|point| point[k]).collect()
        };
        let columns: Vec<Vec<f32>> = self.inputs.iter().map(column).collect();
        self.read.tape().evaluate(&columns, &[]).expect("values")
    }

    /// Bits are promised but for logarithms and powers, whose last bits are the platform's.
    fn agrees(&self, language: &str, found: &[f32]) {
        let transcendental = ["_log", "_power"].iter().any(|part| self.name().contains(part))
            || self.entry["chain"].as_str().is_some_and(|c| c.starts_with("log"));
        // A chain's level is adjusted by the best fit, which may be of powers.
        let near = transcendental || self.entry["gives"] == "adjusted-mip";
        for ((point, expected), found) in POINTS.iter().zip(self.values(&POINTS)).zip(found) {
            let same = match near {
                true => (expected - found).abs() <= 4e-6 * expected.abs().max(1.0),
                false => expected.to_bits() == found.to_bits(),
            };
            assert!(same, "{language}: {} at {point:?}: {expected}, found {found}", self.name());
        }
    }
}

#[test]
fn the_functions_of_probes_return_in_every_language_what_was_certified() {
    assert!(EMITTED.len() >= 4 + 3 * 5 + 3, "{}", EMITTED.len());
    let rust = text(Language::Rust);
    compile_library(&rust);
    let body: String = EMITTED
        .iter()
        .map(|one| {
            let (name, inputs) = (one.name(), one.inputs.join(", "));
            format!(
                "    for &[roughness, alpha, rho, mip] in &points {{\n        let _ = (roughness, alpha, rho, mip);\n        \
                 out.push(lobefit::{name}({inputs}));\n    }}\n"
            )
        })
        .collect();
    let found = run(&rust, 4, &body, &bytes());
    for (one, found) in EMITTED.iter().zip(found.chunks_exact(POINTS.len())) {
        one.agrees("rust", found);
    }
    let call = |one: &Emitted| {
        let index = |input: &String| INPUTS.iter().position(|name| name == input).expect("an input");
        let arguments: Vec<String> = one.inputs.iter().map(|input| format!("p[{}]", index(input))).collect();
        format!("        put({}({}));\n", one.name(), arguments.join(", "))
    };
    let bodies: Vec<String> = EMITTED.iter().map(call).collect();
    for language in FAMILY {
        let found = compilers::run(language, &text(language), &loops(4, &bodies), &bytes(), Contraction::Off);
        let Some(found) = found else { continue };
        for (one, found) in EMITTED.iter().zip(found.chunks_exact(POINTS.len())) {
            one.agrees(language.name(), found);
        }
    }
    for language in [Language::Hlsl, Language::Glsl] {
        assert!(compile(language, &text(language)).is_none_or(|functions| functions >= EMITTED.len()));
    }
    includes_in_cpp(&text(Language::C));
}

/// No width is above 1, below 0 or not a number, whatever is asked; it grows with the ratio, is 0
/// for rays and alpha at rho = 1.
#[test]
fn widths_stay_in_their_range_far_outside_of_their_domain() {
    for one in EMITTED.iter().filter(|one| one.entry["use"] == "parallax") {
        let name = one.name();
        for (point, width) in POINTS.iter().zip(one.values(&POINTS)) {
            let [_, alpha, rho, _] = *point;
            assert!((0.0..=1.0).contains(&width), "{name} at {point:?}: {width}");
            assert!(alpha * rho > 0.0 || width == 0.0, "{name} at {point:?}: {width}");
            // Fits whose powers are free hold alpha within their certificate.
            let allowed = if name.contains("power") {
                one.entry["certificate"]["max_rel"].as_f64().expect("a number")
            } else {
                1e-6
            };
            let off = f64::from((width - alpha).abs());
            assert!(rho != 1.0 || off <= allowed * f64::from(alpha), "{name} at {point:?}: {width}");
        }
        for alpha in [1e-6_f32, 0.01, 0.1, 0.3, 0.6, 1.0] {
            let rising: Vec<[f32; 4]> = (0..=600)
                .map(|i| {
                    [
                        alpha.sqrt(),
                        alpha,
                        ops::exp((-6.0 + 0.015 * f64::from(i)) * std::f64::consts::LN_10) as f32,
                        0.0,
                    ]
                })
                .collect();
            let widths = one.values(&rising);
            let falls = widths.windows(2).position(|pair| pair[1] < pair[0] * (1.0 - 1e-5));
            assert!(falls.is_none(), "{name}: falls at {:?}", falls.map(|i| rising[i]));
        }
    }
}

/// Levels are those of the chain as f64 has it, there and back.
#[test]
fn levels_go_there_and_back() {
    let chains = [
        ("linear_7", MipChain::Mapped { map: MipMap::Linear, count: 7 }),
        ("quadratic_2_5", MipChain::Mapped { map: MipMap::Steep, count: 5 }),
        ("quadratic_17_7", MipChain::Mapped { map: MipMap::Steeper, count: 7 }),
        ("log_8", MipChain::Mapped { map: MipMap::Log, count: 8 }),
        ("levels_5", MipChain::Given(vec![0.0, 0.1, 0.25, 0.5, 1.0])),
    ];
    for (identifier, chain) in chains {
        let of = |part: &str| {
            let name = format!("parallax_{part}_{identifier}");
            EMITTED.iter().find(|one| one.name() == name).unwrap_or_else(|| panic!("no {name}"))
        };
        let ramp: Vec<[f32; 4]> = (0..=1000).map(|i| [i as f32 * 1e-3, 0.0, 1.0, i as f32 * 8e-3]).collect();
        for (point, level) in ramp.iter().zip(of("level").values(&ramp)) {
            let exact = chain.level(f64::from(point[0]));
            assert!((f64::from(level) - exact).abs() < 5e-6, "{identifier} {point:?}: {level} {exact}");
        }
        let back = of("roughness").values(&ramp);
        for (point, roughness) in ramp.iter().zip(&back) {
            let mip = f64::from(point[3]).min(chain.widest());
            assert!(
                (chain.roughness(mip) - f64::from(*roughness)).abs() < 1e-6,
                "{identifier} {point:?}: {roughness}"
            );
            let level = chain.level(f64::from(*roughness));
            assert!((level - mip).abs() < 5e-6, "{identifier} {point:?}: {level}");
        }
        // At rho = 1 nothing is adjusted, but for what the chain cannot hold.
        for (point, mip) in ramp.iter().zip(of("mip").values(&ramp)) {
            let wanted = f64::from(point[3]).min(chain.widest());
            assert!((f64::from(mip) - wanted).abs() < 0.06, "{identifier} {point:?}: {mip}");
        }
    }
}

/// Adding the bias is adjusting the level, within both certificates.
#[test]
fn the_bias_of_a_logarithmic_chain_adjusts_its_level() {
    let chain = MipChain::Mapped { map: MipMap::Log, count: 8 };
    let of = |name: &str| EMITTED.iter().find(|one| one.name() == name).expect("the function");
    for prefix in ["parallax_", "parallax_ndf_"] {
        let [mip, bias] = ["mip_log_8", "bias_log"].map(|part| of(&format!("{prefix}{part}")));
        let allowed =
            [mip, bias].map(|one| one.entry["max_mips"].as_f64().expect("a number")).iter().sum::<f64>();
        assert!(allowed < 0.2, "{allowed}");
        let points: Vec<[f32; 4]> = (2..=19)
            .flat_map(|i| {
                (0..=12).map(move |j| (i as f32 * 0.05, (0.0625 * ops::exp2(0.5 * f64::from(j))) as f32))
            })
            .map(|(r, rho)| [r, r * r, rho, chain.level(f64::from(r)) as f32])
            .filter(|[_, alpha, rho, _]| *rho < 0.95 * (1.0 + alpha) / (2.0 * alpha))
            .collect();
        for ((point, adjusted), bias) in points.iter().zip(mip.values(&points)).zip(bias.values(&points)) {
            let sum = f64::from(point[3] + bias).clamp(0.0, chain.widest());
            assert!(
                (sum - f64::from(adjusted)).abs() <= allowed + 1e-3,
                "{prefix} {point:?}: {sum} {adjusted}"
            );
        }
    }
}
