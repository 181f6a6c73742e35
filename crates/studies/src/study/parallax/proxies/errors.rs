//! What one fetch through a proxy is off by at points at random, against the same lobe traced from
//! the point.

use rayon::prelude::*;

use super::super::measures::{relative, relative_where};
use super::super::rooms::points::{self, Point};
use crate::study::parallax::room::proxies::Body;
use crate::study::parallax::room::{Fetch, Meeting, Patches, Proxy, Room, Tap};
use lobefit_math::vector::{Vec3, length, minus, plus, scaled};
use lobefit_truth::optics::footprint::{area_ratio, width};

/// Points of a room with the truth at a width.
pub(super) struct Sample<'a> {
    probe: Vec3,
    exact: &'a Patches<'a>,
    alpha: f64,
    points: Vec<Known>,
}

/// A point.
struct Known {
    point: Point,
    /// What the round lobe sees.
    truth: [f64; 3],
    /// Whether the lobe reaches over an edge: another plane is nearer to where its axis ends than
    /// the lobe is wide there.
    edge: bool,
}

/// Root of the sum of squared errors over that of squared values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Off {
    pub all: f64,
    /// Where the lobe reaches over an edge.
    pub edges: f64,
}

impl<'a> Sample<'a> {
    /// Of some points at a width; `None` where the probe is not inside.
    pub fn new(
        room: &Room,
        exact: &'a Patches<'a>,
        wanted: &points::Parameters,
        alpha: f64,
    ) -> Option<Sample<'a>> {
        let body = Body::new(&room.shape(), room.probe)?;
        let known = |point: Point| {
            let Point { place, mirror, .. } = point;
            let truth = exact.lobe(place, mirror, alpha);
            Known { point, truth, edge: reaches(&body, place, mirror, alpha) }
        };
        let points = points::points(room, wanted).into_par_iter().map(known).collect();
        Some(Sample { probe: room.probe, exact, alpha, points })
    }

    /// Of all points, how many reach over an edge.
    pub fn edges(&self) -> [usize; 2] {
        [self.points.len(), self.points.iter().filter(|known| known.edge).count()]
    }

    /// The error of a proxy.
    pub fn off(&self, proxy: &dyn Proxy) -> Off {
        let of = |known: &Known| (self.fetched(proxy, &known.point), known.truth);
        let (fetched, truth): (Vec<Vec3>, Vec<Vec3>) = self.points.par_iter().map(of).unzip();
        let edges = relative_where(&fetched, &truth, |i| self.points[i].edge);
        Off { all: relative(&fetched, &truth), edges }
    }

    fn fetched(&self, proxy: &dyn Proxy, Point { place, mirror, .. }: &Point) -> [f64; 3] {
        self.exact.fetch(&tap(proxy, self.probe, *place, *mirror, self.alpha))
    }
}

/// One fetch: the rational width by the ratio of areas, or along the ray where nothing is met.
fn tap(proxy: &dyn Proxy, probe: Vec3, place: Vec3, ray: Vec3, alpha: f64) -> Tap {
    let seen = proxy.meet(place, ray, alpha).and_then(|hit| looked_up(&hit, ray, probe));
    let (towards, ratio) = seen.unwrap_or((ray, 1.0));
    Tap { towards, alpha: width(alpha, ratio), weight: 1.0 }
}

/// Direction and ratio of areas by the distance that a proxy states: that of a faded one is not the
/// distance to its place. `None` where the place is the probe's own.
pub(super) fn looked_up(hit: &Meeting, ray: Vec3, probe: Vec3) -> Option<(Vec3, f64)> {
    let away = minus(hit.place, probe);
    let distance = length(away);
    let towards = scaled(away, 1.0 / distance);
    (distance > 0.0).then(|| (towards, area_ratio(hit.normal, (ray, hit.distance), (towards, distance))))
}

/// Whether the axis of a lobe ends nearer to a second plane than the lobe is wide there.
fn reaches(body: &Body, place: Vec3, ray: Vec3, alpha: f64) -> bool {
    let Some(hit) = body.meet(place, ray, alpha) else { return false };
    let end = plus(place, scaled(ray, hit.distance));
    let wide = alpha * hit.distance;
    body.planes().iter().filter(|plane| plane.normal != hit.normal).any(|plane| plane.depth(end) < wide)
}
