//! Verbs of other packages: their binaries are found, run and answered for, or named with the
//! command that builds them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::stderr;

/// Verb, package, and words that follow the verb. What follows `cost` is read by `lobefit` itself
/// first.
const VERBS: [(&str, &str, &[&str]); 5] = [
    ("audit", "lobefit-audit", &["-x", "two words", "--out=report"]),
    ("furnace", "lobefit-audit", &["-x", "two words", "--out=report"]),
    ("fit", "lobefit-formula", &["-x", "two words", "--out=report"]),
    ("report", "lobefit-studies", &["-x", "two words", "--out=report"]),
    ("cost", "lobefit-gpu", &["--gpu", "--reduced", "two words"]),
];

/// Copies a file by another process. A descriptor for writing in this one would be inherited for a
/// moment by whatever another test starts, and keep the copy from being run: "text file busy".
fn copied(from: &Path, to: &Path) {
    if cfg!(unix) {
        assert!(Command::new("cp").args([from, to]).status().unwrap().success(), "{}", to.display());
    } else {
        fs::copy(from, to).unwrap();
    }
}

/// Runs a copy of the program in `bin`, with `path` as PATH.
fn run(bin: &Path, path: &Path, arguments: &[&str]) -> Output {
    let program = bin.join("lobefit");
    if !program.exists() {
        fs::create_dir_all(bin).unwrap();
        copied(Path::new(env!("CARGO_BIN_EXE_lobefit")), &program);
    }
    Command::new(program).args(arguments).env("PATH", path).output().unwrap()
}

#[test]
fn a_package_that_is_not_built_is_named_with_the_command_that_builds_it() {
    let folder = tempfile::tempdir().unwrap();
    for (verb, package, words) in VERBS {
        let output = run(&folder.path().join("bin"), folder.path(), &[&[verb], words].concat());
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
        let build =
            format!("error: {package} is not built: build it with `cargo build --release -p {package}`");
        assert!(stderr(&output).starts_with(&build), "{}", stderr(&output));
    }
    let help = run(&folder.path().join("bin"), folder.path(), &["--help"]);
    let help = String::from_utf8(help.stdout).unwrap();
    assert!(VERBS.iter().all(|(verb, ..)| help.contains(&format!("\n  {verb} "))), "{help}");
}

#[cfg(unix)]
fn script(at: &Path, package: &str, text: &str) {
    use std::os::unix::fs::PermissionsExt;

    fs::create_dir_all(at).unwrap();
    let draft = at.join("draft");
    fs::write(&draft, format!("#!/bin/sh\n{text}\n")).unwrap();
    copied(&draft, &at.join(package));
    fs::remove_file(draft).unwrap();
    fs::set_permissions(at.join(package), fs::Permissions::from_mode(0o755)).unwrap();
}

/// That a file is not there is no error.
#[cfg(unix)]
fn absent(error: std::io::Error) -> std::io::Result<()> {
    if error.kind() == std::io::ErrorKind::NotFound { Ok(()) } else { Err(error) }
}

#[cfg(unix)]
#[test]
fn the_binary_beside_the_program_is_run_before_the_one_on_path() {
    let folder = tempfile::tempdir().unwrap();
    let [bin, path] = ["bin", "path"].map(|name| folder.path().join(name));
    for (verb, package, words) in VERBS {
        let all = [&[verb], words].concat();
        let answer = |arguments: &[&str]| {
            let output = run(&bin, &path, arguments);
            assert_eq!(
                (output.status.code(), stderr(&output).as_str()),
                (Some(7), "said\n"),
                "{arguments:?}"
            );
            String::from_utf8(output.stdout).unwrap()
        };
        // The package of `audit` has another verb, which its program is given.
        let given = if verb == "furnace" { "furnace " } else { "" };
        let after = format!("{given}{}", words.join(" "));
        fs::remove_file(bin.join(package)).or_else(absent).unwrap();
        script(&path, package, "echo path \"$@\"; echo said >&2; exit 7");
        assert_eq!(answer(&all), format!("path {after}\n"));
        script(&bin, package, "echo beside \"$@\"; echo said >&2; exit 7");
        assert_eq!(answer(&all), format!("beside {after}\n"));
        if verb != "cost" {
            assert_eq!(answer(&[verb, "--help"]), format!("beside {given}--help\n"));
            assert_eq!(answer(&["help", verb]), format!("beside {given}--help\n"));
        }
    }
}

/// Completions and manual pages know the options of packages that are built, as their binaries declare them.
#[cfg(unix)]
#[test]
fn what_a_package_declares_is_completed_and_has_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let bin = folder.path().join("bin");
    let declared = r#"{"about":"Measure","examples":"","arguments":[
        {"name":"file","long":null,"short":null,"help":"The file","value":"FILE","values":[],"required":true,"repeats":false,"defaults":[]},
        {"name":"side","long":"side","short":"s","help":"Whence","value":"SIDE","values":["inside","outside"],
         "required":false,"repeats":true,"defaults":["inside"]}]}"#;
    let answer = format!("test \"$1\" = --declared || exit 2\necho '{declared}'");
    script(&bin, "lobefit-formula", &answer);
    let zsh = run(&bin, folder.path(), &["completions", "zsh"]);
    let zsh = String::from_utf8(zsh.stdout).unwrap();
    assert!(zsh.contains("--side") && zsh.contains("inside outside"), "{zsh}");
    let pages = folder.path().join("pages");
    let man = run(&bin, folder.path(), &["man", pages.to_str().unwrap()]);
    assert_eq!(man.status.code(), Some(0), "{}", stderr(&man));
    let page = fs::read_to_string(pages.join("lobefit-fit.1")).unwrap();
    let said = ["\\-\\-side", "Whence", "default: inside", "<\\fIFILE\\fR>"];
    assert!(said.iter().all(|word| page.contains(word)), "{page}");
    script(&bin, "lobefit-formula", "echo broken >&2; exit 2");
    let refused = run(&bin, folder.path(), &["completions", "zsh"]);
    assert!(refused.status.code() == Some(2) && stderr(&refused).contains("broken"), "{}", stderr(&refused));
}

/// A bake leaves studies alone; `check` asks their package for what is wrong with them, and says
/// where it is not built.
#[cfg(unix)]
#[test]
fn check_asks_for_the_studies_that_are_there() {
    let folder = tempfile::tempdir().unwrap();
    let [bin, out] = ["bin", "out"].map(|name| folder.path().join(name));
    let scene = folder.path().join("scene.json");
    fs::write(&scene, include_str!("../../examples/mirrors.json")).unwrap();
    let results = out.join("reports/studies/coupling/results.json");
    fs::create_dir_all(results.parent().unwrap()).unwrap();
    let [scene, to] = [&scene, &out].map(|path| path.to_str().unwrap());
    let verb = |words: &[&str]| {
        let output = run(&bin, folder.path(), words);
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap() + &stderr(&output))
    };
    fs::write(&results, "mine").unwrap();
    assert_eq!(verb(&["bake", scene, "--out", to, "--quiet"]), (Some(0), String::new()));
    assert_eq!(fs::read_to_string(&results).unwrap(), "mine");
    let check = || verb(&["check", scene, "--against", to]);
    let (code, said) = check();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("note: reports/studies: not checked: lobefit-studies is not built"), "{said}");
    let wrong = r#"{"schema_version":1,"differences":[{"file":"reports/studies/coupling/results.json","detail":"stale"}]}"#;
    script(&bin, "lobefit-studies", &format!("echo '{wrong}'; exit 1"));
    let (code, said) = check();
    assert_eq!(code, Some(1), "{said}");
    assert!(
        said.contains("results.json: stale") && said.contains("1 study is not that of this version"),
        "{said}"
    );
    script(&bin, "lobefit-studies", "echo '{\"schema_version\":1,\"differences\":[]}'");
    assert_eq!(check().0, Some(0));
    script(&bin, "lobefit-studies", "echo broken >&2; exit 2");
    let (code, said) = check();
    assert!(code == Some(2) && said.contains("lobefit-studies: broken"), "{said}");
    fs::write(out.join("reports/studies/coupling/more.png"), "x").unwrap();
    script(&bin, "lobefit-studies", "echo '{\"schema_version\":1,\"differences\":[]}'");
    assert!(check().1.contains("more.png: extra"));
}
