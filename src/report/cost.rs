//! What accuracy costs: every formula on the GPUs of every vendor.

use std::collections::BTreeMap;

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
    /// What longer searches found.
    pub searches: Vec<CostSearch>,
    /// What accuracy costs offline, a processor each.
    pub offline: Vec<OfflineRecord>,
}

/// The frontier that a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct CostSearch {
    /// What its formulas stand for: the title of a job.
    pub title: String,
    /// Where its errors hold, by input.
    pub domain: BTreeMap<String, [f64; 2]>,
    /// What was typed.
    pub command: String,
    /// Operations and largest error of each formula, by rising cost.
    pub found: Vec<(u32, f64)>,
}

/// What a cost is counted in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CostUnit {
    /// The vendor and family of GPUs, `AMD navi21`, or the device; of operations what is counted.
    pub name: String,
    /// What is counted, in a word or two; empty where the name says it.
    pub counted: String,
    /// What is counted, by what compiler, and of published formulas.
    pub unit: String,
    /// Machine code of formulas by their names, where a compiler was asked.
    pub code: Vec<(String, String)>,
}

/// Formulas that approximate the same for the same use.
#[derive(Clone, Debug, PartialEq)]
pub struct CostJob {
    /// What they are.
    pub title: String,
    /// What their error is.
    pub metric: String,
    /// Where it holds, by input.
    pub domain: BTreeMap<String, [f64; 2]>,
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
    /// The same in half precision; none where it is not finite or not measured.
    pub half: Option<f64>,
    /// Somebody else's.
    pub published: bool,
    /// Its cost in each unit; none where no compiled code is recorded.
    pub costs: Vec<Option<f64>>,
}
