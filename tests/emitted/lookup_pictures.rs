//! Pictures by lookups as emitted, beside those by the study's.

use crate::lookup_support::{EMITTED, Point, found, single};
use lobefit::report::Image;
use lobefit_math::vector::{Vec3, cross, minus, normalise, plus, scaled};
use lobefit_shade::code::Language;
use lobefit_studies::flip;
use lobefit_studies::study::parallax::room::{Fetch, Patches, Tap, octagon};

/// The floor of a room as fetches from its probe show it, in light that a screen has: by the
/// emitted function, and by the study's lookup.
#[test]
fn pictures_by_emitted_lookups_are_those_of_the_study() {
    const SIDE: usize = 28;
    let room = single(octagon());
    let (from, to) = ([-2.2, -0.9, 0.2], [0.7, 0.4, -1.5]);
    let forward = normalise(minus(to, from));
    let right = normalise([forward[1], -forward[0], 0.0]);
    let up = cross(right, forward);
    let point = |i: usize| {
        let at = |k: usize| 0.7 * ((2 * k + 1) as f64 / SIDE as f64 - 1.0);
        let ray = normalise(plus(forward, plus(scaled(right, at(i % SIDE)), scaled(up, -at(i / SIDE)))));
        let place = plus(from, scaled(ray, (-1.5 - from[2]) / ray[2]));
        let shown = ray[2] < 0.0 && room.walls.iter().all(|wall| wall.plane.depth(place) > -1e-6);
        shown.then_some((place, ray))
    };
    let seen: Vec<Option<(Vec3, Vec3)>> = (0..SIDE * SIDE).map(point).collect();
    let exact = Patches::new(&room);
    for (name, taps) in [
        ("parallax_lookup_planes_11_smooth_1", 1_usize),
        ("parallax_lookup_planes_11_smooth_3", 3),
        ("parallax_lookup_planes_11_smooth_3_fitted", 3),
    ] {
        let emitted = EMITTED.iter().find(|one| one.name() == name).expect("the lookup");
        for roughness in [0.2_f32, 0.5, 0.9] {
            let alpha = roughness * roughness;
            let points: Vec<Point> = seen
                .iter()
                .flatten()
                .map(|(place, ray)| {
                    let [p, r] = [place, ray].map(|v| v.map(|x| x as f32));
                    // the mirror ray, or the view
                    let [x, y, z] =
                        if name.ends_with("fitted") { [-r[0], -r[1], -r[2]] } else { [r[0], r[1], -r[2]] };
                    [p[0], p[1], p[2], 0.0, 0.0, 1.0, x, y, z, alpha]
                })
                .collect();
            let found = found(Language::Rust, &[(emitted, &points[..])]).expect("rustc is there").concat();
            let mut fetched =
                points.iter().zip(found.chunks_exact(emitted.numbers())).map(|(point, found)| {
                    let ours = emitted.all_expected(point)?;
                    let fetch = |towards, alpha: f64, weight| {
                        scaled(exact.fetch(&Tap { towards, alpha: alpha.max(1e-6), weight: 1.0 }), weight)
                    };
                    let theirs = (0..taps).fold([0.0; 3], |sum, i| {
                        let [x, y, z, width] = [0, 1, 2, 3].map(|k| f64::from(found[4 * i + k]));
                        let weight = if taps == 1 { 1.0 } else { f64::from(found[4 * taps + i]) };
                        plus(sum, fetch([x, y, z], width, weight))
                    });
                    let ours = ours
                        .iter()
                        .fold([0.0; 3], |sum, one| plus(sum, fetch(one.towards, one.width, one.weight)));
                    Some([ours, theirs])
                });
            let mut pixels: Vec<[Vec3; 2]> = Vec::new();
            for one in &seen {
                pixels.push(one.and_then(|_| fetched.next().flatten()).unwrap_or([[0.2; 3]; 2]));
            }
            let [ours, theirs] = [0, 1].map(|k| {
                let image =
                    Image { width: SIDE, height: SIDE, pixels: pixels.iter().map(|pair| pair[k]).collect() };
                flip::shown(&image, 0.0)
            });
            let off = flip::ldr(&ours, &theirs, flip::PIXELS_PER_DEGREE).expect("a difference");
            let worst = off.values.iter().fold(0.0_f64, |worst, x| worst.max(*x));
            assert!(worst < 0.02, "{name}, roughness {roughness}: FLIP up to {worst}");
            let different = pixels.windows(2).filter(|pair| pair[0] != pair[1]).count();
            assert!(different > SIDE * SIDE / 3, "{name}: a picture of nothing");
        }
    }
}
