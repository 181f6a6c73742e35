//! Same scene, same bytes, whatever the number of threads.

use lobefit::bake::{Selection, Silent, bake};
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit::store::Files;

fn files(threads: usize) -> Files {
    let scene = Scene::built_in().expect("the built-in scene");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| bake(&scene, &plan(&scene), &[], Selection::default(), &Silent)).expect("a bake").files
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let one = files(1);
    for threads in [2, 3, 7] {
        let other = files(threads);
        assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
        for (name, bytes) in &one {
            assert!(bytes == &other[name], "{name} differs between 1 and {threads} threads");
        }
    }
}

/// No date, host, user or path of the machine in anything that is written.
#[test]
fn nothing_of_the_machine_is_written() {
    let here = env!("CARGO_MANIFEST_DIR");
    let files = files(2);
    let user = std::env::var("HOME").unwrap_or_default();
    for (name, bytes) in &files {
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains(here), "{name} holds the folder of the build");
        assert!(user.len() < 4 || !text.contains(&format!("{user}/")), "{name} holds the home folder");
    }
}
