//! What a table is laid out in, and what it is looked up for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which coordinates a table is laid out in.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// u = sqrt(mu (1 + alpha) / (mu + alpha)): small tables for a reciprocal more in the shader.
    #[default]
    Homogeneous,
    /// mu and roughness linear, texel centres: what engines use today.
    Plain,
    /// mu = u^2, roughness linear, texel centres.
    PlainSquared,
}

impl Layout {
    /// The word used in scenes and table names.
    pub fn name(self) -> &'static str {
        match self {
            Layout::Homogeneous => "homogeneous",
            Layout::Plain => "plain",
            Layout::PlainSquared => "plain-squared",
        }
    }
}

/// What a table is looked up for; its error is judged in that use.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Serves {
    /// E alone, for energy compensation.
    #[default]
    Albedo,
    /// f0 A + B, for image-based lighting.
    SplitSum,
}

impl Serves {
    /// The word used in scenes and table names.
    pub fn name(self) -> &'static str {
        match self {
            Serves::Albedo => "albedo",
            Serves::SplitSum => "split-sum",
        }
    }

    /// Channels of a texel.
    pub fn channels(self) -> u64 {
        match self {
            Serves::Albedo => 1,
            Serves::SplitSum => 2,
        }
    }
}

/// Which coordinates a table of three axes is laid out in.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum VolumeLayout {
    /// Registration, warp and texel values chosen for the trilinear lookup.
    #[default]
    Optimised,
    /// The nodes, shadowing form and roughness map of a known path tracer, to drop into it.
    PathTracer,
    /// Anisotropic lobes only: the azimuth of the view is a coordinate, where the other layouts hold the mean over it.
    Azimuth,
}

impl VolumeLayout {
    /// The word used in scenes and table names.
    pub fn name(self) -> &'static str {
        match self {
            VolumeLayout::Optimised => "optimised",
            VolumeLayout::PathTracer => "path-tracer",
            VolumeLayout::Azimuth => "azimuth",
        }
    }

    /// Channels of a texel: with the azimuth the four coefficients of a cubic, else one value.
    pub fn channels(self) -> u64 {
        super::Decode::of_volume(self).channels() as u64
    }
}
