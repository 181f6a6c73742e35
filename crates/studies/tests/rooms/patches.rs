//! Lobes integrated by the edges of patches.

use crate::rooms::lobe;
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, scaled};
use lobefit_studies::study::parallax::room::{
    Fetch, Fineness, Patches, Rays, Room, Tap, octagon, practice, room_a, room_b,
};
use lobefit_truth::optics::kernel::Kernel;

fn rooms() -> [Room; 4] {
    [room_a(), room_b(), octagon(), practice()]
}

/// Directions of no symmetry, and two that run along planes of squares' edges.
fn axes() -> [Vec3; 6] {
    [
        [0.3, -0.5, 0.8],
        [-0.9, 0.2, -0.1],
        [0.1, 0.7, -0.6],
        [0.02, -0.07, -1.0],
        [1.0, 0.0, 0.0],
        [0.6, 0.0, 0.8],
    ]
    .map(normalise)
}

const WIDTHS: [f64; 8] = [1e-6, 1e-3, 0.0225, 0.1, 0.35, 0.8, 0.9996, 1.0];

/// Directions of a reference by samples: off by a few 1e-4 of the light.
const MANY: u32 = 1 << 17;

#[test]
fn a_lobe_by_edges_is_the_lobe_by_directions() {
    for alpha in [1e-3, 0.0225, 0.1, 0.35, 0.8, 1.0] {
        let rays = Rays::new(&Kernel::HalfCosine, alpha, MANY, 3);
        for room in rooms() {
            let patches = Patches::new(&room);
            for place in [room.probe, [0.83, -0.41, 0.37]] {
                for axis in &axes()[..4] {
                    let slow = lobe(&room, place, *axis, None, &rays);
                    let fast = patches.lobe(place, *axis, alpha);
                    let off = length(minus(slow, fast)) / length(slow);
                    assert!(off < 2e-3, "{} {place:?} {axis:?} {alpha}: {slow:?} {fast:?}", room.name);
                }
            }
        }
    }
}

#[test]
fn a_finer_division_agrees() {
    for room in rooms() {
        let (usual, fine) = (Patches::new(&room), Patches::new(&room).with(Fineness::Fine));
        for place in [room.probe, [0.83, -0.41, 0.37], [0.9, 0.9, -1.1]] {
            for axis in axes() {
                for alpha in WIDTHS {
                    let (a, b) = (usual.lobe(place, axis, alpha), fine.lobe(place, axis, alpha));
                    let off = length(minus(a, b)) / length(b);
                    assert!(off < 3e-4, "{} {place:?} {axis:?} {alpha}: {a:?} {b:?}", room.name);
                }
            }
        }
    }
}

/// A surface hides what is below its plane: the floor itself, or what is under a table.
#[test]
fn what_is_below_a_plane_is_left_out() {
    let widths = [0.0225, 0.35, 1.0];
    let widths = widths.map(|alpha| (alpha, Rays::new(&Kernel::HalfCosine, alpha, MANY, 5)));
    let up = [0.0, 0.0, 1.0];
    for room in rooms() {
        let floor = -room.exit(room.probe, [0.0, 0.0, -1.0]).0 + room.probe[2];
        for height in [floor, floor + 0.8] {
            let place = [0.7, 0.4, height];
            let patches = Patches::above(&room, place, up);
            for axis in [[0.9, 0.1, 0.2], [-0.2, 0.5, 0.9], [0.3, -0.8, 0.05]].map(normalise) {
                for (alpha, rays) in &widths {
                    let slow = lobe(&room, place, axis, Some(up), rays);
                    let fast = patches.lobe(place, axis, *alpha);
                    let off = length(minus(slow, fast)) / length(slow);
                    assert!(off < 2e-3, "{} {height} {axis:?} {alpha}: {slow:?} {fast:?}", room.name);
                    let axis = minus(axis, scaled(up, 2.0 * dot(axis, up)));
                    let below = patches.lobe(place, axis, *alpha);
                    let slow = lobe(&room, place, axis, Some(up), rays);
                    let off = length(minus(slow, below)) / length(slow);
                    assert!(*alpha < 0.3 || off < 0.02, "{} below {axis:?}: {slow:?} {below:?}", room.name);
                }
            }
        }
    }
}

/// A room of one light shows nothing else; a ray shows what it meets.
#[test]
fn even_light_is_even_and_a_narrow_lobe_is_a_ray() {
    let mut even = octagon();
    for wall in &mut even.walls {
        wall.checker.radiance = [[0.25, 0.5, 2.0]; 2];
        wall.panels.clear();
    }
    let patches = Patches::new(&even);
    for axis in axes() {
        for alpha in WIDTHS {
            let tap = Tap { towards: axis, alpha, weight: 1.0 };
            let light = patches.fetch(&tap);
            assert!(length(minus(light, [0.25, 0.5, 2.0])) < 3e-4, "{axis:?} {alpha}: {light:?}");
        }
    }
    let room = room_b();
    let patches = Patches::new(&room);
    for axis in &axes()[..4] {
        let (ray, light) = (room.seen(room.probe, *axis), patches.lobe(room.probe, *axis, 1e-6));
        assert!(length(minus(ray, light)) < 1e-6, "{axis:?}: {ray:?} {light:?}");
    }
}
