//! The renderer of the studies: spheres whose radiance is known.

use std::f64::consts::{FRAC_1_PI, TAU};

use lobefit::data::Smith;
use lobefit::report::Image;
use lobefit_math::ops;
use lobefit_studies::render::{Environment, Halves, Materials, Settings, diffuse_light, inside, spheres};
use lobefit_truth::integrate::reflection::reflection;
use lobefit_truth::optics::ggx::{self, Vec3};

const SETTINGS: Settings =
    Settings { side: 21, radius: 9.0, samples: 64, lamp_samples: 16, background: [0.25; 3] };

/// A white Lambertian surface, and a lossy GGX lobe of alpha with F = 1.
struct Pair(f64);

impl Materials for Pair {
    fn count(&self) -> usize {
        2
    }

    fn shade(&self, view: Vec3, lights: &[(Vec3, [f64; 3])], sums: &mut [[f64; 3]]) {
        for (light, weight) in lights {
            let sum = [0, 1, 2].map(|i| light[i] + view[i]);
            let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
            let half = sum.map(|x| x / length);
            let masking = 1.0 + ggx::lambda(self.0, light[2]) + ggx::lambda(self.0, view[2]);
            let lobe = ggx::distribution(self.0, half) / (4.0 * light[2] * view[2] * masking);
            for (sum, f) in sums.iter_mut().zip([FRAC_1_PI, lobe]) {
                *sum = [0, 1, 2].map(|c| sum[c] + f * weight[c]);
            }
        }
    }
}

fn shown(environment: &Environment, alpha: f64, settings: &Settings) -> Vec<Halves> {
    spheres(environment, alpha, &Pair(alpha), settings)
}

/// The normal at the middle of a pixel whose whole area lies on the sphere.
fn normal(image: &Image, i: usize) -> Option<Vec3> {
    let (x, y) = ((i % image.width) as f64 + 0.5 - 10.5, 10.5 - (i / image.width) as f64 - 0.5);
    let (x, y) = (x / SETTINGS.radius, y / SETTINGS.radius);
    let square = x * x + y * y;
    (square < 0.7).then(|| [x, y, (1.0 - square).sqrt()])
}

/// In light of radiance 1 a white sphere is white and a GGX lobe shows its albedo.
#[test]
fn the_furnace_shows_the_albedo() {
    for alpha in [0.04, 0.3, 1.0] {
        let shown = shown(&Environment::furnace(), alpha, &SETTINGS);
        let [white, lobe] = [0, 1].map(|m| shown[m].mean());
        let (mut seen, mut mean) = (0, [0.0; 2]);
        for i in 0..white.pixels.len() {
            let Some(n) = normal(&white, i) else { continue };
            let e = reflection(Smith::Correlated, alpha, n[2], 1e-6).expect("an albedo").e;
            let departures = [white.pixels[i][0] - 1.0, lobe.pixels[i][0] - e];
            assert!(departures.iter().all(|d| d.abs() < 0.05), "alpha {alpha}, mu {}: {departures:?}", n[2]);
            mean = [0, 1].map(|m| mean[m] + departures[m]);
            seen += 1;
        }
        assert!(seen > 150, "{seen} pixels");
        assert!(mean.iter().all(|m| m.abs() / f64::from(seen) < 2e-3), "alpha {alpha}: {mean:?} of {seen}");
    }
}

/// A Lambertian sphere under the environment, against the quadrature at its normals.
#[test]
fn a_white_sphere_shows_the_light_that_falls_on_it() {
    let environment = Environment::afternoon();
    let white = shown(&environment, 0.5, &Settings { samples: 512, lamp_samples: 128, ..SETTINGS })[0].mean();
    let lamps = environment.lamps.clone();
    for i in 0..white.pixels.len() {
        let Some(n) = normal(&white, i) else { continue };
        // Where a lamp sets, one pixel holds lit and dark places.
        let sets = lamps.iter().any(|lamp| {
            let length = lamp.towards.iter().map(|x| x * x).sum::<f64>().sqrt();
            let height = (0..3).map(|k| lamp.towards[k] * n[k]).sum::<f64>() / length;
            height.abs() < 0.35
        });
        if sets {
            continue;
        }
        let light = diffuse_light(&environment, n);
        for c in 0..3 {
            let ratio = white.pixels[i][c] / light[c];
            assert!((ratio - 1.0).abs() < 0.03, "normal {n:?}, channel {c}: {ratio}");
        }
    }
    for n in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-0.6, 0.0, 0.8]] {
        let furnace = diffuse_light(&Environment::furnace(), n);
        assert!(furnace.iter().all(|x| (x - 1.0).abs() < 1e-12), "{furnace:?}");
    }
}

/// 1/pi int L max(n.l, 0) dl by sums over even cells: of sky and ground over height and azimuth of
/// the directions, of each lamp over angle and azimuth about its own axis.
fn by_cells(environment: &Environment, normal: Vec3) -> [f64; 3] {
    let bare = Environment { lamps: Vec::new(), ..environment.clone() };
    let mut light = [0.0; 3];
    let mut add = |radiance: [f64; 3], direction: Vec3, angle: f64| {
        let cosine: f64 = (0..3).map(|i| direction[i] * normal[i]).sum();
        for c in 0..3 {
            light[c] += radiance[c] * cosine.max(0.0) * angle * FRAC_1_PI;
        }
    };
    let steps = 2400;
    let about = |k: usize| ops::sincos(TAU * (k as f64 + 0.5) / 400.0);
    for i in 0..steps {
        let height = -1.0 + 2.0 * (i as f64 + 0.5) / steps as f64;
        let flat = (1.0 - height * height).sqrt();
        for k in 0..400 {
            let (sin, cos) = about(k);
            let direction = [flat * cos, height, flat * sin];
            add(bare.radiance(direction), direction, 2.0 / steps as f64 * TAU / 400.0);
        }
    }
    for lamp in &environment.lamps {
        let length = lamp.towards.iter().map(|x| x * x).sum::<f64>().sqrt();
        let axis = lamp.towards.map(|x| x / length);
        // any two directions at right angles to it
        let side = {
            let [x, _, z] = axis;
            let l = (x * x + z * z).sqrt();
            [z / l, 0.0, -x / l]
        };
        let up = [
            axis[1] * side[2] - axis[2] * side[1],
            axis[2] * side[0] - axis[0] * side[2],
            axis[0] * side[1] - axis[1] * side[0],
        ];
        let depth = 1.0 - ops::cos(lamp.degrees.to_radians());
        for i in 0..400 {
            let cosine = 1.0 - depth * (f64::from(i) + 0.5) / 400.0;
            let sine = (1.0 - cosine * cosine).sqrt();
            for k in 0..400 {
                let (sin, cos) = about(k);
                let direction = [0, 1, 2].map(|c| cosine * axis[c] + sine * (cos * side[c] + sin * up[c]));
                add(lamp.radiance, direction, depth / 400.0 * TAU / 400.0);
            }
        }
    }
    light
}

/// The light of a Lambertian surface in closed form against sums: where all lamps are seen, where
/// one sets, where all are behind it.
#[test]
fn the_light_of_a_place_is_its_integral() {
    let mut broad = Environment::afternoon();
    broad.lamps[1].degrees = 80.0;
    for environment in [Environment::afternoon(), broad] {
        let axis = environment.lamps[1].towards;
        // almost at right angles to the cloud, which then is cut by the horizon
        let across = [axis[1] + 0.05, -axis[0], 0.02];
        for n in [
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [-0.6, 0.0, 0.8],
            [0.3, -0.5, 0.2],
            across,
            axis,
        ] {
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
            let n = n.map(|x| x / length);
            let (found, expected) = (diffuse_light(&environment, n), by_cells(&environment, n));
            for c in 0..3 {
                let off = found[c] / expected[c] - 1.0;
                assert!(off.abs() < 1e-4, "normal {n:?}, channel {c}: {} {}", found[c], expected[c]);
            }
        }
    }
}

#[test]
fn the_background_is_beside_the_sphere_alone() {
    let white = shown(&Environment::furnace(), 0.5, &SETTINGS)[0].mean();
    let sphere = inside(&SETTINGS);
    assert_eq!(white.pixels[0], SETTINGS.background);
    for (pixel, inside) in white.pixels.iter().zip(&sphere) {
        assert!(*inside || *pixel == SETTINGS.background, "{pixel:?}");
    }
    let area = sphere.iter().filter(|x| **x).count() as f64;
    assert!(area > 254.0 && area < 254.0 + 60.0, "pi 9^2 and the pixels of its rim: {area}");
}

/// Four times the samples: the halves agree better, at the least by the half that independent
/// samples give.
#[test]
fn noise_falls_with_samples_and_bytes_do_not_depend_on_threads() {
    let environment = Environment::afternoon();
    let noise = |samples, lamp_samples| {
        let settings = Settings { samples, lamp_samples, ..SETTINGS };
        shown(&environment, 0.1, &settings).iter().map(|h| h.noise()).map(|[e, l]| (e / l).sqrt()).collect()
    };
    let (few, many): (Vec<f64>, Vec<f64>) = (noise(16, 8), noise(64, 32));
    for (few, many) in few.iter().zip(&many) {
        assert!(*many > 0.0 && *many < 0.6 * few, "{few} to {many}");
    }
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| shown(&environment, 0.1, &SETTINGS))
    };
    assert_eq!(on(1), on(3));
}
