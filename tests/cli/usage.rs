//! The command line: exit codes, streams, help, what is never written.

use crate::common;

use common::{lobefit, lobefit_with, names, stderr};
use lobefit::cli::output;
use lobefit::store::Written;
use serde_json::{Value, json};

const VERBS: [&str; 9] =
    ["plan", "bake", "check", "eval", "cost", "scene-from", "schema", "completions", "man"];

#[test]
fn wrong_usage_is_exit_2_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        &[][..],
        &["frobnicate"],
        &["plan", "--frobnicate"],
        &["plan", "a.json", "b.json"],
        &["bake", "--threads", "0"],
        &["bake", "--threads", "257"],
        &["bake", "--threads", "99999999999999999999"],
        &["bake", "--threads", "two"],
        &["bake", "--only", "reflections"],
        &["bake", "--only", ""],
        &["check", "--values", "-1"],
        &["check", "--values", "NaN"],
        &["check", "--values", "inf"],
        &["eval"],
        &["eval", "ggx-reflection"],
        &["eval", "no-such", "--points", "-"],
        &["eval", "ggx-reflection", "--points", "-", "--smith", "Heitz"],
        &["eval", "ggx-reflection", "--points", "-", "--tolerance", "0"],
        &["eval", "ggx-reflection", "--points", "-", "--method", "guess"],
        &["eval", "ggx-reflection", "--points", "-", "--samples", "16"],
        &["eval", "ggx-reflection", "--points", "-", "--seed", "1"],
        &["eval", "ggx-reflection", "--points", "-", "--method", "monte-carlo", "--samples", "0"],
        &["eval", "ggx-reflection", "--points", "-", "--method", "monte-carlo", "--seed", "-1"],
        &["eval", "ggx-reflection", "--points", "no-such.csv"],
        &["plan", "no-such.json"],
        &["plan", "."],
        &["bake", "no-such.json"],
        &["check", "no-such.json"],
        &["cost", "no-such.json"],
    ] {
        let output = lobefit(folder.path(), arguments, b"alpha,mu\n");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(output.stdout.is_empty(), "{arguments:?}");
        assert!(!output.stderr.is_empty(), "{arguments:?}");
        assert!(names(folder.path()).is_empty(), "{arguments:?}");
    }
}

#[test]
fn messages_name_the_option_and_what_it_takes() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, expected) in [
        (&["bake", "--threads", "0"][..], "a whole number from 1 to 256"),
        (&["bake", "--only", "reflections"], "no such effect; there are reflection, anisotropy"),
        (&["cost", "--budget", "-3"], "'--budget <COST>': a finite number above 0"),
        (&["check", "--values", "-0.001"], "'--values <TOL>': a finite number, 0 or above"),
        (
            &["eval", "no-such", "--points", "-"],
            "there are ggx-reflection, ggx-reflection-aniso, ggx-average, ggx-glass",
        ),
        (&["eval", "ggx-average", "--points", "-", "--seed", "1"], "--method monte-carlo"),
        (&["eval", "ggx-average", "--points", "-", "--draw", "ndf"], "--method monte-carlo"),
        (
            &["eval", "ggx-glass", "--points", "-", "--method", "monte-carlo", "--draw", "cosine"],
            "--draw cosine: ggx-glass draws ndf or visible",
        ),
        (
            &["eval", "sheen-charlie", "--points", "-", "--method", "monte-carlo", "--draw", "ndf"],
            "sheen-charlie has a way of its own: leave --draw out",
        ),
        (&["plan", "no-such.json"], "error: no-such.json: cannot read: "),
    ] {
        let output = lobefit(folder.path(), arguments, b"alpha\n");
        assert!(stderr(&output).contains(expected), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn every_verb_has_help_with_examples() {
    let folder = tempfile::tempdir().unwrap();
    for verb in VERBS {
        let output = lobefit(folder.path(), &[verb, "--help"], b"");
        assert_eq!(output.status.code(), Some(0));
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains(&format!("Examples:\n  lobefit {verb}")), "{text}");
        assert!(output.stderr.is_empty());
    }
    assert_eq!(lobefit(folder.path(), &["--version"], b"").status.code(), Some(0));
}

#[test]
fn plan_prints_the_keys_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let output = lobefit(folder.path(), &["plan", "--json"], b"");
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
    let plan: Value = serde_json::from_slice(&output.stdout).unwrap();
    let effect = &plan["effects"][0];
    for key in ["effect", "because", "ranges", "approximation", "bytes", "expected_error", "seconds"] {
        assert!(!effect[key].is_null(), "{key}");
    }
    let effects = plan["effects"].as_array().unwrap().iter().filter_map(|e| e["effect"].as_str());
    assert_eq!(
        effects.collect::<Vec<_>>(),
        ["reflection", "anisotropy", "glass", "diffuse-coupling", "parallax"]
    );
    assert_eq!(effect["ranges"]["roughness"], serde_json::json!([0.02, 1.0]));
    let left: Vec<&str> =
        plan["left_out"].as_array().unwrap().iter().filter_map(|l| l["effect"].as_str()).collect();
    assert_eq!(
        left,
        [
            "aniso-glass",
            "beckmann",
            "beckmann-glass",
            "beckmann-glass-outside",
            "beckmann-glass-inside",
            "glass-outside",
            "glass-inside",
            "dielectric",
            "width",
            "clearcoat",
            "eon",
            "sheen",
            "ltc",
            "occlusion"
        ]
    );
    assert!(names(folder.path()).is_empty());
}

#[test]
fn plan_reads_standard_input_and_says_when_there_is_nothing_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let output = lobefit(folder.path(), &["plan", "-"], include_bytes!("../../examples/mirrors.json"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("nothing to bake") && text.contains("no material has a rough specular lobe"),
        "{text}"
    );
}

#[test]
fn names_cannot_drive_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "{\"schema_version\":1,\"name\":\"\u{202e}evil\",\"materials\":[]}";
    let output = lobefit(folder.path(), &["plan", "-"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("scene \\u{202e}evil\n"), "{text}");
}

#[test]
fn an_output_that_cannot_be_written_is_exit_3_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "mine").unwrap();
    std::fs::create_dir(folder.path().join("web")).unwrap();
    std::fs::write(folder.path().join("web/manifest.json"), "{\"icons\":[]}").unwrap();
    std::fs::create_dir(folder.path().join("odd")).unwrap();
    std::fs::write(folder.path().join("odd/tables"), "mine").unwrap();
    for (verb, out, expected) in [
        ("bake", "file", "error: file: a file is in the way"),
        ("bake", "file/below", "error: file"),
        ("bake", "web", "not the manifest of a bake"),
        ("bake", "odd", "tables: a file is in the way"),
        ("cost", "file", "error: file: a file is in the way"),
    ] {
        let output = lobefit(folder.path(), &[verb, "--out", out], b"");
        assert_eq!(output.status.code(), Some(3), "{verb} {out}: {}", stderr(&output));
        assert!(stderr(&output).contains(expected), "{verb} {out}: {}", stderr(&output));
    }
    assert_eq!(names(folder.path()), ["file", "odd", "web"]);
    assert_eq!(std::fs::read_to_string(folder.path().join("file")).unwrap(), "mine");
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_and_a_folder_of_the_system_are_no_output() {
    let folder = tempfile::tempdir().unwrap();
    for (out, expected) in [
        ("/dev/null", "error: /dev/null: a link or device is in the way; move it"),
        ("/dev/null/below", "error: /dev/null: a link or device is in the way; move it"),
        ("/proc", "error: /proc: cannot create a file in this folder: "),
    ] {
        let output = lobefit(folder.path(), &["bake", "--out", out], b"");
        assert_eq!(output.status.code(), Some(3), "{out}: {}", stderr(&output));
        assert!(stderr(&output).starts_with(expected), "{out}: {}", stderr(&output));
        assert!(!stderr(&output).contains(".tmp"), "{out}: {}", stderr(&output));
    }
}

#[test]
fn plan_says_what_is_not_limited_and_what_is_not_yet_known() {
    let folder = tempfile::tempdir().unwrap();
    let scene = br#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":0.5}]}"#;
    let text = String::from_utf8(lobefit(folder.path(), &["plan", "-"], scene).stdout).unwrap();
    for words in [
        "; error within 0.001; at most 32768 bytes; ",
        "; no limit on the error: recommended is the cheapest within 0.02; 0 bytes; ",
        "in all at most 32768 bytes",
    ] {
        assert!(text.contains(words), "`{words}` in {text}");
    }
}

#[test]
fn bake_names_everything_that_calls_a_function() {
    let folder = tempfile::tempdir().unwrap();
    let metal = |name: &str| json!({"name": name, "kind": "metal", "f0": 0.9, "roughness": [0.4, 0.6], "wants": {"fit": {"max_ops": 8}}});
    let materials = ["a", "b", "c", "d"].map(metal);
    let scene = json!({"schema_version": 1, "languages": ["wgsl"], "materials": materials});
    let output = lobefit(folder.path(), &["bake", "-", "--no-reports"], scene.to_string().as_bytes());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("|E N - 1|  4 metals\n")
            && text.contains("\na, b, c, d: ggx_energy_compensation_rgb then f*N; 8 operations in all\n"),
        "{text}"
    );
    let include = std::fs::read_to_string(folder.path().join("fits/lobefit.wgsl")).unwrap();
    assert!(
        include.contains(" operations, and 1 more for alpha, which the lobe needs too; constants"),
        "{include}"
    );
}

#[test]
fn schema_is_one_json_document() {
    let folder = tempfile::tempdir().unwrap();
    let output = lobefit(folder.path(), &["schema"], b"");
    let schema: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(schema["title"], "Scene");
}

#[test]
fn an_effect_that_is_not_called_for_or_not_there_is_refused_with_the_reason_of_the_plan() {
    let folder = tempfile::tempdir().unwrap();
    let mirrors: &[u8] = include_bytes!("../../examples/mirrors.json");
    let rough: &[u8] =
        br#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","ior":1.5,"roughness":0.5}]}"#;
    for (scene, only, expected) in [
        (rough, "glass", "error: --only glass: no material is glass"),
        (rough, "reflection,sheen", "error: --only sheen: no material has a sheen layer"),
        (
            rough,
            "diffuse-coupling",
            "error: --only diffuse-coupling: no material is a dielectric with a diffuse base",
        ),
        (rough, "diffuse-coupling", "`m` has no `base`"),
        (mirrors, "reflection", "error: --only reflection: no material has a rough specular lobe"),
    ] {
        let output = lobefit(folder.path(), &["bake", "-", "--only", only], scene);
        assert_eq!(output.status.code(), Some(2), "{only}: {}", stderr(&output));
        assert!(stderr(&output).contains(expected), "`{expected}` in {}", stderr(&output));
        let plan: Value =
            serde_json::from_slice(&lobefit(folder.path(), &["plan", "-", "--json"], scene).stdout).unwrap();
        let refused = only.rsplit(',').next().unwrap();
        let left_out = plan["left_out"].as_array().unwrap();
        let reason = left_out.iter().find(|l| l["effect"] == refused).unwrap()["reason"].as_str().unwrap();
        assert!(stderr(&output).contains(reason), "`{reason}` in {}", stderr(&output));
        assert!(output.stdout.is_empty() && names(folder.path()).is_empty(), "{only}");
    }
    let help = String::from_utf8(lobefit(folder.path(), &["bake", "--help"], b"").stdout).unwrap();
    assert!(help.contains("keep what an older bake"), "{help}");
}

/// What cannot be kept is said before the work, in the words of the plan.
#[test]
fn a_bake_says_first_what_it_will_not_keep() {
    let folder = tempfile::tempdir().unwrap();
    let scene =
        br#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":0.9,"roughness":[0.05,1],
        "wants":{"fit":{"max_ops":3}}}]}"#;
    let output = lobefit(folder.path(), &["bake", "-", "--no-cache"], scene);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let said = stderr(&output);
    let [note, work] =
        ["note: normalisation: ", "promise not kept"].map(|words| said.find(words).expect(words));
    assert!(note < work && said.contains("and `bake` fails: the cheapest takes 5 operations"), "{said}");
}

#[test]
fn the_only_effect_asked_for_by_name_is_the_whole_bake() {
    let folder = tempfile::tempdir().unwrap();
    let scene = br#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":[0.4,0.6],
        "wants":{"tables":[{"size":[4,4],"layout":"plain"}]}}]}"#;
    let bake = |options: &[&str]| {
        let output = lobefit(folder.path(), &[&["bake", "-", "--json"], options].concat(), scene);
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
        output.stdout
    };
    assert_eq!(bake(&["--only", "reflection", "--out", "one"]), bake(&["--out", "all"]));
    for sub in ["", "tables", "fits", "reports"] {
        let [one, all] = ["one", "all"].map(|out| folder.path().join(out).join(sub));
        assert_eq!(names(&one), names(&all));
        for name in names(&one).iter().filter(|name| one.join(name).is_file()) {
            assert!(
                std::fs::read(one.join(name)).unwrap() == std::fs::read(all.join(name)).unwrap(),
                "{name}"
            );
        }
    }
}

/// What a foreign file says that its scene does not hold stands in the manifest and on the overview as `bake`
/// says it.
#[test]
fn notes_of_a_foreign_file_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let file = br#"{"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit"],"materials":[
        {"name":"sign","extensions":{"KHR_materials_unlit":{}}}]}"#;
    std::fs::write(folder.path().join("room.gltf"), file).unwrap();
    let output = lobefit(folder.path(), &["bake", "room.gltf"], b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).contains("note: sign: unlit: it has no lobe"), "{}", stderr(&output));
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&read("manifest.json")).unwrap();
    let note = json!({ "about": "reading", "of": ["sign"], "text": "unlit: it has no lobe" });
    assert_eq!(manifest["notes"], json!([note]));
    assert!(read("reports/index.html").contains("unlit: it has no lobe"));
}

#[test]
fn bake_prints_columns_and_names_its_stages_where_nobody_sees_a_bar() {
    let folder = tempfile::tempdir().unwrap();
    let scene = br#"{"schema_version":1,"formats":["exr","npy"],"materials":[{"name":"m","kind":"metal","f0":1,"roughness":[0.4,1],
        "wants":{"tables":[{"size":[8,8],"layout":"plain"}],"fit":{"max_ops":7,"norms":["max"]}}}]}"#;
    // What the cache has has no stage.
    let cache = folder.path().join("cache");
    let output = lobefit_with(&cache, folder.path(), &["bake", "-"], scene);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let (out, err) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    let lines: Vec<&str> = out.lines().collect();
    assert!(lines[0].starts_with("call  "), "{out}");
    assert!(lines[1].starts_with("  ggx_albedo  ") && lines[1].ends_with("  m"), "{out}");
    let end = |line: &str, word: &str| line.find(word).expect("the word") + word.len();
    assert_eq!(end(lines[0], "bytes"), end(lines[1], " 128"), "{out}");
    assert!(lines[2].starts_with("* ggx_energy_compensation_rgb  ") && lines[2].ends_with("  m"), "{out}");
    assert_eq!(lines[3], "arguments", "{out}");
    assert_eq!(lines[4], "  ggx_albedo(table, roughness, n_dot_v)", "{out}");
    assert_eq!(lines[5], "  ggx_energy_compensation_rgb(roughness, n_dot_v, f0)", "{out}");
    assert!(
        lines[6].starts_with("  f*N, f the lobe  ")
            && lines[6].ends_with("  N from ggx_energy_compensation_rgb")
    );
    assert!(
        lines[7].starts_with("  ggx_compensate_reflection(") && lines[7].ends_with("  e from ggx_albedo")
    );
    let lines = &lines[6..];
    assert!(lines[3].starts_with("* is recommended: the cheapest function within max_error (0.02 "), "{out}");
    let cosines = "errors of functions without a table hold over n_dot_v 0.01 to 1, the scene's `mu`";
    assert_eq!(lines[4], cosines, "{out}");
    let read = "; load ./tables/{ggx-dfg-correlated-8x8-plain.exr,ggx-dfg-correlated-8x8-plain.npy}";
    assert!(lines[5].starts_with("include ./fits/lobefit.") && lines[5].ends_with(read), "{out}");
    assert!(lines[6].contains(" files written, "), "no older bake to compare with: {out}");
    assert!(err.lines().count() >= 3 && err.starts_with("[1/"), "{err}");
    assert!(err.contains("] table ggx-dfg-correlated-8x8-plain\n"), "{err}");
    for quiet in ["--quiet", "--json"] {
        let output = lobefit(folder.path(), &["bake", "-", quiet], scene);
        assert!(output.stderr.is_empty(), "{quiet}");
    }
}

#[test]
fn counts_of_files_agree_with_their_noun() {
    let written = |n: usize| Written {
        written: vec!["a".into(); n],
        unchanged: vec!["b".into()],
        ..Written::default()
    };
    let said = [0, 1, 2].map(|n| output::files(&written(n)));
    assert_eq!(
        said,
        ["0 files written, 1 unchanged", "1 file written, 1 unchanged", "2 files written, 1 unchanged"]
    );
}
