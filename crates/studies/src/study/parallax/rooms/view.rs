//! What a camera sees in a room.

use serde::Serialize;

use crate::study::parallax::room::Room;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, cross, minus, normalise, plus, scaled};

/// A camera above a level plane that reflects.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Camera {
    pub name: String,
    /// Height of the plane.
    pub plane: f64,
    pub from: Vec3,
    /// The place in the middle of the picture.
    pub to: Vec3,
    /// Angle between the left and the right edge, degrees.
    pub field: f64,
}

/// One pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pixel {
    /// Where it sees the plane, if it does.
    pub place: Option<Vec3>,
    /// Towards the camera.
    pub view: Vec3,
    /// Its mirror direction about the plane's normal.
    pub mirror: Vec3,
    /// What it sees where it does not see the plane.
    pub wall: Vec3,
    /// The wall that the mirror ray meets.
    pub met: usize,
}

/// The pixels of a square picture, row by row from the top.
pub(super) fn pixels(room: &Room, camera: &Camera, side: usize) -> Vec<Pixel> {
    let forward = normalise(minus(camera.to, camera.from));
    let right = normalise(cross(forward, [0.0, 0.0, 1.0]));
    let up = cross(right, forward);
    let half = ops::tan(camera.field.to_radians() / 2.0);
    let pixel = |i: usize| {
        let at = |k: usize| (2.0 * k as f64 + 1.0) / side as f64 - 1.0;
        let (x, y) = (half * at(i % side), -half * at(i / side));
        let ray = normalise(plus(forward, plus(scaled(right, x), scaled(up, y))));
        let view = scaled(ray, -1.0);
        let mirror = [ray[0], ray[1], -ray[2]];
        let along = (camera.plane - camera.from[2]) / ray[2];
        let (distance, wall) = room.exit(camera.from, ray);
        // the floor itself is a wall: what lies on it within rounding is the plane
        let below = along > 0.0 && along <= distance * (1.0 + 1e-9);
        let end = plus(camera.from, scaled(ray, distance));
        if below {
            let place = plus(camera.from, scaled(ray, along));
            let met = room.exit(place, mirror).1;
            Pixel { place: Some(place), view, mirror, wall: [0.0; 3], met }
        } else {
            Pixel { place: None, view, mirror, wall: room.walls[wall].radiance(end), met: wall }
        }
    };
    (0..side * side).map(pixel).collect()
}
