//! `lobefit audit --isa`: what somebody else's function costs, beside ours.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::common::{lobefit, lobefit_with, stderr};

/// Karis, "Physically Based Shading on Mobile", 2014.
const GLSL: &str = "vec3 EnvBRDFApprox(vec3 SpecularColor, float Roughness, float NoV)
{
    const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
    const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
    vec4 r = Roughness * c0 + c1;
    float a004 = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    vec2 AB = vec2(-1.04, 1.04) * a004 + r.zw;
    return SpecularColor * AB.x + AB.y;
}
";

/// The same, beside a function that reads a texture and is not compiled with it.
const WGSL: &str = "const c0 = vec4<f32>(-1.0, -0.0275, -0.572, 0.022);
const c1 = vec4<f32>(1.0, 0.0425, 1.04, -0.04);
@group(0) @binding(0) var lut: texture_2d<f32>;
@group(0) @binding(1) var linear: sampler;
fn fetched(at: vec2<f32>) -> f32 { return textureSampleLevel(lut, linear, at, 0.0).x; }
fn EnvBRDFApprox(SpecularColor: vec3<f32>, Roughness: f32, NoV: f32) -> vec3<f32> {
    let r = Roughness * c0 + c1;
    let a004 = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    let AB = vec2<f32>(-1.04, 1.04) * a004 + r.zw;
    return SpecularColor * AB.x + AB.y;
}
";

/// What the verb prints of a file; none where what compiles is not there and not required.
fn run(cache: &Path, folder: &Path, file: &str, options: &[&str]) -> Option<String> {
    let all = ["audit", file, "--as", "ggx-reflection", "--function", "EnvBRDFApprox", "--isa"];
    let output = lobefit_with(cache, folder, &[&all, options].concat(), b"");
    let error = stderr(&output);
    if error.contains("lobefit-gpu is not built") || error.contains("no driver radv") {
        let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
        assert!(!required, "{error}");
        eprintln!("skipped: {error}");
        return None;
    }
    assert_eq!(output.status.code(), Some(0), "{error}");
    Some(String::from_utf8(output.stdout).expect("text"))
}

fn families(printed: &str) -> Vec<Value> {
    let found: Value = serde_json::from_str(printed).expect("JSON");
    found["cost"]["families"].as_array().expect("families").clone()
}

/// Vector instructions, and all in those of full rate.
fn counts(of: &Value) -> [i64; 2] {
    let [vector, transcendental] =
        ["vector", "transcendental"].map(|name| of[name].as_i64().expect("a count"));
    [vector, vector + 4 * transcendental]
}

#[test]
fn a_published_fit_stands_beside_ours_and_a_multiply_add_more_is_counted() {
    let (cache, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (cache, folder) = (cache.path(), folder.path());
    fs::write(folder.join("karis.glsl"), GLSL).unwrap();
    fs::write(folder.join("karis.wgsl"), WGSL).unwrap();
    let dearer = WGSL.replace("* r.x + r.y;", "* r.x + r.y + 0.001 * NoV;");
    assert_ne!(dearer, WGSL);
    fs::write(folder.join("dearer.wgsl"), dearer).unwrap();

    let Some(glsl) = run(cache, folder, "karis.glsl", &["--json"]) else { return };
    let json = |file: &str| run(cache, folder, file, &["--json"]).expect("as before");
    let (glsl, wgsl, dearer) =
        (families(&glsl), families(&json("karis.wgsl")), families(&json("dearer.wgsl")));
    assert_eq!(glsl.len(), 3);
    for ((glsl, wgsl), dearer) in glsl.iter().zip(&wgsl).zip(&dearer) {
        let audited = &glsl["audited"];
        assert_eq!(audited, &wgsl["audited"], "the language is no cost");
        let ([vector, issued], error) = (counts(audited), audited["error"].as_f64().expect("compared"));
        // Published: 0.504 at most against height-correlated Smith for E, and less for B.
        assert!((0.4..0.55).contains(&error), "{error}");
        assert!((10..30).contains(&vector) && issued == vector + 4, "one exp2: {audited}");
        assert!(counts(&dearer["audited"])[0] > vector, "{audited}, {dearer}");
        let [cheapest, accurate] = ["cheapest", "most_accurate"].map(|which| &glsl[which]);
        let error_of = |of: &Value| of["error"].as_f64().unwrap_or_else(|| panic!("{glsl}"));
        assert!(error_of(cheapest) <= error && error_of(accurate) <= error_of(cheapest), "{glsl}");
        assert!(counts(accurate)[1] <= issued && counts(cheapest)[1] <= counts(accurate)[1], "{glsl}");
        assert!(cheapest["function"].as_str().is_some_and(|name| name.starts_with("ggx_blend_")));
    }

    let text = run(cache, folder, "karis.wgsl", &["--out", "report"]).expect("as before");
    let domain = "Max error: that of f0 A + B for the worst f0 of height-correlated Smith, over alpha 0.0004 to 1 and mu 0.01 to 1.";
    let (_, table) = text.split_once(domain).unwrap_or_else(|| panic!("{text}"));
    let page = include_str!("../../../../docs/audit.md");
    let compiler = text.split("by ").find(|rest| rest.starts_with("radv-")).expect("a compiler");
    if page.contains(compiler.split(',').next().expect("its version")) {
        assert!(page.contains(table.trim()), "docs/audit.md shows other rows than these: {table}");
    }
    let lines = |family: &str| text.lines().filter(|line| line.starts_with(family)).count();
    assert!(["polaris10", "navi21", "gfx1100"].iter().all(|of| (2..=3).contains(&lines(of))), "{text}");
    let page = fs::read_to_string(folder.join("report/karis.wgsl.audit.html")).unwrap();
    assert!(page.contains("Compiled instructions") && page.contains("EnvBRDFApprox --isa"), "its command");
}

#[test]
fn what_cannot_be_compiled_is_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("f.wgsl"),
        "fn f(alpha: f32, mu: f32) -> f32 { return 1.0 - 0.4 * alpha * mu; }",
    )
    .unwrap();
    fs::write(folder.path().join("t.h"), "const float t[4] = {1.0f, 0.5f, 0.25f, 0.125f};").unwrap();
    let table = lobefit(folder.path(), &["audit", "t.h", "--as", "ggx-average", "--isa"], b"");
    assert_eq!(table.status.code(), Some(2));
    assert!(stderr(&table).contains("--isa: t.h is read as a table"), "{}", stderr(&table));
    // Where there is no driver, Debian's package is named.
    let output = Command::new(env!("CARGO_BIN_EXE_lobefit-audit"))
        .args(["f.wgsl", "--as", "beckmann-reflection", "--isa"])
        .env("VK_DRIVER_FILES", "no-driver.json")
        .env("VK_ICD_FILENAMES", "no-driver.json")
        .current_dir(folder.path())
        .output()
        .unwrap();
    let error = stderr(&output);
    assert_eq!((output.status.code(), output.stdout.is_empty()), (Some(2), true), "{error}");
    let named = ["mesa-vulkan-drivers", "cargo build --release -p lobefit-gpu"];
    assert!(named.iter().any(|what| error.contains(what)), "{error}");
}
