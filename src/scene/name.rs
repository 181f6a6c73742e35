//! Names and paths that a scene may hold.

use super::value::TextRule;

/// The name of a scene or of a material: anything that can be read, nothing that acts.
pub(super) struct Name;

impl TextRule for Name {
    const EXPECTED: &'static str = "a name in quotes";

    fn check(text: &str) -> Result<(), String> {
        if text.trim().is_empty() {
            return Err("the name is empty".into());
        }
        if let Some(c) = text.chars().find(|c| c.is_control()) {
            return Err(format!("the name holds the control character {}", c.escape_unicode()));
        }
        Ok(())
    }
}

/// A hypothesis file of the user's: a plain relative path that means the same on every system.
pub(super) struct HypothesisPath;

impl TextRule for HypothesisPath {
    const EXPECTED: &'static str = "the relative path of a .wgsl file in quotes";

    fn check(text: &str) -> Result<(), String> {
        relative(text, ".wgsl")
    }
}

/// Whether a path is relative, plain, and of a file whose name ends in `extension`; if not, the
/// message.
pub(super) fn relative(text: &str, extension: &str) -> Result<(), String> {
    if let Some(c) = text.chars().find(|&c| c.is_control() || matches!(c, '\\' | ':')) {
        return Err(format!("the path holds {}; use a relative path with `/`", c.escape_default()));
    }
    if text.starts_with('/') {
        return Err(format!("`{text}` is an absolute path; give it relative to the scene file"));
    }
    if text.split('/').any(|part| matches!(part, "" | "." | "..")) {
        return Err(format!(
            "`{text}` holds an empty part, `.` or `..`; name a file below the scene's folder"
        ));
    }
    let stem = text.rsplit('/').next().and_then(|file| file.strip_suffix(extension));
    if stem.is_none_or(str::is_empty) {
        return Err(format!("`{text}` does not end in {extension}"));
    }
    Ok(())
}
