//! The store on a disk whose k-th operation fails, for every k.

use std::cell::Cell;
use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::rc::Rc;

use lobefit::store::{
    Disk, Files, Folder, Kind, Layout, LocalDisk, LocalTemp, MANIFEST, SUBFOLDERS, StoreError, Temp, Written,
    list, read, read_set, read_stream, write,
};

/// What happens at the k-th operation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    /// It fails with this error; the operations after it work.
    Error(io::ErrorKind),
    /// Writes take one byte; the k-th write is interrupted. Nothing fails.
    Interrupted,
    /// The process is gone: it and everything after it fails, and temporary files stay.
    Kill,
}

#[derive(Debug)]
struct Countdown {
    left: Cell<i64>,
    fault: Fault,
    /// Files renamed to their destinations.
    renamed: Cell<usize>,
}

impl Countdown {
    fn new(left: i64, fault: Fault) -> Rc<Countdown> {
        Rc::new(Countdown { left: Cell::new(left), fault, renamed: Cell::new(0) })
    }

    /// Counts an operation; an error if it is the one, or if the process is gone.
    fn step(&self) -> io::Result<()> {
        self.left.set(self.left.get() - 1);
        match (self.fault, self.left.get()) {
            (Fault::Error(kind), 0) => Err(kind.into()),
            (Fault::Kill, ..=0) => Err(io::ErrorKind::Other.into()),
            _ => Ok(()),
        }
    }

    fn killed(&self) -> bool {
        self.fault == Fault::Kill && self.left.get() <= 0
    }
}

#[derive(Debug)]
struct FaultyDisk(Rc<Countdown>);

struct FaultyTemp {
    inner: Option<LocalTemp>,
    count: Rc<Countdown>,
}

impl Drop for FaultyTemp {
    fn drop(&mut self) {
        if let Some(inner) = self.inner.take().filter(|_| self.count.killed()) {
            // A killed process leaves its temporary files.
            std::mem::forget(inner);
        }
    }
}

impl Temp for FaultyTemp {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.count.step()?;
        let inner = self.inner.as_mut().expect("not renamed yet");
        if self.count.fault == Fault::Interrupted {
            if self.count.left.get() % 3 == 0 {
                return Err(io::ErrorKind::Interrupted.into());
            }
            return Temp::write(inner, &bytes[..1]);
        }
        Temp::write(inner, bytes)
    }

    fn sync(&mut self) -> io::Result<()> {
        self.count.step()?;
        Temp::sync(self.inner.as_mut().expect("not renamed yet"))
    }

    fn rename(mut self, destination: &Path) -> io::Result<()> {
        self.count.step()?;
        self.count.renamed.set(self.count.renamed.get() + 1);
        Temp::rename(self.inner.take().expect("not renamed yet"), destination)
    }
}

impl Disk for FaultyDisk {
    type Temp = FaultyTemp;
    type Lock = std::fs::File;

    fn look(&self, path: &Path) -> io::Result<Option<Kind>> {
        self.0.step()?;
        LocalDisk.look(path)
    }
    fn read(&self, path: &Path, limit: u64) -> io::Result<Vec<u8>> {
        self.0.step()?;
        LocalDisk.read(path, limit)
    }
    fn list(&self, path: &Path) -> io::Result<Vec<OsString>> {
        self.0.step()?;
        LocalDisk.list(path)
    }
    fn create_folder(&self, path: &Path) -> io::Result<()> {
        self.0.step()?;
        LocalDisk.create_folder(path)
    }
    fn create_temp(&self, folder: &Path, prefix: &str) -> io::Result<FaultyTemp> {
        self.0.step()?;
        let inner = LocalDisk.create_temp(folder, prefix)?;
        Ok(FaultyTemp { inner: Some(inner), count: Rc::clone(&self.0) })
    }
    fn sync_folder(&self, path: &Path) -> io::Result<()> {
        self.0.step()?;
        LocalDisk.sync_folder(path)
    }
    fn remove(&self, path: &Path) -> io::Result<()> {
        self.0.step()?;
        LocalDisk.remove(path)
    }
    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        self.0.step()?;
        LocalDisk.remove_folder(path)
    }
    fn lock(&self, folder: &Path) -> io::Result<Option<std::fs::File>> {
        self.0.step()?;
        LocalDisk.lock(folder)
    }
}

fn set(entries: &[(&str, &str)]) -> Files {
    entries.iter().map(|(name, text)| ((*name).into(), text.as_bytes().to_vec())).collect()
}

fn old_set() -> Files {
    set(&[
        ("fits/a.wgsl", "old fit"),
        ("tables/gone.exr", "stale"),
        ("tables/t.exr", "old table"),
        (
            "manifest.json",
            r#"{"tables":[{"file":"tables/t.exr"},{"file":"tables/gone.exr"}],"includes":[{"file":"fits/a.wgsl"}]}"#,
        ),
    ])
}

fn new_set() -> Files {
    set(&[
        ("fits/a.wgsl", "new fit"),
        ("reports/index.html", "new page"),
        ("tables/t.exr", "new table"),
        ("manifest.json", r#"{"tables":[{"file":"tables/t.exr"}],"includes":[{"file":"fits/a.wgsl"}]}"#),
    ])
}

/// Everything below a folder.
fn everything(root: &Path) -> Files {
    let mut entries = list(root, MANIFEST).unwrap();
    entries.extend(SUBFOLDERS.iter().flat_map(|f| list(root, f).unwrap()));
    read_set(root, entries.iter().map(|e| e.name.as_str()), 1000).unwrap()
}

fn write_all(root: &Path, files: &Files) -> Written {
    Folder::open(root).unwrap().write(files).unwrap()
}

/// A set without tables.
fn narrow_set() -> Files {
    set(&[
        ("fits/a.wgsl", "narrow fit"),
        ("manifest.json", r#"{"tables":[],"includes":[{"file":"fits/a.wgsl"}]}"#),
    ])
}

/// Old or new bytes everywhere; once the manifest is new, everything is.
fn assert_whole(root: &Path, new: &Files, context: &str) {
    let old = old_set();
    let found: Files =
        everything(root).into_iter().filter(|(name, _)| !name.contains(".lobefit-set-")).collect();
    for (name, bytes) in &found {
        assert!(Some(bytes) == old.get(name) || Some(bytes) == new.get(name), "{context}: {name} is torn");
    }
    if found.get(MANIFEST) == new.get(MANIFEST) {
        assert_eq!(&found, new, "{context}: the manifest was written too early");
    }
}

/// Names in a folder, sorted.
fn names(folder: &Path) -> Vec<OsString> {
    LocalDisk.list(folder).unwrap()
}

/// Nothing but the set: no temporary file, no folder that it does not use.
fn assert_only(root: &Path, files: &Files, context: &str) {
    assert_eq!(&everything(root), files, "{context}");
    let mut tops: Vec<&str> = files.keys().filter_map(|name| name.split('/').next()).collect();
    tops.sort();
    tops.dedup();
    assert_eq!(names(root), tops, "{context}");
}

#[test]
fn a_fault_at_any_operation_leaves_old_or_new_and_the_next_run_is_clean() {
    use io::ErrorKind::{CrossesDevices, Other, PermissionDenied, StorageFull};
    let faults = [Other, StorageFull, PermissionDenied, CrossesDevices].map(Fault::Error);
    for fault in faults.into_iter().chain([Fault::Kill]) {
        faults_at_every_operation(fault, &new_set());
    }
    for fault in [Fault::Error(StorageFull), Fault::Kill] {
        faults_at_every_operation(fault, &narrow_set());
    }
}

fn faults_at_every_operation(fault: Fault, new: &Files) {
    for k in 1..500 {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        write_all(root, &old_set());
        let count = Countdown::new(k, fault);
        let result =
            Folder::open_on(FaultyDisk(Rc::clone(&count)), root, Layout::Bake).and_then(|mut f| f.write(new));
        let context = format!("{fault:?} at operation {k}");
        assert_whole(root, new, &context);
        if let Err(error) = &result {
            assert!(error.is_write(), "{context}");
            assert!(error.to_string().contains(root.to_str().unwrap()), "{context}: {error}");
            if count.renamed.get() == 0 && fault != Fault::Kill {
                assert_only(root, &old_set(), &context);
            } else if count.renamed.get() == 0 {
                let mut found = everything(root);
                found.retain(|name, _| !name.contains(".lobefit-set-"));
                assert_eq!(found, old_set(), "{context}");
            }
        }
        write_all(root, new);
        assert_only(root, new, &context);
        if result.is_ok() {
            return;
        }
    }
    panic!("{fault:?}: never ran through");
}

#[test]
fn a_set_that_fails_leaves_no_new_folder() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("a/b");
    for k in 1..500 {
        let count = Countdown::new(k, Fault::Error(io::ErrorKind::StorageFull));
        let result = Folder::open_on(FaultyDisk(Rc::clone(&count)), &root, Layout::Bake)
            .and_then(|mut f| f.write(&new_set()));
        if result.is_ok() {
            return assert_only(&root, &new_set(), "written");
        }
        if count.renamed.get() > 0 {
            std::fs::remove_dir_all(folder.path().join("a")).unwrap();
        }
        assert!(names(folder.path()).is_empty(), "operation {k}");
    }
    panic!("never ran through");
}

#[test]
fn folders_left_empty_are_removed_and_others_stay() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    write_all(root, &old_set());
    std::fs::create_dir(root.join("reports")).unwrap();
    let done = write_all(root, &narrow_set());
    assert_eq!(done.removed, ["tables/gone.exr", "tables/t.exr"]);
    assert_eq!(names(root), ["fits", "manifest.json", "reports"], "reports was not ours to remove");
    write_all(root, &old_set());
    std::fs::write(root.join("tables/mine.txt"), "mine").unwrap();
    write_all(root, &narrow_set());
    assert_eq!(names(&root.join("tables")), ["mine.txt"]);
}

#[test]
fn short_and_interrupted_writes_are_carried_on() {
    let folder = tempfile::tempdir().unwrap();
    let disk = FaultyDisk(Countdown::new(1000, Fault::Interrupted));
    Folder::open_on(disk, folder.path(), Layout::Bake).unwrap().write(&new_set()).unwrap();
    assert_eq!(everything(folder.path()), new_set());
}

#[test]
fn writing_says_what_it_did() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("a/b");
    assert_eq!(write_all(&root, &old_set()).written.len(), 4);
    std::fs::write(root.join("tables/mine.txt"), "mine").unwrap();
    let done = write_all(&root, &new_set());
    assert_eq!(done.removed, ["tables/gone.exr"]);
    assert_eq!(std::fs::read_to_string(root.join("tables/mine.txt")).unwrap(), "mine");
    let again = write_all(&root, &new_set());
    assert_eq!((again.written.len(), again.unchanged.len()), (0, 4));
}

#[test]
fn an_old_manifest_removes_nothing_outside_its_folders() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("out");
    std::fs::create_dir_all(root.join("tables/sub")).unwrap();
    let victim = folder.path().join("victim");
    std::fs::write(&victim, "v").unwrap();
    std::fs::write(root.join("own.txt"), "v").unwrap();
    let absolute = victim.to_str().unwrap();
    let manifest = serde_json::json!({ "tables": [
        { "file": "../victim" }, { "file": "tables/../../victim" }, { "file": absolute }, { "file": "own.txt" },
        { "file": "tables\\..\\own.txt" }, { "file": "tables" }, { "file": "tables/sub" }, { "file": "" },
        { "file": "tables//x" }, { "file": "fits/hypotheses" }, { "file": 3 }
    ]});
    std::fs::write(root.join(MANIFEST), manifest.to_string()).unwrap();
    let done = write_all(&root, &new_set());
    assert!(done.removed.is_empty(), "{done:?}");
    assert!(victim.exists() && root.join("own.txt").exists() && root.join("tables/sub").exists());
}

#[cfg(unix)]
#[test]
fn links_lead_nowhere() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let (root, outside) = (folder.path().join("out"), folder.path().join("outside"));
    std::fs::create_dir_all(root.join("reports")).unwrap();
    std::fs::create_dir_all(&outside).unwrap();
    std::fs::write(outside.join("x"), "x").unwrap();
    // A file that is a link is replaced by a file, not written through.
    symlink(outside.join("x"), root.join("reports/index.html")).unwrap();
    // A stale entry behind a linked folder is left alone.
    symlink(&outside, root.join("reports/link")).unwrap();
    std::fs::write(root.join(MANIFEST), r#"{"tables":[{"file":"reports/link/x"}]}"#).unwrap();
    let done = write_all(&root, &new_set());
    assert_eq!(done.ignored, ["reports/link/x"]);
    assert_eq!(std::fs::read_to_string(outside.join("x")).unwrap(), "x");
    assert_eq!(std::fs::read_to_string(root.join("reports/index.html")).unwrap(), "new page");
    // A folder that is a link is refused.
    let linked = folder.path().join("linked");
    std::fs::create_dir(&linked).unwrap();
    symlink(&outside, linked.join("tables")).unwrap();
    let error = Folder::open(&linked).unwrap_err();
    assert!(matches!(error, StoreError::InTheWay { .. }), "{error}");
    // The output folder itself may be one.
    symlink(&root, folder.path().join("alias")).unwrap();
    write_all(&folder.path().join("alias"), &new_set());
}

#[test]
fn names_that_leave_the_folder_are_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for name in
        ["../x", "/x", "tables/../x", "x", "tables", "tables/", "other/x", "tables/a\0b", "C:/x", "tables\\x"]
    {
        let files = set(&[(name, "x"), ("fits/a", "x")]);
        let error = Folder::open(folder.path()).unwrap().write(&files).unwrap_err();
        assert!(matches!(error, StoreError::Outside { .. }) && error.is_write(), "{name}: {error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{name}");
    }
}

#[test]
fn opening_leaves_nothing_and_two_writers_exclude_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("new");
    let first = Folder::open(&root).unwrap();
    assert!(!root.exists());
    drop(first);
    std::fs::create_dir(&root).unwrap();
    let first = Folder::open(&root).unwrap();
    assert!(matches!(Folder::open(&root).unwrap_err(), StoreError::Busy { .. }));
    drop(first);
    Folder::open(&root).unwrap();
    assert_eq!(std::fs::read_dir(&root).unwrap().count(), 0);
}

#[test]
fn what_is_in_the_way_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "x").unwrap();
    for root in [file.clone(), file.join("below")] {
        let error = Folder::open(&root).unwrap_err();
        assert!(error.is_write() && error.to_string().contains("file"), "{error}");
    }
    let root = folder.path().join("out");
    std::fs::create_dir_all(root.join("manifest.json")).unwrap();
    let error = Folder::open(&root).unwrap_err();
    assert!(error.to_string().contains("manifest.json: a folder is in the way"), "{error}");
    std::fs::remove_dir(root.join("manifest.json")).unwrap();
    for foreign in ["", "[]", "{}", r#"{"name":"web app","icons":[]}"#, "{\"tables\":"] {
        std::fs::write(root.join(MANIFEST), foreign).unwrap();
        let error = Folder::open(&root).unwrap_err();
        assert!(matches!(error, StoreError::ForeignManifest { .. }), "{foreign}: {error}");
    }
}

#[test]
fn reads_are_bounded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x");
    std::fs::write(&path, "12345").unwrap();
    assert_eq!(read(&path, 5).unwrap(), b"12345");
    assert!(matches!(read(&path, 4).unwrap_err(), StoreError::TooLarge { limit: 4, .. }));
    assert!(matches!(read_stream(io::repeat(0), "stdin", 1000).unwrap_err(), StoreError::TooLarge { .. }));
    assert_eq!(read_stream(&b"abc"[..], "stdin", 3).unwrap(), b"abc");
    assert!(!read(&folder.path().join("none"), 4).unwrap_err().is_write());
    for name in ["../x", "tables/a:b"] {
        assert!(!read_set(folder.path(), [name], 4).unwrap_err().is_write(), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn written_files_are_readable_by_all() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x");
    assert!(write(&path, b"one").unwrap());
    assert!(!write(&path, b"one").unwrap());
    assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o444, 0o444);
}
