//! Somebody else's table or function beside the truth, as its page shows it.

use serde::Serialize;

use super::AuditCost;
use crate::audit::{Drawn, Figure, Fit, LookupErrors, TexelErrors, Verdict};
use lobefit::data::Place;
use lobefit::report::{Field, Origin};

/// What an audit found out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditFindings {
    /// What made it.
    pub origin: Origin,
    /// The file, by its name.
    pub file: String,
    /// What it holds: `EXR, 64 x 64, half, channels R G`.
    pub holds: String,
    /// Quantity that it is measured as.
    pub quantity: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The verdict without the options, or without the file's own statement, where they fit nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub otherwise: Option<AuditOtherwise>,
    /// How well.
    pub fits: Fit,
    /// The figure that the verdict is on.
    #[serde(flatten)]
    pub figure: Option<Figure>,
    /// Largest error by the plain reading, where the plain reading is not the best
    /// one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plain: Option<AuditPlain>,
    /// What its values were decoded from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub encoding: Option<String>,
    /// Of a slice: the input that is the same throughout, and its value.
    #[serde(skip_serializing_if = "Place::is_empty")]
    pub slice: Place,
    /// Of a function: the published formula whose values it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub published: Option<AuditPublished>,
    /// Largest error that the user allows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// Whether it fits, and within the limit; absent without a limit, but where the exit code is 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passed: Option<bool>,
    /// How many times worse the next convention fits; none if there is no other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Bound of the truth's own error.
    pub truth_error: f64,
    /// Whether the file said itself how it is read, so that nothing else was tried.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub stated: bool,
    /// The conventions that were tried, the best first.
    pub conventions: Vec<AuditConvention>,
    /// Channels that are judged.
    pub channels: Vec<AuditChannel>,
    /// Lookup of f0 A + B at the worst f0, where channels hold both.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blend: Option<LookupErrors>,
    /// The furnace, where the channels make an albedo.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub furnace: Option<AuditFurnace>,
    /// What the function costs in compiled instructions, where that is called for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cost: Option<AuditCost>,
}

/// The verdict without what the user or the file said.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditOtherwise {
    /// Without what: `its statement`, `those options`.
    pub without: String,
    /// The verdict.
    pub verdict: Verdict,
}

impl AuditOtherwise {
    /// As it is printed below the verdict: its first line.
    pub fn text(&self) -> String {
        format!("Without {}: {} {}\n", self.without, self.verdict.grade.word(), self.verdict.headline)
    }
}

/// A published formula.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditPublished {
    /// Its name here.
    pub name: &'static str,
    /// Where it was published.
    pub publication: &'static str,
    /// The shadowing that it was fitted to, by the word of `--smith`, if that is none of the quantity's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub made_for: Option<&'static str>,
}

/// A table by the plain reading.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditPlain {
    /// What the best reading has that no reader assumes unless the file says so.
    pub untold: Vec<String>,
    /// Largest error under the plain reading; none where the truth cannot be had.
    pub max: Option<f64>,
    /// Options that say that the best reading is meant.
    pub options: String,
}

/// One way to read a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditConvention {
    /// Every axis, or every argument of a function.
    pub axes: Vec<AuditAxis>,
    /// Shadowing form and side; may be empty.
    pub lobe: String,
    /// What the channels hold.
    pub channels: Vec<AuditHeld>,
    /// What conventions are ranked by, smaller is better.
    pub rank: f64,
}

/// One axis or argument.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditAxis {
    /// `x`, `y`, `z`, or the argument's name.
    pub axis: String,
    /// What its coordinate means: `roughness`, `sqrt(mu)`.
    pub coordinate: String,
    /// Whether it is one minus that.
    pub reversed: bool,
    /// Where texel i lies: `centre`, `endpoint`, `left`, `right`, `one-high`, `one-low`,
    /// `end-high`, `end-low`; empty for an argument.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub registration: String,
    /// Least value that the input was clamped to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clamp: Option<f64>,
}

/// What a channel holds under a convention.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditHeld {
    /// Channel.
    pub channel: String,
    /// Column or transform of one.
    pub holds: String,
    /// Largest error.
    pub max: f64,
    /// Root mean square.
    pub rms: f64,
}

/// A channel under the best convention.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditChannel {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub holds: String,
    /// How well.
    pub fits: Fit,
    /// Errors at the texels.
    pub texels: TexelErrors,
    /// Texels with what they hold and what is true, where `--points` asks for them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<Drawn>,
    /// What is wrong with it.
    pub defects: Vec<AuditDefect>,
    /// Lookup at the coordinates that the texels have.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lookup: Option<LookupErrors>,
    /// Lookup by a texture unit without a remap.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plain_lookup: Option<LookupErrors>,
    /// Signed errors of the texels, for pictures.
    #[serde(skip)]
    pub maps: Vec<Field>,
    /// Truth and channel along one axis, for pictures.
    #[serde(skip)]
    pub curves: Vec<AuditCurve>,
}

/// Something that is wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditDefect {
    /// Its kind: `part`, `optimised`, `gain`, `bias`, `clamped`, `noise`, `steps`, `sampled`,
    /// `missing-loss`, `dead`, `other-lobe`.
    pub kind: String,
    /// In a sentence.
    pub text: String,
}

/// The furnace: E over the albedo that the channels make, less 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditFurnace {
    /// Least.
    pub least: f64,
    /// Largest.
    pub most: f64,
    /// Where the magnitude is largest.
    pub at: Place,
}

/// Truth and channel along one axis, the others fixed.
#[derive(Clone, Debug, PartialEq)]
pub struct AuditCurve {
    /// What is fixed: `alpha 0.25`.
    pub title: String,
    /// Name of the horizontal axis.
    pub x: String,
    /// Places along it.
    pub at: Vec<f64>,
    /// Truth at each.
    pub truth: Vec<f64>,
    /// What the channel holds.
    pub held: Vec<f64>,
}
