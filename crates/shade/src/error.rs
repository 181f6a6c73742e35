//! Everything that can be wrong with a formula, its domain or its arithmetic.

use std::fmt;

use super::Precision;

/// A place in a hypothesis's source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// File as named by the caller.
    pub file: String,
    /// 1-based line.
    pub line: usize,
    /// 1-based column, in characters.
    pub column: usize,
    /// The source text at fault, its first line only, at most 80 characters.
    pub excerpt: String,
}

impl Place {
    /// The place of byte range `start..end` of `source`; ends beyond the source are clamped to it.
    /// The name of a function that is called is shown with its arguments.
    pub fn of(file: &str, source: &str, start: usize, end: usize) -> Place {
        let start = floor_char(source, start);
        let end = after_arguments(source, start, floor_char(source, end).max(start));
        let line_start = source[..start].rfind('\n').map_or(0, |i| i + 1);
        let text = source[start..end].lines().next().unwrap_or("").trim_end();
        Place {
            file: file.to_string(),
            line: source[..start].matches('\n').count() + 1,
            column: source[line_start..start].chars().count() + 1,
            excerpt: text.chars().take(80).collect(),
        }
    }
}

/// Where the arguments end, if `start..end` is a name before an opening parenthesis; else `end`.
fn after_arguments(source: &str, start: usize, end: usize) -> usize {
    let name = &source[start..end];
    if name.is_empty()
        || !name.chars().all(|c| c.is_alphanumeric() || c == '_')
        || !source[end..].starts_with('(')
    {
        return end;
    }
    let mut depth = 0;
    for (at, c) in source[end..].char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth == 1 => return end + at + 1,
            ')' => depth -= 1,
            _ => {}
        }
    }
    end
}

/// The largest character boundary of `source` not above `at`.
fn floor_char(source: &str, at: usize) -> usize {
    let mut at = at.min(source.len());
    while !source.is_char_boundary(at) {
        at -= 1;
    }
    at
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)?;
        if self.excerpt.is_empty() { Ok(()) } else { write!(f, ": `{}`", self.excerpt) }
    }
}

/// A value that is not finite, in words.
pub fn value_words(value: f64) -> &'static str {
    match value {
        x if x.is_nan() => "not a number",
        x if x > 0.0 => "infinite",
        _ => "negative and infinite",
    }
}

/// A point in words: `alpha = 0, mu = 0.5`.
fn point_words(at: &[(String, f32)]) -> String {
    if at.is_empty() {
        return "every point".into();
    }
    at.iter().map(|(name, x)| format!("{name} = {x}")).collect::<Vec<_>>().join(", ")
}

/// What can be wrong with a formula, its domain, its numbers or its arithmetic.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShadeError {
    /// The source is not WGSL, or does not type-check.
    #[error("{place}: {message}")]
    Syntax {
        /// Where.
        place: Box<Place>,
        /// What the WGSL front end says.
        message: String,
    },
    /// The source is WGSL, but uses something that hypotheses may not.
    #[error("{place}: {message}")]
    Dialect {
        /// Where.
        place: Box<Place>,
        /// What is not allowed, and what is.
        message: String,
    },
    /// A limit on the size of a hypothesis is passed.
    #[error("{file}: {what}: {found}, the limit is {limit}")]
    TooLarge {
        /// File as named by the caller.
        file: String,
        /// What is too large.
        what: &'static str,
        /// Size found.
        found: usize,
        /// Largest size allowed.
        limit: usize,
    },
    /// A formula can leave the reals inside its domain, or could not be proven not to.
    #[error("{place}: {function} {hazard} near {at}")]
    Irregular {
        /// The sub-expression at fault.
        place: Box<Place>,
        /// Function's name.
        function: String,
        /// What happens: `may divide by zero`, ...
        hazard: &'static str,
        /// The box where it could not be excluded: `alpha = 0.1 .. 0.2, mu = ...`.
        at: String,
    },
    /// A domain does not make sense.
    #[error("domain: input {input}: {message}")]
    Domain {
        /// Input's name.
        input: String,
        /// What is wrong with it.
        message: String,
    },
    /// A formula asks for an input that the domain or the data do not give.
    #[error("{function}: input {input} is not one of {given}")]
    UnknownInput {
        /// Function's name.
        function: String,
        /// Name of its argument.
        input: String,
        /// The inputs that are given.
        given: String,
    },
    /// Data, coefficients or points of the wrong number.
    #[error("{what}: {found} given, {expected} expected")]
    Shape {
        /// What was counted.
        what: String,
        /// Count given.
        found: usize,
        /// Count expected.
        expected: usize,
    },
    /// A datum is NaN or infinite.
    #[error("{column}, sample {index}: value {value:e} is not finite")]
    NotFinite {
        /// Column of the data: an input's name, `scale`, `target`, `coefficient`, `residual`.
        column: String,
        /// Index of the sample.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A formula has no finite value in an arithmetic at a point that it is measured at.
    #[error(
        "{place} is {} in {} at {}, in function {function}; narrow the domain{}", value_words(*value), precision.name(), point_words(at),
        if precision.is_half() { ", scale the formula, or measure it in f32" } else { ", or change this part" }
    )]
    Unmeasurable {
        /// The first sub-expression that is not finite.
        place: Box<Place>,
        /// Function's name.
        function: String,
        /// The arithmetic.
        precision: Precision,
        /// Its value: not a number, or infinite.
        value: f64,
        /// The inputs there, before they are rounded to the arithmetic; empty of a formula without
        /// inputs.
        at: Vec<(String, f32)>,
    },
    /// A number of a formula, or an input, that half precision does not reach.
    #[error(
        "{function}: {what} is infinite in {}, whose largest number is 65504; {remedy}, or measure it in f32", precision.name()
    )]
    Unrepresentable {
        /// Function's name.
        function: String,
        /// The number: `coefficient 100000`, `input x = 70000`.
        what: String,
        /// The arithmetic.
        precision: Precision,
        /// What to change to keep this arithmetic.
        remedy: &'static str,
    },
    /// Syntax that the reader of hypotheses does not let through.
    #[error("{function}: {what}, a defect of this program")]
    Defect {
        /// Function's name.
        function: String,
        /// What was found.
        what: &'static str,
    },
    /// The reader of WGSL could not be started.
    #[error("the WGSL front end could not be started: {message}")]
    Thread {
        /// What the system says.
        message: String,
    },
}
