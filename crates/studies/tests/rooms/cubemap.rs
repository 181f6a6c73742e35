//! The cubemap of a probe: directions, texels, seams, energy, and levels against a quadrature that
//! shares nothing with theirs.

use lobefit::data::{MipChain, MipMap};
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};
use lobefit_studies::study::parallax::room::cubemap::{Bake, Chain, Level, direction, face_of};
use lobefit_studies::study::parallax::room::{Fetch, Rays, Room, Tap, octagon, room_a, room_b};
use lobefit_truth::optics::kernel::Kernel;

fn bake(size: usize, levels: u32) -> Bake {
    Bake {
        kernel: Kernel::HalfCosine,
        map: MipChain::Mapped { map: MipMap::Linear, count: levels },
        size,
        samples: 4,
        rays: 64,
        seed: 7,
    }
}

/// Directions all around, a spiral with the golden angle.
fn around(count: usize) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (s, c) = ops::sincos(i as f64 * 2.399_963_229_728_653);
        let radius = (1.0 - z * z).sqrt();
        [radius * c, radius * s, z]
    })
}

fn largest(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
}

/// A room that shines alike everywhere.
fn even(radiance: [f64; 3]) -> Room {
    let mut room = octagon();
    for wall in &mut room.walls {
        wall.checker.radiance = [radiance; 2];
        for panel in &mut wall.panels {
            panel.radiance = radiance;
        }
    }
    room
}

#[test]
fn directions_and_places_go_there_and_back() {
    for towards in around(5000) {
        let (face, place) = face_of(towards);
        assert!(length(minus(direction(face, place), towards)) < 1e-15);
        assert!(place.iter().all(|c| c.abs() <= 1.0));
    }
    // the axes are in the middle of their faces, in the order of the graphics interfaces
    for face in 0..6 {
        let mut axis = [0.0; 3];
        axis[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
        assert_eq!(face_of(axis), (face, [0.0; 2]));
    }
    // s and t of +x point to -z and -y (OpenGL 4.6, table 8.19)
    assert!(length(minus(direction(0, [0.5, 0.25]), normalise([1.0, -0.25, -0.5]))) < 1e-15);
}

#[test]
fn an_even_room_is_even_in_every_texel_and_fetch() {
    // numbers of 16 bits, so that nothing is rounded
    let light = [0.75, 2.5, 7.0];
    let room = even(light);
    let chain = bake(8, 4).chain(&room).expect("a chain");
    assert_eq!(chain.levels().iter().map(Level::size).collect::<Vec<_>>(), [8, 4, 2, 1]);
    for (i, towards) in around(400).enumerate() {
        let tap = Tap { towards, alpha: (i as f64 + 0.5) / 400.0, weight: 1.0 };
        assert!(largest(chain.fetch(&tap), light) < 1e-14, "{tap:?}");
    }
    let tap = Tap { towards: [0.0, 0.0, 1.0], alpha: 0.3, weight: 0.25 };
    assert!(largest(chain.sum(&[tap, tap]), scaled(light, 0.5)) < 1e-14);
}

/// Solid angle of a rectangle of a face by its ends in s and t: that from the centre to a corner is
/// atan(s t/sqrt(1 + s^2 + t^2)).
fn solid_angle(s: [f64; 2], t: [f64; 2]) -> f64 {
    let corner = |s: f64, t: f64| ops::atan(s * t / (1.0 + s * s + t * t).sqrt());
    corner(s[1], t[1]) - corner(s[0], t[1]) - corner(s[1], t[0]) + corner(s[0], t[0])
}

/// The lobe by midpoints of the texels of a fine cubemap, without rays.
fn by_directions(room: &Room, axis: Vec3, alpha: f64) -> [f64; 3] {
    let (n, lobe) = (512, Kernel::HalfCosine.lobe(alpha));
    let ends = |i: usize| [i, i + 1].map(|e| 2.0 * e as f64 / f64::from(n as u32) - 1.0);
    let (mut sum, mut whole) = ([0.0; 3], 0.0);
    for k in 0..6 * n * n {
        let (face, j, i) = (k / (n * n), k / n % n, k % n);
        let (s, t) = (ends(i), ends(j));
        let towards = direction(face, [0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1])]);
        let cosine = dot(axis, towards);
        if cosine > 0.0 {
            let weight = lobe.per_solid_angle((1.0 - cosine) / (1.0 + cosine)) * solid_angle(s, t);
            sum = plus(sum, scaled(room.seen(room.probe, towards), weight));
            whole += weight;
        }
    }
    assert!((whole - 1.0).abs() < 1e-3, "the kernel is normalised: {whole}");
    sum
}

#[test]
fn texels_are_the_integral_of_the_lobe() {
    for room in [room_b(), octagon()] {
        let baked = Bake { rays: 32768, ..bake(4, 3) };
        let chain = baked.chain(&room).expect("a chain");
        for (level, face, i, j) in [(1, 0, 0, 1), (1, 3, 1, 1), (2, 4, 0, 0)] {
            let n = chain.levels()[level].size() as f64;
            let towards = direction(face, [i, j].map(|i| (2.0 * i as f64 + 1.0) / n - 1.0));
            let roughness = chain.map().roughness(level as f64);
            let wanted = by_directions(&room, towards, roughness * roughness);
            let found = chain.levels()[level].texel(face, i, j);
            assert!(largest(found, wanted) < 0.01 * wanted[0], "{level} {face}: {found:?} {wanted:?}");
            // the rays of the kernel's own quantiles
            let rays = Rays::new(&Kernel::HalfCosine, roughness * roughness, 16384, 5);
            let other = crate::rooms::lobe(&room, room.probe, towards, None, &rays);
            assert!(largest(found, other) < 0.01 * wanted[0], "{level} {face}: {found:?} {other:?}");
        }
    }
}

#[test]
fn a_capture_is_the_mean_over_its_texels() {
    let room = room_a();
    let chain = Bake { samples: 32, ..bake(8, 4) }.chain(&room).expect("a chain");
    // the middle of the ceiling's face: squares of 0.5 at distance 1.5, from (0, 0) to (0.375,
    // 0.375) one square, without a panel
    let texel = chain.levels()[0].texel(4, 4, 3);
    let seen = room.seen(room.probe, direction(4, [0.125, -0.125]));
    assert!(largest(texel, seen) < 1e-3, "{texel:?} {seen:?}");
}

/// The largest jump over steps of 1e-9 across the edges and corners of the cube.
fn jump(chain: &Chain, level: f64) -> f64 {
    let mut worst: f64 = 0.0;
    let tiny = 1e-9;
    for i in 0..200 {
        let along = 2.0 * (i as f64 + 0.5) / 200.0 - 1.0;
        for (a, b, c) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let at = |x: f64, y: f64, along: f64| {
                    let mut towards = [0.0; 3];
                    (towards[a], towards[b], towards[c]) = (x, y, along);
                    chain.at(normalise(towards), level)
                };
                worst = worst.max(largest(at(x * (1.0 + tiny), y, along), at(x, y * (1.0 + tiny), along)));
                let (low, high) = (1.0 - tiny, 1.0 + tiny);
                for corner in [[low, 1.0, high], [high, low, 1.0], [1.0, high, low]] {
                    let [x1, y1, z1] = corner;
                    worst = worst.max(largest(at(x * x1, y * y1, z1), at(x, y, high)));
                }
            }
        }
    }
    worst
}

#[test]
fn faces_are_continuous_across_their_edges() {
    let chain = bake(8, 4).chain(&room_a()).expect("a chain");
    for level in [0.0, 1.0, 1.5, 3.0] {
        let seamless = jump(&chain, level);
        assert!(seamless < 1e-6, "level {level}: {seamless}");
    }
}

#[test]
fn texels_are_rounded_to_16_bits() {
    let texels: Vec<[f64; 3]> =
        (0..24).map(|k| [0.1, 1.0 / 3.0, 7.7].map(|x| x * f64::from(k + 1))).collect();
    let level = Level::new(2, &texels).expect("in range");
    for (k, texel) in texels.iter().enumerate() {
        let stored = level.texel(k / 4, k % 2, k / 2 % 2);
        assert!((0..3).all(|c| (stored[c] / texel[c] - 1.0).abs() <= 1.0 / 2048.0), "{stored:?} {texel:?}");
        assert!(stored.iter().all(|x| half::f16::from_f64(*x).to_f64() == *x), "{stored:?}");
    }
}

#[test]
fn levels_are_fetched_by_the_map_of_the_chain() {
    let chain = bake(8, 4).chain(&room_a()).expect("a chain");
    let towards = normalise([0.3, -0.8, 0.4]);
    let at = |alpha: f64| chain.fetch(&Tap { towards, alpha, weight: 1.0 });
    // roughness 1/3 is level 1 of 0 to 3
    assert!(largest(at(1.0 / 9.0), chain.levels()[1].fetch(towards)) < 1e-12);
    assert!(largest(at(1.0), chain.levels()[3].fetch(towards)) < 1e-12);
    let between = scaled(plus(chain.at(towards, 1.0), chain.at(towards, 2.0)), 0.5);
    assert!(largest(at(0.25), between) < 1e-12);
}

#[test]
fn the_same_texels_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| bake(8, 4).chain(&room_b()).expect("a chain"))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn what_cannot_be_baked_is_refused_by_name() {
    let refused = |bake: Bake, room: &Room| bake.chain(room).expect_err("refused").to_string();
    let size = refused(bake(12, 4), &room_a());
    assert_eq!(size, "faces of 12 texels a side have no 4 levels; choose a size that 2^3 divides");
    assert!(refused(bake(0, 2), &room_a()).contains("faces of 0 texels"));
    assert!(refused(Bake { rays: 0, ..bake(8, 4) }, &room_a()).starts_with("rays is 0"));
    assert!(refused(Bake { samples: 0, ..bake(8, 4) }, &room_a()).starts_with("samples is 0"));
    let bright = refused(bake(8, 4), &even([1.0, 7e4, 1.0]));
    assert!(bright.contains("70000 is no finite number in 16 bits"), "{bright}");
    let few = Level::new(2, &[[0.0; 3]; 23]).expect_err("refused").to_string();
    assert_eq!(few, "a level of 2 texels a side has 24 texels, not 23");
    let level = Level::new(1, &[[0.0; 3]; 6]).expect("a level");
    let map = MipChain::Mapped { map: MipMap::Linear, count: 2 };
    let few = Chain::new(map, vec![level]).expect_err("refused").to_string();
    assert_eq!(few, "the map of the chain has 2 levels, not 1");
}
