//! A shader source: preprocessed, cut into items; one function with what it needs, handed to naga's
//! front ends; and places for messages.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use naga::front::{glsl, wgsl};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, Handle, Module, ShaderStage, Span};

use super::items::{Item, items};
use super::library::{self, library};
use super::needed::Index;
use super::preprocess::{Preprocessed, Surroundings, preprocessed, script};
use super::rewrite::{ENTRY, rewrite};
use super::text::{File, Origin, Text, place};
use super::{ShaderLanguage, eager::eager};
use crate::foreign::recognise::EMPTY;
use crate::foreign::text::nesting;
use crate::foreign::{ForeignError, error, limits};

/// A shader source.
#[derive(Debug)]
pub(super) struct Source {
    pub file: String,
    pub language: ShaderLanguage,
    files: Arc<Vec<File>>,
    read: Preprocessed,
    items: Vec<Item>,
    /// Items from here on are of the library.
    own: usize,
}

/// A function with what it needs, as the front end read it.
#[derive(Clone, Debug)]
pub(super) struct Program {
    pub module: Module,
    pub entry: Handle<Function>,
    /// What the front end was given.
    text: Text,
    files: Arc<Vec<File>>,
    pub language: ShaderLanguage,
}

/// Most parts that the front end may stumble over: every one costs a parse.
const DROPPED: usize = 64;

/// What the front end would make always, though GLSL makes it only where the left side asks for it.
const EAGER: &str = "write it as an if";

/// What is not an argument, and has no value.
pub(super) const NO_GLOBAL: &str = "make it an argument of the function, or a constant";

/// A part that is left out, and why.
struct Dropped {
    item: usize,
    error: ForeignError,
}

impl Source {
    /// Reads the bytes of a file with what it includes.
    pub fn new(bytes: &[u8], file: &str, around: &Surroundings) -> Result<Source, ForeignError> {
        let file = file.to_string();
        if bytes.is_empty() {
            return Err(ForeignError::new(&file, EMPTY));
        }
        if bytes.len() > limits::SHADER {
            let what = "bytes of a shader source";
            return Err(ForeignError::too_large(&file, what, bytes.len(), limits::SHADER));
        }
        let text = script(&file, error::text(bytes, &file, "source")?);
        let language = guess(&file, &text);
        let path = std::fs::canonicalize(Path::new(&file)).ok();
        let given = File { name: file.clone(), text };
        let mut read = preprocessed(given, path.as_deref(), language, around)?;
        let end = read.text.len();
        let own = library(language);
        read.text.copy(&own, Origin { file: read.files.len(), at: 0 });
        read.files.push(File { name: library::NAME.into(), text: own });
        let deepest = nesting(read.text.as_str(), &file);
        if deepest > limits::NESTING {
            let what = "operators and brackets around a term";
            return Err(ForeignError::too_large(&file, what, deepest, limits::NESTING));
        }
        // What is not closed in the source must not reach into the library.
        let (source, library) = read.text.as_str().split_at(end);
        let mut all = items(source, language);
        let own = all.len();
        all.extend(items(library, language).into_iter().map(|item| item.moved(end)));
        if language == ShaderLanguage::Hlsl {
            for word in all.iter_mut().flat_map(|item| &mut item.words) {
                word.text = super::hlsl::renamed(&word.text);
            }
        }
        let files = Arc::new(std::mem::take(&mut read.files));
        Ok(Source { file, language, files, read, items: all, own })
    }

    /// Functions of the file itself, and of a name if one is given, which may be one of an include
    /// file too; entry points are left out.
    pub fn functions(&self, name: Option<&str>) -> Vec<usize> {
        let index = Index::new(&self.items, self.own);
        let all = match name {
            Some(name) => index.functions(name),
            None => (0..self.own).filter(|i| self.items[*i].body && self.here(*i)).collect(),
        };
        all.into_iter().filter(|i| self.items[*i].name() != "main").collect()
    }

    fn here(&self, item: usize) -> bool {
        self.read.text.origin(self.items[item].range[0]).file == 0
    }

    pub fn item(&self, item: usize) -> &Item {
        &self.items[item]
    }

    /// The error that a function is not there: what is, its overloads if it has any, and the condition that
    /// leaves it out.
    pub fn no_such(&self, entry: &str, name: &str, overloads: &[usize]) -> ForeignError {
        let hint = self.excluded(name);
        if let (Some(hint), []) = (&hint, overloads) {
            return ForeignError::new(&self.file, format!("function {entry} is not there: {hint}"));
        }
        let own = self.functions(None);
        let all = (0..self.own).filter(|i| self.items[*i].body);
        let mut known: Vec<String> = match (overloads, own.is_empty()) {
            // A shader of includes alone has no function of its own.
            ([], true) => all.map(|i| self.items[i].name().to_string()).collect(),
            ([], false) => own.into_iter().map(|i| self.items[i].name().to_string()).collect(),
            _ => overloads.iter().map(|i| self.items[*i].signature()).collect(),
        };
        known.dedup();
        let error = ForeignError::no_such(&self.file, "function", entry, &known);
        let error = hint.iter().fold(error, |error, hint| ForeignError {
            message: format!("{}; {hint}", error.message),
            ..error
        });
        if overloads.is_empty() { self.with_missing(error) } else { error }
    }

    /// The error that a file has no function.
    pub fn no_function(&self) -> ForeignError {
        let message = "no function in it but entry points: write the formula as a function of its own";
        self.with_missing(ForeignError::new(&self.file, message))
    }

    /// The condition that leaves out a function of a name.
    fn excluded(&self, name: &str) -> Option<String> {
        // A type stands before a name that is declared.
        let typed = |before: &str| {
            let word = |c: char| c.is_alphanumeric() || c == '_' || c == '>';
            let last = before.trim_end_matches([' ', '\t']);
            last.len() < before.len() && last.ends_with(word) && !last.ends_with("return")
        };
        let declares = |text: &str| {
            text.match_indices(name)
                .any(|(at, _)| typed(&text[..at]) && text[at + name.len()..].trim_start().starts_with('('))
        };
        self.read.excluded.iter().find_map(|part| {
            let text = &self.files[part.from.file].text;
            let [start, end] = part.range;
            let (file, spot) = place(&self.files, part.from);
            declares(text.get(start..end)?)
                .then(|| format!("`{}` at {file}: {spot} leaves it out; --define gives names", part.line))
        })
    }

    /// The error with what was not included, if anything was not.
    fn with_missing(&self, error: ForeignError) -> ForeignError {
        const NAMED: usize = 3;
        let named = self.read.missing.iter().take(NAMED).map(|missing| {
            let (file, spot) = place(&self.files, missing.from);
            format!("`{}` at {file}: {spot} ({})", missing.line, missing.reason)
        });
        let named: Vec<String> = named.collect();
        if named.is_empty() {
            return error;
        }
        let more = self.read.missing.len() - named.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let message = format!("{}; not included: {}{more}", error.message, named.join(", "));
        ForeignError { message, ..error }
    }

    /// A function with what it needs, type-checked. What it may need and cannot be read is left
    /// out, until it is known to be needed.
    ///
    /// # Errors
    /// What it needs cannot be read, with its place.
    pub fn program(&self, entry: usize) -> Result<Program, ForeignError> {
        let index = Index::new(&self.items, self.own);
        let mut dropped: Vec<Dropped> = Vec::new();
        loop {
            let out: BTreeSet<usize> = dropped.iter().map(|d| d.item).collect();
            let needed = index.needed(entry, &out);
            let (stumbled, error) = match self.refused(&index, &needed) {
                Some(found) => found,
                None => match self.parsed(&needed, entry) {
                    Ok(program) => return Ok(program),
                    Err((at, error)) => (at, self.with_missing(error)),
                },
            };
            // Why something that it names is not there says more.
            let names = |d: &&Dropped| self.items[d.item].names.iter().any(|n| quotes(&error.message, n));
            let error = dropped.iter().find(names).map_or(error.clone(), |d| d.error.clone());
            match stumbled {
                Some(item) if item != entry && dropped.len() < DROPPED => {
                    dropped.push(Dropped { item, error })
                }
                _ => return Err(error),
            }
        }
    }

    /// What is not read whatever the front end says: textures, and what changes on the right of
    /// `&&` or `||`.
    fn refused(&self, index: &Index, needed: &[usize]) -> Option<(Option<usize>, ForeignError)> {
        if self.language == ShaderLanguage::Wgsl {
            return None;
        }
        let text = self.read.text.as_str();
        let written = index.writers(needed);
        let (functions, others): (Vec<usize>, Vec<usize>) =
            needed.iter().copied().partition(|i| self.items[*i].function);
        let of = |kind: fn(&Item) -> bool| -> BTreeSet<&str> {
            let those = others.iter().map(|i| &self.items[*i]).filter(|item| kind(item));
            those.flat_map(|item| &item.names).map(String::as_str).collect()
        };
        let (textures, uniforms) = (of(Item::reads_texture), of(Item::is_uniform));
        let mut found = functions.into_iter().filter_map(|i| {
            let item = &self.items[i];
            let name = item.name();
            if item.reads_texture() || item.words.iter().any(|w| textures.contains(w.text.as_str())) {
                let what = format!("`{name}`, a function that reads a texture,");
                let advice = "audit the texture's own file as a table";
                return Some((Some(i), self.lacking(item.range[0], what, advice)));
            }
            if let Some(word) = item.words.iter().find(|w| uniforms.contains(w.text.as_str())) {
                let what = format!("`{name}` reads the uniform `{}`, which", word.text);
                return Some((Some(i), self.lacking(word.at, what, NO_GLOBAL)));
            }
            let (at, what) = eager(text, item.range, &|name| written.contains(name))?;
            let what = format!("in `{name}`, {what} on the right of && or ||");
            Some((Some(i), self.lacking(at, what, EAGER)))
        });
        // The innermost stands first.
        found.next()
    }

    /// What the front end makes of some items; else the item that it stumbles over.
    fn parsed(&self, needed: &[usize], entry: usize) -> Result<Program, (Option<usize>, ForeignError)> {
        let (mut text, mut starts) = (Text::default(), Vec::new());
        for &i in needed {
            starts.push((text.len(), i));
            rewrite(&self.read.text, &self.items[i], i == entry, self.language, &mut text);
        }
        let end = text.origin(text.len());
        if self.language != ShaderLanguage::Wgsl {
            text.put("void main() {}\n", end);
        }
        let refused = |span: Option<Span>, message: String| {
            let at = span.and_then(|s| s.to_range()).map(|r| r.start);
            let origin = text.origin(at.unwrap_or(usize::MAX));
            let (file, spot) = place(&self.files, origin);
            let item = at.map(|at| starts.partition_point(|s| s.0 <= at)).and_then(|k| k.checked_sub(1));
            (item.map(|k| starts[k].1), ForeignError::at(file, spot, message))
        };
        let module = match self.language {
            ShaderLanguage::Wgsl => front_wgsl(text.as_str()),
            ShaderLanguage::Glsl | ShaderLanguage::Hlsl => front_glsl(text.as_str()),
        };
        let what = match self.language {
            ShaderLanguage::Wgsl => "no valid WGSL",
            ShaderLanguage::Glsl => "no GLSL that can be read",
            ShaderLanguage::Hlsl => "no HLSL that can be read",
        };
        let module = module.map_err(|(span, message)| refused(span, format!("{what}: {message}")))?;
        Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).map_err(|e| {
            let span = e.spans().map(|(span, _)| *span).find(Span::is_defined);
            refused(span, format!("no valid shader: {}", chain(e.as_inner())))
        })?;
        let found = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(ENTRY));
        let entry = found.map(|(handle, _)| handle);
        let lost = || (None, ForeignError::new(&self.file, "the front end gave up on this function"));
        let entry = entry.ok_or_else(lost)?;
        Ok(Program { module, entry, text, files: Arc::clone(&self.files), language: self.language })
    }

    fn lacking(&self, at: usize, what: impl AsRef<str>, advice: &str) -> ForeignError {
        let (file, spot) = place(&self.files, self.read.text.origin(at));
        ForeignError::unsupported(file, spot, what.as_ref(), advice)
    }
}

impl Program {
    /// The function, and where it stands.
    pub fn function(&self) -> (&Function, Span) {
        (&self.module.functions[self.entry], self.module.functions.get_span(self.entry))
    }

    /// The error that something is not read.
    pub fn unsupported(&self, span: Span, what: impl AsRef<str>, advice: &str) -> ForeignError {
        let at = span.to_range().map_or(0, |r| r.start);
        let (file, spot) = place(&self.files, self.text.origin(at));
        ForeignError::unsupported(file, spot, what.as_ref(), advice)
    }

    /// The error that a limit is passed.
    pub fn too_large(&self, what: &str, found: usize, limit: usize) -> ForeignError {
        ForeignError::too_large(&self.files[0].name, what, found, limit)
    }
}

/// Whether a message names something in quotation marks.
fn quotes(message: &str, name: &str) -> bool {
    [('\'', '\''), ('`', '`'), ('"', '"')].iter().any(|(a, b)| message.contains(&format!("{a}{name}{b}")))
}

type Stumbled = (Option<Span>, String);

fn front_wgsl(text: &str) -> Result<Module, Stumbled> {
    wgsl::parse_str(text).map_err(|e| {
        let label = e.labels().next();
        let words = label.as_ref().map_or(String::new(), |(_, text)| format!(" ({text})"));
        (label.map(|(span, _)| span), format!("{}{words}", e.message()))
    })
}

fn front_glsl(text: &str) -> Result<Module, Stumbled> {
    let options = glsl::Options::from(ShaderStage::Fragment);
    glsl::Frontend::default().parse(&options, text).map_err(|errors| {
        let first = errors.errors.first();
        let message = first.map_or(String::new(), |e| e.kind.to_string());
        (first.map(|e| e.meta).filter(Span::is_defined), message)
    })
}

/// By the extension, else by words that one language alone has.
fn guess(file: &str, text: &str) -> ShaderLanguage {
    let extension = file.rsplit_once('.').map_or("", |(_, extension)| extension);
    let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    match extension.to_ascii_lowercase().as_str() {
        "wgsl" | "wesl" => ShaderLanguage::Wgsl,
        "glsl" | "frag" | "vert" | "comp" | "fs" | "vs" | "glslf" | "js" | "mjs" | "ts" => {
            ShaderLanguage::Glsl
        }
        "hlsl" | "hlsli" | "fx" | "fxh" | "usf" | "ush" | "slang" | "slangh" | "cginc" => {
            ShaderLanguage::Hlsl
        }
        _ if words.clone().any(|word| word == "fn") => ShaderLanguage::Wgsl,
        _ if words.any(|word| matches!(word, "float2" | "float3" | "float4" | "half3" | "lerp")) => {
            ShaderLanguage::Hlsl
        }
        _ => ShaderLanguage::Glsl,
    }
}

/// An error with its causes in one line.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}
