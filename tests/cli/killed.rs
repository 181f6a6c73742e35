//! Bakes that are killed or broken off at any moment: every file is its old bytes or its new ones, and the
//! next bake is whole and leaves nothing else.

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::time::{Duration, Instant};

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::common::{bytes, first_stage, lobefit_with, signal, start, stderr};

/// Kills where `LOBEFIT_KILLS` names no other number.
const KILLS: u64 = 200;

/// Bakes that run at once, each with a folder of its own.
const LANES: u64 = 2;

/// Two scenes of which each writes files that the other does not have, and other bytes to those that both
/// have.
const SCENES: [&str; 2] = [
    r#"{"schema_version":1,"name":"a","reports":false,"languages":["c","rust","wgsl"],"formats":["exr","dds","ktx2"],"materials":[
        {"name":"m","kind":"metal","f0":1,"roughness":[0.9,1],"wants":{"tables":[{"size":[16,16]}]}}]}"#,
    r#"{"schema_version":1,"name":"b","reports":false,"languages":["c","wgsl","hlsl"],"formats":["exr","dds","raw"],"materials":[
        {"name":"m","kind":"metal","f0":1,"roughness":[0.8,1],"wants":{"tables":[{"size":[16,16]}]}}]}"#,
];

type Contents = BTreeMap<String, Vec<u8>>;

/// What a killed bake leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Left {
    /// The old files alone.
    Old,
    /// The old files, with temporary ones beside them.
    Staged,
    /// Some files old, some new.
    Mixed,
    /// The new files alone.
    New,
}

/// A folder into which both scenes are baked in turns.
struct Lane {
    folder: tempfile::TempDir,
    cache: PathBuf,
    whole: [Contents; 2],
    /// How long a bake takes, and how long it writes.
    whole_time: Duration,
    writing: Duration,
}

fn of_folder(folder: &Path) -> Contents {
    if folder.exists() { bytes(folder).into_iter().collect() } else { Contents::new() }
}

fn is_temporary(name: &str) -> bool {
    name.rsplit('/').next().is_some_and(|name| name.starts_with(".lobefit-set-"))
}

impl Lane {
    /// With the results of both scenes in a cache: what is left of a bake is mostly its writing.
    fn new(cache: &Path) -> Lane {
        let folder = tempfile::tempdir().expect("a folder");
        for (k, scene) in SCENES.iter().enumerate() {
            std::fs::write(folder.path().join(format!("{k}.json")), scene).expect("written");
        }
        let mut lane = Lane {
            folder,
            cache: cache.to_owned(),
            whole: Default::default(),
            whole_time: Duration::ZERO,
            writing: Duration::ZERO,
        };
        for k in [0, 1, 0, 1] {
            let begin = Instant::now();
            let mut child = lane.start(k);
            lane.until_writing(&mut child);
            let written = Instant::now();
            assert!(child.wait().expect("a child").success());
            (lane.whole_time, lane.writing) = (begin.elapsed(), written.elapsed());
            lane.whole[k] = of_folder(&lane.out());
        }
        let [a, b] = &lane.whole;
        let shared: Vec<&String> = a.keys().filter(|name| b.contains_key(*name)).collect();
        assert!(shared.len() > 5 && shared.len() < a.len().min(b.len()), "{shared:?}");
        assert!(shared.iter().all(|name| a[*name] != b[*name]), "every file is another");
        lane
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    fn start(&self, scene: usize) -> Child {
        let scene = format!("{scene}.json");
        let words = ["bake", &scene, "--out", "out", "--quiet", "--threads", "1"];
        start(&self.cache, self.folder.path(), &words)
    }

    /// Whether a temporary file holds something: those that try whether a folder can be written are empty.
    fn is_writing(&self) -> bool {
        ["", "fits", "tables"].iter().any(|below| {
            let entries = std::fs::read_dir(self.out().join(below)).into_iter().flatten().flatten();
            let mut temporary = entries.filter(|e| is_temporary(&e.file_name().to_string_lossy()));
            temporary.any(|e| e.metadata().is_ok_and(|data| data.len() > 0))
        })
    }

    /// Waits for a bake to write, or to end.
    fn until_writing(&self, child: &mut Child) {
        while !self.is_writing() && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(Duration::from_micros(200));
        }
    }

    /// Kills a bake: of four, two at any moment of the run and two while it writes. Every fifth kill is what
    /// Ctrl-C sends.
    fn kill(&self, number: u64, turn: usize) -> Left {
        let scene = turn % 2;
        let part = (Pcg64::seed_from_u64(number).next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut child = self.start(scene);
        let span = if turn % 4 < 2 {
            self.whole_time
        } else {
            self.until_writing(&mut child);
            self.writing
        };
        std::thread::sleep(span.mul_f64(1.05 * part));
        if turn % 5 == 4 {
            interrupt(&mut child)
        } else {
            child.kill().expect("killed")
        }
        child.wait().expect("a child");
        self.left(&format!("kill {number}, {part} of {span:?}"), scene)
    }

    /// What is there after a kill: no file is torn, none that both bakes have is gone, and a new manifest
    /// stands among new files alone.
    fn left(&self, context: &str, scene: usize) -> Left {
        let (old, new) = (&self.whole[1 - scene], &self.whole[scene]);
        let mut found = of_folder(&self.out());
        let all = found.len();
        found.retain(|name, _| !is_temporary(name));
        for (name, bytes) in &found {
            let whole = [old, new].iter().any(|set| set.get(name) == Some(bytes));
            assert!(whole, "{context}: {name} is neither old nor new");
        }
        let kept = old.keys().filter(|name| new.contains_key(*name)).all(|name| found.contains_key(name));
        assert!(kept, "{context}: a file is gone");
        if found.get("manifest.json") == new.get("manifest.json") {
            assert!(&found == new && all == new.len(), "{context}: the manifest was written too early");
        }
        match () {
            () if &found == new => Left::New,
            () if &found != old => Left::Mixed,
            () if all > old.len() => Left::Staged,
            () => Left::Old,
        }
    }

    /// Bakes a scene to its end: its files are there, and nothing else is.
    fn complete(&self, number: u64, scene: usize) {
        let output = self.start(scene).wait_with_output().expect("a child");
        assert!(output.status.success(), "after kill {number}: {}", stderr(&output));
        assert!(of_folder(&self.out()) == self.whole[scene], "after kill {number}: other files");
    }
}

/// Sends what Ctrl-C sends, to a bake that has not ended.
fn interrupt(child: &mut Child) {
    if child.try_wait().expect("a child").is_none() {
        signal(child, "INT");
    }
}

#[test]
fn a_bake_that_is_killed_tears_nothing_and_the_next_one_is_whole() {
    let kills = std::env::var("LOBEFIT_KILLS").map_or(KILLS, |text| text.parse().expect("a number of kills"));
    let caches = tempfile::tempdir().expect("a folder");
    let counts = std::thread::scope(|scope| {
        let lanes: Vec<_> = (0..LANES)
            .map(|first| {
                let cache = caches.path().join(first.to_string());
                scope.spawn(move || {
                    let lane = Lane::new(&cache);
                    let mut counts = BTreeMap::new();
                    for (turn, number) in (first..kills).step_by(LANES as usize).enumerate() {
                        let left = lane.kill(number, turn);
                        *counts.entry(left).or_insert(0) += 1;
                        lane.complete(number, turn % 2);
                    }
                    counts
                })
            })
            .collect();
        let mut counts: BTreeMap<Left, u64> = BTreeMap::new();
        for lane in lanes {
            lane.join()
                .expect("a lane")
                .into_iter()
                .for_each(|(left, n)| *counts.entry(left).or_insert(0) += n);
        }
        counts
    });
    println!("{kills} kills left {counts:?}");
    assert_eq!(counts.values().sum::<u64>(), kills);
    let writing = [Left::Staged, Left::Mixed].iter().filter_map(|left| counts.get(left)).sum::<u64>();
    assert!(writing > 0, "no kill hit the writing: {counts:?}");
}

/// Ctrl-C while the work is done, before anything is written.
#[test]
fn a_bake_that_is_broken_off_leaves_what_was_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let (at, cache) = (folder.path(), folder.path().join("cache"));
    std::fs::write(at.join("scene.json"), SCENES[0]).expect("written");
    assert!(lobefit_with(&cache, at, &["bake", "-", "--out", "out"], SCENES[1].as_bytes()).status.success());
    let before = of_folder(&at.join("out"));
    let mut child = start(&cache, at, &["bake", "scene.json", "--out", "out", "--no-cache"]);
    first_stage(&mut child);
    interrupt(&mut child);
    let status = child.wait().expect("a child");
    assert!(status.signal() == Some(2) || status.code() == Some(130), "{status}");
    assert!(of_folder(&at.join("out")) == before);
}
