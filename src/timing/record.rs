//! Records of times on graphics processors, read back: what a record says, and whether it is of the
//! code at hand.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use crate::bake::Baked;
use crate::emit::manifest::{Entries, Manifest, TableEntry};
use crate::report::{GpuRecord, ReportError, SCHEMA_VERSION, gpu_page};
use crate::store::MANIFEST;
use lobefit_shade::code::Language;

/// Version of the way of measuring: to be raised when rows measured before and after cannot be
/// compared.
pub const METHOD: u32 = 2;

/// The folder of a bake in which records are looked for.
pub const FOLDER: &str = "reports/gpu";

/// Why a record cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// No record of `lobefit cost --gpu`.
    #[error("no record of lobefit cost --gpu --record: {reason}")]
    Foreign {
        /// What the reader says.
        reason: String,
    },
    /// A record of another version of this program.
    #[error(
        "schema_version {found}, this version reads {SCHEMA_VERSION}; measure again with lobefit cost --gpu --record"
    )]
    Version {
        /// The version found.
        found: String,
    },
    /// A time that is no time.
    #[error("{row}: {field} is not a positive number; measure again with lobefit cost --gpu --record")]
    Time {
        /// Name of the row.
        row: String,
        /// The field.
        field: &'static str,
    },
    /// The page refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
}

/// A record from its bytes.
///
/// # Errors
/// Bytes that are no such record, one of another version, times that are not positive.
pub fn read(bytes: &[u8]) -> Result<GpuRecord, RecordError> {
    let foreign = |e: serde_json::Error| RecordError::Foreign { reason: e.to_string() };
    let value: Value = serde_json::from_slice(bytes).map_err(foreign)?;
    let version = &value["schema_version"];
    if *version != SCHEMA_VERSION {
        return Err(RecordError::Version { found: version.to_string() });
    }
    let record: GpuRecord = serde_json::from_value(value).map_err(foreign)?;
    for row in &record.rows {
        let wrong = |field| Err(RecordError::Time { row: row.name.clone(), field });
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if !positive(row.loop_nanoseconds) {
            return wrong("loop_nanoseconds");
        }
        if ![row.ratio.low, row.ratio.median, row.ratio.high].into_iter().all(positive) {
            return wrong("ratio");
        }
    }
    Ok(record)
}

/// A record's page as HTML, and its bytes.
///
/// # Errors
/// Data that is not finite.
pub fn page(record: &GpuRecord) -> Result<(String, Vec<u8>), RecordError> {
    Ok(gpu_page(record)?)
}

/// Rows of a record that are not of a bake's code: their functions have changed or are gone, or
/// they were measured in another way.
pub fn stale(record: &GpuRecord, baked: &Baked) -> Vec<String> {
    let include = Include::of(baked);
    let current = |function: &str, code: Option<&str>| {
        let hash = include.as_ref().and_then(|include| include.hash(function));
        record.method == METHOD && hash.is_some() && hash.as_deref() == code
    };
    let changed = record.rows.iter().filter(|row| match &row.function {
        Some(function) => !current(function, row.code.as_deref()),
        None => record.method != METHOD,
    });
    changed.map(|row| row.name.clone()).collect()
}

/// Functions of a bake's manifest of which a record says nothing: neither a time nor why there is
/// none.
pub fn missing(record: &GpuRecord, baked: &Baked) -> Vec<String> {
    let timed = record.rows.iter().filter_map(|row| row.function.as_deref());
    let known: BTreeSet<&str> =
        timed.chain(record.left_out.iter().map(|out| out.function.as_str())).collect();
    let Some(manifest) = Include::of(baked).and_then(|_| manifest(baked)) else { return Vec::new() };
    let Entries { tables, fits, mips, lookups, .. } = manifest.entries;
    let functions = lookups.into_iter().map(|entry| entry.function);
    let functions = functions.chain(fits.into_iter().map(|entry| entry.function));
    let functions = functions.chain(mips.into_iter().map(|entry| entry.function));
    let all = functions.chain(tables.into_iter().map(|entry| entry.function));
    all.filter(|function| !known.contains(function.as_str())).collect()
}

fn manifest(baked: &Baked) -> Option<Manifest> {
    serde_json::from_slice(baked.files.get(MANIFEST)?).ok()
}

/// What a table's lookup fetches, by function: format and channels, which its code does not tell.
fn texels(manifest: &Manifest) -> BTreeMap<String, String> {
    let texel = |table: &TableEntry| {
        (table.function.clone(), format!("{:?} {}", table.format, json!(table.channels)))
    };
    manifest.entries.tables.iter().map(texel).collect()
}

/// The emitted WGSL of a bake, item by item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Include {
    /// The whole text.
    pub text: String,
    /// Functions and structures by name, without comments.
    items: BTreeMap<String, String>,
    /// Texels of tables by the function that fetches them.
    texels: BTreeMap<String, String>,
}

impl Include {
    /// The WGSL of a bake; none where it emits none.
    pub fn of(baked: &Baked) -> Option<Include> {
        let file = format!("fits/lobefit.{}", Language::Wgsl.extension());
        let bytes = baked.files.get(&file)?;
        let texels = manifest(baked).as_ref().map(texels).unwrap_or_default();
        Some(Include { texels, ..Include::new(String::from_utf8_lossy(bytes).into_owned()) })
    }

    /// Of a text as this program prints it: items begin at the beginning of a line and end with a
    /// brace there.
    pub fn new(text: String) -> Include {
        let mut items: BTreeMap<String, String> = BTreeMap::new();
        let mut inside: Option<String> = None;
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            let name = ["fn ", "struct "].iter().find_map(|word| line.strip_prefix(word)).map(first_word);
            if let Some(name) = name {
                inside = Some(name.to_owned());
            }
            if let Some(name) = &inside {
                let item = items.entry(name.clone()).or_default();
                item.push_str(line);
                item.push('\n');
            }
            if line == "}" {
                inside = None;
            }
        }
        Include { text, items, texels: BTreeMap::new() }
    }

    /// The code of a function and of all that it names, without comments; none where there is no
    /// such function.
    pub fn code(&self, function: &str) -> Option<String> {
        let mut needed = BTreeSet::new();
        let mut pending = vec![self.items.get_key_value(function)?];
        while let Some((name, text)) = pending.pop() {
            if needed.insert(name) {
                pending.extend(words(text).filter_map(|word| self.items.get_key_value(word)));
            }
        }
        Some(needed.into_iter().filter_map(|name| self.items.get(name)).map(String::as_str).collect())
    }

    /// Hash of [`Include::code`], and of the texels where the function fetches from a table.
    pub fn hash(&self, function: &str) -> Option<String> {
        let code = self.code(function)? + self.texels.get(function).map_or("", String::as_str);
        Some(blake3::hash(code.as_bytes()).to_hex().to_string())
    }
}

fn first_word(text: &str) -> &str {
    words(text).next().unwrap_or_default()
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}
