//! The whole of what is measured: the same on any number of threads, and of the order that it must
//! have.

use lobefit::scene::{Culling, Scene};
use lobefit_occlusion::film::{Film, Shot};
use lobefit_occlusion::grid::Grid;
use lobefit_occlusion::passes::{Late, Passes, Work};
use lobefit_occlusion::study::{passes, results};
use lobefit_occlusion::world::world;

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
        pool.install(|| results(&culling))
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

/// Prints the least milliseconds of each pass over frames at the example's sizes: nothing is
/// asserted of a clock.
#[test]
#[ignore = "a measurement"]
fn times_of_passes() {
    let culling = culling("");
    let (boxes, size) = (world(culling.world, culling.seed), culling.buffer.map(|n| n as usize));
    let frames: Vec<usize> = (20..60).collect();
    let film =
        Film::new(&boxes, (Shot { path: culling.path, start: 4, speed: 1.0 }, 60), size, &[2, 4], &frames);
    let mut grid = Grid::new(culling.grid);
    let accumulated = (0..54).map(|frame| {
        let start = std::time::Instant::now();
        film.accumulated(&mut grid, frame..frame + 1);
        1e3 * start.elapsed().as_secs_f64()
    });
    println!("accumulation: {:.2} ms", accumulated.fold(f64::INFINITY, f64::min));
    let all = passes(&culling);
    let conservative = Passes { conservative: true, ..all };
    for (name, passes) in
        [("all", all), ("half", Passes { half: Some(true), ..all }), ("conservative", conservative)]
    {
        let mut least = [f64::INFINITY; 4];
        for frame in 25..60 {
            let old = frame - 5;
            let depth = film.fine(passes.fineness(), old);
            let late = Late { camera: &film.cameras[old], depth: &depth, grid: &grid };
            let Work { reproject, median, voxels, dilation } = passes.run(late, &film.cameras[frame], size).2;
            let taken = [reproject, median, voxels, dilation];
            least.iter_mut().zip(taken).for_each(|(least, taken)| *least = least.min(1e3 * taken));
        }
        let [a, b, c, d] = least;
        println!("{name}: points {a:.2}, medians {b:.2}, voxels {c:.2}, dilation {d:.2} ms");
    }
}
