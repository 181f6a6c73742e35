//! Records of times on graphics processors, read back: what a record says, and whether it is of the
//! code at hand.

use std::collections::BTreeSet;

use crate::bake::Baked;
use crate::emit::include::Include;
use crate::emit::manifest::{Entries, Manifest};
use crate::report::{GpuRecord, ReportError, SCHEMA_VERSION, gpu_page};
use crate::store::MANIFEST;
use crate::timing::Versioned;

/// Version of the way of measuring: to be raised when rows measured before and after cannot be
/// compared.
pub const METHOD: u32 = 2;

/// The folder of a bake in which records are looked for.
pub const FOLDER: &str = "reports/gpu";

/// Why a record cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// No record of `lobefit cost` with this option.
    #[error("no record of lobefit {of}: {reason}")]
    Foreign {
        /// The command.
        of: &'static str,
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
    let foreign =
        |e: serde_json::Error| RecordError::Foreign { of: "cost --gpu --record", reason: e.to_string() };
    let Versioned { schema_version } = serde_json::from_slice(bytes).map_err(foreign)?;
    if schema_version != SCHEMA_VERSION {
        return Err(RecordError::Version { found: schema_version.to_string() });
    }
    let record: GpuRecord = serde_json::from_slice(bytes).map_err(foreign)?;
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
    let include = Include::of(&baked.files);
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
    let Some(manifest) = Include::of(&baked.files).and_then(|_| manifest(baked)) else { return Vec::new() };
    let Entries { tables, fits, mips, lookups, .. } = manifest.entries;
    let functions = lookups.into_iter().map(|entry| entry.function);
    let functions = functions.chain(fits.into_iter().map(|entry| entry.function));
    let functions = functions.chain(mips.into_iter().map(|entry| entry.function));
    let all = functions.chain(tables.into_iter().map(|entry| entry.function));
    all.filter(|function| !known.contains(function.as_str())).collect()
}

fn manifest(baked: &Baked) -> Option<Manifest> {
    Manifest::read(baked.files.get(MANIFEST)?).ok()
}
