//! What a table is laid out in, and what it is looked up for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which coordinates a table is laid out in. The first three are over mu and roughness; the others
/// have a third axis, the anisotropy of the lobe or the index of refraction of glass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// Over mu and roughness, u = sqrt(mu (1 + alpha) / (mu + alpha)): small tables for a
    /// reciprocal more in the shader.
    Homogeneous,
    /// Over mu and roughness, both linear, texel centres: what engines use today.
    Plain,
    /// Over mu and roughness, mu = u^2, texel centres.
    PlainSquared,
    /// With a third axis: registration, warp and texel values chosen for the trilinear lookup.
    Optimised,
    /// With a third axis: the nodes, shadowing form and roughness map of a known path tracer, to
    /// drop into it.
    PathTracer,
    /// With a third axis, of anisotropic lobes only: the azimuth of the view is a coordinate, where
    /// the other layouts hold the mean over it.
    Azimuth,
    /// Over mu, the azimuth of the view, roughness, anisotropy and index of refraction, of anisotropic glass
    /// only.
    FiveAxis,
    /// Over roughness and mu, sqrt(1 - mu), end points: a pair of tables of linearly transformed cosines.
    AreaLights,
    /// Over mu as the homogeneous layout has it, roughness and index of refraction: the albedo of a
    /// dielectric as a part of what a smooth surface reflects.
    Dielectric,
}

impl Layout {
    /// The word used in scenes and table names.
    pub fn name(self) -> &'static str {
        match self {
            Layout::Homogeneous => "homogeneous",
            Layout::Plain => "plain",
            Layout::PlainSquared => "plain-squared",
            Layout::Optimised => "optimised",
            Layout::PathTracer => "path-tracer",
            Layout::Azimuth => "azimuth",
            Layout::FiveAxis => "five-axis",
            Layout::AreaLights => "area-lights",
            Layout::Dielectric => "dielectric",
        }
    }

    /// Whether the azimuth of the view is a coordinate.
    pub fn has_azimuth(self) -> bool {
        matches!(self, Layout::Azimuth | Layout::FiveAxis)
    }

    /// Axes of a table.
    pub fn axes(self) -> usize {
        match self {
            Layout::Homogeneous | Layout::Plain | Layout::PlainSquared | Layout::AreaLights => 2,
            Layout::Optimised | Layout::PathTracer | Layout::Azimuth | Layout::Dielectric => 3,
            Layout::FiveAxis => 5,
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
}
