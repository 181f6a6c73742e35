//! Pictures of a glossy plane in a room.

use rayon::prelude::*;
use serde::Serialize;

use super::super::creases::{Creases, creases, detail};
use super::super::measures::relative;
use super::methods::Method;
use super::random::halves;
use super::view::{Camera, Pixel, pixels};
use crate::flip::{self, ErrorMap};
use crate::study::parallax::findings::{RoomPicture, RoomPictureRow, RoomPictures};
use crate::study::parallax::room::{Fetch, Fineness, GgxRays, Lookup, Patches, Room, Seen};
use crate::study::{Size, StudyError};
use lobefit::report::Image;
use lobefit_math::sum;
use lobefit_math::vector::{Vec3, plus, scaled};

/// What is pictured.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    /// Cameras, each in a room by its place in the list.
    pub cameras: Vec<(usize, Camera)>,
    /// Pixels along each side.
    pub side: usize,
    pub roughness: Vec<f64>,
    /// Visible normals of each half of a GGX reference.
    pub directions: u32,
    /// Exposure, in stops.
    pub stops: f64,
    pub pixels_per_degree: f64,
    /// Roughnesses whose pictures are shown, of the first camera.
    pub shown: Vec<f64>,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        let camera = |name: &str, plane, from, to| Camera { name: name.into(), plane, from, to, field: 70.0 };
        let cameras = vec![
            (0, camera("room A, floor", -1.5, [-2.4, -1.3, 0.2], [0.9, 0.6, -1.5])),
            (0, camera("room A, plane at 0.8", -0.7, [-2.4, -1.3, 0.9], [0.9, 0.6, -0.7])),
            (1, camera("room B, floor", -1.25, [-4.6, -0.7, 0.35], [-0.4, 0.3, -1.25])),
            (2, camera("octagon, floor", -1.5, [-2.2, -0.9, 0.2], [0.7, 0.4, -1.5])),
        ];
        Parameters {
            cameras: if full { cameras } else { cameras.into_iter().take(1).collect() },
            side: if full { 72 } else { 16 },
            roughness: if full { vec![0.15, 0.25, 0.35, 0.5, 0.7, 0.9] } else { vec![0.5] },
            directions: if full { 1024 } else { 256 },
            stops: -1.0,
            pixels_per_degree: 30.0,
            shown: if full { vec![0.15, 0.35, 0.7] } else { vec![0.5] },
        }
    }
}

/// The two references, each in two halves.
struct Truths {
    /// The round lobe, and GGX.
    halves: [[Vec<Vec3>; 2]; 2],
}

/// All cameras.
pub(super) fn pictures(
    rooms: &[Room],
    methods: &[Method],
    parameters: &Parameters,
) -> Result<Vec<RoomPictures>, StudyError> {
    let rays = halves(parameters.directions);
    let seen = parameters.cameras.iter().filter_map(|(room, camera)| Some((rooms.get(*room)?, camera)));
    seen.enumerate()
        .map(|(i, (room, camera))| scene(room, camera, methods, (parameters, &rays, i == 0)))
        .collect()
}

fn scene(
    room: &Room,
    camera: &Camera,
    methods: &[Method],
    (parameters, rays, shown): (&Parameters, &[GgxRays; 2], bool),
) -> Result<RoomPictures, StudyError> {
    let pixels = pixels(room, camera, parameters.side);
    let exact = Patches::new(room);
    let cut = || Patches::above(room, [0.0, 0.0, camera.plane], UP);
    let lobes = [cut(), cut().with(Fineness::Fine)];
    let seen: Vec<usize> = (0..pixels.len()).filter(|&i| pixels[i].place.is_some()).collect();
    let mut all = RoomPictures {
        name: camera.name.clone(),
        side: parameters.side,
        pixels: seen.len(),
        roughness: parameters.roughness.clone(),
        noise: [Vec::new(), Vec::new()],
        flip_of_noise: [Vec::new(), Vec::new()],
        detail: [Vec::new(), Vec::new()],
        rows: Vec::new(),
        shown: Vec::new(),
    };
    let names =
        methods.iter().map(|m| (m.name.clone(), m.fetches)).chain([("exact round lobe".to_string(), 0)]);
    all.rows = names.map(|(name, fetches)| RoomPictureRow::new(name, fetches)).collect();
    for &roughness in &parameters.roughness {
        let show = shown && parameters.shown.contains(&roughness);
        let light = Light { exact: &exact, lobes: &lobes, rays };
        Column { room, parameters, light, pixels: &pixels, seen: &seen, alpha: roughness * roughness }
            .add(&mut all, methods, show)?;
    }
    Ok(all)
}

/// How it is integrated.
#[derive(Clone, Copy)]
struct Light<'a> {
    /// Fetches.
    exact: &'a Patches<'a>,
    /// The round lobe cut off at the plane, coarse and fine.
    lobes: &'a [Patches<'a>; 2],
    /// The two halves of GGX.
    rays: &'a [GgxRays; 2],
}

/// Pictures of one roughness.
struct Column<'a> {
    room: &'a Room,
    parameters: &'a Parameters,
    light: Light<'a>,
    pixels: &'a [Pixel],
    /// Pixels that reflect.
    seen: &'a [usize],
    alpha: f64,
}

impl Column<'_> {
    fn add(&self, all: &mut RoomPictures, methods: &[Method], show: bool) -> Result<(), StudyError> {
        let truths = self.truths();
        let whole = [0, 1].map(|r| mean(&truths.halves[r]));
        let prepared = [0, 1].map(|r| self.displayed(&whole[r]));
        for r in 0..2 {
            let [a, b] = &truths.halves[r];
            all.noise[r].push(0.5 * relative(a, b));
            all.flip_of_noise[r].push(self.flip(&self.displayed(a), &self.displayed(b))?.0);
        }
        let met: Vec<Option<usize>> = self.pixels.iter().map(|p| p.place.map(|_| p.met)).collect();
        let own = detail(&prepared[0], &met);
        all.detail[0].push(own.edges);
        all.detail[1].push(own.elsewhere);
        let lookups = methods.iter().map(|method| method.lookup(self.room));
        let lookups = lookups.collect::<Result<Vec<Box<dyn Lookup>>, _>>()?;
        let mut values: Vec<Vec<Vec3>> = lookups.iter().map(|lookup| self.fetched(lookup.as_ref())).collect();
        values.push(whole[0].clone());
        let mut shown = Vec::new();
        for (row, values) in all.rows.iter_mut().zip(&values) {
            let picture = self.displayed(values);
            let [lobe, surface] = [0, 1].map(|r| self.flip(&prepared[r], &picture));
            let (lobe, surface) = (lobe?, surface?);
            row.flip[0].push(lobe.0);
            row.flip[1].push(surface.0);
            (0..2).for_each(|r| row.l2[r].push(relative(values, &whole[r])));
            let Creases { edges, elsewhere } = creases(&picture, &prepared[0], &met);
            row.edges.push(edges);
            row.elsewhere.push(elsewhere);
            if show {
                shown.push((picture, [lobe.1.values, surface.1.values]));
            }
        }
        if show {
            let (pictures, maps): (Vec<_>, Vec<_>) = shown.into_iter().unzip();
            let references = prepared.to_vec();
            all.shown.push(RoomPicture { roughness: self.alpha.sqrt(), references, pictures, maps });
        }
        Ok(())
    }

    fn at(&self, pixel: usize) -> Option<Seen> {
        let Pixel { place, view, .. } = self.pixels[pixel];
        Some(Seen { place: place?, normal: UP, view, alpha: self.alpha })
    }

    fn truths(&self) -> Truths {
        let lobe = |half: usize| {
            self.each(|seen, mirror| self.light.lobes[half].lobe(seen.place, mirror, self.alpha))
        };
        let surface = |half: usize| self.each(|seen, _| self.light.rays[half].reflected(self.room, seen));
        Truths { halves: [[0, 1].map(lobe), [0, 1].map(surface)] }
    }

    fn fetched(&self, lookup: &dyn Lookup) -> Vec<Vec3> {
        self.each(|seen, _| self.light.exact.sum(&lookup.taps(seen)))
    }

    /// Of every pixel that reflects, by its shading point and mirror direction.
    fn each(&self, value: impl Fn(&Seen, Vec3) -> Vec3 + Sync) -> Vec<Vec3> {
        let of = |&i: &usize| self.at(i).map(|seen| value(&seen, self.pixels[i].mirror));
        let values: Vec<Option<Vec3>> = self.seen.par_iter().map(of).collect();
        values.into_iter().flatten().collect()
    }

    /// The whole picture through the tone mapper: walls as they are, the plane with these values.
    fn displayed(&self, values: &[Vec3]) -> Image {
        let mut pixels: Vec<Vec3> = self.pixels.iter().map(|pixel| pixel.wall).collect();
        for (&i, value) in self.seen.iter().zip(values) {
            pixels[i] = *value;
        }
        let side = self.parameters.side;
        flip::shown(&Image { width: side, height: side, pixels }, self.parameters.stops)
    }

    /// Mean FLIP over the pixels that reflect, and its map.
    fn flip(&self, reference: &Image, test: &Image) -> Result<(f64, ErrorMap), StudyError> {
        let map = flip::ldr(reference, test, self.parameters.pixels_per_degree)?;
        let on: Vec<f64> = self.seen.iter().map(|&i| map.values[i]).collect();
        Ok((sum::mean(&on), map))
    }
}

/// The normal of every plane.
const UP: Vec3 = [0.0, 0.0, 1.0];

fn mean([a, b]: &[Vec<Vec3>; 2]) -> Vec<Vec3> {
    a.iter().zip(b).map(|(a, b)| scaled(plus(*a, *b), 0.5)).collect()
}
