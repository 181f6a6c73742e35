//! Shader functions as engines write them, as channels of the quantity: clamps that hide one,
//! arguments that say nothing, domains.

use lobefit_audit::audit::{Audit, AuditedTable, Channel, Fit, Fixed, Input, Scale, Source, audit, sampled};
use lobefit_audit::foreign::{ShaderFunction, Surroundings, read_functions};
use lobefit_truth::quantity::{self, Quantity};

fn of(name: &str) -> &'static dyn Quantity {
    quantity::find(name).unwrap()
}

fn read(text: &str, file: &str, name: &str) -> ShaderFunction {
    let found = read_functions(text.as_bytes(), file, Some(name), &Surroundings::default());
    found.unwrap_or_else(|e| panic!("{e}")).remove(0)
}

fn table(text: &str, file: &str, name: &str, set: &[(&str, f64)]) -> AuditedTable {
    let set: Vec<(String, f64)> = set.iter().map(|(n, x)| (n.to_string(), *x)).collect();
    sampled(&read(text, file, name), of("ggx-reflection"), &set, &[]).unwrap_or_else(|e| panic!("{e}"))
}

/// The coordinate of a place along an axis of 128.
fn at(i: usize) -> f64 {
    (i as f64 + 0.5) / 128.0
}

#[test]
fn a_clamp_at_black_does_not_hide_the_bias() {
    let text = "
        float3 pre(float3 specular, float alpha, float c) {
            float scale = 0.5 * c + 0.25 * alpha;
            float bias = 0.125 * (1 - c) * alpha;
            return mad(specular, scale, saturate(50.0 * specular.g) * bias);
        }";
    let found = table(text, "f.hlsl", "pre", &[]);
    let names: Vec<&str> = found.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["x less f0 A, by f0 = 0.04 and 1", "x at f0 = 1"]);
    let worst = (0..128 * 128).map(|i| {
        let (alpha, c) = (at(i % 128), at(i / 128));
        (found.channels[0].values[i] - 0.125 * (1.0 - c) * alpha).abs()
    });
    let worst = worst.fold(0.0, f64::max);
    assert!(worst < 2e-7, "{worst}");
    // Without the clamp black itself is taken.
    let plain = table(&text.replace("saturate(50.0 * specular.g) * ", ""), "f.hlsl", "pre", &[]);
    assert_eq!(plain.channels[0].name, "x at f0 = 0");
}

#[test]
fn arguments_that_make_no_difference_need_no_value() {
    let text = "
        struct Material { vec3 diffuse; vec3 specular; float specularF90; float roughness; float coat; bool film; };
        vec3 albedo(const in Material material, const in float dotNV, const in int mode) {
            float a = 0.5 * dotNV, b = 0.25 * material.roughness;
            return material.film ? vec3(mode) : material.specular * a + material.specularF90 * b;
        }";
    let found = table(text, "f.glsl", "albedo", &[("material.film", 0.0), ("mode", 2.0)]);
    assert_eq!(found.axes, ["material.roughness", "dotNV"]);
    let e = &found.channels[1].values;
    assert!((e[40 * 128 + 100] - (0.5 * at(40) + 0.25 * at(100))).abs() < 1e-6);
    // A vector is set by its name.
    let set =
        [("material.specular", 1.0), ("mode", 2.0), ("material.film", 0.0), ("material.specularF90", 0.5)];
    let found = table(text, "f.glsl", "albedo", &set);
    assert!((found.channels[0].values[40 * 128 + 100] - (0.5 * at(40) + 0.125 * at(100))).abs() < 1e-6);
    let error = sampled(&read(text, "f.glsl", "albedo"), of("ggx-reflection"), &[], &[]).unwrap_err();
    assert!(error.to_string().contains("--set material.film=VALUE"), "{error}");
}

/// The audit of a function of an argument of any name and a cosine as `sheen-charlie`, at fewer
/// places than a shader's has: its truth is slow.
fn as_sheen(value: impl Fn(f64, f64) -> f64) -> Audit {
    let n = 24;
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    let values = (0..n * n).map(|i| value(at(i % n), at(i / n))).collect();
    let text = "fn f(x: f32, mu: f32) -> f32 { return x + mu; }";
    let shipped = sampled(&read(text, "f.wgsl", "f"), of("sheen-charlie"), &[], &[]).unwrap();
    let channels = vec![Channel { name: "result".into(), values }];
    let shipped = AuditedTable { size: vec![n; 2], channels, ..shipped };
    assert_eq!(shipped.source, Source::Function);
    audit(&shipped, of("sheen-charlie"), &Fixed::default(), &|_| ()).unwrap()
}

#[test]
fn all_readings_are_ranked_on_the_same_points() {
    // What is far from every reading is as far from each: no reading gains by the points at which
    // it has no truth.
    let found = as_sheen(|x, mu| 1e6 + x * mu);
    let ranks: Vec<f64> = found.tried.iter().map(|t| t.rank).collect();
    assert!(ranks.len() > 5 && ranks[ranks.len() - 1] / ranks[0] < 1.001, "{ranks:?}");
    // E of Charlie grows without bound at grazing view of narrow lobes, which excuses nothing
    // elsewhere: what is off by a fifth everywhere is no approximation of it.
    assert_eq!(as_sheen(|x, mu| 0.4 + 0.1 * lobefit_math::ops::sin(20.0 * mu) * x).fit, Fit::None);
}

#[test]
fn a_function_is_judged_in_its_domain() {
    // Right but for narrow lobes, where it is no albedo at all.
    let text = "fn f(alpha: f32, mu: f32) -> f32 { return select(1.0 - 0.48 * alpha * alpha, -3.0, alpha < 0.125); }";
    let within = |domain: &[(Input, [f64; 2])]| {
        let fixed = Fixed {
            domain: domain.to_vec(),
            axes: Some(vec![(Scale::Alpha, false), (Scale::Mu, false)]),
            ..Fixed::default()
        };
        let found = audit(&table(text, "f.wgsl", "f", &[]), of("ggx-reflection"), &fixed, &|_| ()).unwrap();
        found.channels[0].errors.as_ref().map(|e| (e.max, e.judged, e.at["alpha"])).unwrap()
    };
    let (max, judged, alpha) = within(&[]);
    assert!(max > 3.0 && judged == 128 * 128 && alpha < 0.125, "{max} {judged} {alpha}");
    let (max, judged, alpha) = within(&[(Input::Alpha, [0.125, 1.0]), (Input::Mu, [0.5, 1.0])]);
    assert!(max < 0.5 && judged == 112 * 64 && alpha >= 0.125, "{max} {judged} {alpha}");
}

#[test]
fn a_published_fit_is_named_with_the_lobe_that_it_was_made_for() {
    // The published formula with a floor, as engines ship it.
    let text = "
        fn approx(roughness: f32, mu: f32) -> vec2<f32> {
            let r = roughness * vec4<f32>(-1.0, -0.0275, -0.572, 0.022) + vec4<f32>(1.0, 0.0425, 1.04, -0.04);
            let t = min(r.x * r.x, exp2(-9.28 * mu)) * r.x + r.y;
            return max(vec2<f32>(-1.04, 1.04) * t + r.zw, vec2<f32>(0.0001));
        }";
    let table = table(text, "f.wgsl", "approx", &[]);
    let found = audit(&table, of("ggx-reflection"), &Fixed::default(), &|_| ()).unwrap();
    let known = found.published.as_ref().expect("it is published");
    assert_eq!((known.name, known.made_for.map(|form| form.word)), ("ggx_blend_karis", Some("schlick")));
    let said = found.verdict(None).to_string();
    let line = said.lines().next().expect("a line");
    assert!(line.starts_with("FAIL ") && line.contains("is `ggx_blend_karis` (B. Karis"), "{line}");
    assert!(said.contains("against height-correlated Smith by 0.4"), "{said}");
}

#[test]
fn a_function_of_f0_that_loses_nothing_has_an_albedo_of_one() {
    let text = "vec3 term(vec3 f0, float n_dot_v, float roughness) {
            float f = 0.9 * pow(1.0 - n_dot_v, 5.0) * (1.0 - roughness);
            return f0 + (1.0 - f0) * f;
        }";
    let found = audit(&table(text, "f.glsl", "term", &[]), of("ggx-reflection"), &Fixed::default(), &|_| ());
    let found = found.unwrap();
    let worst = found.channels.iter().filter_map(|c| c.errors.as_ref()).map(|e| e.max).fold(0.0, f64::max);
    assert!(found.best().columns.len() == 2 && found.fit == Fit::None && worst > 0.6, "{worst}");
}
