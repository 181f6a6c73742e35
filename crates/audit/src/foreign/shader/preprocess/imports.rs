//! Imports of WGSL, as naga_oil and WESL write them: `#import a::b::{c, d as e}`, `import a::b;`.
//! Names are not kept apart by module: what an import names is read from its module's file.

use super::lex::{Kind, Token};
use super::{Bad, Open, Preprocessor};

/// A path, and the name that it is given.
struct Import {
    path: Vec<String>,
    name: Option<String>,
}

/// Whether a text has imports.
pub(super) fn called_for(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().trim_start_matches('#').starts_with("import"))
}

/// Code with a bare name for `#{NAME}` and `#NAME`, byte for byte, so that macros are found.
pub(super) fn inserted(part: &str) -> String {
    let mut open = false;
    let named = |rest: &str| rest.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let one = |(at, c): (usize, char)| {
        let rest = &part[at + c.len_utf8()..];
        if c == '#' && rest.strip_prefix('{').is_some_and(named) {
            open = true;
            ' '
        } else if open && (c == '{' || c == '}') {
            open = c == '{';
            ' '
        } else if c == '#' && named(rest) {
            ' '
        } else {
            c
        }
    };
    part.char_indices().map(one).collect()
}

impl Preprocessor {
    /// The modules of an import, each once.
    pub(super) fn import(&mut self, rest: &[Token], here: &Open, depth: usize) -> Result<(), Bad> {
        let words: Vec<&str> =
            rest.iter().filter(|t| t.kind != Kind::Blank).map(|t| t.text.as_str()).collect();
        for Import { path, name } in paths(&words) {
            if let (Some(name), Some(last)) = (name, path.last()) {
                let own =
                    |text: &str, kind| Token { kind, text: text.into(), from: here.from, copied: false };
                if name != *last {
                    self.macros.define(&[
                        own(&name, Kind::Name),
                        own(" ", Kind::Blank),
                        own(last, Kind::Name),
                    ]);
                }
            }
            match self.folders.module(&path) {
                Some(file) if self.once.insert(file.clone()) => self.read(file, here, depth)?,
                Some(_) => {}
                None => {
                    let reason = "its module is in no folder that --include names";
                    self.lacks(here, format!("import of {}", path.join("::")), reason.into());
                }
            }
        }
        Ok(())
    }
}

/// The paths of an import.
fn paths(words: &[&str]) -> Vec<Import> {
    let (mut found, mut stack): (Vec<Import>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut path: Vec<String> = Vec::new();
    let (mut kept, mut name, mut renamed, mut fresh) = (0, None, false, false);
    let end = |path: &mut Vec<String>, kept: usize, name: &mut Option<String>, found: &mut Vec<Import>| {
        if path.len() > kept {
            found.push(Import { path: path.clone(), name: name.take() });
        }
        path.truncate(kept);
    };
    for (k, word) in words.iter().enumerate() {
        match *word {
            ":" => fresh = true,
            "{" => {
                stack.push(kept);
                kept = path.len();
            }
            "}" => {
                end(&mut path, kept, &mut name, &mut found);
                kept = stack.pop().unwrap_or(0);
                path.truncate(kept);
            }
            "," | ";" => end(&mut path, kept, &mut name, &mut found),
            "as" => renamed = true,
            word if renamed => (name, renamed) = (Some(word.to_string()), false),
            word => {
                // `#import a::b c, d` names two items of a module.
                if k > 0 && !fresh && path.len() > kept {
                    kept = path.len();
                }
                path.push(word.to_string());
                fresh = false;
            }
        }
    }
    end(&mut path, kept, &mut name, &mut found);
    found
}
