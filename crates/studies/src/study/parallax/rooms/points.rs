//! Shading points at random in a room.

use std::f64::consts::PI;

use serde::Serialize;

use crate::study::Size;
use crate::study::parallax::room::{Convex, Room};
use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, plus, scaled, tangents, turned};

/// Which points.
#[derive(Clone, Debug, Serialize)]
pub(in crate::study::parallax) struct Parameters {
    /// How many.
    pub count: usize,
    /// Least distance of a point from every wall, in metres.
    pub margin: f64,
    /// Of the sequences that they are drawn from.
    pub seed: u32,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let count = if size == Size::Full { 1200 } else { 60 };
        Parameters { count, margin: 0.1, seed: 1 }
    }
}

/// A place in a room, a direction of reflection, and the normal of a surface that reflects so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::study::parallax) struct Point {
    pub place: Vec3,
    pub mirror: Vec3,
    pub normal: Vec3,
}

/// Least cosine between normal and view.
const LEAST_COSINE: f64 = 0.05;

/// Places evenly inside the walls, directions evenly over the sphere, the cosine n.v evenly above
/// its least.
pub(in crate::study::parallax) fn points(room: &Room, parameters: &Parameters) -> Vec<Point> {
    let Parameters { count, margin, seed } = *parameters;
    let shape = room.shape();
    let [low, high] = bounds(&shape, room.probe);
    let places = Sobol::new([seed, seed ^ 0x5bd1_e995, seed ^ 0x9e37_79b9]);
    let turns = Sobol::new([seed ^ 0x2545_f491, seed ^ 0x7feb_352d, 0]).padded(seed ^ 0x1656_67b1);
    let place =
        |i: u32| [0, 1, 2].map(|axis| low[axis] + (high[axis] - low[axis]) * places.coordinate(i, axis));
    let inside = |place: &Vec3| shape.planes.iter().all(|plane| plane.depth(*place) >= margin);
    let found = (0..).map(place).filter(inside).take(count);
    let tilts = Sobol::new([seed ^ 0x68e3_1da4, seed ^ 0xb529_7a4d, 0]).padded(seed ^ 0x94d0_49bb);
    let point = |(place, i)| {
        let mirror = polar(1.0 - 2.0 * turns.coordinate(i, 0), turns.coordinate(i, 1));
        let mu = 1.0 - (1.0 - LEAST_COSINE) * tilts.coordinate(i, 0);
        let normal = turned(mirror, tangents(mirror), polar(mu, tilts.coordinate(i, 1)));
        Point { place, mirror, normal }
    };
    found.zip(0..).map(point).collect()
}

/// [`points`], every other one of them moved back along its mirror ray to the wall there, whose
/// surface it then is on.
pub(super) fn half_on_walls(room: &Room, parameters: &Parameters) -> Vec<Point> {
    let moved = |(i, point): (usize, Point)| {
        if i % 2 == 0 {
            return point;
        }
        let back = scaled(point.mirror, -1.0);
        let (distance, wall) = room.exit(point.place, back);
        let normal = scaled(room.walls[wall].plane.normal, -1.0);
        Point { place: plus(point.place, scaled(back, distance)), normal, ..point }
    };
    points(room, parameters).into_iter().enumerate().map(moved).collect()
}

/// The direction of a cosine to z and a part of a turn about it.
fn polar(z: f64, turn: f64) -> Vec3 {
    let sine = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (s, c) = ops::sincos(2.0 * PI * turn);
    [sine * c, sine * s, z]
}

/// A box that holds a body.
fn bounds(shape: &Convex, inside: Vec3) -> [Vec3; 2] {
    let [mut low, mut high] = [inside; 2];
    for corner in shape.corners() {
        for axis in 0..3 {
            low[axis] = low[axis].min(corner[axis]);
            high[axis] = high[axis].max(corner[axis]);
        }
    }
    [low, high]
}
