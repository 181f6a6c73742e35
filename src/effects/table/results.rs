//! Tables of three axes as the page of their effect shows them.

use serde::Serialize;

use crate::data::{AlphaMap, Axis, Smith, TexelFormat};
use crate::report::Field;
use crate::report::{EffectFinding, ErrorFigure, Furnace, Origin};

/// What a bake found out about an effect whose tables have three axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VolumeFindings {
    /// What made it.
    pub origin: Origin,
    /// What called for it.
    pub effect: EffectFinding,
    /// The tables.
    pub tables: Vec<VolumeTable>,
    /// The sources' method beside ours; none without a table in their layout.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sources: Option<SourcesFinding>,
    /// Truths over roughness and mu at some slices, which their names tell.
    pub truths: Vec<Field>,
    /// What a shader gets from each layout.
    pub furnaces: Vec<FurnaceFinding>,
    /// What the azimuth of the view changes, a finding for each domain of tables.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub azimuth: Vec<AzimuthFinding>,
}

/// A table of three axes with its errors. Its texels are in its file, not in the findings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VolumeTable {
    /// Name of the table.
    pub name: String,
    /// Its files, one for each container.
    pub files: Vec<String>,
    /// Quantity that it samples.
    pub quantity: String,
    /// Shadowing form.
    pub smith: Smith,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Columns, rows, slices.
    pub axes: Vec<Axis>,
    /// Channels by name.
    pub channels: Vec<String>,
    /// How E follows from the channels.
    pub decode: String,
    /// What the axes do not tell of the nodes; may be empty.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// Texel format.
    pub format: TexelFormat,
    /// Bytes of texels.
    pub bytes: u64,
    /// Operations of a lookup beside its fetch.
    pub ops: u32,
    /// Integrand evaluations that went into it.
    pub evaluations: u64,
    /// Errors, a line each.
    pub errors: Vec<(String, ErrorFigure)>,
    /// Error of the lookup over roughness and mu at some slices.
    pub lookup_error: Vec<Field>,
}

/// What the tables in the sources' layout took, and what the sources' method takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SourcesFinding {
    /// Texels of the tables.
    pub texels: u64,
    /// Integrand evaluations of ours, checks included.
    pub evaluations: u64,
    /// Worst difference of our texels from direct integrals at those checked, before rounding to the texel format.
    pub worst: f64,
    /// Samples that the sources draw for all texels.
    pub samples: f64,
    /// Standard error that these leave, root mean square over texels spread over the table: measured with fewer samples and scaled.
    pub noise: f64,
}

/// Spheres under one condition.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FurnaceFinding {
    /// The condition: `anisotropy 0.5`, `index of refraction 1.5, from inside`.
    pub title: String,
    /// The spheres; rows are lookups.
    pub furnace: Furnace,
}

/// What a table of the azimuth's mean leaves out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AzimuthFinding {
    /// Where the errors are the largest of: `roughness 0.02 to 1, anisotropy 0 to 1`.
    pub domain: String,
    /// Where the fields are drawn: `roughness 0.7, anisotropy 1`.
    pub at: String,
    /// Error over azimuth and mu of each way.
    pub fields: Vec<Field>,
    /// Each way: name, largest error over the domain, root mean square, bytes of texels.
    pub ways: Vec<AzimuthWay>,
}

/// One way to get E at an azimuth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AzimuthWay {
    /// Its name.
    pub name: String,
    /// Its error over the whole domain.
    pub error: ErrorFigure,
    /// Bytes of texels.
    pub bytes: u64,
    /// Operations beside the fetch.
    pub ops: u32,
}
