//! Records of searches: documents of `lobefit fit --search`, beside which the formulas of this version
//! are seen.

use serde::Deserialize;

use super::Versioned;
use super::costs::title;
use super::record::RecordError;
use crate::data::{Certificate, Use};
use crate::emit::manifest::CostEntry;
use crate::report::{CostSearch, SCHEMA_VERSION};

/// The folder of a bake in which records are looked for.
pub const FOLDER: &str = "reports/searches";

/// Of a document what a comparison takes.
#[derive(Deserialize)]
struct Document {
    command: String,
    fits: Vec<Found>,
}

#[derive(Deserialize)]
struct Found {
    quantity: String,
    column: String,
    #[serde(rename = "use")]
    used_as: Use,
    specular: Option<String>,
    side: Option<String>,
    cost: CostEntry,
    certificate: Certificate,
}

/// A record from its bytes.
///
/// # Errors
/// Bytes that are no such record, one of another version.
pub fn read(bytes: &[u8]) -> Result<CostSearch, RecordError> {
    let foreign = |e: serde_json::Error| RecordError::Foreign { of: "fit --search", reason: e.to_string() };
    let refuse = |message: String| Err(foreign(serde::de::Error::custom(message)));
    let Versioned { schema_version } = serde_json::from_slice(bytes).map_err(foreign)?;
    if schema_version != SCHEMA_VERSION {
        return refuse(format!("schema_version {schema_version}"));
    }
    let Document { command, fits } = serde_json::from_slice(bytes).map_err(foreign)?;
    let Some(first) = fits.first() else { return refuse("fits: the list is empty".into()) };
    let of = (first.specular.as_deref(), first.side.as_deref());
    let title = title([&first.quantity, &first.column], first.used_as, of.0, of.1);
    let found = fits.iter().map(|fit| (fit.cost.ops, fit.certificate.max_abs)).collect();
    Ok(CostSearch { title, domain: first.certificate.domain.clone(), command, found })
}
