//! What a scene wants of the lookups of a probe.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a lookup takes the lobe of a surface for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceLobe {
    /// Round about the mirror ray, alpha wide: what the split sum takes it for.
    #[default]
    Mirror,
    /// Leaning towards the normal, and narrower across the plane of incidence, by constants fitted
    /// to GGX.
    Fitted,
}

impl SurfaceLobe {
    /// The word of scenes and manifests.
    pub fn name(self) -> &'static str {
        match self {
            SurfaceLobe::Mirror => "mirror",
            SurfaceLobe::Fitted => "fitted",
        }
    }

    fn is_mirror(&self) -> bool {
        *self == SurfaceLobe::Mirror
    }
}

/// A function that looks a probe up through a proxy of its room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct ProbeLookup {
    /// Whether the engine has met what the ray sees itself, and passes where: no proxy.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub hit: bool,
    /// Planes of the proxy; `None`: a box between two corners.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planes: Option<u32>,
    /// Whether its edges are smooth: rounded by how far the lobe reaches over them.
    pub smooth: bool,
    /// Fetches, 1 to 3.
    pub taps: u32,
    /// What the lobe of the surface is taken for.
    #[serde(skip_serializing_if = "SurfaceLobe::is_mirror")]
    pub lobe: SurfaceLobe,
}

impl ProbeLookup {
    /// The proxy in names of functions.
    pub fn shape(self) -> String {
        if self.hit {
            return "hit".into();
        }
        self.planes.map_or_else(|| "box".into(), |n| format!("planes_{n}"))
    }

    /// Its edges in names of functions.
    pub fn edges(self) -> &'static str {
        match (self.hit, self.smooth) {
            (true, _) => "none",
            (false, true) => "smooth",
            (false, false) => "sharp",
        }
    }

    /// What tells it from the other lookups of a kernel, in the names of functions.
    pub fn identifier(self) -> String {
        if self.hit {
            return self.shape();
        }
        let lobe = if self.is_fitted() { "_fitted" } else { "" };
        format!("{}_{}_{}{lobe}", self.shape(), self.edges(), self.taps)
    }

    /// Whether the lobe is the one fitted to GGX.
    pub fn is_fitted(self) -> bool {
        self.lobe == SurfaceLobe::Fitted
    }

    /// In words.
    pub fn text(self) -> String {
        if self.hit {
            return "what the engine hit, 1 fetch".into();
        }
        let shape = self.planes.map_or_else(|| "a box".into(), |n| format!("{n} planes"));
        let fetches = if self.taps == 1 { "1 fetch".into() } else { format!("{} fetches", self.taps) };
        let lobe = if self.is_fitted() { " of the fitted lobe" } else { "" };
        format!("{shape} with {} edges, {fetches}{lobe}", self.edges())
    }
}
