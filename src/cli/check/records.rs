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
}

impl Record {
    /// What is said of a record that is not of the bake's code; nothing of one that is.
    pub fn note(&self) -> Option<String> {
        let first = self.stale.first()?;
        let more = if self.stale.len() > 1 { ", ..." } else { "" };
        Some(format!(
            "note: {}: {} of {} times on {} are of other code than the bake's ({}{more}); measure again with lobefit cost --gpu \
             --record\n",
            visible(&self.file),
            self.stale.len(),
            self.rows,
            visible(&self.device),
            visible(first)
        ))
    }
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

/// The records that are there, and what is wrong with them: no record, or a page of another. Times of other code are nothing wrong, for
/// they are measured where there is a device; they are told of.
pub(super) fn records(root: &Path, baked: &Baked) -> Result<(Vec<Record>, Vec<Difference>), CliError> {
    let (mut records, mut differences) = (Vec::new(), Vec::new());
    let entries = store::list(root, FOLDER)?;
    for entry in entries.iter().filter(|e| e.name.ends_with(".json") && placed(e, &entries)) {
        let file = entry.name.clone();
        let page = format!("{}.html", file.trim_end_matches(".json"));
        let mut found = store::read_set(root, [file.as_str()], RECORD_BYTES)?;
        found.extend(store::read_set(root, [page.as_str()], PAGE_BYTES)?);
        let Some(bytes) = found.get(&file) else { continue };
        match record::read(bytes) {
            Ok(record) => {
                let stale = record::stale(&record, baked);
                let hash = blake3::hash(bytes).to_hex();
                let named = |page: &Vec<u8>| page.windows(hash.len()).any(|w| w == hash.as_bytes());
                if !found.get(&page).is_some_and(named) {
                    let detail = format!("not the page of {file}; make it with lobefit cost --page {file}");
                    differences.push(Difference::plain(&page, bake::Kind::Different, &detail));
                }
                records.push(Record { file, device: record.device.adapter, rows: record.rows.len(), stale });
            }
            Err(e) => differences.push(Difference::plain(&file, bake::Kind::Different, &e.to_string())),
        }
    }
    Ok((records, differences))
}
