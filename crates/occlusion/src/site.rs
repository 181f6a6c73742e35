//! What is looked at, and from where: a procedural world, or the mesh of a file.

use rayon::prelude::*;

use crate::camera::Place;
use crate::raster::{Cuboid, Solids};
use crate::world::{BOUNDS, objects, world};
use lobefit::scene::Generator;
use lobefit_import::Mesh;

/// Boxes that are tested in each frame, at most.
const BOXES: usize = 8000;
/// Metres of an eye above what it stands on, of what is free above a place to stand, and between an
/// eye and what its path ends at.
const EYE: f32 = 1.7;
const HEADROOM: f32 = 2.2;
const APART: f32 = 0.5;
/// Starts of paths along a side of the footprint, and places along a side that are tried for each start.
const PLACES: usize = 3;
const TRIED: usize = 4;
/// Triangles of a primitive that an object of its own bounds, as renderers cull clusters.
const CLUSTER: usize = 8;

/// A site of the study: metres, z up.
#[derive(Clone, Debug)]
pub struct Site {
    /// What is drawn.
    pub solids: Solids,
    /// Boxes that are tested against buffers. They are not drawn.
    pub objects: Vec<Cuboid>,
    /// What a grid of voxels spans.
    pub bounds: Cuboid,
    /// Where paths start: row by row along x.
    pub starts: [Start; PLACES * PLACES],
}

/// Where a path starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The eye.
    pub eye: Place,
    /// Metres along y, to both sides, in which nothing is in its way.
    pub room: f64,
}

impl Site {
    /// A procedural world, its paths from the crossings of its streets.
    pub fn generated(kind: Generator, seed: u32) -> Site {
        let start = |i: usize| {
            let [x, y] = [i % PLACES, i / PLACES].map(|n| 32.0 * (n + 1) as f32);
            Start { eye: [x, y, EYE], room: f64::INFINITY }
        };
        Site {
            solids: Solids { boxes: world(kind, seed), triangles: Vec::new() },
            objects: objects(seed, BOXES),
            bounds: BOUNDS,
            starts: std::array::from_fn(start),
        }
    }

    /// A mesh of a file. Objects are the bounds of its primitives, and of each cluster of triangles
    /// of one that has several; paths start in each ninth of its footprint where most room is.
    pub fn of_mesh(mesh: &Mesh) -> Site {
        // glTF has y up.
        let upright = |[x, y, z]: [f32; 3]| [x, -z, y];
        let triangles: Vec<[Place; 3]> = mesh.triangles.iter().map(|corners| corners.map(upright)).collect();
        let parts = mesh.parts.iter().flat_map(|part| {
            let own = &triangles[part.clone()];
            let clusters = own.chunks(CLUSTER).filter(|one| one.len() < own.len());
            std::iter::once(bounds(own)).chain(clusters.map(bounds))
        });
        let objects: Vec<Cuboid> = parts.collect();
        let every = objects.len().div_ceil(BOXES).max(1);
        let tight = bounds(&triangles);
        let start = |i: usize| start(&triangles, &tight, [i % PLACES, i / PLACES]);
        let starts: Vec<Start> = (0..PLACES * PLACES).into_par_iter().map(start).collect();
        Site {
            objects: objects.into_iter().step_by(every).collect(),
            bounds: widened(&tight),
            starts: std::array::from_fn(|i| starts[i]),
            solids: Solids { boxes: Vec::new(), triangles },
        }
    }
}

/// The box about triangles.
fn bounds(triangles: &[[Place; 3]]) -> Cuboid {
    let empty = Cuboid { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };
    triangles.iter().flatten().fold(empty, |Cuboid { low, high }, corner| Cuboid {
        low: [0, 1, 2].map(|k| low[k].min(corner[k])),
        high: [0, 1, 2].map(|k| high[k].max(corner[k])),
    })
}

/// The same with a margin: the upper borders of a grid are not in it, and what is flat has a height.
fn widened(of: &Cuboid) -> Cuboid {
    let margin = [0, 1, 2].map(|k| 0.5_f32.max(0.005 * (of.high[k] - of.low[k])));
    Cuboid { low: [0, 1, 2].map(|k| of.low[k] - margin[k]), high: [0, 1, 2].map(|k| of.high[k] + margin[k]) }
}

/// The start in a ninth of the footprint: of the places that are tried the one with most room, the
/// first of several.
fn start(triangles: &[[Place; 3]], within: &Cuboid, ninth: [usize; 2]) -> Start {
    let tried = (0..TRIED * TRIED).map(|i| {
        let part = [i % TRIED, i / TRIED];
        let at = |k: usize| {
            let t = (ninth[k] as f32 + (part[k] as f32 + 0.5) / TRIED as f32) / PLACES as f32;
            within.low[k] + t * (within.high[k] - within.low[k])
        };
        let eye = standing(triangles, [at(0), at(1)], within.low[2]);
        let hits = hits(triangles, 1, [eye[2], eye[0]]);
        let free = hits.iter().map(|(y, _)| (y - eye[1]).abs()).fold(f32::INFINITY, f32::min);
        // The mesh ends the path too: nothing is seen from beyond it.
        let free = free.min(eye[1] - within.low[1]).min(within.high[1] - eye[1]);
        Start { eye, room: f64::from((free - APART).max(0.0)) }
    });
    tried
        .reduce(|best, one| if one.room > best.room { one } else { best })
        .unwrap_or(Start { eye: within.low, room: 0.0 })
}

/// An eye above the lowest surface at a place that looks up and has room above it: not within a solid,
/// whose lower surface looks down. Of a mesh whose faces look the other way, above the lowest with room,
/// or else above the highest.
fn standing(triangles: &[[Place; 3]], [x, y]: [f32; 2], lowest: f32) -> Place {
    let mut surfaces = hits(triangles, 2, [x, y]);
    surfaces.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let above = |i: usize| surfaces.get(i + 1).map_or(f32::INFINITY, |(height, _)| height - surfaces[i].0);
    let roomy: Vec<usize> = (0..surfaces.len()).filter(|i| above(*i) >= HEADROOM).collect();
    let ground = roomy.iter().find(|i| surfaces[**i].1).or(roomy.first());
    [x, y, ground.map_or(lowest, |i| surfaces[*i].0) + EYE]
}

/// Coordinates along an axis at which a line along it meets triangles, and whether their faces look along
/// it; `at` are its places along the next axis and the one after that.
fn hits(triangles: &[[Place; 3]], axis: usize, at: [f32; 2]) -> Vec<(f32, bool)> {
    let [u, v] = [1, 2].map(|k| (axis + k) % 3);
    let meets = |corners: &[Place; 3]| {
        let flat = corners.map(|corner| [corner[u] - at[0], corner[v] - at[1]]);
        let areas = [0, 1, 2].map(|i| {
            let (a, b) = (flat[(i + 1) % 3], flat[(i + 2) % 3]);
            a[0] * b[1] - a[1] * b[0]
        });
        let inside = areas.iter().all(|x| *x >= 0.0) || areas.iter().all(|x| *x <= 0.0);
        let whole = areas[0] + areas[1] + areas[2];
        let place = || (0..3).map(|i| areas[i] * corners[i][axis]).sum::<f32>() / whole;
        (inside && whole != 0.0).then(|| (place(), whole > 0.0))
    };
    triangles.iter().filter_map(meets).collect()
}
