//! A bake in pieces is the bake in one run.

use std::fs;
use std::path::Path;

use crate::common::{bytes, lobefit, names, stderr};

/// Three effects, one of them with a table.
const SCENE: &str = r#"{"schema_version": 1, "languages": ["wgsl"], "materials": [
    {"name": "clay", "kind": "dielectric", "f0": 0.04, "roughness": 0, "base": {"roughness": [0.2, 0.5], "max_ops": 6}},
    {"name": "velvet", "kind": "dielectric", "f0": 0.04, "roughness": [0.4, 1], "wants": {"tables": [{"size": [8, 8]}]}}
  ], "probes": [{"name": "room", "roughness": [0.2, 1], "norms": ["max"], "max_ops": 9}]}"#;

/// Runs the program; what it says on standard error, if it ends with this code.
fn run(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = lobefit(folder, arguments, b"");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
    stderr(&output)
}

/// Makes all pieces, each in a process of its own, and merges them.
fn in_pieces(folder: &Path, of: usize) -> String {
    let shards = format!("shards-{of}");
    for number in 1..=of {
        let piece = format!("{number}/{of}");
        run(folder, &["bake", "scene.json", "--shard", &piece, "--out", &shards, "--quiet"], 0);
    }
    let out = format!("merged-{of}");
    run(folder, &["merge", "scene.json", "--shards", &shards, "--out", &out, "--quiet"], 0);
    out
}

#[test]
fn pieces_merged_are_the_bytes_of_one_run() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("scene.json"), SCENE).unwrap();
    run(at, &["bake", "scene.json", "--out", "whole", "--quiet"], 0);
    let whole = bytes(&at.join("whole"));
    assert!(whole.iter().any(|(name, _)| name == "reports/eon.html") && whole.len() > 8, "{whole:?}");
    for of in [1, 2, 7] {
        let out = in_pieces(at, of);
        assert!(bytes(&at.join(out)) == whole, "{of} pieces");
    }
    let shares: Vec<u64> = (1..=2)
        .map(|k| fs::metadata(at.join(format!("shards-2/shard-{k}-of-2.lobefit"))).unwrap().len())
        .collect();
    assert!(shares.iter().all(|bytes| *bytes > 10_000), "work for both: {shares:?}");
    refused(at);
}

/// What is missing, doubled, damaged or of something else is named, and nothing is written.
fn refused(at: &Path) {
    let merge = |expected: &[&str]| {
        let said = run(at, &["merge", "scene.json", "--shards", "shards-2", "--out", "none"], 2);
        expected.iter().for_each(|words| assert!(said.contains(words), "`{words}` in {said}"));
        assert!(!at.join("none").exists());
    };
    let of_2 = |name: &str| at.join("shards-2").join(name);
    let (first, second) = (of_2("shard-1-of-2.lobefit"), of_2("shard-2-of-2.lobefit"));
    let whole = fs::read(&second).unwrap();
    fs::remove_file(&second).unwrap();
    merge(&["shards-2: missing: shard-2-of-2.lobefit"]);
    let nowhere = run(at, &["merge", "scene.json", "--shards", "nowhere", "--out", "none"], 2);
    assert!(nowhere.contains("--shards nowhere: there is no such folder"), "{nowhere}");
    fs::copy(&first, of_2("again.lobefit")).unwrap();
    merge(&["shard-1-of-2.lobefit: shard 1 of 2, as ", "again.lobefit is"]);
    fs::remove_file(of_2("again.lobefit")).unwrap();
    fs::copy(at.join("shards-7/shard-2-of-7.lobefit"), &second).unwrap();
    merge(&["shard-2-of-2.lobefit: a shard of 7, ", "shard-1-of-2.lobefit is one of 2"]);
    for damaged in [&whole[..whole.len() - 1], b"no shard", b""] {
        fs::write(&second, damaged).unwrap();
        merge(&["shard-2-of-2.lobefit: not a whole shard of a bake"]);
    }
    let head = String::from_utf8_lossy(&whole[..whole.iter().position(|byte| *byte == b'\n').unwrap()]);
    let build = head.split("\"build\":\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
    let mut other = whole.clone();
    let place = whole.windows(build.len()).position(|bytes| bytes == build.as_bytes()).unwrap();
    other[place..place + build.len()].fill(b'0');
    fs::write(&second, other).unwrap();
    merge(&["shard-2-of-2.lobefit: made by another build of lobefit"]);
    fs::write(&second, &whole).unwrap();
    fs::write(at.join("scene.json"), SCENE.replace("0.04", "0.05")).unwrap();
    merge(&["shard-1-of-2.lobefit: a shard of recipe ", "this scene's is "]);
}

#[test]
fn a_piece_that_is_none_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for piece in ["0/2", "3/2", "1", "a/b", "1/1025", "1/18446744073709551615"] {
        let said = run(folder.path(), &["bake", "--shard", piece], 2);
        assert!(said.contains("K/N with whole numbers, K from 1 to N"), "{said}");
    }
    let said = run(folder.path(), &["bake", "--shard", "1/2", "--only", "glass"], 2);
    assert!(said.contains("cannot be used with"), "{said}");
    assert!(names(folder.path()).is_empty());
}

/// A promise that is not kept fails in the piece that finds it.
#[test]
fn a_broken_promise_leaves_no_piece() {
    let folder = tempfile::tempdir().unwrap();
    let scene = SCENE.replace(r#""size": [8, 8]"#, r#""size": [8, 8], "max_error": 1e-9"#);
    fs::write(folder.path().join("scene.json"), scene).unwrap();
    let codes: Vec<Option<i32>> = ["1/2", "2/2"]
        .iter()
        .map(|piece| {
            let words = ["bake", "scene.json", "--shard", piece, "--out", "shards"];
            lobefit(folder.path(), &words, b"").status.code()
        })
        .collect();
    assert!(codes.contains(&Some(1)) && codes.contains(&Some(0)), "{codes:?}");
    assert_eq!(names(&folder.path().join("shards")).len(), 1);
}
