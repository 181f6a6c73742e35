//! What is seen of the edges of the proxy in a mirror-like floor.

use rayon::prelude::*;
use serde::Serialize;

use super::super::creases::{Creases, creases, detail};
use super::measure::Case;
use super::viewpoints::Policy;
use crate::flip;
use crate::study::StudyError;
use crate::study::parallax::findings::{SeamPicture, SeamRow};
use crate::study::parallax::room::cubemap::Integrated;
use crate::study::parallax::room::{Fetch, Fineness, Patches, Room, Seen};
use lobefit::report::Image;
use lobefit_math::vector::{Vec3, cross, dot, minus, normalise, plus, scaled};

/// A view of the floor.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct View {
    /// Pixels along a side.
    pub side: usize,
    /// The camera, in parts of the way from the probe to the walls along the axes.
    pub camera: Vec3,
    /// Where it looks, likewise.
    pub target: Vec3,
    /// Tangent of half the angle of view.
    pub half: f64,
    /// Exposure, in stops.
    pub stops: f64,
}

/// A pixel that shows the floor, and the wall that its mirror ray meets.
struct Pixel {
    seen: Seen,
    wall: usize,
}

/// A picture of the floor by pixel; none where another wall is seen.
struct Floor {
    side: usize,
    pixels: Vec<Option<Pixel>>,
}

/// A place by the parts of the way from the probe to the walls along the axes.
fn place(room: &Room, parts: Vec3) -> Vec3 {
    let moved = |axis: usize| {
        let mut towards = [0.0; 3];
        towards[axis] = if parts[axis] < 0.0 { -1.0 } else { 1.0 };
        room.probe[axis] + parts[axis] * room.exit(room.probe, towards).0
    };
    [moved(0), moved(1), moved(2)]
}

impl Floor {
    fn new(room: &Room, view: &View, alpha: f64) -> Floor {
        let camera = place(room, view.camera);
        let forward = normalise(minus(place(room, view.target), camera));
        let right = normalise(cross(forward, [0.0, 0.0, 1.0]));
        let up = cross(right, forward);
        let pixel = |k: usize| {
            let at = [k % view.side, k / view.side].map(|i| (2.0 * i as f64 + 1.0) / view.side as f64 - 1.0);
            let across = plus(scaled(right, at[0] * view.half), scaled(up, -at[1] * view.half));
            let ray = normalise(plus(forward, across));
            let (distance, floor) = room.exit(camera, ray);
            let normal = scaled(room.walls[floor].plane.normal, -1.0);
            if normal[2] < 0.99 {
                return None;
            }
            let seen =
                Seen { place: plus(camera, scaled(ray, distance)), normal, view: scaled(ray, -1.0), alpha };
            let (_, wall) = room.exit(seen.place, mirror(&seen));
            Some(Pixel { seen, wall })
        };
        Floor { side: view.side, pixels: (0..view.side * view.side).map(pixel).collect() }
    }

    /// Every pixel through the tone mapper; black where the floor is not.
    fn shown(&self, stops: f64, light: impl Fn(&Seen) -> [f64; 3] + Sync) -> Image {
        let one = |pixel: &Option<Pixel>| pixel.as_ref().map_or([0.0; 3], |pixel| light(&pixel.seen));
        let pixels = self.pixels.par_iter().map(one).collect();
        flip::shown(&Image { width: self.side, height: self.side, pixels }, stops)
    }

    /// The wall that each pixel's mirror ray meets.
    fn met(&self) -> Vec<Option<usize>> {
        self.pixels.iter().map(|pixel| pixel.as_ref().map(|pixel| pixel.wall)).collect()
    }
}

fn mirror(seen: &Seen) -> Vec3 {
    minus(scaled(seen.normal, 2.0 * dot(seen.normal, seen.view)), seen.view)
}

/// Pictures of the floor of a room by every law of a bake, the reference first, with their creases.
pub(super) fn seams(
    case: &Case,
    policies: &[Policy],
    view: &View,
    roughness: f64,
) -> Result<SeamRow, StudyError> {
    let alpha = roughness * roughness;
    let floor = Floor::new(case.room, view, alpha);
    let met = floor.met();
    let up = [0.0, 0.0, 1.0];
    let below = case.room.exit(case.room.probe, [0.0, 0.0, -1.0]).0;
    let cut = Patches::above(case.room, minus(case.room.probe, scaled(up, below)), up);
    let traced =
        |patches: &Patches| floor.shown(view.stops, |seen| patches.lobe(seen.place, mirror(seen), alpha));
    let coarse = traced(&cut);
    let reference = traced(&cut.with(Fineness::Fine));
    let row = |policy: &str, Creases { edges, elsewhere }: Creases, picture: Image| SeamPicture {
        policy: policy.into(),
        edge: edges,
        elsewhere,
        picture,
    };
    let noise = creases(&coarse, &reference, &met);
    let own = detail(&reference, &met);
    let mut pictures = vec![row("traced from the floor (reference): its own", own, reference.clone())];
    for policy in policies {
        let lookup = policy.lookup(case)?;
        let exact = Integrated {
            probe: case.room.probe,
            proxy: &case.shape,
            viewpoint: policy.viewpoint,
            exact: &case.exact,
        };
        let shown = floor.shown(view.stops, |seen| exact.sum(&lookup.taps(seen)));
        pictures.push(row(&policy.name, creases(&shown, &reference, &met), shown));
    }
    Ok(SeamRow { room: case.room.name.clone(), roughness, noise: [noise.edges, noise.elsewhere], pictures })
}
