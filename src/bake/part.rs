//! What one effect contributes to a bake, and how the parts of all effects become one set of files.

use std::collections::BTreeMap;

use serde_json::Value;

use super::BakeError;
use super::includes;
use crate::effects::context::Context;
use crate::emit::manifest::{Entries, Include, LeftOut, Manifest, SCHEMA_VERSION, canonical};
use crate::plan::{EffectName, Plan};
use crate::report::{self, EffectFinding, Index, IndexRow, Origin};
use crate::store::{Files, MANIFEST};
use lobefit_shade::code::Language;

/// The contribution of one effect. The same recipe and build give the same part, so a part that
/// an older bake left on the disk stands for the part that would be made.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The effect.
    pub effect: EffectName,
    /// What the scene called for and what was measured.
    pub finding: EffectFinding,
    /// Its entries in the manifest.
    pub entries: Entries,
    /// Its section of each include file, by language.
    pub code: BTreeMap<Language, String>,
    /// Its tables and pages.
    pub files: Files,
}

/// Every file of a bake: those of the parts, the include files, the overview, the manifest.
pub fn assemble(
    plan: &Plan,
    parts: &[Part],
    opening: &[String],
    origin: Origin,
    context: &Context,
) -> Result<Files, BakeError> {
    let mut files = Files::new();
    let mut entries = Entries::default();
    for part in parts {
        files.extend(part.files.clone());
        entries.extend(&part.entries);
    }
    let mut listed = Vec::new();
    for (language, text) in includes::includes(parts, opening, context) {
        let file = includes::path(language);
        listed.push(Include { language: language.name(), file: file.clone() });
        files.insert(file, text.into_bytes());
    }
    let left_out: Vec<LeftOut> = plan
        .left_out
        .iter()
        .map(|l| LeftOut { effect: l.effect.name().into(), reason: l.reason.clone() })
        .collect();
    let index = index(parts, &left_out, origin);
    for file in report::index(&index)? {
        entries
            .reports
            .push(canonical(&crate::emit::manifest::Report { effect: None, file: file.path.clone() })?);
        files.insert(file.path, file.bytes);
    }
    let effects = parts.iter().map(|p| canonical(&p.finding)).collect::<Result<_, _>>()?;
    let manifest = Manifest {
        schema_version: SCHEMA_VERSION,
        tool: context.recipe.tool.clone(),
        scene: context.recipe.scene.clone(),
        recipe: context.recipe.hash.clone(),
        effects,
        entries,
        includes: listed,
        left_out,
    };
    files.insert(MANIFEST.to_string(), manifest.bytes()?);
    Ok(files)
}

/// The overview: every effect with a link to its page, everything that was made.
fn index(parts: &[Part], left_out: &[LeftOut], origin: Origin) -> Index {
    let lines = left_out.iter();
    Index {
        origin,
        effects: parts.iter().map(|p| p.finding.clone()).collect(),
        left_out: lines
            .map(|l| report::LeftOut { effect: l.effect.clone(), reason: l.reason.clone() })
            .collect(),
        rows: parts.iter().flat_map(rows).collect(),
    }
}

fn rows(part: &Part) -> Vec<IndexRow> {
    let tables = part.entries.tables.iter().map(|t| (t, &t["error"]["lookup"]["max"], &t["file"]));
    let fits = part.entries.fits.iter().map(|f| (f, &f["certificate"]["max_abs"], &Value::Null));
    let row = |(entry, error, file): (&Value, &Value, &Value)| IndexRow {
        effect: part.effect.name().into(),
        name: text(&entry["name"]),
        quantity: text(&entry["quantity"]),
        used_as: text(&entry["use"]),
        smith: text(&entry["smith"]),
        max_error: error.as_f64(),
        ops: entry["cost"]["ops"].as_u64().unwrap_or(0),
        fetches: entry["cost"]["fetches"].as_u64().unwrap_or(0),
        bytes: entry["cost"]["bytes"].as_u64().unwrap_or(0),
        file: text(file),
    };
    tables.chain(fits).map(row).collect()
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().into()
}
