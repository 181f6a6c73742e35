//! Committed files as the tests of prose read them.

use std::path::{Path, PathBuf};

use serde_json::Value;

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

pub fn json(name: &str) -> Value {
    serde_json::from_str(&read(name)).expect("JSON")
}

/// The README and the pages in `docs/`, by their paths.
pub fn pages() -> Vec<(PathBuf, String)> {
    let docs = std::fs::read_dir(root().join("docs")).expect("docs");
    let mut paths: Vec<PathBuf> = docs.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "md"));
    paths.push(root().join("README.md"));
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read_to_string(path).expect("a page"))).collect()
}

pub fn find<'a>(list: &'a Value, key: &str, name: &str) -> &'a Value {
    let list = list.as_array().expect("a list");
    list.iter().find(|e| e[key] == name).unwrap_or_else(|| panic!("no {key} `{name}`"))
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// The blocks of a language.
pub fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let opening = format!("```{language}\n");
    let after = page.split(opening.as_str()).skip(1);
    after.map(|rest| rest.split("```").next().expect("its end").trim()).collect()
}

/// Asserts that the rows of a page that begin with one of these are `wanted`, and says what they
/// should be.
pub fn assert_rows(page: &str, begins: &[&str], wanted: &[String]) {
    let text = read(page);
    let found: Vec<&str> =
        text.lines().filter(|line| begins.iter().any(|begin| line.starts_with(begin))).collect();
    assert_eq!(found, wanted, "the rows of {page} should be:\n{}\n", wanted.join("\n"));
}

/// Asserts that WGSL is valid.
pub fn assert_valid(wgsl: &str, what: &str) {
    let module = naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|e| panic!("{what}: {e}"));
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    validator.validate(&module).unwrap_or_else(|e| panic!("{what}: {e:?}"));
}
