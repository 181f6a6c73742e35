//! Committed files: short, and what others take from them. That they follow from their recipe is what the
//! closing `lobefit check` of `.ci/run` shows.

use std::collections::BTreeSet;
use std::path::Path;

use lobefit::effects::parallax::Width;
use lobefit::emit::call::How;
use lobefit::emit::include::call;
use lobefit::emit::manifest::Manifest;
use lobefit_shade::code::Language;
use serde_json::Value;

use crate::emit_support::baked;

/// What the study takes for the width of emitted lookups is the fit that the committed ones call.
#[test]
fn the_width_of_emitted_lookups_is_the_studys() {
    let manifest: Value = serde_json::from_slice(&baked().0.files["manifest.json"]).expect("JSON");
    let lookups = manifest["lookups"].as_array().expect("lookups");
    assert!(!lookups.is_empty() && lookups.iter().all(|lookup| lookup["width"] == "parallax_1"));
    let fits = manifest["fits"].as_array().expect("fits");
    let fit = fits.iter().find(|fit| fit["name"] == "parallax_1").expect("the width");
    let constant = fit["coefficients"]["k"].as_f64().expect("a number") as f32;
    let Width::Cubic { k, c: 0.0, d: 0.0 } = Width::EMITTED else { panic!("another formula") };
    assert_eq!(k as f32, constant);
}

/// The manifest alone is enough to write a call and what is made of it: each include file declares the
/// arguments that it states, a texture and its sampler as `table`.
#[test]
fn the_manifest_states_the_arguments_that_the_include_files_declare() {
    let files = &baked().0.files;
    let manifest = Manifest::read(&files["manifest.json"]).expect("a manifest");
    let fetched = ["table", "texels", "linear_clamp"];
    for include in &manifest.includes {
        let text = String::from_utf8_lossy(&files[&include.file]);
        let declared = |function: &str| {
            let declared = call(&text, function).unwrap_or_else(|| panic!("{}: {function}", include.file));
            declared
                .arguments
                .into_iter()
                .filter(|name| !fetched.contains(&name.as_str()))
                .collect::<Vec<_>>()
        };
        for call in &manifest.entries.calls {
            let stated = call.arguments.strip_prefix(&["table".to_string()]).unwrap_or(&call.arguments);
            assert_eq!(stated.len() < call.arguments.len(), call.file.is_some(), "{}", call.function);
            assert_eq!(declared(&call.function), stated, "{}: {}", include.file, call.function);
            for around in &call.around {
                assert_eq!(declared(&around.function), around.arguments, "{}", include.file);
            }
        }
    }
    let around: BTreeSet<(&str, How)> = manifest
        .entries
        .calls
        .iter()
        .flat_map(|call| &call.around)
        .map(|around| (around.function.as_str(), around.how))
        .collect();
    for named in [
        ("diffuse_coupled_normalised", How::Calls),
        ("diffuse_coupled_normalised_rgb", How::Calls),
        ("ggx_compensate_reflection", How::TakesValue),
        ("ggx_compensate_glass_factor", How::TakesValue),
    ] {
        assert!(around.contains(&named), "{named:?} in {around:?}");
    }
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
