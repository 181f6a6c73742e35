//! What is said of a file beside its scene.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::texture::Extremes;

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum About {
    /// What the file asks for and this version does not have.
    Missing,
    /// How the file was read, and how the emitted functions are called with its values.
    Reading,
}

/// What a file says that its scene does not hold, and the names of the materials that say it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Note {
    /// What it is about.
    pub about: About,
    /// A sentence.
    pub text: String,
    /// Names as the scene has them; none where it is said of the file.
    pub of: Vec<String>,
    /// The roughness with the texels that a quantile leaves out, where it is of that.
    #[serde(skip)]
    pub beyond: Option<[f64; 2]>,
}

/// Names that a message lists.
const NAMED: usize = 3;

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let named = self.of.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
        match self.of.len() {
            0 => f.write_str(&self.text),
            n if n == NAMED + 1 => write!(f, "{}: {}", self.of.join(", "), self.text),
            n if n > NAMED => write!(f, "{named} and {} more: {}", n - NAMED, self.text),
            _ => write!(f, "{named}: {}", self.text),
        }
    }
}

/// Sentences about one material.
#[derive(Debug, Default)]
pub(crate) struct Said(pub Vec<Sentence>);

/// A sentence of a note: what it is about, its text, and [`Note::beyond`].
pub(crate) type Sentence = (About, String, Option<[f64; 2]>);

impl Said {
    pub fn missing(&mut self, text: impl Into<String>) {
        self.0.push((About::Missing, text.into(), None));
    }

    pub fn reading(&mut self, text: impl Into<String>) {
        self.0.push((About::Reading, text.into(), None));
    }
}

/// Notes, each text once, of a quantile once for each roughness with what it leaves out.
#[derive(Default)]
pub(crate) struct Notes {
    all: Vec<Note>,
    places: BTreeMap<(String, Option<[u64; 2]>), usize>,
}

impl Notes {
    /// Adds a note, or a name to the one of its text.
    pub fn add(&mut self, (about, text, beyond): Sentence, of: Option<&str>) {
        let key = (text, beyond.map(|ends| ends.map(f64::to_bits)));
        let place = *self.places.entry(key).or_insert_with_key(|(text, _)| {
            self.all.push(Note { about, text: text.clone(), of: Vec::new(), beyond });
            self.all.len() - 1
        });
        self.all[place].of.extend(of.map(String::from));
    }

    pub fn finish(self) -> Vec<Note> {
        self.all
    }
}

impl Said {
    /// Says what the quantile leaves out of a texture's range, if anything; `roughness` makes roughness of a
    /// texel of that.
    pub fn beyond(
        &mut self,
        what: &str,
        extremes: &Extremes,
        quantile: f64,
        roughness: Option<&dyn Fn(f64) -> f64>,
    ) {
        let Extremes { kept, all } = extremes;
        if kept != all {
            let [[low, high], [least, most]] = [kept, all].map(|ends| ends.map(short));
            let share = short(100.0 * quantile);
            let text = format!(
                "{what} without {share} % of the texels at each end is [{low}, {high}] of its factor, with them [{least}, {most}]: \
                 what is promised is void there"
            );
            self.0.push((About::Reading, text, roughness.map(|of| ordered(all.map(of)))));
        }
    }

    /// Says that a texture's values are not known, and the range that is taken for them.
    pub fn unknown(&mut self, what: &str, why: &str, range: [f64; 2]) {
        let [low, high] = range.map(short);
        self.missing(format!("{what} has an image {why}: it takes [{low}, {high}]"));
    }
}

/// The ends in order.
fn ordered([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// Four decimals, which tell the values of 8 bits apart.
fn short(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}
