//! What becomes of a lookup as its ray passes over an edge of the room.

use std::f64::consts::PI;

use super::errors::looked_up;
use crate::study::parallax::findings::ProxyCrossing;
use crate::study::parallax::room::proxies::Body;
use crate::study::parallax::room::{Meeting, Proxy, Room};
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, length, minus, normalise, plus, scaled, tangents};

/// Turns of a ray about axes through a place: each passes over several edges.
const AXES: [Vec3; 3] = [[0.1, -0.2, 1.0], [1.0, 0.3, 0.2], [-0.2, 1.0, 0.1]];

/// Rays of a turn that are looked at for edges.
const RAYS: usize = 720;

/// Angle over which one-sided derivatives are taken, and how near to the edge both begin.
const STEP: f64 = 1e-4;
const NEAR: f64 = 1e-7;

/// A ray of a turn.
fn ray(axis: Vec3, angle: f64) -> Vec3 {
    let [a, b] = tangents(axis);
    let (sine, cosine) = ops::sincos(angle);
    normalise(plus(scaled(a, cosine), scaled(b, sine)))
}

/// The angles at which the rays of a turn pass over an edge of the planes.
fn edges(body: &Body, place: Vec3, axis: Vec3) -> Vec<f64> {
    let normal = |angle: f64| body.meet(place, ray(axis, angle), 0.0).map(|hit: Meeting| hit.normal);
    let angle = |k: usize| 2.0 * PI * k as f64 / RAYS as f64;
    let pass = |k: usize| {
        let (mut low, mut high) = (angle(k), angle(k + 1));
        if normal(low) == normal(high) {
            return None;
        }
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if normal(middle) == normal(low) { low = middle } else { high = middle }
        }
        Some(high)
    };
    (0..RAYS).filter_map(pass).collect()
}

/// Mean jumps over the edges that rays from a place of a room pass. `None` where a lookup fails.
pub(super) fn crossings(room: &Room, place: Vec3, proxy: &dyn Proxy, alpha: f64) -> Option<ProxyCrossing> {
    let body = Body::new(&room.shape(), room.probe)?;
    let (mut direction, mut ratio, mut slope, mut lobe, mut count) = (0.0, 0.0, 0.0, 0.0, 0);
    for axis in AXES.map(normalise) {
        let look = |angle: f64| {
            let ray = ray(axis, angle);
            let (towards, ratio) = looked_up(&proxy.meet(place, ray, alpha)?, ray, room.probe)?;
            Some((towards, ops::log(ratio)))
        };
        for edge in edges(&body, place, axis) {
            let [a, b, c, d] = [-NEAR - STEP, -NEAR, NEAR, NEAR + STEP].map(|off| look(edge + off));
            let (a, b, c, d) = (a?, b?, c?, d?);
            let before = scaled(minus(b.0, a.0), 1.0 / STEP);
            let after = scaled(minus(d.0, c.0), 1.0 / STEP);
            direction += length(minus(after, before));
            ratio += (c.1 - b.1).abs();
            slope += ((d.1 - c.1) / STEP - (b.1 - a.1) / STEP).abs();
            let [low, high] = [-0.1 * alpha, 0.1 * alpha].map(|off| look(edge + off));
            lobe += (high?.1 - low?.1).abs();
            count += 1;
        }
    }
    let mean = |sum: f64| sum / f64::from(count.max(1));
    Some(ProxyCrossing {
        proxy: String::new(),
        alpha,
        edges: count,
        direction: mean(direction),
        ratio: mean(ratio),
        slope: mean(slope),
        lobe: mean(lobe),
    })
}
