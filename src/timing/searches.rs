//! Records of searches: the frontier that `lobefit fit --search` found, beside which the formulas of this
//! version are seen.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Versioned;
use super::costs::title;
use super::record::RecordError;
use crate::data::Use;
use crate::report::{CostSearch, SCHEMA_VERSION};

/// The folder of a bake in which records are looked for.
pub const FOLDER: &str = "reports/searches";

/// The frontier of a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SearchRecord {
    /// The version of the form.
    pub schema_version: u32,
    /// The command that makes it.
    pub command: String,
    /// What its formulas approximate, and as what they are used.
    pub quantity: String,
    /// The quantity's column.
    pub column: String,
    /// The use.
    #[serde(rename = "use")]
    pub used_as: Use,
    /// The lobe above, where the quantity has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub specular: Option<String>,
    /// The side of the view, where there are two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<String>,
    /// Where the errors hold, by input.
    pub domain: BTreeMap<String, [f64; 2]>,
    /// By rising cost.
    pub found: Vec<FoundForm>,
}

/// A form that no cheaper one beats.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundForm {
    /// Operations.
    pub ops: u32,
    /// Largest error, in f32.
    pub max_abs: f64,
}

impl SearchRecord {
    /// The record as JSON, on one line.
    ///
    /// # Errors
    /// A number that JSON does not have.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}

/// A record from its bytes.
///
/// # Errors
/// Bytes that are no such record, one of another version.
pub fn read(bytes: &[u8]) -> Result<CostSearch, RecordError> {
    let foreign =
        |e: serde_json::Error| RecordError::Foreign { of: "fit --search --record", reason: e.to_string() };
    let Versioned { schema_version } = serde_json::from_slice(bytes).map_err(foreign)?;
    if schema_version != SCHEMA_VERSION {
        return Err(foreign(serde::de::Error::custom(format!("schema_version {schema_version}"))));
    }
    let record: SearchRecord = serde_json::from_slice(bytes).map_err(foreign)?;
    let SearchRecord { command, quantity, column, used_as, specular, side, domain, found, .. } = record;
    let title = title([&quantity, &column], used_as, specular.as_deref(), side.as_deref());
    let found = found.iter().map(|form| (form.ops, form.max_abs)).collect();
    Ok(CostSearch { title, domain, command, found })
}
