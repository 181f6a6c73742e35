//! The folder of results that need not be made twice.

use std::fs::{self, File};
use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use lobefit::store::{Cache, Held};

fn cache(folder: &tempfile::TempDir) -> Cache {
    Cache::at(folder.path().join("results"))
}

/// The file of an entry.
fn path(cache: &Cache, key: &str) -> PathBuf {
    cache.folder().join(format!("{key}.entry"))
}

#[test]
fn what_was_put_is_there_and_damage_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let cache = cache(&folder);
    assert_eq!((cache.get("a"), cache.held().unwrap()), (None, Held::default()));
    cache.put("a", b"some content");
    assert_eq!(cache.get("a").as_deref(), Some(&b"some content"[..]));
    let path = path(&cache, "a");
    let whole = fs::read(&path).unwrap();
    for damaged in [&whole[..whole.len() - 1], &whole[..10], b""] {
        fs::write(&path, damaged).unwrap();
        assert_eq!(cache.get("a"), None);
    }
    cache.put("a", b"some content");
    assert_eq!(cache.clear().unwrap(), Held { entries: 1, bytes: 44 });
    assert_eq!((cache.get("a"), cache.failed().is_some()), (None, false));
}

#[test]
fn the_entries_that_were_read_longest_ago_go_first() {
    let folder = tempfile::tempdir().unwrap();
    let cache = cache(&folder);
    for (key, age) in [("a", 3), ("b", 2), ("c", 1)] {
        cache.put(key, &[0; 68]);
        let time = SystemTime::now() - Duration::from_secs(100 * age);
        File::options().write(true).open(path(&cache, key)).unwrap().set_modified(time).unwrap();
    }
    assert!(cache.get("a").is_some());
    cache.bound(250).unwrap();
    assert_eq!(["a", "b", "c"].map(|key| cache.get(key).is_some()), [true, false, true]);
}

#[test]
fn a_place_that_cannot_be_written_is_named_and_no_error() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("results"), "a file").unwrap();
    let cache = cache(&folder);
    cache.put("a", b"content");
    assert!(cache.failed().is_some_and(|error| error.to_string().contains("results")));
    assert_eq!(cache.get("a"), None);
}
