//! The whole of what is measured: the same on any number of threads, and of the order that it must
//! have.

use std::path::Path;

use crate::mesh::courtyard;
use lobefit::report::numbers::brief;
use lobefit::scene::{CameraPath, Culling, Generator, Scene};
use lobefit_occlusion::camera::{Camera, NEAR};
use lobefit_occlusion::choice::{ALLOWED, choices};
use lobefit_occlusion::depth::Depth;
use lobefit_occlusion::film::{Film, Shot};
use lobefit_occlusion::grid::Grid;
use lobefit_occlusion::measure::{Span, measured};
use lobefit_occlusion::passes::{Late, Passes};
use lobefit_occlusion::raster::Cuboid;
use lobefit_occlusion::site::Site;
use lobefit_occlusion::study::{CHOSEN, Results, SAFE};
use lobefit_occlusion::times::{NONE, OTHER, Times};

fn culling(fields: &str) -> Culling {
    let text = format!(r#"{{"schema_version": 1, "materials": [], "culling": {{{fields}}}}}"#);
    Scene::from_json(text.as_bytes(), "scene.json").expect("a scene").culling.expect("culling")
}

fn results(culling: &Culling, site: &Site) -> Results {
    lobefit_occlusion::study::results(culling, site, choices(culling, site))
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
    assert_eq!(row(SAFE).vanished, 0);
    assert!(one.sweep.iter().all(|point| point.conservative.vanished == 0 && point.chosen.seen > 0));
    assert!(row("depth").holes > row("depth, median").holes);
    assert!(row("depth").holes > row("depth and voxels").holes);
    assert!(row("depth").work.total() < row("depth and voxels, median, dilation").work.total());
    let best = &one.choices.best;
    assert_eq!(one.choices.tried, 216);
    assert!(row(CHOSEN).work.total() > 0 && best.chosen.most_culled <= ALLOWED[0]);
    assert_eq!(
        one.sweep.iter().filter(|point| point.speed == 1.0).count(),
        16,
        "latencies 1 to 8, two paths"
    );
}

/// What a box is by a depth that is taken for farther by a part: hidden where all texels of its rectangle
/// are nearer than it; on the edge by how near the nearest decision was. None of a box without a rectangle.
fn hidden(depth: &Depth, camera: &Camera, cuboid: &Cuboid, bias: f64) -> Option<(bool, bool)> {
    let corners: Vec<[f32; 3]> = (0..8).map(|i| camera.view(cuboid.corner(i))).collect();
    if corners.iter().any(|corner| corner[2] < NEAR) {
        return None;
    }
    let nearest = corners.iter().map(|corner| f64::from(corner[2])).fold(f64::INFINITY, f64::min);
    let pixels =
        corners.iter().map(|corner| camera.pixel(*corner, depth.size).expect("before the near plane"));
    let pixels: Vec<[f32; 2]> = pixels.collect();
    let ends = |k: usize| {
        let all = pixels.iter().map(|pixel| pixel[k]);
        [all.clone().fold(f32::INFINITY, f32::min), all.fold(f32::NEG_INFINITY, f32::max)]
    };
    let [columns, rows] = [ends(0), ends(1)];
    if columns[1] < 0.0
        || rows[1] < 0.0
        || columns[0] >= depth.size[0] as f32
        || rows[0] >= depth.size[1] as f32
    {
        return None;
    }
    // A texel is in it that shares a point with it.
    let within = |i: usize, [low, high]: [f32; 2]| low < i as f32 + 1.0 && high >= i as f32;
    let (mut all, mut close) = (true, false);
    for (i, &z) in depth.texels.iter().enumerate() {
        let (x, y) = (i % depth.size[0], i / depth.size[0]);
        if within(x, columns) && within(y, rows) {
            let away = nearest - f64::from(z) * (1.0 + bias);
            all &= z >= 0.0 && z.is_finite() && away > 0.0;
            close |= away.abs() < 3e-7 * nearest;
        }
    }
    Some((all, close))
}

/// The least margin culls no more than is allowed, the next smaller number does; boxes held against each
/// texel of the buffer say the same, but for those on the edge.
#[test]
fn the_least_margin_is_exact() {
    let (site, size, latency) = (Site::generated(Generator::Town, 1), [64, 36], 5);
    let shot = Shot { path: CameraPath::Strafe, start: 0, speed: 1.0 };
    let film = Film::new(&site, (shot, 30), size, &[], &[]);
    let (frames, voxels) = ([17, 29], [32, 32, 16]);
    let passes = Passes { median: 1, dilation: 2, ..Passes::POINTS };
    // The first and the last share what comes before the erosion.
    let all = [passes, Passes { median: 0, ..passes }, Passes { erosion: 1, ..passes }];
    let found = measured(&film, &Span { latency, frames: &frames, voxels }, &all);
    let grid = Grid::new(voxels, &site.bounds);
    for (found, passes) in found.iter().zip(all) {
        for part in [0.0, 0.005, 0.02] {
            let bias = found.least_bias(part);
            let tally = found.at(bias);
            assert!(tally.wrongly_culled() <= part, "{} for {part}", tally.wrongly_culled());
            assert!(bias == 0.0 || found.at(bias.next_down()).wrongly_culled() > part, "{bias} for {part}");
            let (mut counts, mut edges) = ([0; 4], 0);
            for frame in frames {
                let (camera, late) = (&film.cameras[frame], frame - latency);
                let late = Late { camera: &film.cameras[late], depth: &film.depth[late], grid: &grid };
                let buffer = passes.run(late, camera, size).0;
                for cuboid in &site.objects {
                    let of = |depth, bias| hidden(depth, camera, cuboid, f64::from(bias));
                    let (Some(truth), Some(found)) = (of(&film.depth[frame], 0.0), of(&buffer, bias)) else {
                        continue;
                    };
                    counts[usize::from(truth.0)] += 1;
                    counts[2 + usize::from(truth.0)] += i64::from(found.0 != truth.0);
                    edges += i64::from(truth.1 || found.1);
                }
            }
            let all = [tally.seen, tally.hidden, tally.culled, tally.kept].map(|n| n as i64);
            let off = (0..4).map(|i| (all[i] - counts[i]).abs()).max().unwrap_or(0);
            println!("{part}: {all:?}, texel by texel {counts:?}, on the edge {edges}");
            assert!(off <= edges && edges <= 3, "{part}: {all:?}, {counts:?}, on the edge {edges}");
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
    assert!(results.rows.iter().all(|row| row.name != SAFE || row.tally.vanished == 0));
    let what = ["command", "device"].map(String::from);
    let times = Times::measured((&culling, &site), &results.choices.best.trial, what);
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
