//! Do the files of a folder follow from their recipe? Bytes first, else values, else promises.

mod image;
mod packed;
mod provenance;
mod text;

use std::borrow::Cow;
use std::fmt;

use serde::Serialize;

use super::{Baked, BakedTable};
use crate::data::{Channel, Container};
use crate::effects::context::Progress;
use crate::emit::container::{SIDECAR, packed};
use crate::scene::escape::visible;
use crate::store::{self, Entry, Files};
use provenance::Restated;
pub use text::different as different_text;

/// One file that is not what the recipe gives.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Path, relative to the folder.
    pub file: String,
    /// `missing`, `extra` or `different`.
    pub kind: Kind,
    /// How far it is off and where, in words.
    pub detail: String,
    /// Largest difference of a decoded value; none where values cannot be paired, and of constants of
    /// functions, for which no tolerance holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_abs: Option<f64>,
    /// The same in units of the last place of the stored format.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_ulp: Option<u64>,
    /// Where the largest difference is: a cell or a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
    /// For a table: whether its texels keep the stated lookup error all the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub promise_kept: Option<bool>,
}

/// What is wrong with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// It is not there.
    Missing,
    /// It is there and should not be.
    Extra,
    /// Its bytes are others.
    Different,
}

impl Difference {
    /// One of which no value can be told.
    pub fn plain(file: &str, kind: Kind, detail: &str) -> Difference {
        Difference {
            file: file.into(),
            kind,
            detail: detail.into(),
            max_abs: None,
            max_ulp: None,
            at: None,
            promise_kept: None,
        }
    }

    /// Adds whether texels keep a stated error, as it is measured again on them. A promise that cannot
    /// be measured is not kept.
    pub fn judge(
        &mut self,
        stated: f64,
        channels: &[Channel],
        measured_again: impl Fn(&[Channel]) -> Result<f64, String>,
    ) {
        if channels.iter().any(|c| c.texels.iter().any(|t| !t.is_finite())) {
            self.promise_kept = Some(false);
            self.detail += "; promise broken: a texel is not finite";
            return;
        }
        let (kept, says) = match measured_again(channels) {
            Ok(error) => (error <= stated, format!("lookup error {error:.4e}, stated {stated:e}")),
            Err(error) => (false, format!("its lookup cannot be measured: {error}")),
        };
        let word = if kept { "kept at the points tried" } else { "broken" };
        self.promise_kept = Some(kept);
        self.detail += &format!("; promise {word}: {says}");
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Names and lines of a folder that anybody may have written.
        write!(f, "{}: {}", visible(&self.file), visible(&self.detail))
    }
}

/// Every file of the bake that differs from that of `found`, and the `strays`: what else lies in the
/// folder, links in the places of files among it. With `tolerance`, files whose decoded values are all
/// within it pass, but never a table that breaks its stated error, an error that is stated smaller than
/// it is, another end of a range, nor another constant of a function. Another version of the tool, another
/// recipe, or another name in the scene is then no difference; pages of the report are not compared, since
/// they are drawn from the figures.
pub fn compare(
    baked: &Baked,
    found: &Files,
    strays: &[Entry],
    tolerance: Option<f64>,
    progress: &dyn Progress,
) -> Vec<Difference> {
    progress.stage("compare");
    let mut differences = Vec::new();
    let restated = tolerance.map(|_| Restated::new(&baked.files, found));
    for (file, expected) in &baked.files {
        let bytes = found.get(file).map(|bytes| match &restated {
            Some(restated) => restated.apply(bytes, expected),
            None => Cow::Borrowed(bytes.as_slice()),
        });
        match bytes {
            None if strays.iter().any(|stray| stray.name == *file) => {
                differences.push(Difference::plain(
                    file,
                    Kind::Different,
                    "a link or device where the recipe makes a file",
                ));
            }
            None => differences.push(Difference::plain(file, Kind::Missing, "missing: the recipe makes it")),
            Some(bytes) if *bytes == **expected => {}
            Some(_) if tolerance.is_some() && file.ends_with(".html") => {}
            Some(bytes) => differences.push(different(baked, file, expected, &bytes)),
        }
    }
    for stray in strays.iter().filter(|stray| !baked.files.contains_key(&stray.name)) {
        let detail = match stray.kind {
            store::Kind::Other => "extra: a link or device; the recipe does not make it",
            _ => "extra: the recipe does not make it",
        };
        differences.push(Difference::plain(&stray.name, Kind::Extra, detail));
    }
    if let Some(tolerance) = tolerance {
        let beyond = |d: &Difference| d.max_abs.is_none_or(|x| x.is_nan() || x > tolerance);
        differences.retain(|d| beyond(d) || d.promise_kept == Some(false));
    }
    differences
}

/// What a shader reads of a bake, tables and include files, where its numbers or its code are not those of
/// `found`: comments, headers and sidecars aside.
pub fn changed(files: &Files, found: &Files) -> Vec<String> {
    let changed = |file: &str, bytes: &[u8]| match (file.split_once('/'), found.get(file)) {
        (Some(("tables", _)), _) if file.ends_with(SIDECAR) => false,
        (Some(("fits" | "tables", _)), None) => true,
        (Some(("fits", _)), Some(old)) => text::code(old) != text::code(bytes),
        (Some(("tables", _)), Some(old)) => old != bytes && !image::is_same(file, files, found),
        _ => false,
    };
    let changed = files.iter().filter(|(file, bytes)| changed(file, bytes));
    changed.map(|(file, _)| file.clone()).collect()
}

fn different(baked: &Baked, file: &str, expected: &[u8], found: &[u8]) -> Difference {
    let named = |name: &str, c: Container| file == format!("tables/{name}.{}", c.name());
    let container = |t: &BakedTable| Container::ALL.into_iter().find(|c| named(&t.approximation.name, *c));
    let table = baked.tables.iter().find_map(|t| Some((t, container(t)?, t.table()?)));
    let Some((baked, container, table)) = table else { return text::different(file, expected, found) };
    match packed(container, table) {
        Ok(Some(packed)) => packed::different(baked, (table, &packed), file, expected, found),
        Ok(None) => image::different(baked, file, expected, found),
        // No recipe gives such a file.
        Err(error) => Difference::plain(file, Kind::Different, &error.to_string()),
    }
}
