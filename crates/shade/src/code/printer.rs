//! What a language does its own way: everything that differs between the languages of the emitted
//! code is a method here.

use super::expression::{Text, Writer};
use super::table::TableLookup;
use super::words::Words;
use crate::{Builtin, Expr, Fetches, Function, Kind};

/// What a language is called, and what its files begin with.
pub(super) struct Facts {
    /// The word used in the manifest and on the command line.
    pub name: &'static str,
    /// The name that people give it.
    pub title: &'static str,
    /// What follows the dot in a file's name.
    pub extension: &'static str,
    /// Begins a line of a file's opening comment.
    pub comment: &'static str,
    /// What a file of printed functions says of its language: what it needs, and what becomes of
    /// bits.
    pub notes: &'static [&'static str],
    /// What printed functions need before them in their file, once; empty or ends in a line feed.
    pub opening: &'static str,
    /// What a file says before its functions where it needs nothing else.
    pub attributes: &'static str,
    /// Whether its lookups read arrays, in the order of the `raw` file, for want of textures.
    pub reads_arrays: bool,
    /// Its words.
    pub words: Words,
}

/// A printer: one for each language, without state.
pub(super) trait Printer: Sync {
    /// Names and words.
    fn facts(&self) -> &'static Facts;

    /// The directive that its type of numbers needs at the start of a file; empty or ends in a line
    /// feed.
    fn enables(&self) -> &'static str {
        ""
    }

    /// A literal; `typed` where nothing else says its type.
    fn number(&self, x: f32, typed: bool) -> String;

    /// What stands where a literal alone is the value of two evaluations at once; none where a number
    /// is a number.
    fn both(&self, _literal: &str) -> Option<String> {
        None
    }

    /// true or false.
    fn truth(&self, x: bool) -> &'static str {
        if x { "true" } else { "false" }
    }

    /// The name of a type.
    fn kind(&self, kind: Kind) -> String;

    /// A component of a vector.
    fn component(&self, vector: &str, i: usize) -> String {
        format!("{vector}.{}", &"xyzw"[i..=i])
    }

    /// Whether the language has arithmetic of vectors; where it has none, each component is written
    /// out.
    fn has_vectors(&self) -> bool {
        true
    }

    /// A vector of these components.
    fn vector(&self, components: &[String]) -> String {
        format!("{}({})", self.kind(Kind::Vector(components.len() as u8)), components.join(", "))
    }

    /// An argument with its type.
    fn argument(&self, name: &str, kind: &str) -> String;

    /// What stands before and after the arguments of a function; `public` for one that a file
    /// offers.
    fn signature(&self, name: &str, result: &str, public: bool) -> [String; 2];

    /// Lines before a function, for what its names and statements are.
    fn attributes(&self, _function: &Function, _names: &[String], _name: &str) -> String {
        String::new()
    }

    /// The statement that uses an argument which nothing else does, where compilers ask for it.
    fn unused(&self, _name: &str) -> Option<String> {
        None
    }

    /// `let name = ` or `let mut name: f32 = `; `typed` where the value does not say its type.
    fn declare(&self, name: &str, kind: Kind, mutable: bool, typed: bool) -> String;

    /// The condition of an `if`.
    fn condition(&self, condition: String) -> String {
        format!("({condition})")
    }

    /// Whether a function's last value is written without `return`.
    fn tail(&self) -> bool {
        false
    }

    /// Whether a function may return a vector that it makes in the same statement; else the vector
    /// gets a name first.
    fn returns_vectors(&self) -> bool {
        true
    }

    /// The lines that open a loop over an array: the statement, and what names the vector where the
    /// statement does not.
    fn each(&self, element: &str, list: &str, n: u8) -> Vec<String>;

    /// The name of a copy of an array that may be indexed, and the statement that makes it; none
    /// where the argument may be.
    fn copied(&self, _list: &str) -> Option<[String; 2]> {
        None
    }

    /// The structure of weighted fetches, without its documentation.
    fn fetches(&self, fetches: &Fetches) -> String;

    /// The statements that return such a structure, with a name that is free: what to fetch, then
    /// the weights.
    fn give_fetches(&self, kind: &str, name: &str, lists: [&[String]; 2]) -> Vec<String>;

    /// A built-in function.
    fn builtin(&self, writer: &Writer, builtin: Builtin, operands: &[Expr], typed: bool) -> Text;

    /// What stands in for a built-in that the language lacks: `mix`, `smoothstep`; none where it
    /// has one, or where an expression does.
    fn lacking(&self, builtin: Builtin, operands: &[Expr]) -> Option<&'static str>;

    /// The function that stands in, by what it computes (`mix`, `pow5`).
    fn helper(&self, base: &str, name: &str) -> String;

    /// Whether helpers stand inside the function that calls them.
    fn nests_helpers(&self) -> bool {
        false
    }

    /// The lookup of a table.
    fn lookup(&self, table: &TableLookup) -> String;

    /// What lookups and other functions of vectors share, as far as these texts of functions use
    /// it.
    fn shared(&self, _functions: &str) -> String {
        String::new()
    }

    /// Whether a built-in's rounding is that of the tape, on a machine of IEEE 754.
    fn rounds(&self, _builtin: Builtin) -> bool {
        true
    }
}

/// The lines of the fields of a structure of so many fetches.
pub(super) fn fields(n: u8, field: impl Fn(Kind, &str) -> String) -> String {
    let fetches = (0..n).map(|i| field(Kind::Vector(4), &format!("fetch_{i}")));
    let weights = (0..n).map(|i| field(Kind::Number, &format!("weight_{i}")));
    fetches.chain(weights).map(|field| format!("    {field}\n")).collect()
}
