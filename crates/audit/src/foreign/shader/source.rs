//! Shader sources: checked, handed to naga's front ends, and pointed at in messages.

use naga::front::{glsl, wgsl};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, ShaderStage, Span};

use super::ShaderLanguage;
use super::cut::Cut;
use super::items::{items, plain_arguments};
use crate::foreign::recognise::EMPTY;
use crate::foreign::text::{called, nesting};
use crate::foreign::{ForeignError, Spot, error, limits};

/// A shader source.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub file: String,
    pub text: String,
    pub language: ShaderLanguage,
    /// What stands before the text as the front end is given it.
    prelude: &'static str,
}

/// Directives of GLSL that say nothing about what functions compute, and that the front end
/// stumbles over.
const DIRECTIVES: [&str; 6] = ["version", "extension", "pragma", "line", "include", "import"];

/// Most functions that the front end may stumble over: every one costs a parse.
const DROPPED: usize = 64;

impl Source {
    /// Checks the bytes of a file.
    pub fn new(bytes: &[u8], file: &str) -> Result<Source, ForeignError> {
        let file = file.to_string();
        if bytes.is_empty() {
            return Err(ForeignError::new(&file, EMPTY));
        }
        let too_large =
            |what: &str, found: usize, limit: usize| ForeignError::too_large(&file, what, found, limit);
        if bytes.len() > limits::SHADER {
            return Err(too_large("bytes of a shader source", bytes.len(), limits::SHADER));
        }
        let text = error::text(bytes, &file, "source")?.to_string();
        let deepest = nesting(&text, &file);
        if deepest > limits::NESTING {
            return Err(too_large("operators and brackets around a term", deepest, limits::NESTING));
        }
        let language = guess(&file, &text);
        let prelude = if language == ShaderLanguage::Glsl { prelude(&text) } else { "" };
        Ok(Source { file, text, language, prelude })
    }

    /// The module of the source, type-checked, and the names of functions of GLSL that are left out
    /// of it: those that the front end cannot read and that the one asked for does not need.
    pub fn parse(&self, entry: Option<&str>) -> Result<(Module, Vec<String>), ForeignError> {
        let (module, left_out) = match self.language {
            ShaderLanguage::Wgsl => (self.wgsl()?, Vec::new()),
            ShaderLanguage::Glsl => self.glsl(entry)?,
        };
        Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).map_err(|e| {
            let span = e.spans().map(|(span, _)| *span).find(Span::is_defined);
            self.malformed(span, format!("no valid shader: {}", chain(e.as_inner())))
        })?;
        Ok((module, left_out))
    }

    fn wgsl(&self) -> Result<Module, ForeignError> {
        wgsl::parse_str(&self.text).map_err(|e| {
            let label = e.labels().next();
            let text = label.as_ref().map_or(String::new(), |(_, text)| format!(" ({text})"));
            self.malformed(label.map(|(span, _)| span), format!("no valid WGSL: {}{text}", e.message()))
        })
    }

    /// Parses until what the front end stumbles over is needed, or nothing is left.
    fn glsl(&self, entry: Option<&str>) -> Result<(Module, Vec<String>), ForeignError> {
        let mut cut = Cut::new(self, entry)?;
        let options = glsl::Options::from(ShaderStage::Fragment);
        let (mut refused, mut dropped) = (None, 0);
        loop {
            let text = format!("{}{}", self.prelude, plain_arguments(&blanked(&cut.text(&self.text))));
            let errors = match glsl::Frontend::default().parse(&options, &text) {
                Ok(module) if cut.holds_any() || refused.is_none() => return Ok((module, cut.left_out())),
                Ok(_) => {
                    return Err(
                        refused.unwrap_or_else(|| self.malformed(None, "no GLSL that can be read".into()))
                    );
                }
                Err(errors) => errors,
            };
            let first = errors.errors.first();
            let message = first.map_or(String::new(), |e| e.kind.to_string());
            let span = first.map(|e| e.meta).filter(Span::is_defined);
            let error = self.malformed(span, format!("no GLSL that can be read: {message}"));
            let at = span.and_then(|s| s.to_range()).map(|r| self.own(r.start));
            dropped += 1;
            if dropped > DROPPED || !at.is_some_and(|at| cut.drop_at(at)) {
                return Err(error);
            }
            refused = refused.or(Some(error));
        }
    }

    /// The byte of the text at one of what the front end was given.
    fn own(&self, at: usize) -> usize {
        at.saturating_sub(self.prelude.len())
    }

    /// Line and column of a span.
    pub fn spot(&self, span: Span) -> Spot {
        Spot::of(&self.text, span.to_range().map_or(0, |r| self.own(r.start)))
    }

    fn malformed(&self, span: Option<Span>, message: String) -> ForeignError {
        ForeignError::at(&self.file, self.spot(span.unwrap_or_default()), message)
    }

    /// The error that something is not read.
    pub fn unsupported(&self, span: Span, what: impl AsRef<str>, advice: &str) -> ForeignError {
        ForeignError::unsupported(&self.file, self.spot(span), what.as_ref(), advice)
    }

    /// The same at a byte of the text.
    pub fn lacking(&self, at: usize, what: impl AsRef<str>, advice: &str) -> ForeignError {
        ForeignError::unsupported(&self.file, Spot::of(&self.text, at), what.as_ref(), advice)
    }

    /// The error that a limit is passed.
    pub fn too_large(&self, what: &str, found: usize, limit: usize) -> ForeignError {
        ForeignError::too_large(&self.file, what, found, limit)
    }
}

/// What stands before GLSL: `saturate`, which engines define for all their sources and shaders call
/// without saying so.
fn prelude(text: &str) -> &'static str {
    let defined = text.lines().any(|l| l.trim_start().starts_with('#') && l.contains(" saturate"));
    let declared = || items(text).iter().any(|i| i.function && i.name == "saturate");
    let missing = called(text, "saturate") && !defined && !declared();
    if missing { "#define saturate(x) clamp(x, 0.0, 1.0)\n" } else { "" }
}

/// By the extension, else by the keyword of WGSL's functions.
fn guess(file: &str, text: &str) -> ShaderLanguage {
    let extension = file.rsplit_once('.').map_or("", |(_, extension)| extension);
    match extension.to_ascii_lowercase().as_str() {
        "wgsl" => ShaderLanguage::Wgsl,
        "glsl" | "frag" | "vert" | "comp" | "fs" | "vs" | "glslf" => ShaderLanguage::Glsl,
        _ if text.split(|c: char| !c.is_alphanumeric()).any(|word| word == "fn") => ShaderLanguage::Wgsl,
        _ => ShaderLanguage::Glsl,
    }
}

/// GLSL with the directives of [`DIRECTIVES`] turned into blanks, byte for byte, so that places
/// stay where they are, and with the `main` that the front end asks for.
fn blanked(text: &str) -> String {
    let is_one = |line: &str| {
        let rest = line.trim_start().strip_prefix('#').map(str::trim_start);
        rest.is_some_and(|rest| DIRECTIVES.iter().any(|word| rest.starts_with(word)))
    };
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        if is_one(line) {
            out.extend(line.bytes().map(|b| if b == b'\n' { '\n' } else { ' ' }));
        } else {
            out.push_str(line);
        }
    }
    if !called(text, "main") {
        out.push_str("\nvoid main() {}\n");
    }
    out
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
