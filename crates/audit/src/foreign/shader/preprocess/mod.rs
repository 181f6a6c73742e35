//! The preprocessor: macros, conditions, include files; for WGSL the directives of naga_oil, whose
//! imports are include files too. It knows the macros and folders of the surroundings alone.

mod attributes;
mod condition;
mod imports;
mod include;
mod lex;
mod macros;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use include::Folders;
pub use include::Surroundings;
pub(super) use include::script;
use lex::{Kind, Token, tokens, without_comments};
use macros::Macros;

use super::ShaderLanguage;
use super::text::{File, Origin, Text, place};
use crate::foreign::{ForeignError, limits};

/// What is wrong, and where.
pub(super) struct Bad {
    pub from: Origin,
    pub message: String,
}

/// An include file that was not read.
#[derive(Clone, Debug)]
pub(super) struct Missing {
    pub from: Origin,
    /// The directive.
    pub line: String,
    /// Why.
    pub reason: String,
}

/// A part of a file that a condition left out.
#[derive(Clone, Debug)]
pub(super) struct Excluded {
    /// Where the condition stands.
    pub from: Origin,
    /// The directive.
    pub line: String,
    /// First byte of the part, and the one after its last.
    pub range: [usize; 2],
}

/// A source as a front end may read it.
#[derive(Clone, Debug, Default)]
pub(super) struct Preprocessed {
    pub files: Vec<File>,
    pub text: Text,
    pub missing: Vec<Missing>,
    pub excluded: Vec<Excluded>,
}

/// An `#if` that is open.
struct Open {
    /// Whether its present part is read.
    active: bool,
    /// Whether one of its parts has been.
    done: bool,
    /// Whether what is around it is read.
    around: bool,
    /// Where the directive of its present part stands, the directive, and where the part begins.
    from: Origin,
    line: String,
    start: usize,
}

struct Preprocessor {
    out: Preprocessed,
    folders: Folders,
    macros: Macros,
    /// Where each file lies, if it is known.
    paths: Vec<Option<PathBuf>>,
    /// Files that are read once.
    once: BTreeSet<PathBuf>,
    language: ShaderLanguage,
    /// Bytes of all files.
    bytes: usize,
}

/// The source with its includes, macros and conditions.
///
/// # Errors
/// With file and place: a directive that is open or closes nothing, a condition that is no
/// arithmetic, a macro that is called wrongly or makes too much, include files that are too large
/// or too deep.
pub(super) fn preprocessed(
    file: File,
    path: Option<&Path>,
    language: ShaderLanguage,
    around: &Surroundings,
) -> Result<Preprocessed, ForeignError> {
    let modules = language == ShaderLanguage::Wgsl && imports::called_for(&file.text);
    let (folders, before) = Folders::open(around, modules)?;
    let folders = folders.beside(path);
    let mut all = Preprocessor {
        out: Preprocessed { files: vec![file], ..Preprocessed::default() },
        folders,
        macros: Macros::new(),
        paths: vec![path.map(Path::to_path_buf)],
        once: BTreeSet::new(),
        language,
        bytes: 0,
    };
    let done = all.defines(around).and_then(|()| all.all(before));
    match done {
        Ok(()) => Ok(all.out),
        Err(Bad { from, message }) => {
            let (name, spot) = place(&all.out.files, from);
            Err(ForeignError::at(name, spot, message))
        }
    }
}

impl Preprocessor {
    fn defines(&mut self, around: &Surroundings) -> Result<(), Bad> {
        for define in &around.defines {
            // `NAME(ARGUMENTS)=VALUE` too.
            let name = define.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(define.len());
            let close = if define[name..].starts_with('(') { define.find(')').unwrap_or(0) } else { 0 };
            let text = match define[close..].find('=') {
                Some(at) => format!("{} {}", &define[..close + at], &define[close + at + 1..]),
                None => format!("{define} 1"),
            };
            let from = self.add(File { name: format!("--define {define}"), text: text.clone() }, None);
            if !self.macros.define(&tokens(&text, from)) {
                return Err(Bad { from, message: "NAME or NAME=VALUE is called for".into() });
            }
        }
        Ok(())
    }

    /// The files that stand before the source, then the source.
    fn all(&mut self, before: Vec<PathBuf>) -> Result<(), Bad> {
        let top = Origin { file: 0, at: 0 };
        for path in before {
            let text = include::read(&path).map_err(|e| Bad { from: top, message: e })?;
            let from = self.add(File { name: path.display().to_string(), text }, Some(path));
            self.file(from.file, 0)?;
            self.out.text.put("\n", from);
        }
        self.file(0, 0)
    }

    fn add(&mut self, file: File, path: Option<PathBuf>) -> Origin {
        self.out.files.push(file);
        self.paths.push(path);
        Origin { file: self.out.files.len() - 1, at: 0 }
    }

    fn file(&mut self, file: usize, depth: usize) -> Result<(), Bad> {
        let raw = &self.out.files[file].text;
        self.bytes += raw.len();
        if self.bytes > limits::INCLUDED {
            let message =
                format!("with this file more than {} bytes are included, the limit", limits::INCLUDED);
            return Err(Bad { from: Origin { file, at: 0 }, message });
        }
        let text = without_comments(raw);
        let mut open: Vec<Open> = Vec::new();
        let (mut at, mut chunk) = (0, 0);
        while at < text.len() {
            let length = self.directive_length(&text[at..]);
            let end = at + length.unwrap_or_else(|| line(&text[at..]));
            if length.is_some() {
                self.code(&text[chunk..at], Origin { file, at: chunk }, &open)?;
                self.directive(&text[at..end], Origin { file, at }, &mut open, depth)?;
                // Ends of lines stay, so that the next line is one.
                self.out.text.put("\n", Origin { file, at });
                chunk = end;
            }
            at = end;
        }
        if let Some(open) = open.last() {
            return Err(Bad { from: open.from, message: format!("`{}` has no #endif", open.line) });
        }
        self.code(&text[chunk..], Origin { file, at: chunk }, &open)
    }

    /// Length of the directive that a text begins with: its line, with those that backslashes join
    /// to it; an import of WGSL ends where its braces do, and one of WESL with a semicolon.
    fn directive_length(&self, text: &str) -> Option<usize> {
        let first = text.trim_start_matches([' ', '\t']);
        let wgsl = self.language == ShaderLanguage::Wgsl;
        if wgsl && first.starts_with("import ") {
            return Some(text.find(';').map_or(text.len(), |at| at + 1));
        }
        let rest = first.strip_prefix('#')?;
        if wgsl && rest.starts_with('{') {
            return None;
        }
        let import = wgsl && rest.trim_start().starts_with("import");
        let (mut end, mut depth) = (0, 0_i64);
        loop {
            let line = &text[end..end + line(&text[end..])];
            end += line.len();
            depth += line.bytes().map(|b| i64::from(b == b'{') - i64::from(b == b'}')).sum::<i64>();
            let joined =
                line.trim_end().ends_with('\\') || import && (depth > 0 || line.trim_end().ends_with(','));
            if !joined || end == text.len() {
                return Some(end);
            }
        }
    }

    /// Adds what stands between directives, if it is read.
    fn code(&mut self, part: &str, from: Origin, open: &[Open]) -> Result<(), Bad> {
        if part.is_empty() || !open.last().is_none_or(|o| o.active) {
            return Ok(());
        }
        let mut part = part.replace("\\\n", " \n");
        if self.language == ShaderLanguage::Wgsl {
            part = self.attributes(&imports::inserted(&part), from)?;
        }
        for token in self.macros.expand(tokens(&part, from))? {
            if token.copied {
                self.out.text.copy(&token.text, token.from);
            } else {
                self.out.text.put(&token.text, token.from);
            }
        }
        Ok(())
    }

    fn directive(&mut self, text: &str, from: Origin, open: &mut Vec<Open>, depth: usize) -> Result<(), Bad> {
        let flat = text.replace("\\\n", " \n");
        let lead = flat.len() - flat.trim_start_matches([' ', '\t', '#']).len();
        let all = tokens(&flat[lead..], Origin { at: from.at + lead, ..from });
        let mut names = all.iter().filter(|t| t.kind != Kind::Blank).map(|t| t.text.as_str());
        let (name, next) = (names.next().unwrap_or(""), names.next().unwrap_or(""));
        // naga_oil writes `#else if` and `#else ifdef`.
        let chained = name == "else" && matches!(next, "if" | "ifdef" | "ifndef");
        let (skip, test) = match name {
            "if" | "ifdef" | "ifndef" => (1, name),
            "else" if chained => (2, next),
            "elif" | "elifdef" | "elifndef" => (1, &name[2..]),
            _ => (1, ""),
        };
        let nth = all.iter().enumerate().filter(|(_, t)| t.kind != Kind::Blank).nth(skip - 1);
        let rest = nth.map_or(&[][..], |(k, _)| &all[k + 1..]);
        let line = flat.split_whitespace().collect::<Vec<_>>().join(" ");
        let [start, end] = [from.at, from.at + text.len()];
        let here = Open { active: false, done: false, around: true, from, line, start: end };
        let active = open.last().is_none_or(|o| o.active);
        match name {
            "if" | "ifdef" | "ifndef" => {
                let holds = active && self.holds(test, rest, from)?;
                open.push(Open { active: holds, done: holds, around: active, ..here });
            }
            "else" | "elif" | "elifdef" | "elifndef" | "endif" => {
                let Some(top) = open.pop() else {
                    return Err(Bad { from, message: format!("`{}` has no #if", here.line) });
                };
                if !top.active && top.around {
                    let range = [top.start, start];
                    self.out.excluded.push(Excluded { from: top.from, line: top.line.clone(), range });
                }
                if name != "endif" {
                    let asked = top.around && !top.done;
                    let holds = asked && (test.is_empty() || self.holds(test, rest, from)?);
                    let line = if test.is_empty() { format!("#else of {}", top.line) } else { here.line };
                    open.push(Open {
                        active: holds,
                        done: top.done || holds,
                        around: top.around,
                        line,
                        ..here
                    });
                }
            }
            _ if active => self.other(name, rest, &here, &flat[lead..], depth)?,
            _ => {}
        }
        Ok(())
    }

    /// A directive that is no condition.
    fn other(
        &mut self,
        name: &str,
        rest: &[Token],
        here: &Open,
        text: &str,
        depth: usize,
    ) -> Result<(), Bad> {
        match name {
            "define" => {
                self.macros.define(rest);
            }
            "undef" => {
                for token in rest.iter().filter(|t| t.kind == Kind::Name) {
                    self.macros.known.remove(&token.text);
                }
            }
            "pragma" if rest.iter().any(|t| t.is("once")) => {
                self.once.extend(self.paths[here.from.file].clone());
            }
            "include" => self.include(text, here, depth)?,
            "import" if self.language == ShaderLanguage::Wgsl => self.import(rest, here, depth)?,
            // What says nothing about what functions compute.
            _ => {}
        }
        Ok(())
    }

    fn holds(&mut self, test: &str, rest: &[Token], from: Origin) -> Result<bool, Bad> {
        let known = || {
            rest.iter()
                .find(|t| t.kind == Kind::Name)
                .is_some_and(|t| self.macros.known.contains_key(&t.text))
        };
        match test {
            "ifdef" | "def" => Ok(known()),
            "ifndef" | "ndef" => Ok(!known()),
            _ => condition::holds(rest, &mut self.macros, from),
        }
    }

    /// The file of an `#include`, or a note that it is not read.
    fn include(&mut self, text: &str, here: &Open, depth: usize) -> Result<(), Bad> {
        let name = text["include".len()..].trim();
        let inner = |open: char, close: char| {
            let rest = name.strip_prefix(open)?;
            rest.find(close).map(|end| &rest[..end])
        };
        let found = match (inner('"', '"'), inner('<', '>')) {
            (Some(name), _) => self.folders.find(name, true, self.paths[here.from.file].as_deref()),
            (None, Some(name)) => self.folders.find(name, false, self.paths[here.from.file].as_deref()),
            (None, None) => None,
        };
        match found {
            Some(path) if self.once.contains(&path) => Ok(()),
            Some(path) => self.read(path, here, depth),
            None => {
                self.lacks(here, here.line.clone(), "it is in no folder that --include names".into());
                Ok(())
            }
        }
    }

    /// Takes note of a file that is not read.
    fn lacks(&mut self, here: &Open, line: String, reason: String) {
        self.out.missing.push(Missing { from: here.from, line, reason });
    }

    /// Reads a file that another asks for.
    fn read(&mut self, path: PathBuf, here: &Open, depth: usize) -> Result<(), Bad> {
        if depth >= limits::INCLUDE_DEPTH {
            let line = &here.line;
            let message =
                format!("`{line}`: files that include one another are deeper than {depth}, the limit");
            return Err(Bad { from: here.from, message });
        }
        match include::read(&path) {
            Ok(text) => {
                let from = self.add(File { name: path.display().to_string(), text }, Some(path));
                self.file(from.file, depth + 1)
            }
            Err(reason) => {
                self.lacks(here, here.line.clone(), reason);
                Ok(())
            }
        }
    }
}

/// Length of the line that a text begins with.
fn line(text: &str) -> usize {
    text.find('\n').map_or(text.len(), |at| at + 1)
}
