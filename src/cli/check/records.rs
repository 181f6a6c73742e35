//! Records of times on graphics processors that lie beside a bake.

use std::path::Path;

use serde::Serialize;

use super::super::CliError;
use super::super::cost::RECORD_BYTES;
use crate::bake::{self, Baked, Difference};
use crate::scene::escape::visible;
use crate::store::{self, Entry, Kind};
use crate::timing::record::{self, FOLDER};

/// Largest page that is read, bytes.
const PAGE_BYTES: u64 = 1 << 26;

/// A record that is there.
#[derive(Serialize)]
pub(super) struct Record {
    /// Its file.
    pub file: String,
    /// The graphics processor.
    pub device: String,
    /// Functions and fetches in it.
    pub rows: usize,
    /// Those whose code is not that of the bake.
    pub stale: Vec<String>,
    /// Functions of the bake that are not in it.
    pub missing: Vec<String>,
}

impl Record {
    /// What is said of a record that is not of the bake's code, or not of all of it; nothing of one
    /// that is.
    pub fn note(&self) -> Option<String> {
        let device = visible(&self.device);
        let stale = some(&self.stale).map(|names| {
            let count = self.stale.len();
            format!("{count} of {} times on {device} are of other code than the bake's ({names})", self.rows)
        });
        let missing = some(&self.missing).map(|names| {
            let count = self.missing.len();
            format!("{count} of the bake's functions are not timed on {device} ({names})")
        });
        let told: Vec<String> = stale.into_iter().chain(missing).collect();
        (!told.is_empty()).then(|| {
            let (file, told) = (visible(&self.file), told.join("; "));
            format!("note: {file}: {told}; measure again with lobefit cost --gpu --record\n")
        })
    }
}

/// The first of some names; none of none.
pub(super) fn some(names: &[String]) -> Option<String> {
    let more = if names.len() > 1 { ", ..." } else { "" };
    names.first().map(|first| format!("{}{more}", visible(first)))
}

/// Whether an entry is in the place of a record, or of the page of one that is there.
pub(super) fn placed(entry: &Entry, all: &[Entry]) -> bool {
    let Some(name) = entry.name.strip_prefix(FOLDER).and_then(|rest| rest.strip_prefix('/')) else {
        return false;
    };
    let is_file = |name: &str| all.iter().any(|e| e.name == name && e.kind == Kind::File);
    match name.rsplit_once('.') {
        _ if name.contains('/') || entry.kind != Kind::File => false,
        Some((_, "json")) => true,
        Some((stem, "html")) => is_file(&format!("{FOLDER}/{stem}.json")),
        _ => false,
    }
}

/// The records that are there, and what is wrong with them: no record, or another page than its
/// own. Times of other code are nothing wrong, for they are measured where there is a device; a
/// note names them, of records of this scene.
pub(super) fn records(
    root: &Path,
    (baked, scene): (&Baked, &str),
) -> Result<(Vec<Record>, Vec<Difference>), CliError> {
    let (mut records, mut differences) = (Vec::new(), Vec::new());
    let entries = store::list(root, FOLDER)?;
    for entry in entries.iter().filter(|e| e.name.ends_with(".json") && placed(e, &entries)) {
        let file = entry.name.clone();
        let page = format!("{}.html", file.strip_suffix(".json").unwrap_or(&file));
        let mut found = store::read_set(root, [file.as_str()], RECORD_BYTES)?;
        found.extend(store::read_set(root, [page.as_str()], PAGE_BYTES)?);
        let Some(bytes) = found.get(&file) else { continue };
        match record::read(bytes) {
            Ok(record) => {
                let (stale, missing) = match record.origin.scene == scene {
                    true => (record::stale(&record, baked), record::missing(&record, baked)),
                    false => (Vec::new(), Vec::new()),
                };
                let (html, figures) = record::page(&record)
                    .map_err(|source| CliError::Record { file: file.clone(), source })?;
                let shown = found.get(&page).map_or(&[][..], Vec::as_slice);
                let pairs = [(&file, &figures[..], &bytes[..]), (&page, html.as_bytes(), shown)];
                let differs = pairs.into_iter().find(|(_, made, found)| made != found);
                if let Some((other, made, found)) = differs {
                    let place = bake::different_text(other, made, found).detail;
                    let detail = format!(
                        "not the page of {file}: {other}, {place}; make it with lobefit cost --page {file}"
                    );
                    differences.push(Difference::plain(&page, bake::Kind::Different, &detail));
                }
                let (device, rows) = (record.device.adapter, record.rows.len());
                records.push(Record { file, device, rows, stale, missing });
            }
            Err(e) => differences.push(Difference::plain(&file, bake::Kind::Different, &e.to_string())),
        }
    }
    Ok((records, differences))
}
