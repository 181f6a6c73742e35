//! Points at random in a room with what a lobe there sees, and how far lookups are from it.

use rayon::prelude::*;

use super::super::rooms::points::{self, points};
use crate::effects::parallax::{Faded, Shading, Slant, Width};
use crate::effects::room::cubemap::to_edge;
use crate::effects::room::{Convex, Fan, Fetch, Lookup, Room, Seen};
use crate::math::vector::{plus, scaled};
use crate::optics::kernel::Kernel;

/// What all engines bake.
pub(super) const KERNEL: Kernel = Kernel::HalfCosine;

/// Radii alpha d_s of a lobe on the wall within which an edge of the proxy is near.
pub(super) const NEAR: f64 = 2.0;

/// The points of a room under a roughness.
pub(super) struct Row {
    pub seen: Vec<Seen>,
    /// The lobe traced from each.
    pub light: Vec<[f64; 3]>,
    /// Whether its mirror ray ends near an edge.
    pub near: Vec<bool>,
}

/// A room with its points, row by row of roughness.
pub(super) struct Case<'a> {
    pub room: &'a Room,
    pub shape: Convex,
    pub rows: Vec<Row>,
}

impl<'a> Case<'a> {
    /// The reference is integrated with the directions of `fan`.
    pub fn new(room: &'a Room, points_of: &points::Parameters, roughness: &[f64], fan: &Fan) -> Case<'a> {
        let shape = room.shape();
        let points = points(room, points_of);
        let row = |roughness: &f64| {
            let alpha = roughness * roughness;
            let seen = points.iter().map(|point| Seen {
                place: point.place,
                normal: point.mirror,
                view: point.mirror,
                alpha,
            });
            let seen: Vec<Seen> = seen.collect();
            let light = seen.par_iter().map(|s| fan.lobe(room, s.place, s.view, None, alpha)).collect();
            let near = seen.iter().map(|seen| nearness(&shape, seen) < NEAR).collect();
            Row { seen, light, near }
        };
        let rows = roughness.iter().map(row).collect();
        Case { room, shape, rows }
    }

    /// One fetch.
    pub fn lookup(&self, slant: Slant, width: Width) -> Faded {
        let (proxy, probe) = (self.shape.clone(), self.room.probe);
        Faded { proxy, probe, shading: Shading::Mirror, slant, width }
    }
}

/// Distance of the end of a mirror ray from the nearest edge of its wall, in radii of the lobe on it; that of a ray that meets no wall is 0.
fn nearness(shape: &Convex, seen: &Seen) -> f64 {
    let Some((distance, wall)) = shape.exit(seen.place, seen.view) else { return 0.0 };
    let place = plus(seen.place, scaled(seen.view, distance));
    to_edge(shape, place, wall) / (seen.alpha * distance)
}

/// What a lookup shades the points with.
pub(super) fn shaded(row: &Row, lookup: &dyn Lookup, fetch: &dyn Fetch) -> Vec<[f64; 3]> {
    row.seen.par_iter().map(|seen| fetch.sum(&lookup.taps(seen))).collect()
}
