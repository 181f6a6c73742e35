//! What methods are off by at points at random.

use rayon::prelude::*;
use serde::Serialize;

use super::super::measures::{geometric_mean, relative};
use super::methods::{FROSTBITE, Method};
use super::points::{self, Point};
use crate::study::parallax::findings::{RandomReference, RandomRoom, RandomRow};
use crate::study::parallax::room::{Fetch, Fineness, GgxRays, Lookup, Patches, Room, Seen};
use crate::study::{Size, StudyError};
use lobefit_math::sum;
use lobefit_math::vector::{Vec3, minus, normalise, plus, scaled};

/// What is measured.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    pub points: points::Parameters,
    /// Roots of alpha.
    pub roughness: Vec<f64>,
    /// Visible normals of each half of a GGX reference.
    pub directions: u32,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        Parameters {
            points: points::Parameters::of(size),
            roughness: if full { vec![0.15, 0.25, 0.35, 0.5, 0.7, 0.9] } else { vec![0.25, 0.7] },
            directions: if full { 1024 } else { 256 },
        }
    }
}

/// What a reference is: the round lobe alone, or a surface's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reference {
    Lobe,
    Surface,
}

impl Reference {
    /// Both.
    pub const ALL: [Reference; 2] = [Reference::Lobe, Reference::Surface];

    fn name(self) -> &'static str {
        match self {
            Reference::Lobe => "round lobe",
            Reference::Surface => "GGX",
        }
    }

    /// The shading point of a point: seen head on where there is no surface, so that nothing leans
    /// and no ray leaves below it.
    pub fn seen(self, point: &Point, alpha: f64) -> Seen {
        let Point { place, mirror, normal, .. } = *point;
        match self {
            Reference::Lobe => Seen { place, normal: mirror, view: mirror, alpha },
            Reference::Surface => {
                let view =
                    normalise(minus(scaled(normal, 2.0 * lobefit_math::vector::dot(normal, mirror)), mirror));
                Seen { place, normal, view, alpha }
            }
        }
    }
}

/// The two halves of GGX references.
pub(super) fn halves(directions: u32) -> [GgxRays; 2] {
    [4, 5].map(|seed| GgxRays::new(directions, seed))
}

/// One room under both references.
pub(super) fn measured(
    room: &Room,
    methods: &[Method],
    parameters: &Parameters,
    rays: &[GgxRays; 2],
) -> Result<RandomRoom, StudyError> {
    let points = points::points(room, &parameters.points);
    let lookups = methods.iter().map(|method| method.lookup(room)).collect::<Result<Vec<_>, _>>()?;
    let references = Reference::ALL.map(|reference| {
        let columns: Vec<Column> = parameters
            .roughness
            .iter()
            .map(|r| column(room, &lookups, (reference, r * r), &points, rays))
            .collect();
        let rows = methods.iter().enumerate().map(|(i, method)| RandomRow {
            name: method.name.clone(),
            fetches: method.fetches,
            l2: columns.iter().map(|c| c.l2[i]).collect(),
            mae: columns.iter().map(|c| c.mae[i]).collect(),
            least_l2: columns.iter().map(|c| c.l2[FROSTBITE] / c.l2[i]).fold(f64::INFINITY, f64::min),
            gain_l2: geometric_mean(columns.iter().map(|c| c.l2[FROSTBITE] / c.l2[i])),
            gain_mae: geometric_mean(columns.iter().map(|c| c.mae[FROSTBITE] / c.mae[i])),
        });
        RandomReference {
            name: reference.name().into(),
            noise: columns.iter().map(|c| c.noise).collect(),
            rows: rows.collect(),
        }
    });
    Ok(RandomRoom {
        room: room.name.clone(),
        roughness: parameters.roughness.clone(),
        references: references.into(),
    })
}

/// Errors of one roughness under one reference, by method.
struct Column {
    noise: f64,
    l2: Vec<f64>,
    mae: Vec<f64>,
}

fn column(
    room: &Room,
    lookups: &[Box<dyn Lookup>],
    (reference, alpha): (Reference, f64),
    points: &[Point],
    rays: &[GgxRays; 2],
) -> Column {
    let exact = Patches::new(room);
    let lobes = [Patches::new(room), Patches::new(room).with(Fineness::Fine)];
    let all: Vec<([Vec3; 2], Vec<Vec3>)> = points
        .par_iter()
        .map(|point| {
            let seen = reference.seen(point, alpha);
            let halves = [0, 1].map(|half| match reference {
                Reference::Lobe => lobes[half].lobe(seen.place, point.mirror, alpha),
                Reference::Surface => rays[half].reflected(room, &seen),
            });
            (halves, lookups.iter().map(|lookup| exact.sum(&lookup.taps(&seen))).collect())
        })
        .collect();
    let truth: Vec<Vec3> = all.iter().map(|([a, b], _)| scaled(plus(*a, *b), 0.5)).collect();
    let of = |i: usize| -> Vec<Vec3> { all.iter().map(|(_, values)| values[i]).collect() };
    let halves = [0, 1].map(|half| all.iter().map(|(halves, _)| halves[half]).collect::<Vec<Vec3>>());
    let indices = 0..lookups.len();
    Column {
        // each half has twice the variance of the mean, their difference four times; a coarse lobe
        // and a fine one differ by twice what their mean is off by
        noise: 0.5 * relative(&halves[0], &halves[1]),
        l2: indices.clone().map(|i| relative(&of(i), &truth)).collect(),
        mae: indices.map(|i| shown(&of(i), &truth)).collect(),
    }
}

/// Mean absolute difference of the channels through x/(1 + x).
fn shown(values: &[Vec3], truth: &[Vec3]) -> f64 {
    let mapped = |x: f64| x / (1.0 + x);
    let errors: Vec<f64> = values
        .iter()
        .zip(truth)
        .flat_map(|(v, t)| [0, 1, 2].map(|c| (mapped(v[c]) - mapped(t[c])).abs()))
        .collect();
    sum::mean(&errors)
}
