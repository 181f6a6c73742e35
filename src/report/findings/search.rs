//! A search over forms: what `lobefit fit --search` shows.

use super::Origin;
use crate::data::{Certificate, Use};
use crate::report::Dot;

/// The frontier of a search beside what there was before.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchPage {
    /// What made it; its scene is empty.
    pub origin: Origin,
    /// What was searched for, as in the files' names.
    pub name: String,
    /// What the formulas are used as.
    pub used_as: Use,
    /// What their cost is counted in, and the frontier is by.
    pub unit: String,
    /// What was asked, as names and values.
    pub asked: Vec<(String, String)>,
    /// What was tried beforehand in narrow searches, and what came of it.
    pub tried: Vec<(String, String)>,
    /// Cost against error: the frontier, and published formulas.
    pub dots: Vec<Dot>,
    /// The frontier by rising cost.
    pub rows: Vec<SearchRow>,
    /// The catalogue: name, operations, largest error, RMS, whether it is somebody else's.
    pub others: Vec<(String, u32, f64, f64, bool)>,
}

/// One form.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchRow {
    /// Name of its function.
    pub name: String,
    /// Operations.
    pub ops: u32,
    /// No constants of this form do better on the samples; 0 where nothing is proven.
    pub bound: f64,
    /// Measured error.
    pub certificate: Certificate,
    /// The hypothesis.
    pub source: String,
}
