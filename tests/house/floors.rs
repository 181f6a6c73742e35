//! The house: a module imports only from the floors below it, as the table in `src/lib.rs` numbers
//! them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Module to floor, from the table in the crate's documentation.
fn floors() -> BTreeMap<String, u32> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).unwrap();
    text.lines()
        .filter_map(|line| {
            let mut cells = line.strip_prefix("//! |")?.split('|').map(str::trim);
            let floor = cells.next()?.parse().ok()?;
            let module = cells.next()?.strip_prefix("[`")?.strip_suffix("`]")?;
            Some((module.to_owned(), floor))
        })
        .collect()
}

pub(crate) fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The text without comments (strings are kept: none of ours holds `crate::`, and a false alarm
/// would be seen).
pub(crate) fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

pub(crate) fn word(text: &str) -> &str {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
}

/// The first name of every path in `text`, which begins where a path to the crate's root ends:
/// `a::b`, or `{a::b, c}`.
pub(crate) fn heads(text: &str) -> Vec<String> {
    let text = text.trim_start();
    let Some(group) = text.strip_prefix('{') else { return vec![word(text).to_owned()] };
    let mut names = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(word(group[start..i].trim_start()).to_owned());
                start = i + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// Modules of the crate that a source names: through `crate::`, or through as many `super::` as
/// lead to the root. `depth` is the depth of the file's module.
fn imports(text: &str, depth: usize) -> BTreeSet<String> {
    let text = code(text);
    let mut found = BTreeSet::new();
    for (at, root) in text.match_indices("crate::") {
        found.extend(heads(&text[at + root.len()..]));
    }
    let mut at = 0;
    while let Some(next) = text[at..].find("super::") {
        at += next;
        let rest = text[at..].trim_start_matches("super::");
        let supers = (text.len() - at - rest.len()) / "super::".len();
        if supers >= depth {
            found.extend(heads(rest));
        }
        at = text.len() - rest.len();
    }
    found
}

/// Every forbidden edge, as `file imports module`.
fn forbidden(
    file: &str,
    module: &str,
    text: &str,
    depth: usize,
    floors: &BTreeMap<String, u32>,
) -> Vec<String> {
    let own = floors[module];
    imports(text, depth)
        .into_iter()
        .filter(|to| to != module)
        .filter(|to| floors.get(to).is_none_or(|&floor| floor >= own))
        .map(|to| format!("{file} imports {to}"))
        .collect()
}

#[test]
fn every_module_has_a_floor() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let floors = floors();
    let folders: BTreeSet<String> = fs::read_dir(&root)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .map(|path| path.file_name().unwrap().to_str().unwrap().to_owned())
        .collect();
    assert_eq!(floors.keys().cloned().collect::<BTreeSet<_>>(), folders);
}

#[test]
fn modules_import_only_from_the_floors_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let floors = floors();
    let mut bad = Vec::new();
    let mut seen = 0;
    for path in sources(&root) {
        let inside = path.strip_prefix(&root).unwrap();
        let parts: Vec<&str> = inside.iter().map(|p| p.to_str().unwrap()).collect();
        if parts.len() == 1 {
            continue; // lib.rs and main.rs, which hold no logic
        }
        let depth = parts.len() - usize::from(parts.last() == Some(&"mod.rs"));
        let text = fs::read_to_string(&path).unwrap();
        assert!(!text.contains("#[cfg(test)]"), "{}: tests stand in tests/", path.display());
        bad.extend(forbidden(&inside.display().to_string(), parts[0], &text, depth, &floors));
        seen += 1;
    }
    assert!(seen > 20, "only {seen} files were read");
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn planted_edges_are_caught() {
    let floors = floors();
    let edges = |module: &str, text: &str, depth| forbidden("f.rs", module, text, depth, &floors);
    assert_eq!(
        edges("data", "use crate::approximate::Entry;", 2),
        ["f.rs imports approximate"],
        "the floor above"
    );
    assert_eq!(edges("store", "use crate::scene::Scene;", 2), ["f.rs imports scene"], "same floor");
    assert_eq!(edges("plan", "use crate::{\n  data::{Axis, Warp},\n  cli,\n};", 2), ["f.rs imports cli"]);
    assert_eq!(edges("effects", "fn f() -> crate::plan::Plan {}", 2), ["f.rs imports plan"]);
    assert_eq!(edges("plan", "use super::super::bake::Baked;", 2), ["f.rs imports bake"]);
    assert_eq!(edges("plan", "use crate::nowhere::X;", 2), ["f.rs imports nowhere"]);
    assert!(
        edges("plan", "// use crate::cli::X;\nuse crate::scene::Scene;\nuse super::job::Job;", 2).is_empty()
    );
    assert!(edges("plan", "use crate::plan::job;\nuse crate::data::{self, Axis};", 2).is_empty());
}

#[test]
fn entry_points_hold_no_logic() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (file, cap) in [("lib.rs", 50), ("main.rs", 20)] {
        let lines = fs::read_to_string(root.join(file)).unwrap().lines().count();
        assert!(lines <= cap, "{file} has {lines} lines");
    }
}
