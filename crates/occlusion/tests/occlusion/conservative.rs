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

/// Boxes of pairs of cameras.
#[derive(Default)]
struct Cases {
    /// Seen ones that are culled, or called outside of the frame.
    wrong: usize,
    /// Seen ones.
    seen: usize,
    /// Hidden ones that are culled.
    culled: usize,
    /// All that are in the frame.
    all: usize,
}

impl Cases {
    fn sum(of: impl ParallelIterator<Item = Cases>) -> Cases {
        of.reduce(Cases::default, |a, b| Cases {
            wrong: a.wrong + b.wrong,
            seen: a.seen + b.seen,
            culled: a.culled + b.culled,
            all: a.all + b.all,
        })
    }
}

/// Cases of a pair of cameras in a street.
fn cases(seed: u64, boxes: usize) -> Cases {
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
) -> Cases {
    let turn = f64::from(random.within(0.0, 6.3));
    let old = Camera::new(eye, [turn, 0.0], SIZE);
    // More than eight frames of the study's paths: 2.8 m of a walk, 0.42 of a turn.
    let step = [0, 1, 2].map(|k| if k < 2 { random.within(-3.0, 3.0) } else { random.within(-0.2, 0.2) });
    let turned = turn + f64::from(random.within(-0.5, 0.5));
    let new =
        Camera::new([0, 1, 2].map(|k| eye[k] + step[k]), [turned, f64::from(random.within(-0.1, 0.1))], SIZE);
    let fine = SIZE.map(|n| n * PASSES.fineness());
    let depth = rendered(&old, solids, fine);
    let truth = rendered(&new, solids, fine);
    let grid = Grid::new([2; 3], &BOUNDS);
    let buffer = PASSES.run(Late { camera: &old, depth: &depth, grid: &grid }, &new, SIZE).0;
    let mut found = Cases::default();
    for _ in 0..boxes {
        let [x, y] = [0, 1].map(|k| random.within(within.low[k], within.high[k]));
        let base = [x, y, random.within(0.0, 6.0)];
        let large = random.within(0.2, 5.0);
        let cuboid = Cuboid::on(base, [0, 1, 2].map(|_| random.within(0.1, large)));
        let verdict = test(&buffer, &new, &cuboid, 0.0);
        let seen = is_seen(&new, &cuboid, &truth);
        found.seen += usize::from(seen);
        found.all += usize::from(verdict != Verdict::Outside);
        found.culled += usize::from(!seen && verdict == Verdict::Culled);
        if seen && verdict != Verdict::Kept {
            println!("seed {seed}: {cuboid:?} is seen and {verdict:?}");
            found.wrong += 1;
        }
    }
    found
}

/// The same in the mesh of the example, from the starts of its paths.
#[test]
fn no_seen_box_among_triangles_is_culled() {
    let site = courtyard();
    let one = |i: usize| {
        let pair = (i as u64, Random::new(i as u64));
        of_pair(pair, &site.solids, (site.starts[i % 9].eye, &site.bounds), 1000)
    };
    let Cases { wrong, seen, culled, all } = Cases::sum((0..27).into_par_iter().map(one));
    println!("{all} boxes in frames, {seen} seen, {culled} culled, {wrong} wrongly");
    assert!(all > 5000 && seen > all / 8 && culled > all / 8, "{seen} of {all} seen, {culled} culled");
    assert_eq!(wrong, 0);
}

/// A million boxes in frames.
#[test]
fn no_seen_box_of_a_million_is_culled() {
    let pairs = (0..2000).into_par_iter().map(|seed| cases(seed, 2200));
    let Cases { wrong, seen, culled, all } = Cases::sum(pairs);
    println!("{all} boxes in frames, {seen} seen, {culled} culled, {wrong} wrongly");
    assert!(all >= 1_000_000 && seen > 250_000 && culled > all / 8, "{seen} of {all} seen, {culled} culled");
    assert_eq!(wrong, 0);
}
