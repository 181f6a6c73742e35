//! Lobes integrated in a room without samples.
//!
//! A room is made of patches of even light, so that what a lobe sees of it is a sum over the edges
//! between them. With phi the azimuth about the lobe's axis, E the share of its energy inside a
//! cone ([`Lobe::encircled`](lobefit_truth::optics::kernel::Lobe::encircled)) and G = 1 - E, the
//! energy in a patch is the integral of E dphi/(2 pi) around it (Green's theorem on the sphere),
//! and the mean radiance
//!
//!   L(axis) - sum over edges of (L left - L right) int G dphi/(2 pi),
//!
//! exact but for the rule that takes the integrals along edges. Of the cosine-weighted kernel
//! alone: its G is 0 behind the horizon of the axis, so that half of the room drops out.

mod flux;
mod walls;

use super::super::Plane;
use super::super::light::Room;
use super::super::{Fetch, Tap};
use flux::{Block, View, total};
use lobefit_math::vector::{Vec3, dot, normalise, plus, scaled, tangents};

/// How finely edges are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Fineness {
    /// Off by some 1e-4 of the light at worst, 1e-5 as a rule.
    Usual,
    /// By a tenth of that: what the usual one is off by is seen beside it.
    Fine,
}

/// A room as the edges of its patches, for lobes of the kernel `half-cosine` from any place inside.
#[derive(Clone, Debug)]
pub struct Patches<'a> {
    room: &'a Room,
    /// What is below this plane is left out.
    above: Option<Plane>,
    blocks: Vec<Block>,
    fineness: Fineness,
}

/// How far the axis is turned, in radians: an edge that runs through it exactly would be on neither
/// side. Far above the rounding of directions, far below what is seen.
const ASIDE: [f64; 2] = [0.73e-11, 0.41e-11];

impl<'a> Patches<'a> {
    /// All of a room, whose walls have axes of unit length at right angles.
    pub fn new(room: &'a Room) -> Patches<'a> {
        Patches { room, above: None, blocks: walls::blocks(room, None), fineness: Fineness::Usual }
    }

    /// What of it is above a plane through `place` with the unit normal `up`: the lobes of places
    /// on that plane, axes above it, are cut off there, and what is left is weighted up.
    pub fn above(room: &'a Room, place: Vec3, up: Vec3) -> Patches<'a> {
        let plane = Plane::through(place, up);
        let blocks = walls::blocks(room, Some(plane));
        Patches { room, above: Some(plane), blocks, fineness: Fineness::Usual }
    }

    /// The same, divided otherwise.
    pub fn with(self, fineness: Fineness) -> Patches<'a> {
        Patches { fineness, ..self }
    }

    /// Mean radiance of the lobe of a width in (0, 1] about `axis`, of unit length, from a place
    /// inside.
    pub fn lobe(&self, place: Vec3, axis: Vec3, alpha: f64) -> [f64; 3] {
        let [x, y] = tangents(axis);
        let axis = normalise(plus(axis, plus(scaled(x, ASIDE[0]), scaled(y, ASIDE[1]))));
        let [x, y] = tangents(axis);
        let view = View::new(place, [x, y, axis], alpha, self.fineness);
        let [r, g, b, covered] = total(&self.blocks, &view);
        let centre = self.room.seen(place, axis);
        let light = [centre[0] - r, centre[1] - g, centre[2] - b];
        match self.above {
            None => light,
            // a lobe whose axis is below has nothing there but what reaches above
            Some(plane) if dot(plane.normal, axis) <= 0.0 => scaled([-r, -g, -b], -1.0 / covered),
            Some(_) => scaled(light, 1.0 / (1.0 - covered)),
        }
    }
}

/// Fetches from the room's probe.
impl Fetch for Patches<'_> {
    fn fetch(&self, tap: &Tap) -> [f64; 3] {
        self.lobe(self.room.probe, tap.towards, tap.alpha)
    }
}
