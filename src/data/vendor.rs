//! Vendors of GPUs, and what a formula costs on their GPUs by a model that is fitted to what their
//! compilers make of every formula.

use std::collections::BTreeMap;

use lobefit_shade::{Features, Tape};
use serde::{Deserialize, Serialize};

/// The committed prices, `lobefit cost --weights` makes them.
const WEIGHTS: &str = include_str!("weights.json");

/// A vendor of GPUs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Vendor {
    /// AMD.
    Amd,
    /// Intel.
    Intel,
    /// Qualcomm Adreno.
    Adreno,
    /// Arm Mali.
    Mali,
    /// NVIDIA.
    Nvidia,
}

impl Vendor {
    /// All of them.
    pub const ALL: [Vendor; 5] = [Vendor::Amd, Vendor::Intel, Vendor::Adreno, Vendor::Mali, Vendor::Nvidia];
    /// The word that files and options have.
    pub fn word(self) -> &'static str {
        ["amd", "intel", "adreno", "mali", "nvidia"][self as usize]
    }

    /// The name that people give it.
    pub fn title(self) -> &'static str {
        ["AMD", "Intel", "Adreno", "Mali", "NVIDIA"][self as usize]
    }

    /// What work costs by the committed model, in its unit.
    ///
    /// # Errors
    /// As [`Vendor::model`].
    pub fn price(self, work: &Features) -> Result<f64, WeightsError> {
        Ok(self.model()?.features().price(work))
    }

    /// The committed model of the vendor's GPUs.
    ///
    /// # Errors
    /// `src/data/weights.json` is not as `lobefit cost --weights` writes it, or lacks the vendor.
    pub fn model(self) -> Result<Model, WeightsError> {
        let mut weights = Weights::read(WEIGHTS.as_bytes())?;
        weights.vendors.remove(&self).ok_or(WeightsError::Lacks { vendor: self.word() })
    }
}

/// Why there is no model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WeightsError {
    /// No file of `lobefit cost --weights`.
    #[error("weights.json: not as lobefit cost --weights writes it: {0}")]
    Foreign(#[from] serde_json::Error),
    /// A vendor that the file lacks.
    #[error("weights.json: lacks {vendor}; make it again with lobefit cost --weights")]
    Lacks {
        /// The vendor.
        vendor: &'static str,
    },
}

/// Models of all vendors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Weights {
    /// The command that makes them.
    pub command: String,
    /// By vendor.
    pub vendors: BTreeMap<Vendor, Model>,
}

impl Weights {
    /// From bytes.
    ///
    /// # Errors
    /// Bytes that are no such file.
    pub fn read(bytes: &[u8]) -> Result<Weights, serde_json::Error> {
        serde_json::from_slice(bytes)
    }

    /// The file.
    ///
    /// # Errors
    /// Data that cannot be written as JSON.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}

/// What kinds of work cost on a family of GPUs, in units of what its compiler counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// The family whose compiled code the prices are fitted to.
    pub family: String,
    /// The compiler, with its version.
    pub compiler: String,
    /// The unit.
    pub unit: String,
    /// Prices of [`Features`], by their names.
    pub prices: BTreeMap<String, f64>,
    /// What a call for three channels costs beside that of N: the mean over every formula.
    pub coloured: f64,
    /// How well the model's costs follow those of the compiled code.
    pub agreement: Agreement,
    /// The same of formulas that took no part in the fit.
    pub left_out: Agreement,
    /// The same of the neutral operations ([`Tape::cost_ops`]).
    pub operations: Agreement,
}

/// Correlation of two costs, in three decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Agreement {
    /// Of the values.
    pub pearson: f64,
    /// Of the ranks.
    pub spearman: f64,
    /// Formulas.
    pub formulas: usize,
}

impl Model {
    /// What a formula costs, in the model's unit. Not negative.
    pub fn cost(&self, tape: &Tape) -> f64 {
        self.features().price(&tape.features())
    }

    /// The prices; a kind of work without one costs nothing.
    pub fn features(&self) -> Features {
        Features::of(Features::NAMES.map(|name| self.prices.get(name).copied().unwrap_or(0.0)))
    }
}
