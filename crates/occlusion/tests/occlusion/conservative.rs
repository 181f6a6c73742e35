//! In the conservative mode no box is culled of which a pixel of the frame would be seen, as long
//! as nothing moves but the camera.

use lobefit::scene::Generator;
use lobefit_occlusion::camera::Camera;
use lobefit_occlusion::cull::{Verdict, test};
use lobefit_occlusion::grid::Grid;
use lobefit_occlusion::passes::{Late, Passes};
use lobefit_occlusion::raster::{Cuboid, Solids, is_seen, rendered};
use lobefit_occlusion::world::{BOUNDS, Random, world};
use rayon::prelude::*;

use crate::mesh::courtyard;

const SIZE: [usize; 2] = [80, 48];
const PASSES: Passes = Passes { half: None, ..Passes::CONSERVATIVE };

/// Cases of a pair of cameras: of seen boxes culled, of hidden ones culled, and all that are in the
/// frame.
fn cases(seed: u64, boxes: usize) -> [usize; 3] {
    let mut random = Random::new(seed);
    let kind = if seed.is_multiple_of(3) { Generator::Forest } else { Generator::Town };
    let solids = Solids::of(&world(kind, (seed / 40) as u32));
    let street = 32.0 * (1.0 + random.within(0.0, 3.0).floor());
    let along = random.within(8.0, 120.0);
    let lane = street + random.within(-3.0, 3.0);
    let eye = if seed.is_multiple_of(2) { [lane, along, 1.7] } else { [along, lane, 1.7] };
    of_pair((seed, random), &solids, (eye, &BOUNDS), boxes)
}

/// The same of a pair of cameras at and near a place, with boxes within a box.
fn of_pair(
    (seed, mut random): (u64, Random),
    solids: &Solids,
    (eye, within): ([f32; 3], &Cuboid),
    boxes: usize,
) -> [usize; 3] {
    let turn = f64::from(random.within(0.0, 6.3));
    let old = Camera::new(eye, [turn, 0.0], SIZE);
    // Up to five frames of the fastest path of the study, and of a fast turn.
    let step = [0, 1, 2].map(|k| if k < 2 { random.within(-2.0, 2.0) } else { random.within(-0.2, 0.2) });
    let turned = turn + f64::from(random.within(-0.4, 0.4));
    let new =
        Camera::new([0, 1, 2].map(|k| eye[k] + step[k]), [turned, f64::from(random.within(-0.1, 0.1))], SIZE);
    let fine = SIZE.map(|n| n * PASSES.fineness());
    let depth = rendered(&old, solids, fine);
    let truth = rendered(&new, solids, fine);
    let grid = Grid::new([2; 3], &BOUNDS);
    let buffer = PASSES.run(Late { camera: &old, depth: &depth, grid: &grid }, &new, SIZE).0;
    let mut found = [0; 3];
    for _ in 0..boxes {
        let [x, y] = [0, 1].map(|k| random.within(within.low[k], within.high[k]));
        let base = [x, y, random.within(0.0, 6.0)];
        let large = random.within(0.2, 5.0);
        let cuboid = Cuboid::on(base, [0, 1, 2].map(|_| random.within(0.1, large)));
        let verdict = test(&buffer, &new, &cuboid, 0.0);
        if verdict == Verdict::Outside {
            continue;
        }
        let (seen, culled) = (is_seen(&new, &cuboid, &truth), verdict == Verdict::Culled);
        found[0] += usize::from(seen && culled);
        found[1] += usize::from(!seen && culled);
        found[2] += 1;
        if seen && culled {
            println!("seed {seed}: {cuboid:?} is seen and culled");
        }
    }
    found
}

fn over(pairs: u64, boxes: usize) -> [usize; 3] {
    let all: Vec<[usize; 3]> = (0..pairs).into_par_iter().map(|seed| cases(seed, boxes)).collect();
    all.into_iter().fold([0; 3], |sum, one| [0, 1, 2].map(|k| sum[k] + one[k]))
}

/// The same in the mesh of the example, from the starts of its paths.
#[test]
fn no_seen_box_among_triangles_is_culled() {
    let site = courtyard();
    let one = |i: usize| {
        let pair = (i as u64, Random::new(i as u64));
        of_pair(pair, &site.solids, (site.starts[i % 9].eye, &site.bounds), 1000)
    };
    let all: Vec<[usize; 3]> = (0..27).into_par_iter().map(one).collect();
    let [wrong, right, all] = all.into_iter().fold([0; 3], |sum, one| [0, 1, 2].map(|k| sum[k] + one[k]));
    assert!(all > 5000 && right > all / 8, "{right} of {all} culled");
    assert_eq!(wrong, 0);
}

/// A million boxes in frames.
#[test]
fn no_seen_box_of_a_million_is_culled() {
    let [wrong, right, all] = over(2000, 2200);
    println!("{all} boxes in frames, {right} culled, {wrong} of them seen");
    assert!(all >= 1_000_000 && right > all / 8, "{right} of {all} culled");
    assert_eq!(wrong, 0);
}
