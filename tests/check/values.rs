//! `lobefit check --values`: other texels pass within the tolerance as long as the table keeps its
//! stated error. And `--against`.

use crate::common;

use std::path::Path;

use common::{lobefit, stderr};

/// A scene whose bake takes little: a small table of samples.
const SCENE: &str = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":[0.4,1],
    "wants":{"tables":[{"size":[32,32],"layout":"plain","format":"f32"}]}}]}"#;
const TABLE: &str = "tables/ggx-dfg-correlated-32x32-f32-plain.exr";

fn bake(folder: &Path, scene: &str) {
    let output = lobefit(folder, &["bake", "-", "--quiet"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(0));
}

fn check(folder: &Path, options: &[&str]) -> (i32, String) {
    check_of(SCENE, folder, options)
}

fn check_of(scene: &str, folder: &Path, options: &[&str]) -> (i32, String) {
    let output = lobefit(folder, &[&["check", "-"], options].concat(), scene.as_bytes());
    assert_eq!(stderr(&output), "");
    (output.status.code().expect("a code"), String::from_utf8(output.stdout).expect("text"))
}

/// Flips the lowest bit of a byte of the last texel, which ends the file: 4 back is its lowest
/// byte, 1 its highest.
fn flip(path: &Path, from_end: usize) {
    let mut bytes = std::fs::read(path).expect("an image");
    let at = bytes.len() - from_end;
    bytes[at] ^= 1;
    std::fs::write(path, bytes).expect("written");
}

#[test]
fn values_pass_within_the_tolerance_while_the_promise_is_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    // The texels alone, without pages, are looked at again and again.
    let scene = SCENE.replacen("\"materials\"", r#""reports":false,"languages":["c"],"materials""#, 1);
    let check = |folder: &Path, options: &[&str]| check_of(&scene, folder, options);
    bake(folder.path(), &scene);
    let table = folder.path().join(TABLE);
    flip(&table, 4);
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("max ulp 1; promise kept at the points tried"), "{text}");
    assert!(text.contains("1 of 3 files in . differs or is missing\n"), "{text}");
    assert_eq!(check(folder.path(), &["--values", "1e-6"]).0, 0);
    assert_eq!(check(folder.path(), &["--values", "1e-12"]).0, 1);
    flip(&table, 4);
    assert_eq!(check(folder.path(), &[]).0, 0);
    // The exponent's second bit: four times the value, or a quarter.
    flip(&table, 1);
    let (code, text) = check(folder.path(), &["--values", "10"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("promise broken: lookup error"), "{text}");
    flip(&table, 1);
    std::fs::write(folder.path().join("tables/mine.exr"), "mine").expect("written");
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("3 files in . follow from their recipe, 1 extra\n"), "{text}");
    let help = lobefit(folder.path(), &["check", "--help"], b"").stdout;
    assert!(String::from_utf8_lossy(&help).contains("is never accepted, whatever --values says"));
}

/// Edits every text file of the folder's bake.
fn rewrite(folder: &Path, edit: impl Fn(String) -> String) {
    let manifest = std::fs::read_to_string(folder.join("manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_str(&manifest).expect("JSON");
    let mut files = vec!["manifest.json".to_string()];
    for list in ["includes", "reports"] {
        let entries = manifest[list].as_array().expect("a list");
        files.extend(entries.iter().map(|entry| entry["file"].as_str().expect("a file").to_owned()));
    }
    for file in files {
        let text = std::fs::read_to_string(folder.join(&file)).expect("text");
        std::fs::write(folder.join(&file), edit(text)).expect("written");
    }
}

#[test]
fn another_version_with_the_same_numbers_passes_by_its_values() {
    let folder = tempfile::tempdir().expect("a folder");
    bake(folder.path(), SCENE);
    let text = std::fs::read_to_string(folder.path().join("manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let recipe = manifest["recipe"].as_str().expect("a hash").to_owned();
    let version = env!("CARGO_PKG_VERSION");
    rewrite(folder.path(), |text| {
        text.replace(&recipe, &"0".repeat(64))
            .replace(&format!("lobefit {version}"), "lobefit 0.0.1")
            .replace(&format!("\"tool\": \"{version}\""), "\"tool\": \"0.0.1\"")
    });
    assert_eq!(check(folder.path(), &[]).0, 1);
    let (code, text) = check(folder.path(), &["--values", "0"]);
    assert_eq!(code, 0, "{text}");
    // A number is one still.
    rewrite(folder.path(), |text| text.replacen("0.001", "0.002", 1));
    assert_eq!(check(folder.path(), &["--values", "1e-4"]).0, 1);
}

#[test]
fn parts_of_a_bake_are_checked_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    bake(folder.path(), SCENE);
    std::fs::remove_file(folder.path().join("reports/index.html")).expect("a page");
    std::fs::write(folder.path().join("tables/mine.exr"), "mine").expect("written");
    let (code, text) = check(folder.path(), &["--only", "fits,manifest"]);
    assert_eq!((code, text.as_str()), (0, "7 files in . follow from their recipe\n"));
    let (code, text) = check(folder.path(), &["--only", "tables"]);
    assert_eq!(code, 1);
    assert!(text.contains("tables/mine.exr: extra") && !text.contains("index.html"), "{text}");
    assert_eq!(check(folder.path(), &["--only", "reports"]).0, 1);
    let wrong = lobefit(folder.path(), &["check", "-", "--only", "pages"], SCENE.as_bytes());
    assert_eq!(wrong.status.code(), Some(2));
}

#[test]
fn pages_are_left_out_on_request() {
    let folder = tempfile::tempdir().expect("a folder");
    let bake = ["bake", "-", "--quiet", "--no-reports"];
    assert_eq!(lobefit(folder.path(), &bake, SCENE.as_bytes()).status.code(), Some(0));
    assert!(!folder.path().join("reports/index.html").exists());
    assert_eq!(check(folder.path(), &["--no-reports"]).0, 0);
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 1);
    let said =
        "the scene changed: reports: false became true\n  without pages: lobefit check - --no-reports\n";
    assert!(text.starts_with(said), "{text}");
}

#[test]
fn a_folder_that_is_not_there_is_said_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("file"), "x").expect("written");
    for against in ["none", "file", "file/below"] {
        let output = lobefit(folder.path(), &["check", "-", "--against", against], SCENE.as_bytes());
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
        assert_eq!(stderr(&output), format!("error: --against {against}: there is no such folder\n"));
    }
}
