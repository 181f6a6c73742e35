//! Output folders and caches that are shared, lead elsewhere, go away, or may not be written.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use crate::common::{bytes, first_stage, lobefit, lobefit_with, names, signal, start, stderr};

/// A table that takes some tenths of a second.
const SCENE: &str = r#"{"schema_version": 1, "reports": false, "languages": ["wgsl"], "materials": [
    {"name": "steel", "kind": "metal", "f0": 0.6, "roughness": [0.9, 1], "wants": {"tables": [{"size": [16, 16]}]}}
]}"#;

/// A bake that computes everything, and so is at work for a while after its first stage.
const SLOW: [&str; 5] = ["bake", "scene.json", "--out", "out", "--no-cache"];
const WARM: [&str; 5] = ["bake", "scene.json", "--out", "out", "--quiet"];

/// A folder with the scene, and what its bake gives.
fn scene() -> (tempfile::TempDir, Vec<(String, Vec<u8>)>) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), SCENE).unwrap();
    let output = lobefit(folder.path(), &["bake", "scene.json", "--out", "whole"], b"");
    assert!(output.status.success(), "{}", stderr(&output));
    let whole = bytes(&folder.path().join("whole"));
    assert!(whole.len() > 2, "{:?}", names(&folder.path().join("whole")));
    (folder, whole)
}

fn assert_ends(output: &Output, code: i32, words: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{said}");
    assert!(said.contains(words), "`{words}` in {said}");
}

/// Runs a slow bake; once it is at work, it stands still while `meddle` changes what lies around it.
fn meddled(mut child: Child, meddle: impl FnOnce()) -> Output {
    first_stage(&mut child);
    signal(&child, "STOP");
    meddle();
    signal(&child, "CONT");
    child.wait_with_output().unwrap()
}

fn slow(at: &Path) -> Child {
    start(&at.join("cache"), at, &SLOW)
}

/// The second of two bakes into one folder is refused before its work.
#[test]
fn of_two_bakes_into_one_folder_the_second_is_refused() {
    const BUSY: &str = "error: out: another lobefit is writing to this folder; wait for it";
    let (folder, whole) = scene();
    let at = folder.path();
    fs::create_dir(at.join("out")).unwrap();
    let first = meddled(slow(at), || {
        assert_ends(&lobefit(at, &WARM, b""), 3, BUSY);
        assert!(names(&at.join("out")).is_empty(), "it has written nothing");
    });
    assert_ends(&first, 0, "");
    assert!(bytes(&at.join("out")) == whole);
    // A folder that neither finds cannot be locked before it is made: both work, and where they come to
    // write at once, one of them does.
    for _ in 0..5 {
        fs::remove_dir_all(at.join("out")).unwrap();
        let both = std::thread::scope(|scope| {
            let runs = [(); 2].map(|()| scope.spawn(|| lobefit(at, &WARM, b"")));
            runs.map(|run| run.join().unwrap())
        });
        both.iter().filter(|output| !output.status.success()).for_each(|output| assert_ends(output, 3, BUSY));
        assert!(both.iter().any(|output| output.status.success()));
        assert!(bytes(&at.join("out")) == whole);
    }
}

#[test]
fn a_folder_that_is_removed_in_mid_run_is_made_again() {
    let (folder, whole) = scene();
    let at = folder.path();
    let out = at.join("out");
    fs::create_dir(&out).unwrap();
    let output = meddled(slow(at), || fs::remove_dir(&out).unwrap());
    assert_ends(&output, 0, "");
    assert!(bytes(&out) == whole);
    // One that somebody else makes again is locked all the same.
    fs::remove_dir_all(&out).unwrap();
    fs::create_dir(&out).unwrap();
    let output = meddled(slow(at), || {
        fs::remove_dir(&out).unwrap();
        fs::create_dir(&out).unwrap();
    });
    assert_ends(&output, 0, "");
    assert!(bytes(&out) == whole);
    // The folder that the program stands in cannot be made again.
    let output = meddled_here(at);
    assert_ends(&output, 3, "error: ");
    assert!(!at.join("here").exists());
}

/// Removes the current folder of a bake into it.
fn meddled_here(at: &Path) -> Output {
    let here = at.join("here");
    fs::create_dir(&here).unwrap();
    let child = start(&at.join("cache"), &here, &["bake", "../scene.json", "--no-cache"]);
    meddled(child, || fs::remove_dir(&here).unwrap())
}

#[test]
fn what_comes_into_the_way_in_mid_run_is_named_and_stays() {
    let (folder, _) = scene();
    let at = folder.path();
    let out = at.join("out");
    for (place, is_link, words) in [
        ("out", false, "error: out: a file is in the way"),
        ("out/tables", false, "error: out/tables: a file is in the way"),
        ("out/tables", true, "error: out/tables: a link or device is in the way"),
        ("out/manifest.json", false, "error: out/manifest.json: not the manifest of a bake"),
    ] {
        fs::create_dir(&out).unwrap();
        let output = meddled(slow(at), || {
            if place == "out" {
                fs::remove_dir(&out).unwrap();
            }
            if is_link {
                std::os::unix::fs::symlink(at, at.join(place)).unwrap();
            } else {
                fs::write(at.join(place), "mine").unwrap();
            }
        });
        assert_ends(&output, 3, words);
        let left = if out.is_dir() { names(&out) } else { Vec::new() };
        let own = place.strip_prefix("out/").map(String::from);
        assert_eq!(left, own.into_iter().collect::<Vec<_>>(), "{place}: nothing of the bake stays");
        if out.is_dir() { fs::remove_dir_all(&out).unwrap() } else { fs::remove_file(&out).unwrap() }
    }
    assert_eq!(names(at), ["scene.json", "whole"]);
}

#[test]
fn links_are_followed_to_the_output_folder_and_nowhere_else() {
    use std::os::unix::fs::symlink;
    let (folder, whole) = scene();
    let at = folder.path();
    fs::create_dir(at.join("real")).unwrap();
    fs::write(at.join("victim"), "mine").unwrap();
    symlink("real", at.join("out")).unwrap();
    assert_ends(&lobefit(at, &WARM, b""), 0, "");
    assert!(fs::symlink_metadata(at.join("out")).unwrap().is_symlink());
    // A file of the bake that is a link is replaced by a file, and so is one that `eval` writes.
    for (name, _) in &whole {
        fs::remove_file(at.join("out").join(name)).unwrap();
        symlink(at.join("victim"), at.join("out").join(name)).unwrap();
    }
    // A link in the place of the manifest is none.
    assert_ends(&lobefit(at, &WARM, b""), 0, "");
    assert!(bytes(&at.join("real")) == whole);
    symlink("victim", at.join("values.csv")).unwrap();
    let eval = ["eval", "ggx-average", "--points", "-", "--out", "values.csv"];
    assert_ends(&lobefit(at, &eval, b"alpha\n0.5\n"), 0, "");
    assert!(fs::symlink_metadata(at.join("values.csv")).unwrap().is_file());
    // A folder of the bake that is a link is refused before the work.
    fs::remove_dir_all(at.join("real/tables")).unwrap();
    fs::create_dir(at.join("elsewhere")).unwrap();
    symlink("../elsewhere", at.join("real/tables")).unwrap();
    assert_ends(&lobefit(at, &WARM, b""), 3, "error: out/tables: a link or device is in the way");
    assert!(names(&at.join("elsewhere")).is_empty());
    assert_eq!(fs::read(at.join("victim")).unwrap(), b"mine");
}

/// Runs the program as a user who is not root, for root may write anywhere.
fn as_user(at: &Path, words: &[&str]) -> Output {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    use std::os::unix::process::CommandExt;
    const NOBODY: u32 = 65534;
    // That user may not be able to reach the folder of the build.
    let program = at.join("program");
    // Copied by another process: a child of another test would hold the file open for writing.
    let copied = Command::new("cp").arg(env!("CARGO_BIN_EXE_lobefit")).arg(&program).status();
    assert!(copied.unwrap().success());
    let mut command = Command::new(&program);
    command.args(words).current_dir(at).env("LOBEFIT_CACHE", at.join("cache"));
    if fs::metadata(&program).unwrap().uid() == 0 {
        fs::set_permissions(at, fs::Permissions::from_mode(0o755)).unwrap();
        command.uid(NOBODY).gid(NOBODY);
    }
    let output = command.stdin(Stdio::null()).output().unwrap();
    fs::remove_file(&program).unwrap();
    output
}

/// Sets whether a folder may be written, by anybody.
fn allow(folder: &Path, is_allowed: bool) {
    use std::os::unix::fs::PermissionsExt;
    let mode = if is_allowed { 0o777 } else { 0o555 };
    fs::set_permissions(folder, fs::Permissions::from_mode(mode)).unwrap();
}

#[test]
fn folders_that_may_not_be_written_are_named_before_the_work() {
    let (folder, whole) = scene();
    let at = folder.path();
    let [out, below, cache] = ["out", "out/tables", "cache"].map(|name| at.join(name));
    for folder in [&out, &below, &cache] {
        fs::create_dir(folder).unwrap();
        allow(folder, true);
    }
    let refused = |folder: &PathBuf, words: &str| {
        allow(folder, false);
        let output = as_user(at, &WARM);
        assert_ends(&output, 3, words);
        assert!(names(&below).is_empty() && names(&out) == ["tables"], "{words}");
        allow(folder, true);
    };
    refused(&out, "error: out: cannot create a file in this folder: Permission denied");
    refused(&below, "error: out/tables: cannot create a file in this folder: Permission denied");
    // A cache stops no bake.
    allow(&cache, false);
    let output = as_user(at, &WARM);
    assert_ends(&output, 0, "note: nothing is kept for other bakes: ");
    assert!(stderr(&output).contains("cache: cannot write: Permission denied"), "{}", stderr(&output));
    assert!(bytes(&out) == whole && names(&cache).is_empty());
}

type Damage = fn(&[u8]) -> Vec<u8>;

/// Every entry of a cache damaged in one of these ways: as good as none.
#[test]
fn damaged_entries_of_a_cache_are_made_again() {
    let (folder, whole) = scene();
    let (at, cache) = (folder.path(), folder.path().join("cache"));
    let bake = |out: &str| {
        let output = lobefit_with(&cache, at, &["bake", "scene.json", "--out", out], b"");
        assert_ends(&output, 0, "");
        assert!(!stderr(&output).contains("note:"), "{}", stderr(&output));
        assert!(bytes(&at.join(out)) == whole, "{out}");
    };
    bake("first");
    let entries = bytes(&cache);
    assert!(entries.len() > 3, "{:?}", names(&cache));
    let damages: [Damage; 5] = [
        |_| Vec::new(),
        |bytes| vec![0; bytes.len()],
        |bytes| bytes[..bytes.len() - 1].to_vec(),
        |bytes| [bytes, bytes].concat(),
        |bytes| {
            let mut bytes = bytes.to_vec();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 1;
            bytes
        },
    ];
    for first in 0..damages.len() {
        for (k, (name, bytes)) in entries.iter().enumerate() {
            fs::write(cache.join(name), damages[(first + k) % damages.len()](bytes)).unwrap();
        }
        bake(&format!("after-{first}"));
        assert!(bytes(&cache) == entries, "round {first}");
    }
}
