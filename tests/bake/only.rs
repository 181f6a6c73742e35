//! `lobefit bake` on a folder that holds a bake: other containers, a promise that is not kept, and
//! effects one by one.

use crate::common;
use crate::sliced_support;

use std::path::Path;

use common::{lobefit, stderr};
use lobefit::bake::{BUILD_FILE, sign};
use lobefit::store::Files;
use sliced_support::{ANISO, entry, manifest, small, small_baked};
use tempfile::TempDir;

#[path = "../../build/sources.rs"]
mod sources;

const FORMATS: &str = r#""formats":["exr","dds","ktx2","npy","raw"],"#;

/// The full bake of the small scene, in memory.
fn full() -> &'static Files {
    &small_baked().files
}

/// Runs a bake of a scene in a folder; its exit code, and standard error. What one run has made of
/// an effect the others take: which parts go into a folder is what is looked at here.
fn bake(folder: &Path, scene: &str, options: &[&str]) -> (i32, String) {
    let arguments = [&["bake", "-", "--quiet"], options].concat();
    let output = lobefit(folder, &arguments, scene.as_bytes());
    assert!(output.stdout.is_empty());
    (output.status.code().expect("a code"), stderr(&output))
}

/// Every file of a bake in a folder, by path.
fn files(folder: &Path) -> Files {
    let mut files = Files::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name =
                    path.strip_prefix(folder).expect("below").to_str().expect("a name").replace('\\', "/");
                files.insert(name, std::fs::read(&path).expect("a file"));
            }
        }
    }
    files.remove(BUILD_FILE);
    files
}

/// The same names and the same bytes.
fn same(found: &Files, expected: &Files) {
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (name, bytes) in expected {
        assert!(&found[name] == bytes, "{name} differs");
    }
}

/// A folder that holds the full bake of the small scene, as this build writes it.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mut files = full().clone();
    sign(&mut files);
    for (name, bytes) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("written");
    }
    folder
}

/// An empty list of materials is more often a mistake of what wrote it than a wish to remove all.
#[test]
fn a_scene_that_calls_for_nothing_removes_no_bake() {
    let folder = folder();
    let before = files(folder.path());
    let (code, said) = bake(folder.path(), r#"{"schema_version":1,"materials":[]}"#, &[]);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("it calls for nothing, and . holds a bake"), "{said}");
    assert!(files(folder.path()) == before);
    // Where nothing lies, nothing is removed: the second time as the first.
    let empty = tempfile::tempdir().expect("a folder");
    for _ in 0..2 {
        assert_eq!(bake(empty.path(), r#"{"schema_version":1,"materials":[]}"#, &[]), (0, String::new()));
    }
}

#[test]
fn containers_come_with_their_sidecars_and_go_with_a_bake_without_them() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_eq!(bake(folder.path(), &small(FORMATS), &[]), (0, String::new()));
    let all = files(folder.path());
    let told = manifest(&all);
    let mut tables = Vec::new();
    for table in told["tables"].as_array().expect("tables[]") {
        let name = table["name"].as_str().expect("a name");
        let extensions =
            ["exr", "dds", "dds.json", "ktx2", "ktx2.json", "npy", "npy.json", "raw", "raw.json"];
        let expected = extensions.map(|extension| format!("tables/{name}.{extension}"));
        assert_eq!(table["files"], serde_json::json!(expected));
        assert_eq!(table["file"], serde_json::json!(expected[0]));
        tables.extend(expected);
    }
    tables.sort();
    let written: Vec<&String> = all.keys().filter(|name| name.starts_with("tables/")).collect();
    assert_eq!(written, tables.iter().collect::<Vec<_>>(), "no more and no less");
    for name in tables.iter().filter(|name| name.ends_with(".json")) {
        let sidecar: serde_json::Value = serde_json::from_slice(&all[name]).expect("JSON");
        let table = entry(&told, sidecar["name"].as_str().expect("a name"));
        for field in ["quantity", "smith", "alpha_map", "axes", "channels", "decode", "format"] {
            assert_eq!(sidecar[field], table[field], "{field} of {name}");
        }
        assert_eq!(sidecar["certificate"]["max_abs"], table["error"]["lookup"]["max"], "{name}");
    }
    // Effects one by one keep the others' containers.
    assert_eq!(bake(folder.path(), &small(FORMATS), &["--only", "glass"]), (0, String::new()));
    same(&files(folder.path()), &all);
    std::fs::write(folder.path().join("tables/mine.raw"), "mine").expect("written");
    assert_eq!(bake(folder.path(), &small(""), &[]), (0, String::new()));
    assert_eq!(std::fs::read(folder.path().join("tables/mine.raw")).expect("still there"), b"mine");
    std::fs::remove_file(folder.path().join("tables/mine.raw")).expect("removed");
    same(&files(folder.path()), full());
}

/// Functions of C and Rust read arrays, in the order of the `raw` file: that is the file of their calls.
#[test]
fn the_file_of_a_call_is_the_one_that_its_function_reads() {
    for (languages, read) in [(r#"["c"]"#, "raw"), (r#"["c", "rust"]"#, "raw"), (r#"["c", "wgsl"]"#, "npy")] {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = format!(
            r#"{{"schema_version": 1, "languages": {languages}, "formats": ["npy", "raw"], "reports": false, "materials":
            [{{"name": "m", "kind": "metal", "f0": 0.6, "roughness": [0.3, 1], "wants": {{"tables": [{{"size": [8, 8]}}]}}}}]}}"#
        );
        assert_eq!(bake(folder.path(), &scene, &[]), (0, String::new()));
        let manifest = manifest(&files(folder.path()));
        let file = format!("tables/ggx-dfg-correlated-8x8.{read}");
        assert_eq!([&manifest["calls"][0]["file"], &manifest["tables"][0]["file"]], [&file, &file]);
    }
}

#[test]
fn a_limit_that_cannot_be_met_fails_with_the_table_and_the_field() {
    for (material, table) in [
        (r#""kind":"metal","f0":1,"anisotropy":[0.4,0.6]"#, "ggx-aniso-correlated-4x4x4"),
        (r#""kind":"glass","ior":[1.4,1.6]"#, "ggx-glass-outside-correlated-4x4x4"),
    ] {
        let wants = r#"{"tables":[{"layout":"optimised","size":[8,8,4]},{"size":[4,4,4],"max_error":1e-6}]}"#;
        let scene = format!(
            r#"{{"schema_version":1,"materials":[{{"name":"m",{material},"roughness":[0.5,0.6],"wants":{wants}}}]}}"#
        );
        let folder = tempfile::tempdir().expect("a folder");
        let (code, said) = bake(folder.path(), &scene, &[]);
        assert_eq!(code, 1, "{said}");
        assert!(said.contains(&format!("promise not kept: table {table}: lookup error ")), "{said}");
        let field = "exceeds the max_error 0.000001 of m (materials[0].wants.tables[1].max_error)";
        assert!(said.contains(field) && said.ends_with("nothing written\n"), "{said}");
        assert!(files(folder.path()).is_empty());
    }
}

#[test]
fn one_effect_again_changes_nothing() {
    let folder = folder();
    for only in ["anisotropy", "glass", "glass,reflection"] {
        assert_eq!(bake(folder.path(), &small(""), &["--only", only]), (0, String::new()), "{only}");
        same(&files(folder.path()), full());
    }
}

#[test]
fn effects_one_by_one_make_the_full_bake() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_eq!(bake(folder.path(), &small(""), &["--only", "anisotropy"]), (0, String::new()));
    let first = files(folder.path());
    assert!(first.contains_key("reports/anisotropy.html") && !first.contains_key("reports/glass.html"));
    let effects = manifest(&first)["effects"].as_array().expect("effects[]").len();
    assert_eq!(effects, 1, "what is not baked is not told of");
    assert!(first.keys().filter(|name| name.starts_with("tables/")).all(|name| name.contains("aniso")));
    assert_eq!(bake(folder.path(), &small(""), &["--only", "glass"]), (0, String::new()));
    assert_eq!(bake(folder.path(), &small(""), &["--only", "reflection"]), (0, String::new()));
    same(&files(folder.path()), full());
}

#[test]
fn the_bake_of_another_scene_is_not_mixed_in() {
    let folder = folder();
    let other = small("").replace("0.3,0.7", "0.3,0.75");
    let (code, said) = bake(folder.path(), &other, &["--only", "anisotropy"]);
    assert_eq!(code, 2, "{said}");
    let found = manifest(full())["recipe"].as_str().expect("a recipe").to_string();
    assert!(
        said.starts_with(&format!("error: --only: .: the bake there has recipe {found}, this one ")),
        "{said}"
    );
    assert!(
        said.ends_with(
            ": the scene, its hypotheses or the tool changed, so its other effects may not follow any more; bake \
             without --only\n"
        ),
        "{said}"
    );
    same(&files(folder.path()), full());
}

/// Another build's parts, an older version's and those beside another manifest may be stale: they
/// are not kept.
#[test]
fn the_bake_of_another_build_is_not_mixed_in() {
    let folder = folder();
    let record = folder.path().join(BUILD_FILE);
    let own = std::fs::read_to_string(&record).expect("a record");
    assert!(own.starts_with(&format!("build {}\nmanifest ", lobefit::bake::BUILD)), "{own}");
    let other_manifest = own.replace("manifest ", "manifest 0");
    for other in [Some(own.replace("build ", "build 0")), Some(other_manifest), None] {
        match other {
            Some(other) => std::fs::write(&record, other).expect("written"),
            None => std::fs::remove_file(&record).expect("removed"),
        }
        let (code, said) = bake(folder.path(), &small(""), &["--only", "glass"]);
        let expected = "error: --only: .: fits/build.txt does not say that this build of lobefit made the bake there, so its other \
                        effects may not follow any more; bake without --only\n";
        assert_eq!((code, said.as_str()), (2, expected));
        same(&files(folder.path()), full());
    }
    assert_eq!(bake(folder.path(), &small(""), &[]), (0, String::new()));
    assert_eq!(std::fs::read_to_string(&record).expect("a record"), own);
}

/// The build's hash is that of its sources: every byte and every name counts, the place of the root
/// does not.
#[test]
fn another_source_is_another_build() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let places = sources::places(root).expect("a manifest");
    for place in ["src", "crates/math", "crates/truth", "crates/shade", "crates/fit", "fits/hypotheses"] {
        assert!(places.iter().any(|p| p == place), "{place} is not in {places:?}");
    }
    assert_eq!(sources::hash(root, &places, |bytes| bytes).expect("sources"), lobefit::bake::BUILD);
    let hash = |files: &[(&str, &str)]| {
        let copy = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            let path = copy.path().join(name);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(path, text).expect("written");
        }
        sources::hash(copy.path(), &["src".to_string()], |bytes| bytes).expect("sources")
    };
    let one = hash(&[("src/a.rs", "1"), ("src/b/c.rs", "2")]);
    assert_eq!(hash(&[("src/b/c.rs", "2"), ("src/a.rs", "1")]), one);
    for other in [
        &[("src/a.rs", "2"), ("src/b/c.rs", "1")][..],
        &[("src/a.rs", "1"), ("src/b/d.rs", "2")],
        &[("src/a.rs", "1 "), ("src/b/c.rs", "2")],
        &[("src/a.rs", "1")],
    ] {
        assert_ne!(hash(other), one);
    }
}

#[test]
fn a_bake_with_a_file_missing_is_not_completed() {
    for (missing, only) in [
        (format!("tables/{ANISO}.exr"), "glass"),
        ("reports/glass.html".into(), "anisotropy"),
        ("fits/lobefit.rs".into(), "anisotropy"),
    ] {
        let folder = folder();
        std::fs::remove_file(folder.path().join(&missing)).expect("removed");
        let before = files(folder.path());
        let (code, said) = bake(folder.path(), &small(""), &["--only", only]);
        let expected = format!(
            "error: --only: .: the bake there lacks {missing}, which its manifest lists; bake without --only\n"
        );
        assert_eq!((code, said), (2, expected));
        same(&files(folder.path()), &before);
    }
}
