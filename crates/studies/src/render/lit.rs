//! Radiance of spheres in an environment.

use std::f64::consts::PI;

use rayon::prelude::*;
use serde::Serialize;

use super::sphere::{Pixel, Place, pixel};
use super::{Environment, Materials};
use lobefit::report::Image;
use lobefit_formula::perceptual::Aimed;
use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, normalise, plus, scaled};
use lobefit_truth::optics::ggx;

/// How spheres are shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// Pixels along a side of the picture.
    pub side: usize,
    /// Pixels along the sphere's radius.
    pub radius: f64,
    /// Directions at each pixel and half, drawn by the cosine, and as many by the lobe's visible
    /// normals.
    pub samples: u32,
    /// Directions at each pixel and half, for each lamp.
    pub lamp_samples: u32,
    /// Radiance around the sphere.
    pub background: [f64; 3],
}

/// Two independent pictures of the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Halves(pub [Image; 2]);

impl Halves {
    /// Their mean, which is the picture.
    pub fn mean(&self) -> Image {
        let [a, b] = &self.0;
        let pixels = a.pixels.iter().zip(&b.pixels).map(|(a, b)| scaled(plus(*a, *b), 0.5)).collect();
        Image { width: a.width, height: a.height, pixels }
    }

    /// Sums over the pixels of the square of the mean's standard error, estimated as (difference of
    /// the halves)^2/4, and of the mean's square, over all channels: their quotient is the square
    /// of the relative noise.
    pub fn noise(&self) -> [f64; 2] {
        let [a, b] = &self.0;
        let pairs = || a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
        let error: Vec<f64> = pairs().map(|(a, b)| (a - b) * (a - b) / 4.0).collect();
        let light: Vec<f64> = pairs().map(|(a, b)| (a + b) * (a + b) / 4.0).collect();
        [&error, &light].map(|x| lobefit_math::sum::pairwise(x))
    }
}

/// A picture of a sphere of each material, all under the same directions. `alpha` is the GGX width
/// that directions are drawn for, in (0, 1]; a material may be any other lobe and is then noisier.
/// At the sphere's edge a pixel is the mean of several places.
pub fn spheres(
    environment: &Environment,
    alpha: f64,
    materials: &dyn Materials,
    settings: &Settings,
) -> Vec<Halves> {
    let side = settings.side;
    let lamps = environment.lamps.iter().map(Aimed::new).collect();
    let sampler = Sampler { environment, lamps, alpha, settings };
    let rows: Vec<Vec<[Vec<[f64; 3]>; 2]>> = (0..side)
        .into_par_iter()
        .map(|row| {
            let pixels: Vec<Pixel> =
                (0..side).map(|column| pixel(column, row, side, settings.radius)).collect();
            let halves = |half| pixels.iter().enumerate().map(move |(i, p)| (i, p, half));
            let shown = [0, 1].map(|half| {
                halves(half).map(|(i, p, half)| sampler.pixel(p, (row * side + i) as u32, half, materials))
            });
            let [first, second] = shown.map(|half| half.collect::<Vec<Vec<[f64; 3]>>>());
            (0..materials.count())
                .map(|m| [&first, &second].map(|half| half.iter().map(|pixel| pixel[m]).collect()))
                .collect()
        })
        .collect();
    let picture = |m: usize, half: usize| {
        let pixels = rows.iter().flat_map(|row| row[m][half].iter().copied()).collect();
        Image { width: side, height: side, pixels }
    };
    (0..materials.count()).map(|m| Halves([0, 1].map(|half| picture(m, half)))).collect()
}

/// Whether each pixel of such a picture sees a part of the sphere, row by row.
pub fn inside(settings: &Settings) -> Vec<bool> {
    let side = settings.side;
    (0..side * side).map(|i| !pixel(i % side, i / side, side, settings.radius).places.is_empty()).collect()
}

/// A number that looks random: the finaliser "lowbias32" of Wellons 2018.
fn mixed(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// What draws directions and weighs them.
struct Sampler<'a> {
    environment: &'a Environment,
    lamps: Vec<Aimed>,
    alpha: f64,
    settings: &'a Settings,
}

impl Sampler<'_> {
    /// Radiance of a pixel for each material.
    fn pixel(&self, pixel: &Pixel, index: u32, half: u32, materials: &dyn Materials) -> Vec<[f64; 3]> {
        let beside = (pixel.taken - pixel.places.len()) as f64;
        let mut sums = vec![scaled(self.settings.background, beside); materials.count()];
        for (k, place) in pixel.places.iter().enumerate() {
            let seed = index.wrapping_mul(32).wrapping_add(2 * k as u32 + half);
            let lights = self.directions(place, seed, pixel.places.len());
            materials.shade(place.view, &lights, &mut sums);
        }
        sums.into_iter().map(|sum| scaled(sum, 1.0 / pixel.taken as f64)).collect()
    }

    /// Directions of the light about the normal with their weights: radiance times cosine over the
    /// density of all ways to draw it (the balance heuristic of Veach and Guibas 1995). Where a
    /// pixel has several places each gets a part of the samples.
    fn directions(&self, place: &Place, seed: u32, places: usize) -> Vec<(Vec3, [f64; 3])> {
        let part = |samples: u32| samples.div_ceil(places as u32);
        let (samples, lamp_samples) = (part(self.settings.samples), part(self.settings.lamp_samples));
        let mut drawn: Vec<Vec3> = Vec::new();
        let points = |way: u32| {
            let key = seed.wrapping_mul(16).wrapping_add(2 * way);
            Sobol::new([mixed(key), mixed(key + 1), 0])
        };
        let pair = |points: &Sobol, i: u32| (points.coordinate(i, 0), points.coordinate(i, 1));
        let (by_cosine, by_lobe) = (points(0), points(1));
        for i in 0..samples {
            let (u, v) = pair(&by_cosine, i);
            drawn.push(cosine(u, v));
            let (u, v) = pair(&by_lobe, i);
            let normal = ggx::visible_normal([self.alpha; 2], place.view, u, v);
            drawn.push(ggx::mirror(place.view, normal).0);
        }
        for (k, lamp) in self.lamps.iter().enumerate() {
            let points = points(2 + k as u32);
            drawn.extend((0..lamp_samples).map(|i| {
                let (u, v) = pair(&points, i);
                place.inward(lamp.draw(u, v))
            }));
        }
        let above = drawn.into_iter().filter(|light| light[2] > 0.0);
        let counts = [f64::from(samples), f64::from(lamp_samples)];
        above.map(|light| (light, self.weight(place, light, counts))).collect()
    }

    fn weight(&self, place: &Place, light: Vec3, [samples, lamp_samples]: [f64; 2]) -> [f64; 3] {
        let direction = place.outward(light);
        let (mut radiance, mut lamps) = (self.environment.sky(direction), 0.0);
        for (light, density) in self.lamps.iter().map(|lamp| lamp.seen(direction)) {
            (radiance, lamps) = (plus(radiance, light), lamps + density);
        }
        let density = samples * (light[2] / PI + self.lobe_density(place.view, light)) + lamp_samples * lamps;
        scaled(radiance, light[2] / density)
    }

    /// Density of a direction drawn by mirroring the view about a visible normal: G1(v) D(h)/(4
    /// mu).
    fn lobe_density(&self, view: Vec3, light: Vec3) -> f64 {
        let half = normalise(plus(view, light));
        let masking = 1.0 / (1.0 + ggx::lambda(self.alpha, view[2]));
        masking * ggx::distribution(self.alpha, half) / (4.0 * view[2])
    }
}

/// A direction about the axis z of the density cosine/pi, from two numbers in [0, 1).
fn cosine(u: f64, v: f64) -> Vec3 {
    let (s, c) = ops::sincos(2.0 * PI * u);
    [v.sqrt() * c, v.sqrt() * s, (1.0 - v).sqrt()]
}
