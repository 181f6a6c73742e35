//! What bakes leave for others.

use std::fs;
use std::path::Path;

use lobefit::store::Cache;

use crate::common::{bytes, lobefit_with, names};

const SCENE: &str = r#"{"schema_version": 1, "languages": ["wgsl"], "materials": [
    {"name": "steel", "kind": "metal", "f0": 0.6, "roughness": [0.2, 1], "wants": {"fit": {"max_ops": 8}}}
]}"#;

/// Bakes the scene into a folder; the stages that it announces.
fn bake(cache: &Path, folder: &Path, out: &str, more: &[&str]) -> String {
    fs::write(folder.join("scene.json"), SCENE).unwrap();
    let arguments = [&["bake", "scene.json", "--out", out], more].concat();
    let output = lobefit_with(cache, folder, &arguments, &[]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    said
}

#[test]
fn a_second_bake_computes_nothing_and_writes_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let run = |arguments: &[&str]| {
        let output = lobefit_with(&cache, folder.path(), arguments, &[]);
        assert!(output.status.success());
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    assert!(!bake(&cache, folder.path(), "alone", &["--no-cache"]).is_empty());
    assert!(!cache.exists(), "--no-cache keeps nothing");
    assert!(!bake(&cache, folder.path(), "first", &[]).is_empty());
    assert_eq!(bake(&cache, folder.path(), "second", &[]), "", "no stage is announced");
    let alone = bytes(&folder.path().join("alone"));
    assert!(alone.len() > 5);
    for out in ["first", "second"] {
        assert!(bytes(&folder.path().join(out)) == alone, "{out}");
    }
    assert!(run(&["cache"]).contains("cache: 1 entry, "), "one effect");
    // Damage is no result, of a file or of the part in it.
    let entry = cache.join(&names(&cache)[0]);
    let whole = fs::read(&entry).unwrap();
    fs::write(&entry, &whole[..whole.len() / 2]).unwrap();
    assert!(!bake(&cache, folder.path(), "third", &[]).is_empty());
    assert_eq!(fs::read(&entry).unwrap(), whole);
    let (key, results) = (names(&cache)[0].replace(".entry", ""), Cache::at(cache.clone()));
    let part = results.get(&key).unwrap();
    results.put(&key, &part[..part.len() - 1]);
    assert!(!bake(&cache, folder.path(), "fourth", &[]).is_empty());
    // What another effect's formula changes of a part is the recipe that its files name: a part that
    // another recipe left is signed anew.
    let manifest: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("alone/manifest.json")).unwrap()).unwrap();
    let recipe = manifest["recipe"].as_str().unwrap().as_bytes();
    let mut other = part.clone();
    let places: Vec<usize> = (0..part.len()).filter(|at| part[*at..].starts_with(recipe)).collect();
    assert!(places.len() > 2, "{places:?}: in the part and in its files");
    places.iter().for_each(|at| other[*at..][..recipe.len()].fill(b'b'));
    results.put(&key, &other);
    assert_eq!(bake(&cache, folder.path(), "fifth", &[]), "", "no stage is announced");
    for out in ["third", "fourth", "fifth"] {
        assert!(bytes(&folder.path().join(out)) == alone, "{out}");
    }
    assert!(run(&["cache", "clear"]).contains("removed"));
    assert!(run(&["cache"]).contains("cache: 0 entries, 0.0 MiB"));
}

#[test]
fn bakes_at_once_share_a_cache() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    std::thread::scope(|scope| {
        for out in ["a", "b"] {
            let (cache, at) = (&cache, folder.path().join(out));
            scope.spawn(move || {
                fs::create_dir(&at).unwrap();
                bake(cache, &at, "out", &[]);
            });
        }
    });
    let [a, b] = ["a", "b"].map(|name| bytes(&folder.path().join(name).join("out")));
    assert!(a == b);
    assert_eq!(names(&cache).len(), 1, "{:?}", names(&cache));
}

#[test]
fn a_cache_that_cannot_be_written_is_named_and_stops_no_bake() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    fs::write(&cache, "no folder").unwrap();
    let said = bake(&cache, folder.path(), "out", &[]);
    assert!(said.contains("note: nothing is kept for other bakes: ") && said.contains("cache: "), "{said}");
    assert_eq!(fs::read(&cache).unwrap(), b"no folder");
}
