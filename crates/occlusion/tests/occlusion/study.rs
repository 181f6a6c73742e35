//! The whole of what is measured: the same on any number of threads, and of the order that it must
//! have.

use std::path::Path;

use crate::mesh::courtyard;
use lobefit::report::numbers::brief;
use lobefit::scene::{Culling, Generator, Scene};
use lobefit_occlusion::site::Site;
use lobefit_occlusion::study::results;
use lobefit_occlusion::times::{NONE, OTHER, Times};

fn culling(fields: &str) -> Culling {
    let text = format!(r#"{{"schema_version": 1, "materials": [], "culling": {{{fields}}}}}"#);
    Scene::from_json(text.as_bytes(), "scene.json").expect("a scene").culling.expect("culling")
}

#[test]
fn results_do_not_depend_on_threads() {
    let culling = culling(
        r#""world": "forest", "path": "walk", "buffer": [32, 18], "latency": 3, "grid": [32, 32, 16]"#,
    );
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| results(&culling, &Site::generated(Generator::Forest, 1)))
    };
    let (one, three) = (on(1), on(3));
    let text = |results| serde_json::to_string(results).expect("JSON");
    assert_eq!(text(&one), text(&three));
    assert_eq!(one.pictures.buffers, three.pictures.buffers);
    let row = |name: &str| one.rows.iter().find(|row| row.name == name).expect("a row").tally;
    assert_eq!(row("conservative").vanished, 0);
    assert!(row("depth").holes > row("depth, median").holes);
    assert!(row("depth").holes > row("depth and voxels").holes);
    assert!(row("depth").work.total() < row("depth and voxels, median, dilation").work.total());
    assert!(one.sweep.iter().filter(|point| point.speed == 1.0).count() == 16);
}

/// A scene whose world is a mesh: its conservative mode makes nothing vanish, and what was timed is of
/// the rows that did the same work.
#[test]
fn a_mesh_is_studied_and_its_passes_are_timed() {
    let culling = culling(r#""world": "courtyard.glb", "buffer": [16, 16], "grid": [16, 16, 8]"#);
    let site = courtyard();
    let results = results(&culling, &site);
    let tally = |name: &str| results.rows.iter().find(|row| row.name == name).expect("a row").tally;
    assert!(tally("depth").seen > 500 && tally("depth").hidden > 100, "{:?}", tally("depth"));
    assert!(results.rows.iter().all(|row| row.name != "conservative" || row.tally.vanished == 0));
    let times = Times::measured(&culling, &site, "command".into(), "device".into());
    let timed = Times::of(Some(&times), &results.rows).expect("times of these rows");
    assert!(timed.iter().all(|row| row.milliseconds.total() > 0.0));
    let alone = &timed[0].milliseconds;
    assert!(alone.reproject > 0.0 && alone.median + alone.accumulate + alone.voxels + alone.dilation == 0.0);
    assert_eq!(Times::of(None, &results.rows), Err(NONE));
    let mut other = times.clone();
    other.rows[3].work += 1;
    assert_eq!(Times::of(Some(&other), &results.rows), Err(OTHER));
    other.rows.clear();
    assert_eq!(Times::of(Some(&other), &results.rows), Err(OTHER));
}

/// The committed record is of the committed results, and the committed page shows it.
#[test]
fn the_committed_page_shows_the_committed_times() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reports/studies/occlusion");
    let read = |file: &str| std::fs::read_to_string(folder.join(file)).expect(file);
    let times: Times = serde_json::from_str(&read("times.json")).expect("a record");
    let results: serde_json::Value = serde_json::from_str(&read("results.json")).expect("JSON");
    let rows = results["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), times.rows.len());
    for (row, timed) in rows.iter().zip(&times.rows) {
        let work = row["tally"]["work"].as_object().expect("work").values();
        assert_eq!(work.map(|n| n.as_u64().expect("a count")).sum::<u64>(), timed.work, "{}", timed.name);
    }
    let (page, first) = (read("index.html"), &times.rows[0].milliseconds);
    for shown in [times.device.clone(), brief(first.total(), 3)] {
        assert!(page.contains(&shown), "{shown}");
    }
}
