//! Shader functions as engines write them, as channels of the quantity: clamps that hide one,
//! arguments that say nothing, domains.

use lobefit_audit::audit::{
    Audit, AuditedTable, Channel, Column, Fit, Fixed, Form, Input, Scale, Source, audit, sampled,
};
use lobefit_audit::foreign::{ShaderFunction, Surroundings, read_functions};
use lobefit_truth::quantity::{self, Quantity};

use crate::common::{lobefit, stderr};
use crate::support::says;

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
fn point_12_a_clamp_at_black_does_not_hide_the_bias() {
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
fn point_12_arguments_that_make_no_difference_need_no_value() {
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
    let values: Vec<f64> = (0..n * n).map(|i| value(at(i % n), at(i / n))).collect();
    let text = "fn f(x: f32, mu: f32) -> f32 { return x + mu; }";
    let shipped = sampled(&read(text, "f.wgsl", "f"), of("sheen-charlie"), &[], &[]).unwrap();
    let channels = vec![Channel { name: "result".into(), values: values.into() }];
    let shipped = AuditedTable { size: vec![n; 2], channels, ..shipped };
    assert_eq!(shipped.source, Source::Function);
    audit(&shipped, of("sheen-charlie"), &Fixed::default(), &|_| ()).unwrap()
}

#[test]
fn point_12_all_readings_are_ranked_on_the_same_points() {
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
fn point_12_a_function_is_judged_in_its_domain() {
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
fn point_12_a_function_of_f0_that_loses_nothing_has_an_albedo_of_one() {
    let text = "vec3 term(vec3 f0, float n_dot_v, float roughness) {
            float f = 0.9 * pow(1.0 - n_dot_v, 5.0) * (1.0 - roughness);
            return f0 + (1.0 - f0) * f;
        }";
    let found = audit(&table(text, "f.glsl", "term", &[]), of("ggx-reflection"), &Fixed::default(), &|_| ());
    let found = found.unwrap();
    let worst = found.channels.iter().filter_map(|c| c.errors.as_ref()).map(|e| e.max).fold(0.0, f64::max);
    assert!(found.best().columns.len() == 2 && found.fit == Fit::None && worst > 0.6, "{worst}");
}

/// Karis' fit for mobile GPUs, with what stands around it.
fn karis(head: &str, result: &str) -> String {
    format!(
        "{head}float roughness, float nov) {{
            float4 r = roughness * float4(-1, -0.0275, -0.572, 0.022) + float4(1, 0.0425, 1.04, -0.04);
            float a004 = min(r.x * r.x, exp2(-9.28 * nov)) * r.x + r.y;
            float2 ab = float2(-1.04, 1.04) * a004 + r.zw;
            return {result};
        }}"
    )
}

/// Karis' fit had "no approximation under any reading": it is named with the lobe that it was made for,
/// also behind a floor or a clamp, as engines ship it, and held against the one of the use, or the one
/// that is stated. Its error was that of the nearest lobe, 0.196 of A.
#[test]
fn point_04_karis_fit_is_named_with_the_lobe_that_it_was_made_for() {
    for (head, result, far) in [
        ("float2 karis(", "max(ab, 0.0001)", "0.478"),
        ("float3 karis(float3 f0, ", "saturate((f0 * ab.x + ab.y) * 1.0)", "0.526"),
    ] {
        let table = table(&karis(head, result), "f.hlsl", "karis", &[]);
        let found = audit(&table, of("ggx-reflection"), &Fixed::default(), &|_| ()).unwrap();
        let known = found.published.as_ref().expect("it is published");
        assert_eq!((known.name, known.made_for.map(|form| form.word)), ("ggx_blend_karis", Some("schlick")));
        let usual = format!(
            "is `ggx_blend_karis`, made for Schlick-Smith with k = alpha/2: against height-correlated Smith off by at most {far} of "
        );
        let own = "held against that it is off by at most 0.";
        says(&found.verdict(None), "FAIL", &[&usual, ": B. Karis, ", own, "say so (`--smith schlick`)"]);
        // A meaning that its results do not have is named.
        let swapped: Vec<_> = known.columns.iter().rev().copied().collect();
        let stated = Fixed { meanings: Some(swapped), ..Fixed::default() };
        let swapped = audit(&table, of("ggx-reflection"), &stated, &|_| ()).unwrap();
        says(&swapped.verdict(None), "FAIL", &["is not what --meaning says"]);
        let stated = Fixed { form: Form::find("schlick"), ..Fixed::default() };
        let found = audit(&table, of("ggx-reflection"), &stated, &|_| ()).unwrap();
        let text = found.verdict(None).to_string();
        assert!(["`ggx_blend_karis`", "Schlick-Smith with k = alpha/2"].iter().all(|own| text.contains(own)));
        assert!(!found.best().columns.contains(&Some(Column::Share)), "{:?}", found.best());
    }
}

/// With arguments whose names say nothing its albedo passed as that of separable Smith over alpha.
#[test]
fn a_published_fit_is_named_whatever_its_arguments_are_called() {
    for [rough, cosine] in [["r", "nov"], ["x", "y"]] {
        let text = karis("float karis(", "ab.x + ab.y").replace("roughness", "rough");
        let text = text.replace("float4 r =", "float4 q =").replace("r.", "q.").replace("nov", cosine);
        let function = table(&text.replace("rough", rough), "f.hlsl", "karis", &[]);
        let found = audit(&function, of("ggx-reflection"), &Fixed::default(), &|_| ()).unwrap();
        assert_eq!(found.published.as_ref().map(|known| known.name), Some("ggx_blend_karis"), "{rough}");
        assert!(!found.fixed && found.best().axes[0].scale == Scale::Roughness, "{:?}", found.best());
        says(&found.verdict(None), "FAIL", &["is `ggx_blend_karis`, made for Schlick-Smith"]);
    }
}

/// At an f0 of 1 it has f0 A + B, the albedo, and no A, however near that is to it in a domain.
#[test]
fn a_function_of_f0_has_an_albedo_at_one() {
    let fitted = karis("float3 karis(float3 f0, ", "f0 * ab.x + ab.y");
    let domain = vec![(Input::Mu, [0.05, 1.0]), (Input::Alpha, [0.01, 1.0])];
    let fixed = Fixed { domain, ..Fixed::default() };
    let found =
        audit(&table(&fitted, "f.hlsl", "karis", &[]), of("ggx-reflection"), &fixed, &|_| ()).unwrap();
    assert_eq!(found.best().columns, [Some(Column::B), Some(Column::E)]);
    says(&found.verdict(None), "FAIL", &["against height-correlated Smith off by at most 0.39"]);
}

/// A chunk of a library of scripts with what killed the whole file: a macro and a helper elsewhere,
/// functions under conditions, overloads, an unknown type and a texture in functions that are not asked
/// for.
const CHUNK: &str = "export default /* glsl */ `
#include <common>
uniform sampler2D lut;
void light( const in Nowhere light, inout Reflected out_ ) { out_.x = unknown( light.y ); }
float fetched( vec2 uv ) { return texture2D( lut, uv ).x; }
#if QUALITY > 1
    float albedo( const in float roughness, const in float dotNV ) { return nowhere( dotNV ); }
#elif defined( BASE )
    float albedo( const in float roughness, const in float dotNV ) {
        return saturate( BASE - pow2( roughness ) * ( 0.27 + 0.48 * dotNV ) );
    }
#endif
vec3 albedo( const in vec3 f0, const in float roughness, const in float dotNV ) { return f0 * albedo( roughness, dotNV ); }
`;
";
const COMMON: &str = "export default `
#define saturate( a ) clamp( a, 0.0, 1.0 )
float pow2( const in float x ) { return x * x; }
`;
";

/// One of 18 shader files could be read as it was shipped.
#[test]
fn point_11_a_function_is_read_and_not_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    std::fs::create_dir(folder.path().join("chunks")).unwrap();
    write("chunks/common.glsl.js", COMMON);
    write("chunk.glsl.js", CHUNK);
    let run = |file: &str, more: &[&str]| {
        let output =
            lobefit(folder.path(), &[&["audit", file, "--as", "ggx-reflection"], more].concat(), b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
    };
    let whole = ["--function", "albedo(float, float)", "--define", "BASE=1.0", "--include", "chunks"];
    let (code, out, err) = run("chunk.glsl.js", &whole);
    assert_eq!(code, Some(0), "{out}{err}");
    // Least squares over a lattice left 0.18 at most, 0.047 RMS.
    let line = "ggx-reflection E: albedo (chunk.glsl.js) is off by at most 0.";
    assert!(out.contains(line) && out.contains("of height-correlated Smith"), "{out}");
    assert!(out.contains("roughness given roughness") && out.contains("dotNV given mu"), "{out}");
    for (less, words) in [
        (&whole[..4], "not included: `#include <common>` at chunk.glsl.js: 2:1"),
        (&[&whole[..2], &whole[4..]].concat(), "`#if QUALITY > 1` at chunk.glsl.js: 6:1"),
        (
            &["--function", "albedo", "--define", "BASE=1.0", "--include", "chunks"],
            "choose one by --function",
        ),
        (&[&whole[..], &["--define", "QUALITY=2"]].concat(), "nowhere"),
    ] {
        let (code, out, err) = run("chunk.glsl.js", less);
        assert!(code == Some(2) && out.is_empty() && err.contains(words), "{words}: {err}");
    }
    // HLSL, which had "no array of at least 8 numbers", beside a buffer and a texture.
    let hlsl = "cbuffer View { float4x4 world; };\nTexture2D lut; SamplerState linear_clamp;\n        float fetched(float2 uv) { return lut.Sample(linear_clamp, uv).x; }\n        float albedo(float roughness, float n_dot_v) {\n            return saturate(1 - roughness * roughness * mad(0.48, n_dot_v, 0.27));\n}\n";
    write("brdf.hlsl", hlsl);
    let (code, said, err) = run("brdf.hlsl", &["--function", "albedo"]);
    assert_eq!(code, Some(0), "{said}{err}");
    let figure =
        |said: &str| said.split(" is off by ").nth(1).unwrap().split(" (").next().unwrap().to_string();
    assert_eq!(figure(&said), figure(&out));
    // Without a name, what can be read is listed.
    let (code, _, err) = run("chunk.glsl.js", &whole[2..]);
    assert!(code == Some(2) && err.contains("`albedo(float, float)`, `albedo(vec3, float, float)`"), "{err}");
}

/// The functions that the built-in scene is baked to.
const BAKED: &str = include_str!("../../../../../fits/lobefit.wgsl");

/// The whole of a verdict as the program prints it.
fn printed(text: &str, function: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("f.wgsl"), format!("{BAKED}{text}")).unwrap();
    let asked = ["audit", "f.wgsl", "--as", "ggx-reflection", "--function", function];
    let output = lobefit(folder.path(), &asked, b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    String::from_utf8(output.stdout).unwrap()
}

/// Names of arguments are trusted, so that a call with two of them in the wrong order followed nothing.
#[test]
fn arguments_in_the_wrong_order_are_named() {
    let call = "ggx_energy_compensation(roughness, n_dot_v)";
    let right = format!("fn own(n_dot_v: f32, roughness: f32) -> f32 {{ return 1.0 / {call}; }}");
    assert!(printed(&right, "own").starts_with("PASS ggx-reflection E: own"));
    let wrong = right.replace("(roughness, n_dot_v)", "(n_dot_v, roughness)");
    let said = printed(&wrong, "own");
    assert!(
        said.starts_with("FAIL ") && said.contains("is not what the names of its arguments say"),
        "{said}"
    );
    assert!(said.contains("n_dot_v and roughness stand in the wrong order"), "{said}");
    assert!(said.contains("Without the names of its arguments: PASS ggx-reflection E"), "{said}");
    // Names that say nothing are in no order; what follows nothing in either has no second verdict.
    let karis = "
        fn own(x: f32, q: f32, f0: f32) -> f32 {
            let r = q * vec4<f32>(-1.0, -0.0275, -0.572, 0.022) + vec4<f32>(1.0, 0.0425, 1.04, -0.04);
            let a = min(r.x * r.x, exp2(-9.28 * x)) * r.x + r.y;
            return f0 * (-1.04 * a + r.z) + 1.04 * a + r.w;
        }";
    let said = printed(karis, "own");
    assert!(said.contains("`ggx_blend_karis`") && !said.contains("wrong order"), "{said}");
    let nothing =
        "fn own(n_dot_v: f32, roughness: f32) -> f32 { return sin(20.0 * n_dot_v) * cos(9.0 * roughness); }";
    let said = printed(nothing, "own");
    assert!(said.starts_with("UNKNOWN ") && !said.contains("names"), "{said}");
}

#[test]
fn a_constant_factor_of_a_function_is_found() {
    let over =
        "fn own(r: f32, n_dot_v: f32) -> f32 { return 0.3183099 / ggx_energy_compensation(r, n_dot_v); }";
    let said = printed(over, "own");
    assert!(said.starts_with("FAIL ") && said.contains("divide its values by 1/pi"), "{said}");
}

/// A formula that follows a reading within what approximations leave on average, but not by far at its worst.
#[test]
fn a_formula_of_something_else_is_no_pass() {
    let mixed = "fn own(n_dot_v: f32, alpha: f32) -> f32 { return mix(1.0, 0.4, alpha); }";
    let said = printed(mixed, "own");
    assert!(said.starts_with("UNKNOWN ") && said.contains("it may be of something else"), "{said}");
}

/// A loop over 1024 samples, as renderers have it, takes fewer places.
#[test]
#[ignore = "six seconds of two cores: .ci/nightly"]
fn nightly_a_loop_over_samples_is_taken_at_fewer_places() {
    let text = "
        fn own(n_dot_v: f32, roughness: f32) -> f32 {
            var sum = 0.0;
            for (var i = 0; i < 1024; i = i + 1) {
                let r = roughness + 1e-6 * sin(f32(i));
                sum = sum + 1.0 / ggx_energy_compensation(r, n_dot_v);
            }
            return sum / 1024.0;
        }";
    let said = printed(text, "own");
    let line = said.lines().next().unwrap();
    assert!(line.starts_with("PASS ggx-reflection E: own") && !line.contains("16384"), "{said}");
}

/// What its name says it is not: whoever calls it with alpha gets another error.
#[test]
fn a_roughness_called_alpha_stands_in_the_first_line() {
    let folder = tempfile::tempdir().unwrap();
    let code = "fn average(alpha: f32) -> f32 { return 1.0 - alpha * alpha * (0.41 + 0.18 * alpha); }\n";
    std::fs::write(folder.path().join("average.wgsl"), code).unwrap();
    let audited = ["audit", "average.wgsl", "--as", "ggx-average", "--function", "average"];
    let output = lobefit(folder.path(), &audited, b"");
    let out = String::from_utf8_lossy(&output.stdout).into_owned();
    let first = out.lines().next().unwrap_or_default();
    assert!(first.contains("(alpha is a roughness, whose square alpha is)"), "{out}{}", stderr(&output));
}
