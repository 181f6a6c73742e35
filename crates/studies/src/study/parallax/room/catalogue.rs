//! The rooms of the study: checker walls and bright panels, six of them or more, in a box about the
//! probe, a long low box with the probe off its centre, and an eight-sided hall with a sloping
//! roof.

use super::light::{Checker, Panel, Room, Wall};
use super::{Convex, Plane};
use lobefit_math::vector::{Vec3, cross, normalise};

const UP: Vec3 = [0.0, 0.0, 1.0];

/// 6 x 4 x 3 about the origin, the probe in its centre.
pub fn room_a() -> Room {
    let shape = Convex::cuboid([-3.0, -2.0, -1.5], [3.0, 2.0, 1.5]);
    Room {
        name: "A".into(),
        probe: [0.0; 3],
        walls: shape.planes.into_iter().enumerate().map(wall).collect(),
    }
}

/// 12 x 2.6 x 2.5, the probe off its centre.
pub fn room_b() -> Room {
    let shape = Convex::cuboid([-6.0, -1.3, -1.25], [6.0, 1.3, 1.25]);
    let walls = shape.planes.into_iter().enumerate().map(wall).collect();
    Room { name: "B".into(), probe: [-2.0, 0.3, 0.2], walls }
}

/// An eight-sided hall 6 across and 3 high, whose roof slopes towards two sides: 11 planes.
pub fn octagon() -> Room {
    let side = |normal: Vec3| Plane { normal: normalise(normal), offset: 3.0 };
    let around = [
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [-1.0, -1.0, 0.0],
        [0.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
    ];
    let ends = [
        Plane::through([0.0, 0.0, -1.5], [0.0, 0.0, -1.0]),
        Plane::through([0.0, 0.0, 1.8], [0.5, 0.0, 1.0]),
        Plane::through([0.0, 0.0, 1.8], [-0.5, 0.0, 1.0]),
    ];
    let planes = around.into_iter().map(side).chain(ends);
    Room { name: "octagon".into(), probe: [0.4, -0.3, 0.0], walls: planes.enumerate().map(wall).collect() }
}

/// 5 x 4.4 x 2.8, none of the study's: the constants of lobes are fitted here and judged in the
/// others.
pub fn practice() -> Room {
    let shape = Convex::cuboid([-2.1, -2.5, -1.2], [2.9, 1.9, 1.6]);
    let walls = shape.planes.into_iter().enumerate().map(|(i, plane)| wall((5 - i, plane))).collect();
    Room { name: "practice".into(), probe: [0.2, -0.4, 0.1], walls }
}

/// Colours of the squares, dark and light, and of the panel of the walls in turn.
const COLOURS: [[[f64; 3]; 3]; 6] = [
    [[0.10, 0.12, 0.20], [0.45, 0.52, 0.70], [9.0, 8.0, 6.0]],
    [[0.20, 0.10, 0.08], [0.70, 0.50, 0.42], [6.0, 7.5, 9.0]],
    [[0.08, 0.18, 0.10], [0.45, 0.68, 0.48], [8.0, 7.0, 5.0]],
    [[0.18, 0.16, 0.06], [0.72, 0.66, 0.40], [5.0, 6.5, 8.0]],
    [[0.14, 0.14, 0.14], [0.55, 0.55, 0.55], [7.0, 4.0, 3.0]],
    [[0.16, 0.12, 0.18], [0.62, 0.56, 0.66], [10.0, 10.0, 10.0]],
];

/// A wall by its place in the room: squares of half a metre and one panel.
fn wall((index, plane): (usize, Plane)) -> Wall {
    let [dark, light, bright] = COLOURS[index % COLOURS.len()];
    let level = plane.normal[2].abs() > 0.5;
    let across = if level { [1.0, 0.0, -plane.normal[0] / plane.normal[2]] } else { cross(UP, plane.normal) };
    let across = normalise(across);
    let axes = [across, cross(plane.normal, across)];
    // no panel is where another wall's is: the third part of a turn of the golden angle along each
    // wall
    let shift = (index as f64 * 0.618).fract() - 0.5;
    let panel = Panel { centre: [1.2 * shift, 0.35 - 0.5 * shift], half: [0.45, 0.3], radiance: bright };
    Wall { plane, axes, checker: Checker { side: 0.5, radiance: [dark, light] }, panels: vec![panel] }
}
