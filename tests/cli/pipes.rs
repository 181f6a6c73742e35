//! Standard output that is closed or full.

use std::fs::File;
use std::io::pipe;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::stderr;

/// A scene whose bake takes no time: it calls for no effect.
const MIRRORS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/mirrors.json");

/// Every verb of the program itself that prints, `eval` more than a pipe holds.
const PRINTING: [&[&str]; 14] = [
    &["--help"],
    &["--version"],
    &["bake", "--help"],
    &["plan", MIRRORS],
    &["plan", MIRRORS, "--json"],
    &["bake", MIRRORS, "--out", "out"],
    &["bake", MIRRORS, "--out", "out", "--json"],
    &["check", MIRRORS, "--against", "whole"],
    &["check", MIRRORS, "--against", "whole", "--json"],
    &["eval", "eon-single", "--points", "points.csv"],
    &["cache"],
    &["scene-from", concat!(env!("CARGO_MANIFEST_DIR"), "/examples/surfaces.mtlx")],
    &["schema"],
    &["man", "--help"],
];

/// A folder with a bake and points.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let points: String = (1..=3000).map(|k| format!("0.5,{:e}\n", f64::from(k) / 3000.0)).collect();
    std::fs::write(folder.path().join("points.csv"), format!("roughness,mu\n{points}")).unwrap();
    let baked = run(folder.path(), &["bake", MIRRORS, "--out", "whole"], Stdio::null());
    assert!(baked.status.success(), "{}", stderr(&baked));
    folder
}

fn run(folder: &Path, words: &[&str], stdout: impl Into<Stdio>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lobefit"));
    command.args(words).current_dir(folder).env("LOBEFIT_CACHE", folder.join("cache"));
    command.stdin(Stdio::null()).stdout(stdout).stderr(Stdio::piped());
    command.spawn().unwrap().wait_with_output().unwrap()
}

/// As before `| head -1` once it has its line.
#[test]
fn a_closed_standard_output_is_a_quiet_end() {
    let folder = folder();
    for words in PRINTING {
        let (reader, writer) = pipe().unwrap();
        drop(reader);
        let [read, closed] = [Stdio::null(), writer.into()].map(|stdout| run(folder.path(), words, stdout));
        let said = stderr(&closed);
        assert_eq!((closed.status.code(), &said), (Some(0), &stderr(&read)), "{words:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_exit_3() {
    let folder = folder();
    for words in PRINTING {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = run(folder.path(), words, full);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(3), "{words:?}: {said}");
        assert!(said.starts_with("error: standard output: cannot write"), "{words:?}: {said}");
    }
}
