//! Places that are hard: behind the camera, at infinity, on the near plane, twice in a texel,
//! without area, on the grid's borders, with the camera inside.

use lobefit_occlusion::camera::{Camera, NEAR};
use lobefit_occlusion::cull::{Verdict, test};
use lobefit_occlusion::depth::{Depth, EMPTY};
use lobefit_occlusion::grid::{Grid, Lod};
use lobefit_occlusion::raster::{Cuboid, Solids, is_seen, rendered};
use lobefit_occlusion::reproject::{reproject, reproject_conservatively};
use lobefit_occlusion::world::BOUNDS;

const SIZE: [usize; 2] = [32, 32];

fn ahead() -> Camera {
    Camera::new([0.0; 3], [0.0, 0.0], SIZE)
}

fn filled(z: f32) -> Depth {
    Depth { size: SIZE, texels: vec![z; SIZE[0] * SIZE[1]] }
}

#[test]
fn what_is_behind_or_before_the_near_plane_has_no_pixel() {
    let camera = ahead();
    assert_eq!(camera.pixel([0.0, 0.0, -1.0], SIZE), None);
    assert_eq!(camera.pixel([0.0, 0.0, 0.0], SIZE), None);
    assert_eq!(camera.pixel([0.0, 0.0, NEAR.next_down()], SIZE), None);
    assert_eq!(camera.pixel([0.0, 0.0, NEAR], SIZE), Some([16.0, 16.0]));
    assert_eq!(camera.pixel([f32::NAN, 0.0, 1.0], SIZE), None);
    assert_eq!(camera.pixel([0.0, 0.0, f32::INFINITY], SIZE), None);
}

/// Infinite depth stays infinite, and moves with turns alone; a point that comes to lie behind is
/// left out.
#[test]
fn infinite_and_passed_depth() {
    let camera = ahead();
    for to in [Camera::new([3.0, 1.0, 2.0], [0.0, 0.0], SIZE), Camera::new([0.0; 3], [0.3, 0.0], SIZE)] {
        let mut out = Depth::empty(SIZE);
        reproject(&filled(f32::INFINITY), &camera, &to, &mut out);
        assert!(out.texels.iter().all(|z| *z == EMPTY || *z == f32::INFINITY));
        assert_eq!(out.holes() > 0, to.eye == [0.0; 3], "a turn leaves a gap, a step does not");
    }
    for z in [2.0, 5.0, 5.0 + NEAR.next_down()] {
        let mut out = Depth::empty(SIZE);
        reproject(&filled(z), &camera, &Camera::new([5.0, 0.0, 0.0], [0.0, 0.0], SIZE), &mut out);
        assert_eq!(out.holes(), SIZE[0] * SIZE[1], "behind the camera, on it, before the near plane");
    }
}

/// Of two depths in a texel the nearer counts, in any order; in the conservative mode the farthest
/// of a plane in the texel and those about it.
#[test]
fn two_points_in_a_texel() {
    let (camera, small) = (ahead(), [8, 8]);
    let inner = 3 * 8 + 3;
    for (farther, nearer) in [(0, 1), (1, 0)] {
        let mut fine = Depth { size: [64, 64], texels: vec![4.0; 64 * 64] };
        fine.texels[64 * 28 + 28 + farther] = 7.0;
        fine.texels[64 * 28 + 28 + nearer] = 3.0;
        let mut out = Depth::empty(small);
        reproject(&fine, &camera, &camera, &mut out);
        assert_eq!(out.texels[inner], 3.0);
        let mut out = Depth::empty(small);
        reproject_conservatively(&fine, &camera, &camera, &mut out);
        assert!(out.texels[inner] >= 7.0, "{}", out.texels[inner]);
    }
    // A plane: 1/z is linear. Texel 3 has columns 24 to 31, with its neighbours 16 to 39.
    let depth = |column: usize| 1.0 / (0.1 + 0.002 * column as f32);
    for (turned, farthest) in [(false, depth(16)), (true, depth(63 - 39))] {
        let at = |i: usize| depth(if turned { 63 - i % 64 } else { i % 64 });
        let fine = Depth { size: [64, 64], texels: (0..64 * 64).map(at).collect() };
        let mut out = Depth::empty(small);
        reproject_conservatively(&fine, &camera, &camera, &mut out);
        let off = out.texels[inner] - farthest;
        assert!(off.abs() < 1e-4, "{} for {farthest}", out.texels[inner]);
    }
}

#[test]
fn boxes_without_area_or_place() {
    let (camera, wall) = (ahead(), filled(5.0));
    let point = |z: f32| Cuboid { low: [z, 0.1, 0.1], high: [z, 0.1, 0.1] };
    let verdict = |cuboid: Cuboid| test(&wall, &camera, &cuboid, 0.0);
    assert_eq!(
        [point(4.0), point(6.0), point(-1.0)].map(verdict),
        [Verdict::Kept, Verdict::Culled, Verdict::Outside]
    );
    assert_eq!(verdict(point(5.0)), Verdict::Kept, "at the depth of the wall");
    assert_eq!(verdict(point(NEAR)), Verdict::Kept);
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(verdict(Cuboid { low: [8.0, 0.0, 0.0], high: [9.0, x, 1.0] }), Verdict::Kept, "{x}");
    }
    // A box about the camera, one across the near plane, ends exchanged, one beside the frame.
    assert_eq!(verdict(Cuboid { low: [-1.0; 3], high: [1.0; 3] }), Verdict::Kept);
    assert_eq!(verdict(Cuboid { low: [0.0, 0.0, 0.0], high: [9.0, 0.1, 0.1] }), Verdict::Kept);
    assert_eq!(verdict(Cuboid { low: [9.0, 1.0, 1.0], high: [8.0, 0.0, 0.0] }), Verdict::Culled);
    assert_eq!(verdict(Cuboid::on([8.0, 50.0, 0.0], [1.0; 3])), Verdict::Outside);
    assert_eq!(
        test(&Depth::empty(SIZE), &camera, &point(6.0), 0.0),
        Verdict::Kept,
        "empty texels hide nothing"
    );
    assert_eq!(test(&filled(f32::INFINITY), &camera, &point(6.0), 0.0), Verdict::Kept);
    assert!(!is_seen(&camera, &point(6.0), &filled(9.0)), "what has no area has no pixel");
}

/// A box that holds the camera, or that the near plane cuts, is drawn as far as it lies ahead.
#[test]
fn boxes_around_the_camera() {
    let camera = ahead();
    let around = rendered(&camera, &Solids::of(&[Cuboid { low: [-2.0; 3], high: [2.0; 3] }]), SIZE);
    assert!(around.texels.iter().all(|z| *z == f32::INFINITY), "its faces look away");
    let below = Cuboid { low: [-9.0, -9.0, -2.0], high: [9.0, 9.0, -0.01] };
    let cut = rendered(&camera, &Solids::of(&[below]), SIZE);
    assert!(cut.texels.iter().all(|z| *z >= NEAR * 0.999) && cut.texels.iter().any(|z| z.is_finite()));
}

/// The lower border of the grid is in it, the upper one and what is not a number are not; the
/// camera in a cell sees nothing of it.
#[test]
fn borders_of_the_grid_and_the_camera_in_a_cell() {
    let moved = Cuboid { low: [-7.0, 3.0, -1.0], high: [9.0, 4.0, 1.0] };
    for (voxels, bounds) in
        [([64, 64, 32], BOUNDS), ([8, 64, 2], BOUNDS), ([2, 2, 2], BOUNDS), ([8, 2, 4], moved)]
    {
        let mut grid = Grid::new(voxels, &bounds);
        let Cuboid { low, high } = bounds;
        // From a corner that is not the origin, distances are rounded.
        let below = |x: f32| if low == [0.0; 3] { x.next_down() } else { x - 1e-6 };
        assert!(grid.set(low) && grid.set(high.map(below)));
        assert!(!grid.set(high) && !grid.set([high[0], low[1], low[2]]));
        assert!(!grid.set([low[0] - 1e-6, low[1], low[2]]));
        assert!(!grid.set([f32::NAN, low[1], low[2]]) && !grid.set([low[0], f32::INFINITY, low[2]]));
        assert_eq!(grid.count(), 2);
    }
    let mut grid = Grid::new([64, 64, 32], &BOUNDS);
    let cell = BOUNDS.high[0] / 64.0;
    let middle = [16.0 * cell + 0.6 * cell, 16.0 * cell + 0.6 * cell, 4.0 * cell + 0.6 * cell];
    assert!(grid.set(middle));
    for back in [0.0, 0.2 * cell] {
        let camera = Camera::new([middle[0] - back, middle[1], middle[2]], [0.0, 0.0], SIZE);
        for far in [0.0, 9.0] {
            let mut out = Depth::empty(SIZE);
            grid.splat(&camera, Lod { near: 0.0, far }, &mut out);
            assert_eq!(out.holes(), SIZE[0] * SIZE[1], "{back} m before it");
        }
    }
}
