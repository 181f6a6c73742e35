//! `manifest.json`: what a bake made, for scripts. Keys in alphabetical order; no dates or hosts.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::call::{Call, LookupFunction, MaskLookup, MipEntry};
use crate::data::{Approximation, Axis, Certificate, Cost, Form, Half, Place, Table, TexelFormat};
use lobefit_import::Note;

/// Version of the manifest's form.
pub const SCHEMA_VERSION: u32 = 1;

/// The whole manifest: written by a bake, and read back by one that keeps parts of an older bake.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of this form: 1.
    pub schema_version: u32,
    /// Tool and version.
    pub tool: String,
    /// Hash of the scene.
    pub scene: String,
    /// The scene, with every default filled in.
    #[serde(default)]
    pub made_from: Value,
    /// The command that makes it again, which every header names.
    #[serde(default)]
    pub command: String,
    /// Hash of tool version, command, scene and hypotheses.
    pub recipe: String,
    /// Effects baked: what called for them, ranges, expected and measured error.
    pub effects: Vec<EffectFinding>,
    /// What was made.
    #[serde(flatten)]
    pub entries: Entries,
    /// Include files.
    pub includes: Vec<Include>,
    /// Effects left out, of the whole scene or of some of its materials.
    pub left_out: Vec<LeftOut>,
    /// What a foreign file says that the scene does not hold, and how its values are passed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
}

/// The lists that every effect adds to; each entry names its effect.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Entries {
    /// Tables baked.
    pub tables: Vec<TableEntry>,
    /// Fits made and published formulas emitted beside them.
    pub fits: Vec<FitEntry>,
    /// Hypotheses of the catalogue without a reliable fit in this scene.
    pub fits_left_out: Vec<FitLeftOut>,
    /// Functions of the levels of prefiltered chains.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mips: Vec<MipEntry>,
    /// Functions that look a probe up through a proxy.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lookups: Vec<LookupFunction>,
    /// Functions of masks of sub-voxels.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masks: Vec<MaskLookup>,
    /// What each material and probe calls.
    #[serde(default)]
    pub calls: Vec<Call>,
    /// Pages and their data.
    pub reports: Vec<Report>,
}

impl Entries {
    /// Appends those of another effect.
    pub fn extend(&mut self, other: Entries) {
        self.tables.extend(other.tables);
        self.fits.extend(other.fits);
        self.fits_left_out.extend(other.fits_left_out);
        self.mips.extend(other.mips);
        self.lookups.extend(other.lookups);
        self.masks.extend(other.masks);
        self.calls.extend(other.calls);
        self.reports.extend(other.reports);
    }

    /// Those of one effect.
    pub fn of(&self, effect: &str) -> Entries {
        Entries {
            tables: self.tables.iter().filter(|e| e.effect == effect).cloned().collect(),
            fits: self.fits.iter().filter(|e| e.effect == effect).cloned().collect(),
            fits_left_out: self.fits_left_out.iter().filter(|e| e.effect == effect).cloned().collect(),
            mips: self.mips.iter().filter(|e| e.effect == effect).cloned().collect(),
            lookups: self.lookups.iter().filter(|e| e.effect == effect).cloned().collect(),
            masks: self.masks.iter().filter(|e| e.effect == effect).cloned().collect(),
            calls: self.calls.iter().filter(|e| e.effect == effect).cloned().collect(),
            reports: self.reports.iter().filter(|e| e.effect.as_deref() == Some(effect)).cloned().collect(),
        }
    }
}

/// One effect that the scene called for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectFinding {
    /// Name of the effect: `reflection`, ...
    pub effect: String,
    /// What in the scene called for it.
    pub because: Vec<String>,
    /// The same for people, where sentences differ in names and ranges alone: each such group in one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reasons: Vec<String>,
    /// Domain that the scene spans, by input.
    pub ranges: BTreeMap<String, [f64; 2]>,
    /// Approximation chosen.
    pub approximation: String,
    /// Error that the scene allows; none where it sets no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_error: Option<f64>,
    /// What the scene allows each of its jobs, in words.
    #[serde(default)]
    pub limit: String,
    /// Error that was measured; none where nothing was made that has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_error: Option<f64>,
    /// What error that is: `furnace error |E N - 1|`, ...
    pub metric: String,
}

/// One table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableEntry {
    /// Effect that called for it.
    pub effect: String,
    /// Name.
    pub name: String,
    /// File, relative to the manifest: the first of `files`.
    pub file: String,
    /// Its files in all containers, with their sidecars.
    pub files: Vec<String>,
    /// Its lookup in the emitted code.
    pub function: String,
    /// What the arguments of the lookup are, in order, after the texture and its sampler.
    pub inputs: Vec<String>,
    /// Quantity.
    pub quantity: String,
    /// What it is looked up for: `value` (E) or `f0-blend` (f0 A + B).
    #[serde(rename = "use")]
    pub used_as: String,
    /// Shadowing form, of a quantity that has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smith: Option<String>,
    /// Roughness to alpha.
    pub alpha_map: String,
    /// Channels by name.
    pub channels: Vec<String>,
    /// How E, A and B follow from the channels.
    pub decode: BTreeMap<String, String>,
    /// Texel format.
    pub format: TexelFormat,
    /// Columns, then rows, then slices where there are any.
    pub axes: Vec<AxisEntry>,
    /// Measured errors.
    pub error: TableError,
    /// Bytes of texels.
    pub bytes: u64,
    /// Cost of a lookup.
    pub cost: Cost,
}

/// One axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisEntry {
    /// Physical variable.
    pub name: String,
    /// Texels.
    pub size: usize,
    /// `centre` or `endpoint`.
    pub registration: String,
    /// Formula of the unit coordinate.
    pub warp: String,
    /// Physical value at u = 0.
    pub min: f64,
    /// Physical value at u = 1.
    pub max: f64,
}

/// Errors of a table, told apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableError {
    /// Largest error of its truths: the tolerance of direct integrals, or the worst at a fixed sample.
    pub integration: f64,
    /// Largest change of a texel by rounding to the format.
    pub quantisation: f64,
    /// Lookup (bilinear, of slices trilinear) of the quantised texels against the truth, f32 weights.
    pub lookup: LookupEntry,
    /// The same with weights of 8 fractional bits.
    pub lookup_8_bit_weights: LookupEntry,
    /// Coordinates and decoding in half precision.
    pub half: Half,
}

/// Error of a lookup.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LookupEntry {
    /// Largest absolute error.
    pub max: f64,
    /// Largest error as a part of the truth there.
    pub max_rel: f64,
    /// Root mean square.
    pub rms: f64,
    /// Where the largest absolute one is.
    pub at: Place,
}

/// One emitted formula.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitEntry {
    /// Effect that called for it.
    pub effect: String,
    /// Name.
    pub name: String,
    /// Quantity.
    pub quantity: String,
    /// Column of the quantity.
    pub column: String,
    /// Use, from which the error metric follows.
    #[serde(rename = "use")]
    pub used_as: String,
    /// Shadowing form; null of a quantity that has none.
    pub smith: Option<String>,
    /// The side of the view: `outside` or `inside`, of a quantity that has two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side: Option<String>,
    /// Roughness to alpha.
    pub alpha_map: String,
    /// Function in the emitted code: numbers to a number.
    pub function: String,
    /// 1 + f0 (N - 1) of a normalisation N, for a last argument f0 of three channels; if a metal calls it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rgb: Option<String>,
    /// Two evaluations at once, vectors of two numbers to such a vector; of formulas of f16 without branches.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pair: Option<String>,
    /// What its arguments are, in order.
    pub inputs: Vec<String>,
    /// Hypothesis.
    pub hypothesis: String,
    /// Norm that the coefficients minimise: `max`, `rms` or `published`.
    pub norm: String,
    /// Coefficients by parameter.
    pub coefficients: BTreeMap<String, f32>,
    /// Measured error.
    pub certificate: Certificate,
    /// What it is in half precision; none of a fit that is measured in precisions of its own choice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half: Option<Half>,
    /// What multiplies the specular lobe above a base; none of other quantities.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub specular: Option<String>,
    /// Largest error over all f0 in [0, 1]; none of formulas that do not depend on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub any_f0: Option<AnyF0Entry>,
    /// The lobe that a chain is prefiltered with; none of other quantities.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kernel: Option<String>,
    /// Total variation between the footprint wanted and the one fetched; none of other quantities.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub total_variation: Option<VariationEntry>,
    /// Where a factor of f0 is proven to have no pole and no value below 0, by input.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub safe: Option<BTreeMap<String, [f64; 2]>>,
    /// Cost.
    pub cost: Cost,
    /// `fitted` or the publication.
    pub source: String,
}

/// Error of a factor over all f0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnyF0Entry {
    /// Largest absolute error.
    pub max_abs: f64,
    /// Where it is.
    pub at: Place,
    /// Places of roughness and mu that were looked at.
    pub places: u64,
    /// Values of f0 there: `every f0` where the error is a parabola in it, or `17 values of f0`.
    pub looked_at: String,
}

/// Total variation of a fit, and of the best width in every cell, over cells that are not saturated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariationEntry {
    /// Where the shading point is nearer than the probe, rho < 1; none without such cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearer: Option<SpreadEntry>,
    /// Where it is farther, rho > 1; none without such cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub farther: Option<SpreadEntry>,
}

/// Total variation over some cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpreadEntry {
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub max: f64,
    /// Where that is.
    pub at: Place,
    /// The mean that the best widths leave.
    pub least_mean: f64,
    /// The largest that they leave.
    pub least_max: f64,
    /// Number of cells.
    pub cells: usize,
}

/// One include file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Include {
    /// `rust`, `wgsl`, ...
    pub language: String,
    /// File, relative to the manifest.
    pub file: String,
}

/// One page or data file of the report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Effect that it shows; none for the overview.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effect: Option<String>,
    /// File, relative to the manifest.
    pub file: String,
}

/// A hypothesis without a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitLeftOut {
    /// Effect that it belongs to.
    pub effect: String,
    /// Its name.
    pub hypothesis: String,
    /// Norm that was minimised.
    pub norm: String,
    /// Why.
    pub reason: String,
}

/// An effect left out, of the whole scene or of the materials that the reason names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Its name.
    pub effect: String,
    /// Why.
    pub reason: String,
}

impl AxisEntry {
    /// The entry of an axis.
    pub fn new(axis: &Axis) -> AxisEntry {
        AxisEntry {
            name: axis.name.clone(),
            size: axis.size,
            registration: axis.registration.name().into(),
            warp: axis.formula(),
            min: axis.min,
            max: axis.max,
        }
    }
}

impl TableEntry {
    /// Whether its lookup gives E, by which a lobe is compensated, and B beside it.
    pub fn has_albedo(&self) -> [bool; 2] {
        ["E", "B"].map(|value| self.decode.contains_key(value))
    }

    /// The entry of a table's approximation.
    pub fn new(
        effect: &str,
        approximation: &Approximation,
        table: &Table,
        decode: &[(&str, &str)],
        error: TableError,
    ) -> TableEntry {
        TableEntry {
            effect: effect.into(),
            name: table.name.clone(),
            file: format!("tables/{}.exr", table.name),
            files: vec![format!("tables/{}.exr", table.name)],
            function: String::new(),
            inputs: Vec::new(),
            quantity: table.quantity.clone(),
            used_as: approximation.used_as.name.into(),
            smith: table.smith.map(|smith| smith.name().into()),
            alpha_map: table.alpha_map.name().into(),
            channels: table.channels.iter().map(|c| c.name.clone()).collect(),
            decode: decode.iter().map(|(name, formula)| (name.to_string(), formula.to_string())).collect(),
            format: table.format,
            axes: table.axes.iter().map(AxisEntry::new).collect(),
            error,
            bytes: table.bytes(),
            cost: approximation.cost,
        }
    }

    /// The entry of a table that lies in these files.
    pub fn in_files(self, files: Vec<String>) -> TableEntry {
        TableEntry { file: files.first().cloned().unwrap_or_default(), files, ..self }
    }

    /// The entry of a table with this lookup.
    pub fn read_by(self, function: &str, inputs: &[&str]) -> TableEntry {
        let inputs = inputs.iter().map(|name| (*name).into()).collect();
        TableEntry { function: function.into(), inputs, ..self }
    }
}

impl FitEntry {
    /// The entry of a formula whose function has its name; `None` for a table.
    pub fn new(effect: &str, alpha_map: &str, approximation: &Approximation) -> Option<FitEntry> {
        let Form::Formula(formula) = &approximation.form else { return None };
        Some(FitEntry {
            effect: effect.into(),
            name: approximation.name.clone(),
            quantity: approximation.quantity.clone(),
            column: approximation.column.clone(),
            used_as: approximation.used_as.name.into(),
            smith: approximation.smith.map(|smith| smith.name().into()),
            side: approximation.side.map(|side| side.name().into()),
            alpha_map: alpha_map.into(),
            function: approximation.name.clone(),
            rgb: None,
            pair: None,
            inputs: formula.inputs.clone(),
            hypothesis: formula.hypothesis.clone(),
            norm: formula.norm.clone(),
            coefficients: formula.coefficients.iter().cloned().collect(),
            certificate: approximation.certificate.clone(),
            half: formula.half.clone(),
            specular: None,
            any_f0: None,
            kernel: None,
            total_variation: None,
            safe: None,
            cost: approximation.cost,
            source: approximation.source.text().to_string(),
        })
    }

    /// The entry of a factor under a lobe, with its error over all f0 and where it is proven safe.
    pub fn under(
        self,
        specular: &str,
        any_f0: AnyF0Entry,
        safe: Option<BTreeMap<String, [f64; 2]>>,
    ) -> FitEntry {
        FitEntry { specular: Some(specular.into()), any_f0: Some(any_f0), safe, ..self }
    }

    /// The entry of a width to fetch from a chain of this kernel.
    pub fn fetching(self, kernel: &str, total_variation: VariationEntry) -> FitEntry {
        FitEntry { kernel: Some(kernel.into()), total_variation: Some(total_variation), ..self }
    }
}

impl Manifest {
    /// The manifest of these bytes. A reader of each caller's own would be compiled as often as there are.
    ///
    /// # Errors
    /// No manifest of this version.
    pub fn read(bytes: &[u8]) -> Result<Manifest, serde_json::Error> {
        serde_json::from_slice(bytes)
    }

    /// The manifest's bytes, keys in alphabetical order.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let ordered: Value = serde_json::from_slice(&serde_json::to_vec(self)?)?;
        let mut bytes = serde_json::to_vec_pretty(&ordered)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}
