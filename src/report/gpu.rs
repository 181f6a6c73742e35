//! What emitted functions take on a graphics processor, as measured on one: not reproducible, so
//! kept apart from the findings of a bake.

use serde::{Deserialize, Serialize};

use super::{Origin, ReportError};
use crate::data::{Use, Vendor};
use crate::emit::include::Include;

/// Times that come with this version: those of the built-in scene's functions.
const RECORDED: &str = include_str!("../../reports/gpu/nvidia-h200.json");

/// The record that comes with this version. A time in it holds of a function whose code has the
/// same hash, whatever the scene.
///
/// # Errors
/// A record of another version: a defect of this program.
pub(super) fn recorded() -> Result<GpuRecord, ReportError> {
    serde_json::from_str(RECORDED).map_err(|e| refused("index", &e))
}

/// Data that its own type does not read.
pub(super) fn refused(section: &str, error: &serde_json::Error) -> ReportError {
    ReportError::Drawing { section: section.into(), reason: error.to_string() }
}

/// Times of a bake's emitted functions on one graphics processor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GpuRecord {
    /// The bake whose functions were measured, and the command.
    pub origin: Origin,
    /// Version of the way of measuring.
    pub method: u32,
    /// The graphics processor.
    pub device: GpuDevice,
    /// What the times were read from.
    pub clock: GpuClock,
    /// Invocations of a dispatch, one per pixel of a square picture.
    pub threads: u32,
    /// Pairs of dispatches that each row is the median of.
    pub repeats: u32,
    /// Fewer threads and repeats: for software drivers and for trying out.
    pub reduced: bool,
    /// Fetches to compare with, then everything emitted, in the manifest's order.
    pub rows: Vec<GpuRow>,
    /// Functions that were not measured.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<GpuLeftOut>,
}

/// A graphics processor as its driver names it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GpuDevice {
    /// Name.
    pub adapter: String,
    /// `discrete`, `integrated`, `virtual`, `software`, `other`.
    pub kind: String,
    /// Driver and its version.
    pub driver: String,
    /// Interface that it is driven by: `vulkan`, ...
    pub backend: String,
}

/// What times were read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GpuClock {
    /// The processor's own stamps at the beginning and the end of a dispatch.
    Timestamps,
    /// Wall time from submission to completion: the driver offers no stamps.
    Wall,
}

/// What a row measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GpuKind {
    /// A plain fetch from a texture of two or three axes, to compare with.
    Fetch,
    /// A plain fetch from a cubemap, filtered between levels.
    CubemapFetch,
    /// A fit, or a published formula.
    Fit,
    /// A table by its lookup, the fetch included.
    Table,
    /// A level of a chain, or the way back.
    Level,
    /// The lookup of a probe, without its fetches.
    Lookup,
    /// The lookup of a probe with its fetches from a cubemap.
    LookupFetches,
}

/// The middle of repeated measurements: median and quartiles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GpuSpread {
    /// A quarter lies below.
    pub low: f64,
    /// Half lie below.
    pub median: f64,
    /// A quarter lies above.
    pub high: f64,
}

/// One function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GpuRow {
    /// Name in the manifest, or what is fetched.
    pub name: String,
    /// What it measures.
    pub kind: GpuKind,
    /// Name of the emitted function; none of a plain fetch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub function: Option<String>,
    /// Hash of its emitted code and of all that it calls, comments apart; none of a plain fetch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code: Option<String>,
    /// Operations by the model of [`crate::data::Cost`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ops: Option<u32>,
    /// Texture fetches that the time holds.
    pub fetches: u32,
    /// What it approximates and how well; none where the manifest states none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<GpuError>,
    /// Evaluations of a thread in a dispatch.
    pub evaluations: u32,
    /// Nanoseconds of the loop that makes the inputs, per evaluation: median.
    pub loop_nanoseconds: f64,
    /// Nanoseconds that an evaluation adds to the loop.
    pub nanoseconds: GpuSpread,
    /// The loop with the evaluation over the loop without it, of dispatches one after the other.
    pub ratio: GpuSpread,
    /// Evaluations a second that the device does, from the median; none where the time is not told
    /// from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evaluations_per_second: Option<f64>,
    /// Beside a plain fetch of the same repeat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub against: Option<GpuAgainst>,
}

/// The certified error of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GpuError {
    /// Quantity.
    pub quantity: String,
    /// Column of the quantity; empty for a table.
    pub column: String,
    /// What it is used as.
    #[serde(rename = "use")]
    pub used_as: Use,
    /// Largest error of the use.
    pub max: f64,
    /// Somebody else's formula.
    pub published: bool,
}

/// A row's time over that of a plain fetch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GpuAgainst {
    /// Name of the fetch's row.
    pub fetch: String,
    /// What the evaluation adds over what the fetch adds, repeat by repeat.
    pub ratio: GpuSpread,
}

/// A function that was not measured.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GpuLeftOut {
    /// Its name.
    pub function: String,
    /// Why.
    pub reason: String,
}

impl GpuRecord {
    /// Whether the graphics processor is of a vendor.
    pub fn is_of(&self, vendor: Vendor) -> bool {
        self.device.driver.to_lowercase().contains(vendor.word())
    }

    /// Nanoseconds of a call of a function, if it was measured as it is emitted here; of a lookup with its
    /// fetches.
    pub fn nanoseconds(&self, function: &str, include: &Include) -> Option<f64> {
        let code = include.hash(function)?;
        let is_own =
            |row: &&GpuRow| row.function.as_deref() == Some(function) && row.code.as_ref() == Some(&code);
        let own = self.rows.iter().filter(|row| is_own(row) && row.resolved());
        Some(own.max_by_key(|row| row.fetches)?.nanoseconds.median)
    }
}

impl GpuRow {
    /// Whether the time differs from 0: its lower quartile is above.
    pub fn resolved(&self) -> bool {
        self.nanoseconds.low > 0.0
    }
}

impl GpuSpread {
    /// Of at least one value, in any order.
    ///
    /// The quartiles are values of the list, the nearest to a quarter and three quarters of it.
    pub fn of(values: &[f64]) -> Option<GpuSpread> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let at = |quarter: usize| sorted[(last * quarter + 2) / 4];
        Some(GpuSpread { low: at(1), median: at(2), high: at(3) })
    }
}
