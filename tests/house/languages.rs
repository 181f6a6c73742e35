//! Only the printers know what differs between the languages of the emitted code.

use std::fs;
use std::path::Path;

use super::floors::{code, sources, word};

const LANGUAGES: [&str; 6] = ["Rust", "Wgsl", "Hlsl", "Glsl", "Msl", "C"];

/// Whether a line matches a language, or compares with one.
fn matches(line: &str) -> bool {
    line.match_indices("Language::").any(|(at, found)| {
        let (before, after) = (&line[..at], &line[at + found.len()..]);
        let other = before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let compared = ["== ", "!= ", "matches!("].iter().any(|sign| before.contains(sign));
        !other && LANGUAGES.contains(&word(after)) && (after.contains("=>") || compared)
    })
}

#[test]
fn languages_part_in_the_printers_alone() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = [sources(&root.join("src")), sources(&root.join("crates"))].concat();
    let printers = root.join("crates/shade/src/code");
    let judged = files.iter().filter(|file| !file.starts_with(&printers));
    let judged = judged.filter(|file| !file.components().any(|part| part.as_os_str() == "tests"));
    for file in judged {
        let text = code(&fs::read_to_string(file).unwrap());
        let found = text.lines().find(|line| matches(line));
        assert_eq!(found, None, "{}", file.display());
    }
}
