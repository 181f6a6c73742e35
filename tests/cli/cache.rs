//! What bakes leave for others.

use std::fs;
use std::path::Path;
#[cfg(unix)]
use std::{os::unix::fs::MetadataExt, time::Duration};

use lobefit::store::Cache;

use crate::common::{bytes, lobefit_with, names, start};

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
    let part = || {
        let parts: Vec<String> = names(&cache).into_iter().filter(|name| name.starts_with("part-")).collect();
        assert_eq!(parts.len(), 1, "one effect");
        parts[0].clone()
    };
    assert!(run(&["cache"]).contains(&format!("cache: {} entries, ", names(&cache).len())));
    // Damage is no result, of a file or of the part in it.
    let entry = cache.join(part());
    let whole = fs::read(&entry).unwrap();
    fs::write(&entry, &whole[..whole.len() / 2]).unwrap();
    assert!(!bake(&cache, folder.path(), "third", &[]).is_empty());
    assert_eq!(fs::read(&entry).unwrap(), whole);
    let (key, results) = (part().replace(".entry", ""), Cache::at(cache.clone()));
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
fn a_scene_with_more_in_it_is_spared_what_was_fitted_and_tabulated() {
    let folder = tempfile::tempdir().unwrap();
    let caches = ["first", "other"].map(|name| folder.path().join(name));
    let scene = |ops: u32, more: &str| {
        let table = r#""tables": [{"size": [16, 16, 4], "format": "f32"}]"#;
        let materials = [
            format!(
                r#"{{"name": "steel", "kind": "metal", "f0": 0.6, "roughness": [0.2, 1], "wants": {{"fit": {{"max_ops": {ops}}}}}}}"#
            ),
            format!(
                r#"{{"name": "pane", "kind": "glass", "ior": 1.5, "roughness": [0.1, 1], "wants": {{{table}}}}}"#
            ),
        ];
        format!(
            r#"{{"schema_version": 1, "languages": ["wgsl"], "reports": false, "materials": [{}{more}]}}"#,
            materials.join(", ")
        )
    };
    let brass = r#", {"name": "brass", "kind": "metal", "f0": 0.9, "roughness": [0.4, 1], "wants": {"fit": {"max_ops": 6}}}"#;
    let bake = |cache: &Path, out: &str, scene: String| {
        let output = lobefit_with(cache, folder.path(), &["bake", "-", "--out", out], scene.as_bytes());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        names(cache)
    };
    let of = |names: &[String], kind: &str| -> Vec<String> {
        names.iter().filter(|name| name.starts_with(kind)).cloned().collect()
    };
    let before = bake(&caches[0], "before", scene(6, ""));
    let after = bake(&caches[0], "after", scene(8, brass));
    let alone = bake(&caches[1], "alone", scene(8, brass));
    assert!(bytes(&folder.path().join("after")) == bytes(&folder.path().join("alone")));
    // A glass's tables are not made again, nor the fits of the first six operations: the entries are the
    // same, and the new ones are those of the new formulas.
    assert_eq!(of(&before, "tables-"), of(&after, "tables-"));
    let (old, new) = (of(&before, "fit-"), of(&after, "fit-"));
    assert!(old.iter().all(|name| new.contains(name)) && old.len() < new.len(), "{old:?} {new:?}");
    assert!(of(&alone, "fit-").iter().all(|name| new.contains(name)));
}

#[cfg(unix)]
#[test]
fn an_interrupted_bake_goes_on_from_what_was_finished() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let scene = r#"{"schema_version": 1, "languages": ["wgsl"], "reports": false, "materials": [
        {"name": "steel", "kind": "metal", "f0": 0.6, "roughness": [0.2, 1], "wants": {"fit": {"max_ops": 20}}},
        {"name": "pane", "kind": "glass", "ior": 1.5, "roughness": [0.1, 1], "wants": {"tables": [{"size": [32, 32, 8]}]}}
    ]}"#;
    fs::write(folder.path().join("scene.json"), scene).unwrap();
    let arguments = |out: &'static str| ["bake", "scene.json", "--threads", "1", "--out", out];
    let mut child = start(&cache, folder.path(), &arguments("out"));
    // The numbers of entries: one that is made again is another file of the same name.
    let finished = || -> Vec<(String, u64)> {
        let all = if cache.exists() { names(&cache) } else { Vec::new() };
        let of_file = |name: String| Some((name.clone(), fs::metadata(cache.join(name)).ok()?.ino()));
        all.into_iter().filter(|name| name.ends_with(".entry")).filter_map(of_file).collect()
    };
    while finished().len() < 3 {
        std::thread::sleep(Duration::from_millis(2));
        assert!(child.try_wait().unwrap().is_none(), "it ended before it was broken off");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = finished();
    assert!(
        !folder.path().join("out").exists() && kept.iter().all(|(name, _)| !name.starts_with("part-")),
        "{kept:?}"
    );
    for (cache, out) in [(&cache, "out"), (&folder.path().join("other"), "alone")] {
        let output = lobefit_with(cache, folder.path(), &arguments(out), &[]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(bytes(&folder.path().join("out")) == bytes(&folder.path().join("alone")));
    let all = finished();
    assert!(all.len() > kept.len() && kept.iter().all(|entry| all.contains(entry)), "{kept:?} {all:?}");
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
    let parts = names(&cache).into_iter().filter(|name| name.starts_with("part-"));
    assert_eq!(parts.count(), 1, "{:?}", names(&cache));
    assert!(names(&cache).iter().all(|name| name.ends_with(".entry")), "{:?}", names(&cache));
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
