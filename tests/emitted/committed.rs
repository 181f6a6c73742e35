//! The committed files are the built-in scene's bake.

use std::path::Path;

use lobefit::bake::{BUILD_FILE, Selection, Silent, bake};
use lobefit::effects::parallax::Width;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit_shade::code::Language;
use serde_json::Value;

use crate::emit_support::{baked, say};

/// What the study takes for the width of emitted lookups is the fit that the committed ones call.
#[test]
fn the_width_of_emitted_lookups_is_the_studys() {
    let manifest: Value = serde_json::from_slice(&baked().0.files["manifest.json"]).expect("JSON");
    let lookups = manifest["lookups"].as_array().expect("lookups");
    assert!(!lookups.is_empty() && lookups.iter().all(|lookup| lookup["width"] == "parallax_1"));
    let page: Value = serde_json::from_slice(&baked().0.files["reports/parallax.json"]).expect("JSON");
    let fits = page["lobes"][0]["approximations"].as_array().expect("fits");
    let fit = fits.iter().find(|fit| fit["name"] == "parallax_1").expect("the width");
    let constant = fit["coefficients"][0][1].as_f64().expect("a number") as f32;
    let Width::Cubic { k, c: 0.0, d: 0.0 } = Width::EMITTED else { panic!("another formula") };
    assert_eq!(k as f32, constant);
}

/// An include file is read from its top to its end.
#[test]
fn the_built_in_include_files_are_short() {
    for language in Language::ALL {
        let name = format!("fits/lobefit.{}", language.extension());
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&name);
        let lines = std::fs::read_to_string(path).expect("a committed file").lines().count();
        assert!(lines < 600, "{name}: {lines} lines");
    }
}

/// The page that `lobefit cost --page` writes; `tests/house/docs.rs` makes it again.
const COSTS: &str = "reports/cost.html";

/// What `bake` writes; folders below hold what other commands and people write.
const FOLDERS: [&str; 3] = ["tables", "fits", "reports"];

#[test]
fn the_committed_files_are_the_bake_of_the_built_in_scene() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scene = Scene::built_in().expect("the built-in scene");
    let baked = bake(&scene, &plan(&scene), &[], Selection::default(), &Silent).expect("a bake");
    let files = &baked.files;
    assert!(files.len() > 10);
    for (name, bytes) in files {
        let committed = std::fs::read(root.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(&committed == bytes, "{name} is not what `lobefit bake` writes");
    }
    for folder in FOLDERS {
        for entry in std::fs::read_dir(root.join(folder)).expect("committed files") {
            let entry = entry.expect("an entry");
            let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
            let beside = name.starts_with("reports/timings.") || [BUILD_FILE, COSTS].contains(&name.as_str());
            let known = entry.path().is_dir() || files.contains_key(&name) || beside;
            assert!(known, "{name} is not in the bake");
        }
    }
    say(&format!("committed: {} files, every byte the same", files.len()));
}

/// Bytes of all reports together.
const BYTES: u64 = 6 << 20;

fn bytes(folder: &Path) -> u64 {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let of = |path: &Path| if path.is_dir() { bytes(path) } else { path.metadata().expect("a file").len() };
    entries.map(|entry| of(&entry.path())).sum()
}

#[test]
fn the_committed_reports_are_at_most_6_mib() {
    let found = bytes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("reports"));
    assert!(found <= BYTES, "{found} bytes");
}
