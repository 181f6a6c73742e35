//! Options whose value is a word of a list: read in any case of its letters, completed by the shell, and
//! listed where another is given.

use std::ffi::OsStr;
use std::sync::Arc;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command, Error};

/// Reads a value, of which it knows words that a shell may complete.
#[derive(Clone)]
pub struct Words<T> {
    words: Vec<&'static str>,
    read: Reader<T>,
}

type Reader<T> = Arc<dyn Fn(&str) -> Result<T, String> + Send + Sync>;

impl<T: Clone + Send + Sync + 'static> Words<T> {
    /// One of a list of things, each by its word. `what` it is stands in the error: "no such effect".
    pub fn one_of(what: &'static str, all: impl IntoIterator<Item = (&'static str, T)>) -> Words<T> {
        let all: Vec<(&'static str, T)> = all.into_iter().collect();
        let words: Vec<&'static str> = all.iter().map(|(word, _)| *word).collect();
        let list = words.join(", ");
        Words::read(words, move |text| {
            let found = all.iter().find(|(word, _)| word.eq_ignore_ascii_case(text));
            found.map(|(_, thing)| thing.clone()).ok_or_else(|| format!("no such {what}; there are {list}"))
        })
    }

    /// A value that begins with one of the words, or is one.
    pub fn read(
        words: Vec<&'static str>,
        read: impl Fn(&str) -> Result<T, String> + Send + Sync + 'static,
    ) -> Words<T> {
        Words { words, read: Arc::new(read) }
    }
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for Words<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<T, Error> {
        let read = Arc::clone(&self.read);
        TypedValueParser::parse_ref(&move |text: &str| read(text), command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.words.iter().map(PossibleValue::new)))
    }
}
