//! Same scene, same bytes, whatever the number of threads. What is baked here has every effect and
//! every kind of job in little; the built-in scene is baked again, and compared with the committed
//! files, in tests/emitted/committed.rs. Every material has a budget: one without wants every
//! formula of the catalogue, and 11 operations have a form of each kind: sums, sums of a reciprocal
//! with a parameter of its own, and quotients of sums.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::OnceLock;

use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::plan::plan;
use lobefit::scene::{Scene, SceneError};
use lobefit::store::{Cache, Files};
use lobefit_truth::optics::kernel::Kernel;

const SCENE: &str = include_str!("all_in_little.json");

/// A fit and tables of two and of three axes, in a bake of half a second.
const LITTLE: &str = r#"{"schema_version":1,"reports":false,"formats":["exr","raw"],"materials":[
{"name":"plain","kind":"dielectric","f0":0.5,"roughness":[0.9,1],"base":{"roughness":[0.2,0.3],"max_ops":7},"wants":{"tables":[{"size":[16,8]}]}},
{"name":"brushed","kind":"metal","f0":1,"anisotropy":[0.4,0.6],"roughness":[0.5,0.6],"wants":{"tables":[{"size":[8,6,4]}]}}]}"#;

fn baked(threads: usize, cache: Option<&Cache>) -> Baked {
    baked_of(SCENE, threads, cache)
}

fn baked_of(scene: &str, threads: usize, cache: Option<&Cache>) -> Baked {
    let scene = Scene::from_json(scene.as_bytes(), "scene.json").expect("a scene");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    let selection = Selection { cache, ..Selection::default() };
    pool.install(|| bake(&scene, &plan(&scene), &[], selection, &Silent)).expect("a bake")
}

/// The bake of one thread.
fn one() -> &'static Files {
    static ONE: OnceLock<Files> = OnceLock::new();
    ONE.get_or_init(|| baked(1, None).files)
}

/// Every effect that the built-in scene or an example calls for.
fn called_for() -> BTreeSet<String> {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").read_dir().expect("examples");
    let paths = examples.map(|entry| entry.expect("an entry").path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|e| e == "json")).map(|path| {
        let bytes = std::fs::read(&path).expect("a file");
        let kernel = |_: &str, _| Ok::<_, SceneError>(Kernel::default());
        Scene::with_kernels(&bytes, &path.display().to_string(), kernel).expect("a scene")
    });
    let scenes = scenes.chain([Scene::built_in().expect("a scene")]);
    let effects = scenes.flat_map(|scene| plan(&scene).effects);
    effects.map(|effect| effect.effect.to_string()).collect()
}

#[test]
fn any_number_of_threads_gives_the_same_bytes_with_a_cache_and_without() {
    let one = one();
    for effect in called_for() {
        assert!(one.contains_key(&format!("reports/{effect}.html")), "{effect} is not baked");
    }
    // More threads than most machines of CI have cores; what a bake takes that was not told a number
    // is compared with the committed files by `lobefit check`.
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::at(folder.path().into());
    let [cold, warm] = [7, 3].map(|threads| baked(threads, Some(&cache)));
    for (other, how) in [(&cold, "and 7 threads"), (&warm, "and 3 threads, of which most comes from a cache")]
    {
        assert_eq!(one.keys().collect::<Vec<_>>(), other.files.keys().collect::<Vec<_>>());
        for (name, bytes) in one {
            assert!(bytes == &other.files[name], "{name} differs between 1 {how}");
        }
    }
    assert!(cache.failed().is_none(), "{:?}", cache.failed());
    assert!(2 * warm.truths < cold.truths, "{} {}: fits and tables are known", warm.truths, cold.truths);
}

#[test]
fn five_numbers_of_threads_give_the_same_bytes() {
    let [one, others @ ..] = [1, 2, 3, 7, 16].map(|threads| baked_of(LITTLE, threads, None).files);
    assert!(one.len() > 10, "{:?}", one.keys());
    for (other, threads) in others.iter().zip([2, 3, 7, 16]) {
        assert!(*other == one, "{threads} threads");
    }
}

/// Of every effect, without a cache.
#[test]
#[ignore = "a minute for each number: .ci/nightly"]
fn nightly_every_effect_has_the_same_bytes_on_2_3_and_16_threads() {
    for threads in [2, 3, 16] {
        assert!(baked(threads, None).files == *one(), "{threads} threads");
    }
}

/// The committed files of a folder: those of the built-in scene's bake.
fn committed(folder: &str) -> Vec<(String, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries =
        std::fs::read_dir(root).expect("committed files").map(|entry| entry.expect("an entry").path());
    let files = entries.filter(|path| path.is_file());
    files.map(|path| (path.display().to_string(), std::fs::read(&path).expect("a file"))).collect()
}

/// No date, host, user or path of the machine in anything that is written.
#[test]
fn nothing_of_the_machine_is_written() {
    let here = env!("CARGO_MANIFEST_DIR");
    let user = std::env::var("HOME").unwrap_or_default();
    let mut all: Vec<(String, Vec<u8>)> =
        ["tables", "fits", "reports"].into_iter().flat_map(committed).collect();
    let manifest = Path::new(here).join("manifest.json");
    all.push(("manifest.json".into(), std::fs::read(manifest).expect("a file")));
    assert!(all.len() > 10);
    all.extend(one().iter().map(|(name, bytes)| (name.clone(), bytes.clone())));
    for (name, bytes) in &all {
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains(here), "{name} holds the folder of the build");
        assert!(user.len() < 4 || !text.contains(&format!("{user}/")), "{name} holds the home folder");
    }
}
