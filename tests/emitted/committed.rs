//! The committed files are the built-in scene's bake.

use std::path::Path;

use crate::emit_support::{baked, say};

/// What `bake` writes; folders below hold what other commands and people write.
const FOLDERS: [&str; 3] = ["tables", "fits", "reports"];

#[test]
fn the_committed_files_are_the_bake_of_the_built_in_scene() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = &baked().0.files;
    assert!(files.len() > 10);
    for (name, bytes) in files {
        let committed = std::fs::read(root.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(&committed == bytes, "{name} is not what `lobefit bake` writes");
    }
    for folder in FOLDERS {
        for entry in std::fs::read_dir(root.join(folder)).expect("committed files") {
            let entry = entry.expect("an entry");
            let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
            let known =
                entry.path().is_dir() || files.contains_key(&name) || name.starts_with("reports/timings.");
            assert!(known, "{name} is not in the bake");
        }
    }
    say(&format!("committed: {} files, every byte the same", files.len()));
}
