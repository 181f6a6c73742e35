//! Each part against its definition.

use lobefit_occlusion::camera::Camera;
use lobefit_occlusion::depth::{Depth, EMPTY};
use lobefit_occlusion::grid::{Grid, Lod};
use lobefit_occlusion::measure::{Holes, TOLERANCE, error, is_far, is_near};
use lobefit_occlusion::raster::{Cuboid, Solids, rendered};
use lobefit_occlusion::reproject::reproject;
use lobefit_occlusion::world::BOUNDS;

const SIZE: [usize; 2] = [64, 40];

fn looking(eye: [f32; 3], yaw: f64) -> Camera {
    Camera::new(eye, [yaw, 0.1], SIZE)
}

/// The rasteriser's depth is where the ray through a pixel centre enters the first box.
#[test]
fn depth_is_that_of_rays() {
    let boxes = [
        Cuboid::on([20.0, 3.0, 0.0], [4.0, 6.0, 5.0]),
        Cuboid::on([30.0, -4.0, 0.0], [2.0, 9.0, 9.0]),
        Cuboid { low: [-90.0, -90.0, -1.0], high: [90.0, 90.0, 0.0] },
    ];
    let camera = looking([10.0, 0.0, 1.7], 0.05);
    let depth = rendered(&camera, &Solids::of(&boxes), SIZE);
    let [corner, across, down] = camera.rays(SIZE);
    for (i, found) in depth.texels.iter().enumerate() {
        let (x, y) = ((i % SIZE[0]) as f32 + 0.5, (i / SIZE[0]) as f32 + 0.5);
        let ray = [0, 1, 2].map(|k| corner[k] + x * across[k] + y * down[k]);
        let enters = |cuboid: &Cuboid| {
            let slab = |k: usize| {
                let t = [cuboid.low[k], cuboid.high[k]].map(|end| (end - camera.eye[k]) / ray[k]);
                [t[0].min(t[1]), t[0].max(t[1])]
            };
            let [a, b, c] = [0, 1, 2].map(slab);
            let (first, last) = (a[0].max(b[0]).max(c[0]), a[1].min(b[1]).min(c[1]));
            if first <= last && first > 0.0 { first } else { f32::INFINITY }
        };
        let truth = boxes.iter().map(enters).fold(f32::INFINITY, f32::min);
        // On an edge rounding decides: a neighbour then has the other depth.
        let near = |z: f32| z == truth || (z - truth).abs() < 1e-3 * truth;
        let beside = [i.wrapping_sub(1), i + 1, i.wrapping_sub(SIZE[0]), i + SIZE[0]];
        let edge = beside.iter().any(|k| depth.texels.get(*k).is_some_and(|z| near(*z)));
        assert!(near(*found) || edge, "texel {i}: {found}, {truth}");
    }
}

/// Depth that is not old at all comes back as it is, and nothing is empty; a turn leaves holes out
/// of the frame, a step sideways leaves some behind an edge.
#[test]
fn reprojection_of_now_is_now_and_holes_have_causes() {
    let boxes = [
        Cuboid::on([20.0, 0.0, -3.0], [1.0, 4.0, 9.0]),
        Cuboid { low: [40.0, -90.0, -50.0], high: [41.0, 90.0, 50.0] },
    ];
    let camera = looking([0.0, 0.0, 0.0], 0.0);
    let depth = rendered(&camera, &Solids::of(&boxes), SIZE);
    let into = |to: &Camera| {
        let mut out = Depth::empty(SIZE);
        reproject(&depth, &camera, to, &mut out);
        out
    };
    let same = into(&camera);
    assert!(same.texels.iter().zip(&depth.texels).all(|(a, b)| (a - b).abs() < 1e-4 * b));
    let holes = |to: Camera| {
        let truth = rendered(&to, &Solids::of(&boxes), SIZE);
        Holes::of(&into(&to), (&truth, &to), (&depth, &camera))
    };
    let turned = holes(looking([0.0, 0.0, 0.0], 0.4));
    assert!(turned.out_of_frame > 300 && turned.disoccluded < 20, "{turned:?}");
    let stepped = holes(looking([0.0, 2.0, 0.0], 0.0));
    assert!(stepped.disoccluded > 10 && stepped.out_of_frame < 400, "{stepped:?}");
}

#[test]
fn medians_fill_cracks_and_dilation_takes_the_farthest() {
    let mut crack = Depth { size: [5, 5], texels: vec![4.0; 25] };
    (0..5).for_each(|y| crack.texels[5 * y + 2] = EMPTY);
    crack.texels[0] = 9.0;
    let mut large = crack.clone();
    large.texels[5..].fill(EMPTY);
    crack.median(1);
    assert_eq!(crack.holes(), 0);
    assert_eq!(crack.texels[12], 4.0);
    let before = large.holes();
    large.median(1);
    assert!(large.holes() == before, "less than half is written");
    large.dilation(1);
    assert_eq!(large.texels[5..8], [9.0, 9.0, 4.0]);
    assert!(large.texels[10..].iter().all(|z| *z == EMPTY), "beyond the radius");
    large.dilation(2);
    assert_eq!(large.texels[10], 9.0);
    let far = Depth { size: [3, 1], texels: vec![1.0, f32::INFINITY, EMPTY] };
    assert_eq!(far.eroded(1).texels, [f32::INFINITY, EMPTY, EMPTY]);
}

/// Held against a search through each square, of depths with holes and sky.
#[test]
fn an_erosion_is_the_farthest_of_each_square() {
    let size = [5, 4];
    let one = |i: usize| match i * 7 % 20 {
        3 => EMPTY,
        5 => f32::INFINITY,
        k => 1.0 + k as f32,
    };
    let depth = Depth { size, texels: (0..20).map(one).collect() };
    for radius in [0, 1, 3, 9] {
        let square = |x: usize, y: usize| {
            let around =
                (0..20_usize).filter(|k| (k % 5).abs_diff(x) <= radius && (k / 5).abs_diff(y) <= radius);
            let all: Vec<f32> = around.map(|k| depth.texels[k]).collect();
            if all.contains(&EMPTY) { EMPTY } else { all.into_iter().fold(0.0, f32::max) }
        };
        let expected: Vec<f32> = (0..20).map(|i| square(i % 5, i / 5)).collect();
        assert_eq!(depth.eroded(radius).texels, expected, "radius {radius}");
    }
}

/// Sub-voxels are splatted one by one up close, as the cell's centroid farther away and as the
/// super-voxel's beyond: all within the cell, and none where something is written already.
#[test]
fn levels_of_detail_stay_in_their_cells() {
    let mut grid = Grid::new([64, 64, 32], &BOUNDS);
    let cell = BOUNDS.high[0] / 64.0;
    let place = [32.0 * cell + 0.1, 32.0 * cell + 0.1, 8.0 * cell + 0.1];
    assert!(grid.set(place) && grid.set([place[0] + 0.5 * cell, place[1], place[2]]) && grid.count() == 2);
    let camera = Camera::new([place[0] - 20.0, place[1], place[2]], [0.0, 0.0], SIZE);
    for (lod, side) in [((40.0, 40.0), 0.5), ((0.0, 40.0), 1.0), ((0.0, 0.0), 2.0)] {
        let mut out = Depth::empty(SIZE);
        grid.splat(&camera, Lod { near: lod.0, far: lod.1 }, &mut out);
        let written: Vec<f32> = out.texels.iter().copied().filter(|z| *z != EMPTY).collect();
        assert!(!written.is_empty() && written.len() < 40, "{} texels", written.len());
        let range = 20.0 - 0.1..20.0 + cell * (1.0 + side);
        assert!(written.iter().all(|z| range.contains(z)), "{written:?}");
        let mut full = Depth { size: SIZE, texels: vec![5.0; SIZE[0] * SIZE[1]] };
        grid.splat(&camera, Lod { near: lod.0, far: lod.1 }, &mut full);
        assert!(full.texels.iter().all(|z| *z == 5.0));
    }
}

#[test]
fn errors_have_signs() {
    let far = f32::INFINITY;
    assert_eq!(error(9.0, 10.0).map(|e| (e * 10.0).round()), Some(-1.0));
    assert_eq!(
        [error(far, far), error(far, 1.0), error(1.0, far), error(EMPTY, 1.0)],
        [Some(0.0), Some(1.0), Some(-1.0), None]
    );
    for truth in [1.0, 7.0, far] {
        for found in [EMPTY, 0.5, 0.979, 0.981, 1.0, 1.019, 1.021, 6.0, 6.99, 8.0, far] {
            let known = error(found, truth);
            assert_eq!(is_near(found, truth), known.is_some_and(|e| e < -TOLERANCE), "{found} {truth}");
            assert_eq!(is_far(found, truth), known.is_none_or(|e| e > TOLERANCE), "{found} {truth}");
        }
    }
}
