//! What is seen of the edges of the proxy in a mirror-like floor.

use rayon::prelude::*;
use serde::Serialize;

use super::measure::Case;
use super::viewpoints::Policy;
use crate::effects::parallax::Width;
use crate::effects::room::cubemap::Integrated;
use crate::effects::room::{Fan, Fetch, Lookup, Room, Seen};
use crate::math::ops;
use crate::math::vector::{Vec3, cross, dot, minus, normalise, plus, scaled};
use crate::report::{Image, SeamPicture, SeamRow};

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

    /// Displayed colours of every pixel; black where the floor is not.
    fn shown(&self, light: impl Fn(&Seen) -> [f64; 3] + Sync) -> Vec<[f64; 3]> {
        let one = |pixel: &Option<Pixel>| {
            let light = pixel.as_ref().map_or([0.0; 3], |pixel| light(&pixel.seen));
            light.map(|x| x / (1.0 + x))
        };
        self.pixels.par_iter().map(one).collect()
    }

    /// Mean magnitude of the second difference, along rows and columns, of the difference of two pictures' displayed luminance: where the
    /// three mirror rays meet different walls, and where they meet one.
    fn creases(&self, picture: &[[f64; 3]], reference: &[[f64; 3]]) -> [f64; 2] {
        let off: Vec<f64> =
            picture.iter().zip(reference).map(|(a, b)| displayed(*a) - displayed(*b)).collect();
        let (mut sums, mut counts) = ([0.0; 2], [0_u32; 2]);
        for step in [1, self.side] {
            for k in step..self.pixels.len() - step {
                // a row's ends have no neighbour in it
                if step == 1 && (k % self.side == 0 || k % self.side == self.side - 1) {
                    continue;
                }
                let [Some(a), Some(b), Some(c)] = [k - step, k, k + step].map(|k| self.pixels[k].as_ref())
                else {
                    continue;
                };
                let elsewhere = usize::from(a.wall == b.wall && b.wall == c.wall);
                sums[elsewhere] += (off[k - step] - 2.0 * off[k] + off[k + step]).abs();
                counts[elsewhere] += 1;
            }
        }
        [0, 1].map(|i| sums[i] / f64::from(counts[i].max(1)))
    }
}

fn mirror(seen: &Seen) -> Vec3 {
    minus(scaled(seen.normal, 2.0 * dot(seen.normal, seen.view)), seen.view)
}

/// sRGB's curve of the luminance (IEC 61966-2-1) of a colour in [0, 1].
fn displayed(colour: [f64; 3]) -> f64 {
    let linear = dot([0.2126, 0.7152, 0.0722], colour);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * ops::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// Pictures of the floor of a room by every law of a bake, the reference first, with their creases.
pub(super) fn seams(case: &Case, fan: &Fan, policies: &[Policy], view: &View, roughness: f64) -> SeamRow {
    let alpha = roughness * roughness;
    let floor = Floor::new(case.room, view, alpha);
    let traced = |seen: &Seen| fan.lobe(case.room, seen.place, mirror(seen), Some(seen.normal), alpha);
    let reference = floor.shown(traced);
    let mut pictures = vec![SeamPicture {
        policy: "traced from the floor (reference)".into(),
        edge: 0.0,
        elsewhere: 0.0,
        picture: image(view.side, &reference),
    }];
    for (name, viewpoint, slant) in policies {
        let lookup = case.lookup(*slant, Width::Rational);
        let exact = Integrated { room: case.room, proxy: &case.shape, viewpoint: *viewpoint, fan };
        let shown = floor.shown(|seen| exact.sum(&lookup.taps(seen)));
        let [edge, elsewhere] = floor.creases(&shown, &reference);
        pictures.push(SeamPicture {
            policy: name.clone(),
            edge,
            elsewhere,
            picture: image(view.side, &shown),
        });
    }
    SeamRow { room: case.room.name.clone(), roughness, pictures }
}

fn image(side: usize, pixels: &[[f64; 3]]) -> Image {
    Image { width: side, height: side, pixels: pixels.to_vec() }
}
