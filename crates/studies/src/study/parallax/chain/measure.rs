//! Points at random in a room with what a lobe there sees, and how far lookups are from it.

use rayon::prelude::*;

use super::super::measures::relative;
use super::super::rooms::points::{self, points};
use crate::study::parallax::room::cubemap::to_edge;
use crate::study::parallax::room::{Convex, Faded, Fetch, Fineness, Lookup, Patches, Room, Seen, Slant};
use lobefit::effects::parallax::{Shading, Width};
use lobefit_math::vector::{plus, scaled};
use lobefit_truth::optics::kernel::Kernel;

/// What all engines bake.
pub(super) const KERNEL: Kernel = Kernel::HalfCosine;

/// Radii alpha d_s of a lobe on the wall within which an edge of the proxy is near.
pub(super) const NEAR: f64 = 2.0;

/// The points of a room under a roughness.
pub(super) struct Row {
    pub seen: Vec<Seen>,
    /// The lobe traced from each.
    pub light: Vec<[f64; 3]>,
    /// What that is off by: its relative difference from a finer one.
    pub noise: f64,
    /// Whether its mirror ray ends near an edge.
    pub near: Vec<bool>,
}

/// A room with its points, row by row of roughness.
pub(super) struct Case<'a> {
    pub room: &'a Room,
    /// Lobes integrated.
    pub exact: Patches<'a>,
    pub shape: Convex,
    pub rows: Vec<Row>,
}

impl<'a> Case<'a> {
    /// With references.
    pub fn new(room: &'a Room, points_of: &points::Parameters, roughness: &[f64]) -> Case<'a> {
        let shape = room.shape();
        let exact = Patches::new(room);
        let fine = exact.clone().with(Fineness::Fine);
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
            let lobes = |from: &Patches| -> Vec<[f64; 3]> {
                seen.par_iter().map(|s| from.lobe(s.place, s.view, alpha)).collect()
            };
            let light = lobes(&fine);
            let noise = relative(&lobes(&exact), &light);
            let near = seen.iter().map(|seen| nearness(&shape, seen) < NEAR).collect();
            Row { seen, light, noise, near }
        };
        let rows = roughness.iter().map(row).collect();
        Case { room, exact, shape, rows }
    }

    /// One fetch.
    pub fn lookup(&self, slant: Slant, width: Width) -> Faded {
        let (proxy, probe) = (self.shape.clone(), self.room.probe);
        Faded { proxy, probe, shading: Shading::Mirror, slant, width }
    }
}

/// Distance of the end of a mirror ray from the nearest edge of its wall, in radii of the lobe on
/// it; that of a ray that meets no wall is 0.
fn nearness(shape: &Convex, seen: &Seen) -> f64 {
    let Some((distance, wall)) = shape.exit(seen.place, seen.view) else { return 0.0 };
    let place = plus(seen.place, scaled(seen.view, distance));
    to_edge(shape, place, wall) / (seen.alpha * distance)
}

/// What a lookup shades the points with.
pub(super) fn shaded(row: &Row, lookup: &dyn Lookup, fetch: &dyn Fetch) -> Vec<[f64; 3]> {
    row.seen.par_iter().map(|seen| fetch.sum(&lookup.taps(seen))).collect()
}
