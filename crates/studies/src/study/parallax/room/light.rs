//! The light of a room.

use super::{Convex, Plane};
use lobefit_math::vector::{Vec3, dot, plus, scaled};

/// A pattern of squares over a wall's coordinates.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Checker {
    /// Side of a square.
    pub side: f64,
    /// Radiance of the two kinds.
    pub radiance: [[f64; 3]; 2],
}

/// A bright rectangle on a wall.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Panel {
    /// Its centre in the wall's coordinates.
    pub centre: [f64; 2],
    /// Half of its sides.
    pub half: [f64; 2],
    /// Radiance.
    pub radiance: [f64; 3],
}

/// One wall of a room.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Wall {
    /// Where it is.
    pub plane: Plane,
    /// Directions of its coordinates in the plane, which are the products of a place with them.
    pub axes: [Vec3; 2],
    /// Its squares.
    pub checker: Checker,
    /// Its panels, the first on top.
    pub panels: Vec<Panel>,
}

impl Wall {
    /// Radiance at a place of its plane, towards everywhere.
    pub fn radiance(&self, place: Vec3) -> [f64; 3] {
        self.at(self.axes.map(|axis| dot(axis, place)))
    }

    /// Radiance at coordinates in its plane.
    #[inline]
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        if let Some((_, panel)) = self.panel([x, y]) {
            return panel.radiance;
        }
        let Checker { side, radiance } = self.checker;
        let odd = (below(x / side) + below(y / side)) & 1 == 1;
        radiance[usize::from(odd)]
    }

    /// The panel at coordinates in its plane, and its place in the list.
    #[inline]
    pub fn panel(&self, [x, y]: [f64; 2]) -> Option<(usize, &Panel)> {
        let inside = |p: &Panel| (x - p.centre[0]).abs() < p.half[0] && (y - p.centre[1]).abs() < p.half[1];
        self.panels.iter().enumerate().find(|(_, panel)| inside(panel))
    }
}

/// The largest whole number not above x.
#[inline(always)]
fn below(x: f64) -> i64 {
    let whole = x as i64;
    whole - i64::from(x < whole as f64)
}

/// A room with its light and the place of its probe.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Room {
    /// Name.
    pub name: String,
    /// Where the cubemap is taken.
    pub probe: Vec3,
    /// Its walls, which bound it.
    pub walls: Vec<Wall>,
}

impl Room {
    /// The body that its walls bound.
    pub fn shape(&self) -> Convex {
        Convex { planes: self.walls.iter().map(|wall| wall.plane).collect() }
    }

    /// What a ray from inside meets: the distance, the wall. A room is bounded: every ray leaves
    /// it.
    pub fn exit(&self, from: Vec3, towards: Vec3) -> (f64, usize) {
        let mut exit = (f64::INFINITY, 0);
        for (i, wall) in self.walls.iter().enumerate() {
            let approach = dot(wall.plane.normal, towards);
            // from a wall itself no ray that leaves it meets it
            if approach > 0.0 {
                let t = wall.plane.depth(from) / approach;
                if t < exit.0 {
                    exit = (t, i);
                }
            }
        }
        exit
    }

    /// Radiance seen from a place inside in a direction.
    pub fn seen(&self, from: Vec3, towards: Vec3) -> [f64; 3] {
        let (distance, wall) = self.exit(from, towards);
        self.walls[wall].radiance(plus(from, scaled(towards, distance)))
    }
}
