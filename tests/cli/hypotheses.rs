//! A hypothesis of the user's: a good one is fitted and emitted, a bad one is refused with file and
//! place, and nothing is written.

use crate::common;

use std::path::Path;

use common::{lobefit, names, stderr};

const SCENE: &str = r#"{"schema_version": 1, "pick": "all", "materials": [{"name": "m", "kind": "metal", "f0": 0.9,
  "roughness": [0.02, 1], "wants": {"fit": {"norms": ["max"], "max_ops": 13, "hypotheses": ["mine.wgsl"]}}}]}"#;

fn bake(folder: &Path, hypothesis: &str) -> (i32, String) {
    std::fs::write(folder.join("scene.json"), SCENE).expect("written");
    std::fs::write(folder.join("mine.wgsl"), hypothesis).expect("written");
    let output = lobefit(folder, &["bake", "scene.json", "--out", "out", "--json"], b"");
    (output.status.code().expect("a code"), stderr(&output))
}

#[test]
fn a_good_one_is_fitted_and_emitted() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override c: f32 = 1.0;\noverride d: f32 = 0.1;\n\
                  fn my_norm(alpha: f32, mu: f32) -> f32 { return 1.0 + alpha * (d + c * alpha * mu); }\n";
    let (code, error) = bake(folder.path(), source);
    assert_eq!((code, error.as_str()), (0, ""));
    let text = std::fs::read_to_string(folder.path().join("out/fits/lobefit.wgsl")).expect("emitted");
    assert!(text.contains("fn my_norm(alpha: f32, mu: f32) -> f32"), "{text}");
    let manifest = std::fs::read(folder.path().join("out/manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).expect("JSON");
    let fits = manifest["fits"].as_array().expect("a list");
    let fit = fits.iter().find(|f| f["name"] == "my_norm").expect("the fit");
    // Between the source's form with one constant (0.128) and what three operations reach (0.098).
    let error = fit["certificate"]["max_abs"].as_f64().expect("a number");
    assert!((0.095..0.12).contains(&error) && fit["cost"]["ops"] == 3, "{fit}");
}

#[test]
fn bad_ones_are_refused_with_their_place() {
    for (source, words) in [
        (
            "override c: f32 = 1.0;\nfn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + c * alpha / (mu - 0.5); }\n",
            ["mine.wgsl:2:", "may divide by zero near", "mu = 0.5"],
        ),
        ("fn mine(alpha: f32 -> f32 { return alpha; }", ["mine.wgsl:1:", "expected", ""]),
        (
            "fn mine(mu: f32) -> f32 {\n    let v = vec2<f32>(mu, mu);\n    return v.x;\n}\n",
            ["mine.wgsl:2:", "vectors", ""],
        ),
        ("fn mine(nu: f32) -> f32 { return nu; }\n", ["mine.wgsl:1:9", "`nu`", "roughness, mu, alpha"]),
        ("fn mine(mu: f32) -> f32 { return sqrt(mu - 0.5); }\n", ["mine.wgsl:1:", "negative", ""]),
        (
            "override c: f32 = 1.0;\nfn ggx_norm_n1(mu: f32) -> f32 { return 1.0 + c * mu; }\n",
            ["mine.wgsl", "ggx_norm_n1", "rename"],
        ),
        ("", ["mine.wgsl", "", ""]),
        ("override k: f32 = 0.1;\nfn mine() -> f32 { return 1.0 + k; }\n", ["mine.wgsl", "no argument", ""]),
        ("fn gen(mu: f32) -> f32 { return 1.0 + mu; }\n", ["mine.wgsl", "gen", "Rust"]),
        ("fn cell(mu: f32) -> f32 { return 1.0 + mu; }\n", ["mine.wgsl", "`cell`", "rename"]),
        (
            "fn ggx_compensate_glass(mu: f32) -> f32 { return 1.0 + mu; }\n",
            ["mine.wgsl", "`ggx_compensate_glass`", "rename"],
        ),
        ("fn ggx_norm_r1_rgb(mu: f32) -> f32 { return 1.0 + mu; }\n", ["mine.wgsl", "rename", ""]),
        (
            "override k: f32 = 1.0;\noverride c: f32 = 0.3712345;\n\
             fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + k * alpha * alpha / (mu - c); }\n",
            ["mine.wgsl", "", ""],
        ),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let (code, error) = bake(folder.path(), source);
        assert_eq!(code, 2, "{source}: {error}");
        for word in words {
            assert!(error.contains(word), "`{word}` in {error} for {source}");
        }
        assert_eq!(names(folder.path()), ["mine.wgsl", "scene.json"], "nothing written for {source}");
    }
}

/// Bakes with two files whose names, without folder and case, are one.
fn bake_two(folder: &Path, functions: [&str; 2]) -> (i32, String) {
    let files = ["a/my-form.wgsl", "b/My_form.wgsl"];
    for (file, function) in files.iter().zip(functions) {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("created");
        let source = format!(
            "override c: f32 = 0.3;\nfn {function}(alpha: f32, mu: f32) -> f32 {{ return 1.0 + c * alpha * alpha; }}\n"
        );
        std::fs::write(path, source).expect("written");
    }
    let scene = SCENE.replace(r#""mine.wgsl""#, &files.map(|f| format!("{f:?}")).join(","));
    std::fs::write(folder.join("scene.json"), scene.replace("\"max_ops\": 13", "\"max_ops\": 7"))
        .expect("written");
    let output = lobefit(folder, &["bake", "scene.json", "--out", "out", "--quiet"], b"");
    (output.status.code().expect("a code"), stderr(&output))
}

#[test]
fn files_may_share_a_name_and_functions_may_not() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_eq!(bake_two(folder.path(), ["one_form", "other_form"]), (0, String::new()));
    let text = std::fs::read_to_string(folder.path().join("out/fits/lobefit.rs")).expect("emitted");
    assert!(text.contains("pub fn one_form(") && text.contains("pub fn other_form("), "{text}");
    let folder = tempfile::tempdir().expect("a folder");
    let (code, error) = bake_two(folder.path(), ["one_form", "one_form"]);
    assert_eq!(code, 2, "{error}");
    assert!(error.contains("b/My_form.wgsl: function `one_form`"), "{error}");
    assert_eq!(names(folder.path()), ["a", "b", "scene.json"], "nothing written");
}

/// Every verb parses the files that a scene names, and names them where they lie; nothing that is
/// written does.
#[test]
fn files_are_read_by_plan_and_named_where_they_lie() {
    let folder = tempfile::tempdir().expect("a folder");
    let below = folder.path().join("below");
    std::fs::create_dir(&below).expect("created");
    std::fs::write(below.join("scene.json"), SCENE).expect("written");
    let run = |verb: &str| {
        let output = lobefit(folder.path(), &[verb, "below/scene.json"], b"");
        (output.status.code().expect("a code"), stderr(&output))
    };
    for (source, words, verbs) in [
        (
            None,
            "below/scene.json: materials[0].wants.fit.hypotheses[0]: below/mine.wgsl: cannot read: ",
            &["plan", "bake", "check", "cost"][..],
        ),
        (
            Some("fn mine(mu: f32 -> f32 { return mu; }"),
            "error: below/mine.wgsl:1:",
            &["plan", "bake", "check", "cost"],
        ),
        (
            Some("fn mine(nu: f32) -> f32 { return nu; }"),
            "error: below/mine.wgsl:1:9: argument `nu`",
            &["bake"],
        ),
        (
            Some("fn mine(mu: f32) -> f32 { return 1.0 / (mu - 0.5); }"),
            "error: below/mine.wgsl:1:",
            &["bake"],
        ),
        (
            Some("override c: f32 = 1.0;\nfn ggx_norm_n1(mu: f32) -> f32 { return 1.0 + c * mu; }"),
            "error: below/mine.wgsl: function",
            &["bake"],
        ),
    ] {
        if let Some(source) = source {
            std::fs::write(below.join("mine.wgsl"), source).expect("written");
        }
        for verb in verbs {
            let (code, message) = run(verb);
            assert_eq!(code, 2, "{verb}: {message}");
            assert!(message.contains(words), "{verb}: `{words}` in {message}");
        }
    }
    assert_eq!(names(folder.path()), ["below"], "nothing written");
    std::fs::write(below.join("scene.json"), SCENE.replace("\"max_ops\": 13", "\"max_ops\": 5"))
        .expect("written");
    // Too dear: it is left out with its file, and that is the path of the scene.
    std::fs::write(below.join("mine.wgsl"), "override c: f32 = 1.0;\nfn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + alpha * (c + alpha * mu); }\n").expect("written");
    let output = lobefit(folder.path(), &["bake", "below/scene.json", "--out", "out"], b"");
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let said = String::from_utf8(output.stdout).expect("text");
    assert!(said.contains("mine left out: mine.wgsl: "), "{said}");
    let written =
        |file: &str| std::fs::read_to_string(folder.path().join("out").join(file)).expect("written");
    for file in ["manifest.json", "reports/reflection.html", "reports/reflection.json"] {
        assert!(written(file).contains("mine.wgsl") && !written(file).contains("below/"), "{file}");
    }
    // The overview lists what was made, and the pages that tell the rest.
    assert!(!written("reports/index.html").contains("below/"));
}
