//! The committed reports are small enough to live beside the code.

use std::path::Path;

use crate::texts::root;

/// Bytes of all reports together.
const BYTES: u64 = 6 << 20;

fn bytes(folder: &Path) -> u64 {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let of = |path: &Path| if path.is_dir() { bytes(path) } else { path.metadata().expect("a file").len() };
    entries.map(|entry| of(&entry.path())).sum()
}

#[test]
fn the_committed_reports_are_at_most_6_mib() {
    let found = bytes(&root().join("reports"));
    assert!(found <= BYTES, "{found} bytes");
}
