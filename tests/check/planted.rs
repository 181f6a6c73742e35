//! `lobefit check`: a planted change is found and named.

use crate::common;

use std::path::Path;

use common::{lobefit, stderr};
use lobefit::emit::exr;

/// A table as the built-in scene wants it, and the cheapest fits.
const SCENE: &str = r#"{"schema_version":1,"pick":"all","materials":[{"name":"m","kind":"metal","f0":1,"roughness":[0.02,1],
    "wants":{"tables":[{"size":[32,32],"serves":"albedo"}],"fit":{"max_ops":7,"norms":["max"]}}}]}"#;

/// The same table alone.
const TABLE: &str = r#"{"schema_version":1,"pick":"all","materials":[{"name":"m","kind":"metal","f0":1,"roughness":[0.02,1],
    "wants":{"tables":[{"size":[32,32],"serves":"albedo"}]}}]}"#;

/// The bake of a scene in a folder of its own, beside the scene.
fn baked(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.json"), scene).expect("written");
    let output = lobefit(folder.path(), &["bake", "scene.json", "--quiet"], b"");
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    folder
}

fn check(folder: &Path, options: &[&str]) -> (i32, String) {
    let output = lobefit(folder, &[&["check"], options].concat(), b"");
    assert_eq!(stderr(&output), "");
    let text = String::from_utf8(output.stdout).expect("text");
    (output.status.code().expect("a code"), text)
}

/// Flips the last bit of the last texel: with uncompressed scan lines it ends the file.
fn flip_last_texel(path: &Path) {
    let mut bytes = std::fs::read(path).expect("an image");
    let last = bytes.len() - 2;
    bytes[last] ^= 1;
    exr::decode(&bytes).expect("still an image");
    std::fs::write(path, bytes).expect("written");
}

#[test]
fn planted_changes_are_found_and_named() {
    let folder = baked(SCENE);
    let at = |name: &str| folder.path().join(name);
    flip_last_texel(&at("tables/ggx-dfg-correlated-32x32.exr"));
    let rust = std::fs::read_to_string(at("fits/lobefit.rs")).expect("text");
    let changed = rust.replacen("1.0 + 2.5", "1.0 + 2.6", 1);
    assert_ne!(rust, changed, "the refitted constant of the source's form begins with 2.5");
    std::fs::write(at("fits/lobefit.rs"), changed).expect("written");
    std::fs::remove_file(at("fits/lobefit.wgsl")).expect("removed");
    std::fs::write(at("tables/stale.exr"), b"old").expect("written");
    std::fs::write(at("reports/timings.json"), b"measured").expect("written");
    let (code, text) = check(folder.path(), &["scene.json"]);
    assert_eq!(code, 1, "{text}");
    for words in [
        "tables/ggx-dfg-correlated-32x32.exr: channel loss, column 31, row 31",
        "max ulp 1",
        "promise broken: lookup error",
        "fits/lobefit.rs: line ",
        "a constant of a function, 9.99",
        "fits/lobefit.wgsl: missing",
        "tables/stale.exr: extra",
        "3 of ",
        " files in . differ or are missing, 1 extra",
    ] {
        assert!(text.contains(words), "`{words}` in\n{text}");
    }
    assert!(!text.contains("timings"), "{text}");
}

#[test]
fn a_broken_promise_is_never_within_a_tolerance() {
    let folder = baked(TABLE);
    flip_last_texel(&folder.path().join("tables/ggx-dfg-correlated-32x32.exr"));
    for tolerance in ["1e-9", "1e-3", "1"] {
        let (code, text) = check(folder.path(), &["scene.json", "--values", tolerance, "--json"]);
        assert_eq!(code, 1, "{text}");
        let verdict: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(verdict["differences"][0]["at"], "channel loss, column 31, row 31");
        assert_eq!(verdict["differences"][0]["max_ulp"], 1);
        assert_eq!(verdict["differences"][0]["promise_kept"], false);
    }
}
