//! The whole of what is measured: the same on any number of threads, and of the order that it must
//! have.

use std::path::Path;

use crate::mesh::courtyard;
use lobefit::report::numbers::brief;
use lobefit::scene::{CameraPath, Culling, Generator, Scene};
use lobefit_occlusion::choice::ALLOWED;
use lobefit_occlusion::cull::{Footprint, Verdict, test};
use lobefit_occlusion::film::{Film, Shot};
use lobefit_occlusion::grid::Grid;
use lobefit_occlusion::measure::{Span, measured};
use lobefit_occlusion::passes::{Late, Passes};
use lobefit_occlusion::site::Site;
use lobefit_occlusion::study::{CHOSEN, results};
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
    let best = &one.choices.best;
    assert!(row(CHOSEN).work.total() > 0 && best.chosen.most_culled <= ALLOWED[0]);
    assert!(one.sweep.iter().filter(|point| point.speed == 1.0).count() == 16);
}

/// The least margin culls no more than is allowed, the next smaller number does; boxes tested one by
/// one against the buffer say the same.
#[test]
fn the_least_margin_is_exact() {
    let (site, size, latency) = (Site::generated(Generator::Town, 1), [64, 36], 5);
    let shot = Shot { path: CameraPath::Strafe, start: 0, speed: 1.0 };
    let film = Film::new(&site, (shot, 30), size, &[], &[]);
    let (frames, voxels) = ([17, 29], [32, 32, 16]);
    let passes = Passes { median: 1, dilation: 2, ..Passes::POINTS };
    let eroded = Passes { erosion: 1, ..passes };
    let found = measured(&film, &Span { latency, frames: &frames, voxels }, &[passes, eroded]);
    let grid = Grid::new(voxels, &site.bounds);
    for (found, passes) in found.iter().zip([passes, eroded]) {
        for part in [0.0, 0.005, 0.02] {
            let bias = found.least_bias(part);
            let tally = found.at(bias);
            assert!(tally.wrongly_culled() <= part, "{} for {part}", tally.wrongly_culled());
            assert!(bias == 0.0 || found.at(bias.next_down()).wrongly_culled() > part, "{bias} for {part}");
            let mut counts = [0; 4];
            for frame in frames {
                let (camera, late) = (&film.cameras[frame], frame - latency);
                let late = Late { camera: &film.cameras[late], depth: &film.depth[late], grid: &grid };
                let buffer = passes.run(late, camera, size).0;
                for cuboid in &site.objects {
                    let culled = |depth, bias| test(depth, camera, cuboid, bias) == Verdict::Culled;
                    let hidden = culled(&film.depth[frame], 0.0);
                    if Footprint::of(camera, cuboid, size).is_ok() {
                        counts[usize::from(hidden)] += 1;
                        counts[2 + usize::from(hidden)] += usize::from(culled(&buffer, bias) != hidden);
                    }
                }
            }
            let all = [tally.seen, tally.hidden, tally.culled, tally.kept].map(|n| n as usize);
            assert_eq!(all, counts, "{part}");
        }
    }
    assert!(found[0].least_bias(0.0) > 0.0, "without a margin something is culled wrongly");
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
