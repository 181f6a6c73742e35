//! `lobefit completions` and `lobefit man`.

use crate::common;

use common::{lobefit, names, stderr};

#[test]
fn every_shell_completes_every_verb() {
    let folder = tempfile::tempdir().expect("a folder");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = lobefit(folder.path(), &["completions", shell], b"");
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
        let script = String::from_utf8(output.stdout).expect("text");
        for word in ["bake", "check", "audit", "against"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    let output = lobefit(folder.path(), &["completions", "tcsh"], b"");
    assert!(output.status.code() == Some(2) && stderr(&output).contains("possible values: bash"));
}

#[test]
fn every_verb_has_a_manual_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = lobefit(folder.path(), &["man", "pages"], b"");
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let pages = names(&folder.path().join("pages"));
    let verbs = [
        "audit",
        "bake",
        "cache",
        "check",
        "completions",
        "cost",
        "eval",
        "fit",
        "furnace",
        "man",
        "merge",
        "plan",
        "report",
        "scene-from",
        "schema",
    ];
    let expected: Vec<String> = verbs.iter().map(|verb| format!("lobefit-{verb}.1")).collect();
    assert_eq!(pages, [expected, vec!["lobefit.1".into()]].concat());
    let page = std::fs::read_to_string(folder.path().join("pages/lobefit-bake.1")).expect("text");
    for words in [".TH lobefit-bake 1", "\\-\\-threads", "lobefit bake scene.json \\-\\-out assets"] {
        assert!(page.contains(words), "`{words}` in\n{page}");
    }
    let output = lobefit(folder.path(), &["man", "pages/lobefit.1"], b"");
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
}
