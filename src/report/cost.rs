//! What accuracy costs: every formula on the GPUs of every vendor.

use super::{GpuRecord, OfflineRecord, Origin};
use crate::emit::manifest::TableEntry;

/// What the page of costs shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Costs {
    /// What made it.
    pub origin: Origin,
    /// What costs are counted in: first the neutral operations.
    pub units: Vec<CostUnit>,
    /// Formulas by what they approximate.
    pub jobs: Vec<CostJob>,
    /// Tables of the committed bake.
    pub tables: Vec<TableEntry>,
    /// Times of functions of other scenes.
    pub times: Vec<GpuRecord>,
    /// What accuracy costs offline, a processor each.
    pub offline: Vec<OfflineRecord>,
}

/// What a cost is counted in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CostUnit {
    /// The vendor and family of GPUs, `AMD navi21`, or the device; of operations what is counted.
    pub name: String,
    /// What is counted, in a word or two; empty where the name says it.
    pub counted: String,
    /// What is counted, by what compiler, and of published formulas.
    pub unit: String,
}

/// Formulas that approximate the same for the same use.
#[derive(Clone, Debug, PartialEq)]
pub struct CostJob {
    /// What they are.
    pub title: String,
    /// What their error is.
    pub metric: String,
    /// The formulas, those of ours first.
    pub points: Vec<CostPoint>,
}

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub struct CostPoint {
    /// Name.
    pub name: String,
    /// Largest error.
    pub error: f64,
    /// Somebody else's.
    pub published: bool,
    /// Its cost in each unit; none where no compiled code is recorded.
    pub costs: Vec<Option<f64>>,
}
