//! The verdict for somebody who writes shaders: one word, one line, at most five points.

mod advice;
mod defect;
mod drop_in;
mod figure;
mod headline;
mod points;
mod reason;
mod words;

pub(super) use defect::sentence;
pub(super) use figure::worst;
pub use figure::{Figure, Kind};
pub(super) use headline::said_limit;
pub(super) use points::{is_loose, of};
pub(crate) use words::place;
pub(super) use words::{along, listed, long, number};

use std::fmt;

use serde::Serialize;

/// The judgement in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Grade {
    /// It is what it is read as; with a limit, within the limit; without one, nothing about it is to
    /// be mended.
    Pass,
    /// It is over the limit, or something about it is to be mended.
    Fail,
    /// It follows no convention that was tried, or a limit was given and not all of it was judged.
    Unknown,
}

impl Grade {
    /// The word, as the first line begins.
    pub fn word(self) -> &'static str {
        match self {
            Grade::Pass => "PASS",
            Grade::Fail => "FAIL",
            Grade::Unknown => "UNKNOWN",
        }
    }
}

/// Whether a file passed, for scripts: without a limit nothing is asked of it unless it is not what it is
/// said to be.
pub(super) fn passed(limit: Option<f64>, passes: bool) -> Option<bool> {
    (limit.is_some() || !passes).then_some(passes)
}

/// The figure that the verdict on an audit is on.
pub(super) fn figure(audit: &super::Audit, limit: Option<f64>) -> Option<Figure> {
    figure::figure(audit, limit).map(|told| told.figure)
}

/// Most characters of a first line whose file has a short name, which a terminal and a log show whole.
const LINE: usize = 200;

/// Characters of a file's name, with the dots that end it, that a first line has even where it grows beyond.
const NAME: usize = 64;

/// A first line behind its word: of the file's name as much as there is room for, and of `more`, which the
/// points say too, the first that there is room for.
pub(crate) fn first_line([what, file, found]: [&str; 3], more: &[String], limit: &str) -> String {
    let length = |text: &str| text.chars().count();
    let room = LINE - length(Grade::Unknown.word()) - 1 - length(limit);
    let file_room = room.saturating_sub(length(what) + length(found)).max(NAME);
    let file = match length(file) <= file_room {
        true => file.to_string(),
        false => file.chars().take(file_room.saturating_sub(1)).chain(['\u{2026}']).collect(),
    };
    let mut line = format!("{what}{file}{found}");
    for text in more {
        if length(&line) + length(text) > room {
            break;
        }
        line += text;
    }
    line + limit
}

/// What is said of a file. Displayed as its first line and a list of what the fields hold; a point of
/// which there is nothing to say is left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// The judgement.
    pub grade: Grade,
    /// Quantity and columns, file, largest error of the use and where: the rest of the first line.
    pub headline: String,
    /// How it is read.
    pub convention: String,
    /// How far off it is, and what is wrong with it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<String>,
    /// What it does to a white furnace.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub furnace: Option<String>,
    /// What to change.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remedy: Vec<String>,
    /// How sure the reading is.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub certainty: String,
}

impl Verdict {
    /// The points with their names, in order.
    pub fn points(&self) -> Vec<(&'static str, String)> {
        let all = [
            ("Convention", self.convention.clone()),
            ("Errors", self.errors.join(" ")),
            ("White furnace", self.furnace.clone().unwrap_or_default()),
            ("Remedy", self.remedy.join("; ")),
            ("Certainty", self.certainty.clone()),
        ];
        all.into_iter().filter(|(_, text)| !text.is_empty()).collect()
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.grade.word(), self.headline)?;
        self.points().into_iter().try_for_each(|(name, text)| write!(f, "\n- {name}: {text}"))
    }
}
