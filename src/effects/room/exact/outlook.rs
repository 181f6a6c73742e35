//! A room as it is seen from a place, in a frame.

use super::super::light::{Room, Wall};
use crate::math::vector::{Vec3, dot, scaled};

/// Directions that are met at once.
pub(super) const LANES: usize = 8;

/// Least distance to a wall, in metres: a place on a wall or beyond it sees the wall there in every direction towards it.
const NEAREST: f64 = 1e-12;

/// What is seen from a place inside a room, by directions in the coordinates of three axes at right angles.
#[derive(Clone, Debug)]
pub struct Outlook<'a> {
    walls: Vec<Seen<'a>>,
}

/// A wall from the place.
#[derive(Clone, Debug)]
struct Seen<'a> {
    wall: &'a Wall,
    /// The normal over the distance: its product with a direction is 1 over the distance along that.
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

    /// Radiance from a direction, of any length but 0. A room is bounded, so that every direction meets a wall.
    #[inline]
    pub fn seen(&self, towards: Vec3) -> [f64; 3] {
        let (mut nearness, mut met) = (0.0, 0);
        for (i, wall) in self.walls.iter().enumerate() {
            let near = dot(wall.normal, towards);
            if near > nearness {
                (nearness, met) = (near, i);
            }
        }
        self.radiance(met, nearness, towards)
    }

    /// 1 over the distance to the wall that each of many directions meets, and which it is.
    #[inline(always)]
    pub(super) fn met(&self, [x, y, z]: &[[f64; LANES]; 3]) -> ([f64; LANES], [usize; LANES]) {
        let (mut nearness, mut met) = ([0.0; LANES], [0; LANES]);
        for (i, wall) in self.walls.iter().enumerate() {
            let [a, b, c] = wall.normal;
            for l in 0..LANES {
                let near = a * x[l] + b * y[l] + c * z[l];
                met[l] = if near > nearness[l] { i } else { met[l] };
                nearness[l] = if near > nearness[l] { near } else { nearness[l] };
            }
        }
        (nearness, met)
    }

    /// Radiance from where a direction meets a wall.
    #[inline(always)]
    pub(super) fn radiance(&self, met: usize, nearness: f64, towards: Vec3) -> [f64; 3] {
        let Seen { wall, foot, axes, .. } = &self.walls[met];
        let distance = 1.0 / nearness;
        wall.at([0, 1].map(|i| foot[i] + distance * dot(axes[i], towards)))
    }
}
