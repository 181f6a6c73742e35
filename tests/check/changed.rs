//! `lobefit check` of another scene than the one that was baked: the change is named, once.

use crate::common;

use common::lobefit;

const SCENE: &str = r#"{"schema_version":1,"name":"game","reports":false,"languages":["c"],"materials":[{"name":"steel","kind":"metal",
    "f0":1,"roughness":[0.4,1],"wants":{"fit":{"max_ops":9}}}]}"#;

#[test]
fn a_change_of_the_scene_is_named_with_the_command_that_bakes_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str], scene: &str| {
        let output = lobefit(folder.path(), arguments, scene.as_bytes());
        (output.status.code(), String::from_utf8(output.stdout).expect("text"))
    };
    assert_eq!(run(&["bake", "-", "--out", "assets", "--quiet"], SCENE).0, Some(0));
    assert_eq!(run(&["check", "-", "--against", "assets", "--quiet"], SCENE).0, Some(0));
    let changed = SCENE.replace("[0.4,1]", "[0.5,1]").replace("\"game\"", "\"play\"");
    let (code, text) = run(&["check", "-", "--against", "assets"], &changed);
    assert_eq!(code, Some(1), "{text}");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[..5],
        [
            "the scene changed: materials[0].roughness[0]: 0.4 became 0.5",
            "the scene changed: name: \"game\" became \"play\"",
            "files that differ: fits/lobefit.h, manifest.json",
            "numbers or code that a shader reads changed in fits/lobefit.h",
            "bake it again: lobefit bake - --out assets"
        ],
        "{text}"
    );
    assert_eq!(lines.len(), 6, "no line for each file, nor that of names alone: {text}");
    let json = run(&["check", "-", "--against", "assets", "--json"], &changed).1;
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["scene_changes"].as_array().map(Vec::len), Some(2));
    assert!(!json["differences"].as_array().expect("a list").is_empty());
    for (scene, code, said) in
        [(SCENE, 0, ""), (&changed, 1, "2 of 2 files in assets differ or are missing\n")]
    {
        let quiet = lobefit(folder.path(), &["check", "-", "--against", "assets", "-q"], scene.as_bytes());
        assert_eq!(quiet.status.code(), Some(code));
        assert_eq!((&quiet.stdout[..], &*String::from_utf8_lossy(&quiet.stderr)), (&b""[..], said));
    }
}

/// Where the changed scene cannot be baked, what changed is said before what it does not keep.
#[test]
fn a_change_that_breaks_a_promise_is_named_before_the_promise() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str], scene: &str| lobefit(folder.path(), arguments, scene.as_bytes());
    let scene = |side: u32| {
        SCENE.replace(
            r#"{"fit":{"max_ops":9}}"#,
            &format!(r#"{{"tables":[{{"size":[{side},{side}],"max_error":0.01}}]}}"#),
        )
    };
    assert_eq!(run(&["bake", "-", "--quiet"], &scene(16)).status.code(), Some(0));
    let checked = run(&["check", "-"], &scene(2));
    let said = String::from_utf8_lossy(&checked.stderr);
    assert_eq!((checked.status.code(), &checked.stdout[..]), (Some(1), &b""[..]), "{said}");
    let change = "the scene changed: materials[0].wants.tables[0].size: 16 became 2\npromise not kept: ";
    assert!(said.contains(change), "{said}");
}

/// Names change no number: `--values` does not mind them, short as they may be, and minds
/// everything else of a scene.
#[test]
fn a_renamed_material_passes_by_its_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let run =
        |arguments: &[&str], scene: &str| lobefit(folder.path(), arguments, scene.as_bytes()).status.code();
    let check = |scene: &str| run(&["check", "-", "--values", "0"], scene);
    let scene = SCENE.replace("\"reports\":false,", "").replace("steel", "a");
    assert_eq!(run(&["bake", "-", "--quiet"], &scene), Some(0));
    let renamed = scene.replace("\"a\"", r#""an \"old\" name""#).replace("game", "e");
    let plain = lobefit(folder.path(), &["check", "-"], renamed.as_bytes());
    let (code, text) = (plain.status.code(), String::from_utf8(plain.stdout).expect("text"));
    assert_eq!(code, Some(1), "{text}");
    assert!(text.ends_with("names only: `lobefit check - --values 0` passes\n"), "{text}");
    assert!(text.contains("\nno number and no code that a shader reads changed\n"), "{text}");
    assert_eq!(check(&renamed), Some(0));
    assert_eq!(check(&renamed.replace("[0.4,1]", "[0.5,1]")), Some(1));
    assert_eq!(check(&renamed.replace("\"f0\":1", "\"f0\":0.9")), Some(1));
    let manifest = folder.path().join("manifest.json");
    let text = std::fs::read_to_string(&manifest).expect("a manifest");
    std::fs::write(&manifest, text.replace("\"of\": \"a\"", "\"of\": \"b\"")).expect("written");
    assert_eq!(check(&renamed), Some(1), "a name that is none of the scene's");
    // A figure in a comment may be off, but no error may be stated smaller than it is; a constant is exact,
    // in code and in the manifest.
    let edit = |file: &str, old: &str, after: &str, new: &str| {
        let path = folder.path().join(file);
        let text = std::fs::read_to_string(&path).expect("text");
        let at = text.find(after).expect("the place") + after.len();
        std::fs::write(&path, text[..at].to_owned() + &text[at..].replacen(old, new, 1)).expect("written");
    };
    std::fs::write(&manifest, text).expect("written");
    let checked = || lobefit(folder.path(), &["check", "-", "--values", "10"], scene.as_bytes());
    edit("fits/lobefit.h", "max 0.", ": ", "max 2.");
    assert_eq!(checked().status.code(), Some(0));
    edit("fits/lobefit.h", "max 2.", ": ", "max 0.00");
    edit("manifest.json", ": 0.", "\"max_abs\"", ": 0.0");
    let said = String::from_utf8(checked().stdout).expect("text");
    let smaller = said.lines().filter(|line| line.contains("; a smaller error than is true, by ")).count();
    assert!(smaller == 2 && said.contains("2 of "), "{said}");
    edit("fits/lobefit.h", " (0.", "return 1.0f", " (0.0");
    edit("manifest.json", ": 0.", "\"coefficients\": {", ": 0.0");
    let said = String::from_utf8(checked().stdout).expect("text");
    let constants = said.lines().filter(|line| line.contains("; a constant, ")).count();
    assert!(constants == 2 && said.contains("2 of "), "{said}");
}

/// A colour is one change, and so is an index of refraction with the reflectance that follows from
/// it; neither is in the code of an energy compensation.
#[test]
fn another_reflectance_is_said_once_and_changes_no_number_of_shaders() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str], scene: &str| {
        let output = lobefit(folder.path(), arguments, scene.as_bytes());
        String::from_utf8(output.stdout).expect("text")
    };
    let plastic = SCENE.replace("metal", "dielectric");
    let said = |old: &str, new: &str| {
        run(&["bake", "-", "--quiet"], old);
        run(&["check", "-"], new)
    };
    for (old, new, change) in [
        (SCENE, SCENE.replace("\"f0\":1", "\"f0\":0.9"), "materials[0].f0: 1.0 became 0.9"),
        (SCENE, SCENE.replace("\"f0\":1", "\"f0\":[1,0.9,0.5]"), "materials[0].f0: 1.0 became [1.0,0.9,0.5]"),
        (
            &plastic.replace("\"f0\":1", "\"ior\":1.5"),
            plastic.replace("\"f0\":1", "\"ior\":1.6"),
            "materials[0].ior: 1.5 became 1.6",
        ),
    ] {
        let text = said(old, &new);
        assert_eq!(text.matches("the scene changed: ").count(), 1, "{text}");
        assert!(text.starts_with(&format!("the scene changed: {change}\n")), "{text}");
        assert!(text.contains("no number and no code that a shader reads changed\n"), "{text}");
        let baked = run(&["bake", "-"], &new);
        assert!(baked.contains("\nno number and no code that a shader reads changed\n"), "{baked}");
    }
    // A language that goes or comes is named itself, wherever it stands in the list.
    let many = SCENE.replace(r#"["c"]"#, r#"["wgsl","hlsl","c"]"#);
    run(&["bake", "-", "--quiet"], &many);
    let text = run(&["check", "-"], &many.replace(r#""hlsl","c""#, r#""c","rust""#));
    let changes = "the scene changed: languages: \"hlsl\" is gone\nthe scene changed: languages: \"rust\" is new\nfiles ";
    assert!(text.starts_with(changes), "{text}");
    // Headers of tables name the recipe: texels are compared without them, in every format.
    let table = r#"{"tables":[{"size":[8,8]}]}"#;
    let tables = SCENE
        .replace(r#"{"fit":{"max_ops":9}}"#, table)
        .replace("\"reports\"", r#""formats":["exr","dds","ktx2","npy","raw"],"reports""#);
    assert!(tables.contains(table), "{tables}");
    let text = said(&tables, &tables.replace("\"f0\":1", "\"f0\":0.9"));
    assert!(text.contains("no number and no code that a shader reads changed\n"), "{text}");
    let text = run(&["check", "-"], &tables.replace("[0.4,1]", "[0.5,1]"));
    for file in ["fits/lobefit.h", ".dds", ".exr", ".ktx2", ".npy", ".raw"] {
        let line = text.lines().find(|line| line.starts_with("numbers or code")).expect("the line");
        assert!(line.contains(file) && !line.contains(".json"), "{file}: {text}");
    }
}
