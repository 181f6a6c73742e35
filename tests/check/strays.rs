//! `lobefit check` and what else lies in the folders of a bake: odd names, links, line ends.

use crate::common;

use std::path::Path;

use common::{lobefit, stderr};

/// A scene whose bake takes no time: it calls for no effect.
const SCENE: &[u8] = include_bytes!("../../examples/mirrors.json");

fn baked() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let output = lobefit(folder.path(), &["bake", "-", "--quiet"], SCENE);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    for sub in ["tables", "fits/hypotheses", "reports"] {
        std::fs::create_dir_all(folder.path().join(sub)).expect("a folder");
    }
    folder
}

fn check(folder: &Path, options: &[&str]) -> (i32, String) {
    let output = lobefit(folder, &[&["check", "-"], options].concat(), SCENE);
    assert_eq!(stderr(&output), "");
    (output.status.code().expect("a code"), String::from_utf8(output.stdout).expect("text"))
}

#[test]
fn a_bake_with_hypotheses_and_timings_beside_it_passes() {
    let folder = baked();
    for name in ["fits/hypotheses/mine.wgsl", "reports/timings.json", "reports/timings.html", "other.txt"] {
        std::fs::write(folder.path().join(name), "x").expect("written");
    }
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 0, "{text}");
}

#[cfg(unix)]
#[test]
fn odd_names_are_extra_and_cannot_drive_the_terminal() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    for (name, shown) in [
        (&b"tables/a:b.txt"[..], "tables/a:b.txt: extra"),
        (b"fits/a\\b.rs", "fits/a\\b.rs: extra"),
        (b"reports/two\nlines", "reports/two\\u{a}lines: extra"),
        (b"reports/\x1b[2J", "reports/\\u{1b}[2J: extra"),
        (b"tables/caf\xe9.exr", "tables/caf\\xe9.exr: extra"),
    ] {
        let folder = baked();
        std::fs::write(folder.path().join(OsStr::from_bytes(name)), "x").expect("written");
        let (code, text) = check(folder.path(), &[]);
        assert_eq!(code, 1, "{shown}: {text}");
        assert!(text.contains(shown), "`{shown}` in\n{text}");
        assert_eq!(text.lines().count(), 2, "{text}");
        let (code, text) = check(folder.path(), &["--json"]);
        let verdict: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!((code, &verdict["differences"][0]["kind"]), (1, &serde_json::json!("extra")));
    }
}

#[cfg(unix)]
#[test]
fn links_are_extra_wherever_they_lead() {
    use std::os::unix::fs::symlink;
    let outside = tempfile::tempdir().expect("a folder");
    std::fs::write(outside.path().join("file"), "x").expect("written");
    for target in [outside.path().join("file"), outside.path().to_path_buf(), outside.path().join("none")] {
        for sub in ["tables", "fits", "reports"] {
            let folder = baked();
            symlink(&target, folder.path().join(sub).join("link")).expect("a link");
            let (code, text) = check(folder.path(), &[]);
            assert_eq!(code, 1, "{text}");
            assert!(text.contains(&format!("{sub}/link: extra: a link or device")), "{text}");
        }
    }
    // In the place of a folder, and of a file of the bake that it even has the bytes of.
    let folder = baked();
    std::fs::remove_dir(folder.path().join("tables")).expect("removed");
    symlink(outside.path(), folder.path().join("tables")).expect("a link");
    let page = folder.path().join("reports/index.html");
    std::fs::rename(&page, outside.path().join("index.html")).expect("moved");
    symlink(outside.path().join("index.html"), &page).expect("a link");
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("tables: extra: a link or device"), "{text}");
    assert!(text.contains("reports/index.html: a link or device where the recipe makes a file"), "{text}");
    assert!(text.contains("bake it again: lobefit bake"), "{text}");
    assert_eq!(text.lines().count(), 4, "{text}");
}

#[test]
fn a_file_in_the_place_of_a_folder_is_told() {
    let folder = baked();
    std::fs::remove_dir_all(folder.path().join("reports")).expect("removed");
    std::fs::write(folder.path().join("reports"), "x").expect("written");
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("reports: extra") && text.contains("reports/index.html: missing"), "{text}");
}

#[cfg(unix)]
#[test]
fn what_cannot_be_read_is_exit_2() {
    let folder = baked();
    // A folder that leads to itself, and a name that no file system takes: no user may read these.
    std::os::unix::fs::symlink("loop", folder.path().join("loop")).expect("a link");
    for against in ["loop".to_string(), "x".repeat(5000)] {
        let output = lobefit(folder.path(), &["check", "-", "--against", &against], SCENE);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(
            stderr(&output).contains(&format!("error: {against}: cannot access: ")),
            "{}",
            stderr(&output)
        );
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn line_ends_are_named() {
    let folder = baked();
    let page = folder.path().join("manifest.json");
    let text = std::fs::read_to_string(&page).expect("text");
    let count = text.lines().count();
    for (changed, words) in [
        (text.trim_end().to_string(), format!("line {count}: only line ends differ: no final newline")),
        (text.replace('\n', "\r\n"), "line 1: only line ends differ: CR LF where the recipe gives LF".into()),
    ] {
        std::fs::write(&page, changed).expect("written");
        let (code, found) = check(folder.path(), &[]);
        assert_eq!(code, 1, "{found}");
        assert!(found.contains(&words), "`{words}` in\n{found}");
    }
}

#[test]
fn a_folder_without_a_bake_is_told_from_one_that_differs() {
    let empty = tempfile::tempdir().expect("a folder");
    let (code, text) = check(empty.path(), &[]);
    assert_eq!(code, 1, "{text}");
    let last = text.lines().last().expect("a line");
    assert_eq!(
        last,
        "none of them is there: `--against` names the folder of a bake; `lobefit bake -` makes one here"
    );
    let folder = baked();
    std::fs::remove_file(folder.path().join("manifest.json")).expect("removed");
    let (code, text) = check(folder.path(), &[]);
    assert!(code == 1 && !text.contains("none of them"), "{text}");
}
