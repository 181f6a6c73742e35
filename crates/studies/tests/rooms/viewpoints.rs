//! Texels that see a room from elsewhere than the probe, and ratios that fade at the edges of its
//! proxy.

use lobefit::effects::parallax::{Corrected, Ratio, Shading, TapRule, Width, width};
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};
use lobefit_studies::study::parallax::room::cubemap::{Integrated, Viewpoint, direction, to_edge};
use lobefit_studies::study::parallax::room::proxies::Body;
use lobefit_studies::study::parallax::room::{
    Faded, Fetch, Lookup, Patches, Room, Seen, Slant, Tap, octagon, room_a, room_b,
};
use lobefit_truth::optics::kernel::Kernel;

/// Directions all around, none of them along an edge.
fn around() -> impl Iterator<Item = Vec3> {
    let n = 15;
    (0..6 * n * n).map(move |k| {
        let at = [k % n, k / n % n].map(|i| (2.0 * i as f64 + 1.03) / n as f64 - 1.0);
        direction(k / (n * n), at)
    })
}

#[test]
fn viewpoints_see_what_the_probe_sees() {
    for room in [room_a(), room_b(), octagon()] {
        let shape = room.shape();
        for towards in around() {
            let (far, wall) = room.exit(room.probe, towards);
            let place = plus(room.probe, scaled(towards, far));
            let normal = shape.planes[wall].normal;
            for (viewpoint, alpha) in [
                (Viewpoint::Probe, 0.2),
                (Viewpoint::Perpendicular, 1e-3),
                (Viewpoint::Perpendicular, 0.2),
                (Viewpoint::Sliding { widths: 1.0 }, 0.02),
                (Viewpoint::Sliding { widths: 3.0 }, 0.9),
            ] {
                let eye = viewpoint.eye(&shape, room.probe, towards, alpha);
                assert!(
                    shape.planes.iter().all(|p| p.depth(eye.place) > -1e-12),
                    "{viewpoint:?} {towards:?}"
                );
                let (near, met) = room.exit(eye.place, eye.axis);
                let again = plus(eye.place, scaled(eye.axis, near));
                assert!(length(minus(again, place)) < 1e-9 && met == wall, "{viewpoint:?} {towards:?}");
                assert!(eye.alpha > 0.0 && eye.alpha <= 1.0);
                // the footprint of a narrow lobe on the wall is as large as the probe's
                let area =
                    |alpha: f64, distance: f64, cosine: f64| alpha * alpha * distance * distance / cosine;
                if alpha < 0.01 && dot(normal, towards) > 0.02 {
                    let ratio =
                        area(eye.alpha, near, dot(normal, eye.axis)) / area(alpha, far, dot(normal, towards));
                    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
                }
            }
            ends_of_sliding(&room, towards, far, place, wall);
        }
    }
}

/// Above the wall far from edges, at the probe near them, half way where an edge is a radius away.
fn ends_of_sliding(room: &Room, towards: Vec3, far: f64, place: Vec3, wall: usize) {
    let shape = room.shape();
    let radii = to_edge(&shape, place, wall) / far;
    let sliding = |alpha: f64| Viewpoint::Sliding { widths: 1.0 }.eye(&shape, room.probe, towards, alpha);
    let above = Viewpoint::Perpendicular.eye(&shape, room.probe, towards, 0.1);
    assert!(length(minus(above.axis, shape.planes[wall].normal)) < 1e-12);
    assert!(length(minus(sliding(radii * 1e-9).place, above.place)) < 1e-6);
    assert!(length(minus(sliding(radii * 1e9).place, room.probe)) < 1e-6);
    let middle = scaled(plus(room.probe, above.place), 0.5);
    assert!(length(minus(sliding(radii).place, middle)) < 1e-9);
}

#[test]
fn a_lookup_needs_not_know_the_law_of_the_bake() {
    // from the point through the probe to the viewpoint, or at once
    for alpha in [0.01, 0.1, 0.3] {
        for (first, second) in [(0.3, 0.7), (1.4, 0.5), (0.6, 1.5)] {
            let through = width(width(alpha, first), second);
            assert!((through / width(alpha, first * second) - 1.0).abs() < 1e-12);
        }
    }
}

/// The perpendicular texel by an integral over the areas of the walls.
#[test]
fn the_perpendicular_texel_is_an_integral_over_the_walls() {
    let room = room_a();
    let towards = normalise([1.0, 0.45, 0.2]);
    // the probe's lobe is 0.3 wide, as far away as (3, 1.35, 0.6), 3 from the wall: both footprints
    // are as large
    let far = length([3.0, 1.35, 0.6]);
    let alpha = width(0.3, far / 3.0 * (far / 3.0).sqrt());
    // the wall x = 3 at (1.35, 0.6), from the middle of the box in x
    let eye = [0.0, 1.35, 0.6];
    let lobe = Kernel::HalfCosine.lobe(alpha);
    let (mut sum, mut whole) = ([0.0; 3], 0.0);
    let half = [3.0, 2.0, 1.5];
    let n = 700;
    for wall in 0..6 {
        let axis = wall / 2;
        let [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
        for k in 0..n * n {
            let mut at = [0.0; 3];
            at[axis] = if wall % 2 == 0 { half[axis] } else { -half[axis] };
            at[a] = half[a] * ((2 * (k % n) + 1) as f64 / n as f64 - 1.0);
            at[b] = half[b] * ((2 * (k / n) + 1) as f64 / n as f64 - 1.0);
            let ray = minus(at, eye);
            let distance = length(ray);
            let cosine = ray[0] / distance;
            if cosine > 0.0 {
                let area = 4.0 * half[a] * half[b] / (n * n) as f64;
                let seen = ray[axis].abs() / distance * area / (distance * distance);
                let weight = lobe.per_solid_angle((1.0 - cosine) / (1.0 + cosine)) * seen;
                sum = plus(sum, scaled(room.seen(eye, scaled(ray, 1.0 / distance)), weight));
                whole += weight;
            }
        }
    }
    assert!((whole - 1.0).abs() < 1e-3, "{whole}");
    let (exact, proxy) = (Patches::new(&room), room.shape());
    let exact =
        Integrated { proxy: &proxy, probe: room.probe, viewpoint: Viewpoint::Perpendicular, exact: &exact };
    let found = exact.fetch(&Tap { towards, alpha: 0.3, weight: 1.0 });
    assert!(length(minus(found, sum)) < 0.01 * length(sum), "{found:?} {sum:?}");
}

fn lookup(room: &Room, slant: Slant) -> Faded {
    let (proxy, probe) = (room.shape(), room.probe);
    Faded { proxy, probe, shading: Shading::Mirror, slant, width: Width::Rational }
}

fn head_on(place: Vec3, mirror: Vec3, alpha: f64) -> Seen {
    Seen { place, normal: mirror, view: mirror, alpha }
}

#[test]
fn ratios_that_do_not_fade_are_the_plain_ones() {
    let room = room_b();
    let place = [1.5, -0.4, 0.3];
    for mirror in around() {
        for (slant, ratio) in [(Slant::Ignored, Ratio::Distance), (Slant::Whole, Ratio::Area)] {
            let plain = Corrected {
                proxy: Body::new(&room.shape(), room.probe).expect("a probe inside"),
                probe: room.probe,
                shading: Shading::Mirror,
                rule: TapRule::one(),
                ratio,
                width: Width::Rational,
            };
            let seen = head_on(place, mirror, 0.2);
            let (found, wanted) = (lookup(&room, slant).taps(&seen), plain.taps(&seen));
            assert_eq!((found.len(), wanted.len()), (1, 1));
            assert!((found[0].alpha / wanted[0].alpha - 1.0).abs() < 1e-9, "{mirror:?}");
            assert!(length(minus(found[0].towards, wanted[0].towards)) < 1e-12);
        }
    }
}

#[test]
fn ratios_that_fade_do_not_jump_at_edges_and_others_do() {
    let room = octagon();
    let (place, mirror) = ([-1.2, 0.9, 0.2], normalise([0.8, 0.1, 0.02]));
    let widths = |slant: Slant| -> Vec<f64> {
        let lookup = lookup(&room, slant);
        // across the edge of a wall and the roof
        let at = |i: usize| normalise(plus(mirror, [0.0, 0.0, (i as f64 - 1000.0) * 2e-4]));
        (0..2000).map(|i| lookup.taps(&head_on(place, at(i), 0.2))[0].alpha).collect()
    };
    let jump = |values: &[f64]| values.windows(2).map(|w| (w[1] / w[0] - 1.0).abs()).fold(0.0, f64::max);
    let whole = jump(&widths(Slant::Whole));
    assert!(whole > 0.05, "{whole}");
    for slant in [Slant::Ignored, Slant::Fading { widths: 1.0 }, Slant::Fading { widths: 4.0 }] {
        let found = jump(&widths(slant));
        assert!(found < 3e-3, "{slant:?}: {found}");
    }
}

#[test]
fn rays_that_meet_nothing_are_fetched_as_they_are() {
    let room = room_a();
    // from outside, away from the room
    let seen = head_on([9.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.3);
    let taps = lookup(&room, Slant::Fading { widths: 2.0 }).taps(&seen);
    assert_eq!(taps, [Tap { towards: [1.0, 0.0, 0.0], alpha: 0.3, weight: 1.0 }]);
    // a probe on a wall sees that wall from where it stands
    let eye = Viewpoint::Perpendicular.eye(&room.shape(), [3.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.3);
    assert_eq!((eye.place, eye.alpha), ([3.0, 0.0, 0.0], 0.3));
}
