//! A room as it is seen from a place, in a frame.

use super::super::light::{Panel, Room, Wall};
use lobefit_math::vector::{Vec3, dot, length, plus, scaled};

/// Least distance to a wall, in metres: a place on a wall or beyond it sees the wall there in every
/// direction towards it.
const NEAREST: f64 = 1e-12;

/// What is seen from a place inside a room, by directions in the coordinates of three axes at right
/// angles.
#[derive(Clone, Debug)]
pub struct Outlook<'a> {
    walls: Vec<Seen<'a>>,
}

/// A wall from the place.
#[derive(Clone, Debug)]
struct Seen<'a> {
    wall: &'a Wall,
    /// The normal over the distance: its product with a direction is 1 over the distance along
    /// that.
    normal: Vec3,
    /// Coordinates in the wall of the place's foot on it.
    foot: [f64; 2],
    /// The wall's own directions.
    axes: [Vec3; 2],
}

impl<'a> Outlook<'a> {
    /// The view from a place in the frame of unit vectors `frame`.
    pub fn new(room: &'a Room, place: Vec3, frame: [Vec3; 3]) -> Outlook<'a> {
        let local = |v: Vec3| frame.map(|axis| dot(axis, v));
        let seen = |wall: &'a Wall| {
            let Wall { plane, axes, .. } = wall;
            let depth = plane.depth(place).max(NEAREST);
            Seen {
                wall,
                normal: scaled(local(plane.normal), 1.0 / depth),
                foot: axes.map(|axis| dot(axis, place)),
                axes: axes.map(local),
            }
        };
        Outlook { walls: room.walls.iter().map(seen).collect() }
    }

    /// Radiance from a direction, of any length but 0.
    #[inline]
    pub fn seen(&self, towards: Vec3) -> [f64; 3] {
        let (Seen { wall, .. }, _, at) = self.met(towards);
        wall.at(at)
    }

    /// Radiance from a direction of unit length, and how many points per solid angle are there of
    /// `count` spread evenly over every panel; 0 where no panel is.
    pub(super) fn among(&self, towards: Vec3, count: f64) -> ([f64; 3], f64) {
        let (Seen { wall, normal, .. }, nearness, at) = self.met(towards);
        match wall.panel(at) {
            None => (wall.at(at), 0.0),
            Some((_, panel)) => {
                (panel.radiance, density(panel, 1.0 / nearness, nearness / length(*normal), count))
            }
        }
    }

    /// The wall that a direction meets, 1 over the distance to it along the direction, and where. A
    /// room is bounded, so that every direction meets a wall.
    #[inline(always)]
    fn met(&self, towards: Vec3) -> (&Seen<'a>, f64, [f64; 2]) {
        let (mut nearness, mut met) = (0.0, 0);
        for (i, wall) in self.walls.iter().enumerate() {
            let near = dot(wall.normal, towards);
            if near > nearness {
                (nearness, met) = (near, i);
            }
        }
        let seen = &self.walls[met];
        let distance = 1.0 / nearness;
        (seen, nearness, [0, 1].map(|i| seen.foot[i] + distance * dot(seen.axes[i], towards)))
    }

    /// What is seen of every panel at some of its points, given in [0, 1)^2: the direction, the
    /// radiance, and how many of the points there are per solid angle. Without those that another
    /// panel covers.
    pub(super) fn panels(&self, points: &[[f64; 2]], mut each: impl FnMut(Vec3, [f64; 3], f64)) {
        for Seen { wall, foot, axes, normal } in &self.walls {
            let depth = 1.0 / length(*normal);
            let outward = scaled(*normal, depth * depth);
            for (k, panel) in wall.panels.iter().enumerate() {
                for point in points {
                    let at = [0, 1]
                        .map(|i| panel.centre[i] + (2.0 * point[i] - 1.0) * (1.0 - INSIDE) * panel.half[i]);
                    if wall.panel(at).is_none_or(|(top, _)| top != k) {
                        continue;
                    }
                    let across = [0, 1].map(|i| scaled(axes[i], at[i] - foot[i]));
                    let way = plus(outward, plus(across[0], across[1]));
                    let distance = length(way);
                    let towards = scaled(way, 1.0 / distance);
                    each(
                        towards,
                        panel.radiance,
                        density(panel, distance, depth / distance, points.len() as f64),
                    );
                }
            }
        }
    }
}

/// By how much points keep off the edges of a panel, of its half: above the rounding of places.
const INSIDE: f64 = 1e-12;

/// Points per solid angle of `count` on a panel, seen from a distance at a cosine to its normal.
fn density(panel: &Panel, distance: f64, cosine: f64, count: f64) -> f64 {
    count * distance * distance / (4.0 * panel.half[0] * panel.half[1] * cosine)
}
