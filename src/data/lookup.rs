//! What a scene wants of the lookups of a probe.

use serde::Serialize;

/// A function that looks a probe up through a proxy of its room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct ProbeLookup {
    /// Planes of the proxy; `None`: a box between two corners.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planes: Option<u32>,
    /// Whether its edges are smooth: the planes blended by a p-norm.
    pub smooth: bool,
    /// Fetches, 1 to 3.
    pub taps: u32,
}

impl ProbeLookup {
    /// The proxy in names of functions.
    pub fn shape(self) -> String {
        self.planes.map_or_else(|| "box".into(), |n| format!("planes_{n}"))
    }

    /// Its edges in names of functions.
    pub fn edges(self) -> &'static str {
        if self.smooth { "smooth" } else { "sharp" }
    }

    /// What tells it from the other lookups of a kernel, in the names of functions.
    pub fn identifier(self) -> String {
        format!("{}_{}_{}", self.shape(), self.edges(), self.taps)
    }

    /// In words.
    pub fn text(self) -> String {
        let shape = self.planes.map_or_else(|| "a box".into(), |n| format!("{n} planes"));
        let fetches = if self.taps == 1 { "1 fetch".into() } else { format!("{} fetches", self.taps) };
        format!("{shape} with {} edges, {fetches}", self.edges())
    }
}
