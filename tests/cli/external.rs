//! Verbs of other packages: their binaries are found, run and answered for, or named with the command that builds them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::stderr;

/// Verb and package.
const VERBS: [(&[&str], &str); 1] = [(&["audit"], "lobefit-audit")];

/// Runs a copy of the program in `bin`, with `path` as PATH.
fn run(bin: &Path, path: &Path, arguments: &[&str]) -> Output {
    let program = bin.join("lobefit");
    if !program.exists() {
        fs::create_dir_all(bin).unwrap();
        fs::copy(env!("CARGO_BIN_EXE_lobefit"), &program).unwrap();
    }
    Command::new(program).args(arguments).env("PATH", path).output().unwrap()
}

#[test]
fn a_package_that_is_not_built_is_named_with_the_command_that_builds_it() {
    let folder = tempfile::tempdir().unwrap();
    for (verb, package) in VERBS {
        let output = run(&folder.path().join("bin"), folder.path(), verb);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
        let build =
            format!("error: {package} is not built: build it with `cargo build --release -p {package}`");
        assert!(stderr(&output).starts_with(&build), "{}", stderr(&output));
    }
    let help = run(&folder.path().join("bin"), folder.path(), &["--help"]);
    let help = String::from_utf8(help.stdout).unwrap();
    assert!(VERBS.iter().all(|(verb, _)| help.contains(&format!("\n  {} ", verb[0]))), "{help}");
}

#[cfg(unix)]
#[test]
fn the_binary_beside_the_program_is_run_before_the_one_on_path() {
    use std::os::unix::fs::PermissionsExt;

    let folder = tempfile::tempdir().unwrap();
    let [bin, path] = ["bin", "path"].map(|name| folder.path().join(name));
    let script = |at: &Path, package: &str, answer: &str| {
        fs::create_dir_all(at).unwrap();
        let text = format!("#!/bin/sh\necho {answer} \"$@\"\necho said >&2\nexit 7\n");
        fs::write(at.join(package), text).unwrap();
        fs::set_permissions(at.join(package), fs::Permissions::from_mode(0o755)).unwrap();
    };
    for (verb, package) in VERBS {
        let words = [verb, &["-x", "two words", "--out=report"]].concat();
        let answer = |arguments: &[&str]| {
            let output = run(&bin, &path, arguments);
            assert_eq!(
                (output.status.code(), stderr(&output).as_str()),
                (Some(7), "said\n"),
                "{arguments:?}"
            );
            String::from_utf8(output.stdout).unwrap()
        };
        let after = words[1..].join(" ");
        script(&path, package, "path");
        assert_eq!(answer(&words), format!("path {after}\n"));
        script(&bin, package, "beside");
        assert_eq!(answer(&words), format!("beside {after}\n"));
        let help = [verb, &["--help"]].concat();
        assert_eq!(answer(&help), format!("beside {}\n", help[1..].join(" ")));
        assert_eq!(answer(&["help", verb[0]]), "beside --help\n");
    }
}
