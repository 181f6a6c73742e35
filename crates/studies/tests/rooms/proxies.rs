//! Proxies of rooms: where they must agree with one another, and that nothing about them is not a
//! number or jumps.

use lobefit_math::ops;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};
use lobefit_studies::study::parallax::room::proxies::{
    Body, Eased, Faded, Law, NEAREST, Pushed, Rounded, Smooth, Tied,
};
use lobefit_studies::study::parallax::room::{Convex, Meeting, Plane, Proxy, Room, octagon, room_a, room_b};

const POINTS: u32 = 3000;

fn body(room: &Room) -> Body {
    Body::new(&room.shape(), room.probe).expect("a probe inside")
}

fn rooms() -> [Room; 3] {
    [room_a(), room_b(), octagon()]
}

fn constant(value: f64) -> Law {
    Law::Constant { value }
}

fn smooth(room: &Room, power: f64) -> Smooth {
    Smooth { body: body(room), power: constant(power) }
}

fn rounded(room: &Room, radius: f64) -> Rounded {
    Rounded { body: body(room), radius: constant(radius) }
}

/// All families with parameters from nothing to far beyond use.
fn families(room: &Room) -> Vec<(String, Box<dyn Proxy>)> {
    let mut all: Vec<(String, Box<dyn Proxy>)> = vec![
        ("planes".into(), Box::new(body(room))),
        ("by eye".into(), Box::new(Smooth { body: body(room), power: Smooth::BY_EYE })),
        ("eased".into(), Box::new(Eased { body: body(room) })),
        ("tied".into(), Box::new(Tied { body: body(room), tie: Tied::FITTED })),
    ];
    for power in [1.5, 2.0, 4.0, 17.3, 256.0, 1e6] {
        all.push((format!("smooth {power}"), Box::new(smooth(room, power))));
    }
    for radius in [0.0, 1e-6, 0.1, 0.5, 1.0] {
        all.push((format!("rounded {radius}"), Box::new(rounded(room, radius))));
    }
    for least in [0.0, 0.3, 4.0, 1e6] {
        all.push((format!("pushed {least}"), Box::new(Pushed { body: body(room), least: constant(least) })));
    }
    for share in [0.0, 0.2, 1.0] {
        all.push((format!("faded {share}"), Box::new(Faded { body: body(room), share: constant(share) })));
    }
    all
}

/// Six numbers in [-1, 1).
fn numbers(i: u32) -> [f64; 6] {
    static SETS: std::sync::LazyLock<[Sobol; 2]> =
        std::sync::LazyLock::new(|| [Sobol::new([1, 2, 3]), Sobol::new([4, 5, 6]).padded(7)]);
    std::array::from_fn(|k| 2.0 * SETS[k / 3].coordinate(i, k % 3) - 1.0)
}

/// A direction that is no axis'.
fn direction(x: [f64; 3]) -> Vec3 {
    normalise(plus(x, [1e-9, 2e-9, 3e-9]))
}

/// Whether a place is inside by more than a margin.
fn within(room: &Room, place: Vec3, margin: f64) -> bool {
    room.walls.iter().all(|wall| wall.plane.depth(place) > margin)
}

/// Places inside with rays.
fn inside(room: &Room) -> Vec<(Vec3, Vec3)> {
    let ray = |i| {
        let [x, y, z, a, b, c] = numbers(i);
        ([6.0 * x, 3.0 * y, 2.0 * z], direction([a, b, c]))
    };
    let rays: Vec<_> = (0..6 * POINTS).map(ray).filter(|(place, _)| within(room, *place, 0.02)).collect();
    assert!(rays.len() > 500, "{}", rays.len());
    rays
}

/// Places on planes, at edges, corners and far outside, with rays along planes, along axes and as
/// good as along them.
fn hard(room: &Room) -> Vec<(Vec3, Vec3)> {
    let mut rays = Vec::new();
    for (i, wall) in room.walls.iter().enumerate() {
        let other = &room.walls[(i + 2) % room.walls.len()].plane;
        let onto = |plane: &Plane, place: Vec3| plus(place, scaled(plane.normal, plane.depth(place)));
        let foot = onto(&wall.plane, room.probe);
        let edge = (0..200).fold(foot, |place, _| onto(&wall.plane, onto(other, place)));
        let outside = plus(foot, scaled(wall.plane.normal, 3.0));
        let nudged = plus(foot, scaled(wall.plane.normal, 1e-13));
        for place in [foot, edge, outside, nudged, scaled(foot, 1e3)] {
            for k in 0..6_usize {
                let mut axis = [0.0; 3];
                axis[k / 2] = if k % 2 == 0 { 1.0 } else { -1.0 };
                let along = normalise(minus(axis, scaled(wall.plane.normal, dot(axis, wall.plane.normal))));
                rays.push((place, axis));
                rays.push((place, normalise(plus(axis, [1e-12, -1e-14, 1e-9]))));
                rays.push((place, normalise(plus(axis, scaled(wall.plane.normal, 1e-7)))));
                if along.iter().all(|x| x.is_finite()) {
                    rays.push((place, along));
                }
            }
            rays.push((place, wall.plane.normal));
            rays.push((place, scaled(wall.plane.normal, -1.0)));
        }
    }
    rays
}

fn check(name: &str, (place, ray): (Vec3, Vec3), alpha: f64, meeting: &Meeting) {
    let Meeting { distance, place: met, normal } = *meeting;
    let text = || format!("{name}, alpha {alpha}, from {place:?} along {ray:?}: {meeting:?}");
    assert!(distance.is_finite() && distance > 0.0, "{}", text());
    assert!(met.iter().all(|x| x.is_finite()), "{}", text());
    assert!((length(normal) - 1.0).abs() < 1e-9, "{}", text());
}

#[test]
fn every_proxy_is_finite_everywhere() {
    for room in rooms() {
        let rays: Vec<_> = inside(&room).into_iter().take(800).chain(hard(&room)).collect();
        for (name, proxy) in families(&room) {
            for alpha in [0.0, 1e-6, 0.01, 0.3, 1.0] {
                for ray in &rays {
                    let met = proxy.meet(ray.0, ray.1, alpha);
                    let met =
                        met.unwrap_or_else(|| panic!("{name}, {}: nothing met along {ray:?}", room.name));
                    check(&name, *ray, alpha, &met);
                }
            }
        }
    }
}

/// What the lookup is made of: the direction from the probe and the ratio of distances.
fn looked_up(proxy: &dyn Proxy, room: &Room, (place, ray): (Vec3, Vec3)) -> (Vec3, f64) {
    let met = proxy.meet(place, ray, 0.3).expect("a meeting");
    let apart = minus(met.place, room.probe);
    (normalise(apart), met.distance / length(apart))
}

/// A step of 1e-7 moves a lookup by as little, wherever it is taken: through planes, edges, and
/// rays along planes. A proxy whose normal jumps at edges has a continuous place; the smooth ones'
/// normals are continuous too.
#[test]
fn lookups_are_continuous_in_place_and_ray() {
    const STEP: f64 = 1e-7;
    for room in rooms() {
        let rays: Vec<_> = inside(&room).into_iter().take(800).chain(hard(&room)).collect();
        for (name, proxy) in families(&room) {
            let far_or_sharp = ["1000000", "256", "eased"].iter().any(|part| name.ends_with(part));
            for (i, &(place, ray)) in rays.iter().enumerate().filter(|(_, (p, _))| length(*p) < 20.0) {
                let [x, y, z, a, b, c] = numbers(i as u32 + 17);
                let next =
                    (plus(place, scaled([x, y, z], STEP)), normalise(plus(ray, scaled([a, b, c], STEP))));
                let [here, there] = [(place, ray), next].map(|ray| looked_up(&*proxy, &room, ray));
                // the steepest: grazing a plane from its nearest distance, which rounds the edges of
                // the others too where they are eased, or powers that are nearly the planes'
                let steep = 1.0 / NEAREST;
                let moved = length(minus(here.0, there.0)).max((here.1 / there.1 - 1.0).abs());
                let allowed = STEP * steep * if far_or_sharp { 10.0 } else { 1.0 };
                assert!(
                    moved < 20.0 * allowed,
                    "{name}, room {}: {moved:e} from {place:?} {ray:?}",
                    room.name
                );
            }
        }
    }
}

/// On a wall the ray into it meets the proxy at once, and one away from it does not know of the
/// wall.
#[test]
fn shading_points_on_a_wall_meet_it_at_the_nearest_distance() {
    for room in rooms() {
        let shape = body(&room);
        for wall in &room.walls {
            let height = wall.plane.depth(room.probe);
            let foot = plus(room.probe, scaled(wall.plane.normal, height));
            let into = shape.meet(foot, wall.plane.normal, 0.1).expect("a meeting");
            assert!((into.distance - NEAREST).abs() < 1e-12);
            let away = shape.meet(foot, scaled(wall.plane.normal, -1.0), 0.1).expect("a meeting");
            let exact = room.exit(foot, scaled(wall.plane.normal, -1.0)).0;
            assert!((away.distance - exact).abs() < 1e-12);
        }
    }
}

/// The body about a shading point lies inside the planes, no farther than n equal terms allow, and
/// nears them with the power.
#[test]
fn the_smooth_body_lies_inside_and_nears_the_planes() {
    for room in rooms() {
        for power in [2.0, 4.0, 32.0, 1e5] {
            let proxy = smooth(&room, power);
            let terms = ops::pow(room.walls.len() as f64, -1.0 / power);
            for (place, ray) in inside(&room) {
                let exact = body(&room).meet(place, ray, 0.1).expect("a meeting");
                let met = proxy.meet(place, ray, 0.1).expect("a meeting");
                let share = met.distance / exact.distance;
                assert!(share <= 1.0 + 1e-12 && share >= terms - 1e-12, "p = {power}: {share}");
            }
        }
    }
}

/// The place on a proxy along neighbouring rays moves at right angles to its normal.
fn normals_are_those_of_the_body(name: &str, proxy: &dyn Proxy, room: &Room, margin: f64, allowed: f64) {
    const STEP: f64 = 1e-5;
    let mut worst = 0.0_f64;
    for (place, ray) in inside(room).into_iter().filter(|(place, _)| within(room, *place, margin)) {
        let met = proxy.meet(place, ray, 0.1).expect("a meeting");
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            let [a, b] = [STEP, -STEP].map(|step| normalise(plus(ray, scaled(axis, step))));
            let [a, b] = [a, b].map(|ray| proxy.meet(place, ray, 0.1).expect("a meeting").place);
            let along = minus(a, b);
            let cosine = dot(met.normal, along) / length(along).max(1e-3 * STEP);
            worst = worst.max(cosine.abs());
        }
    }
    assert!(worst < allowed, "{name}, room {}: {worst}", room.name);
}

#[test]
fn normals_are_the_gradients_of_the_bodies() {
    for room in rooms() {
        for power in [3.0, 8.0, 20.0] {
            normals_are_those_of_the_body(&format!("p = {power}"), &smooth(&room, power), &room, 0.1, 1e-3);
        }
        for radius in [0.2, 0.6] {
            // farther from every plane than the radius is inside the rounded body
            let margin = radius * body(&room).nearest();
            let name = format!("radius {radius}");
            normals_are_those_of_the_body(&name, &rounded(&room, radius), &room, margin, 1e-3);
        }
    }
}

/// Of a box the rounded body is the offset of a smaller box: the place met is a radius away from
/// it.
#[test]
fn a_rounded_box_is_the_offset_of_a_smaller_one() {
    for room in [room_a(), room_b()] {
        let (shape, nearest) = (room.shape(), body(&room).nearest());
        let extent = |axis: usize| [-shape.planes[2 * axis].offset, shape.planes[2 * axis + 1].offset];
        for share in [0.1, 0.5, 0.95] {
            let (proxy, radius) = (rounded(&room, share), share * nearest);
            let apart = |place: Vec3| {
                let beyond = |k: usize| {
                    let [low, high] = extent(k);
                    (low + radius - place[k]).max(place[k] - high + radius).max(0.0)
                };
                length([beyond(0), beyond(1), beyond(2)])
            };
            let mut rounds = 0;
            for (place, ray) in inside(&room).into_iter().filter(|(place, _)| apart(*place) < 0.99 * radius) {
                let met = proxy.meet(place, ray, 0.1).expect("a meeting");
                assert!((apart(met.place) / radius - 1.0).abs() < 1e-9, "{share}: {}", apart(met.place));
                rounds += u32::from(met.normal.iter().filter(|x| x.abs() > 1e-6).count() > 1);
            }
            assert!(rounds > 20, "{rounds} met a rounded edge");
        }
    }
}

/// A huge least distance and a whole fade are no correction; none of either is the planes.
#[test]
fn pushed_planes_and_fades_end_at_the_ray_and_at_the_planes() {
    let room = octagon();
    let near = |a: Vec3, b: Vec3, allowed| length(minus(a, b)) < allowed;
    for ray in inside(&room) {
        let exact = looked_up(&body(&room), &room, ray);
        let gone: [Box<dyn Proxy>; 2] = [
            Box::new(Pushed { body: body(&room), least: constant(1e8) }),
            Box::new(Faded { body: body(&room), share: constant(1.0) }),
        ];
        let kept: [Box<dyn Proxy>; 3] = [
            Box::new(Pushed { body: body(&room), least: constant(0.0) }),
            Box::new(Faded { body: body(&room), share: constant(0.0) }),
            Box::new(rounded(&room, 0.0)),
        ];
        for proxy in gone {
            let (towards, rho) = looked_up(&*proxy, &room, ray);
            assert!(near(towards, ray.1, 1e-7) && (rho - 1.0).abs() < 1e-7);
        }
        for proxy in kept {
            let (towards, rho) = looked_up(&*proxy, &room, ray);
            assert!(near(towards, exact.0, 1e-12) && (rho / exact.1 - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn laws_keep_their_ends() {
    let law = Smooth::BY_EYE;
    for (alpha, expected) in [(0.0, 256.0), (1e-9, 256.0), (0.01, 60.0), (0.1, 6.0), (0.15, 4.0), (1.0, 4.0)]
    {
        assert!((law.at(alpha) - expected).abs() < 1e-12, "{alpha}");
    }
    let law = Law::Inverse { over: 0.25, power: 1.5, least: 2.0, most: 100.0 };
    for (alpha, expected) in [(0.0, 100.0), (0.0625, 16.0), (0.25, 2.0), (1.0, 2.0)] {
        assert!((law.at(alpha) - expected).abs() < 1e-12, "{alpha}");
    }
    let law = Law::Power { scale: 0.5, power: 0.5, most: 0.4 };
    for (alpha, expected) in [(0.0, 0.0), (0.25, 0.25), (1.0, 0.4)] {
        assert!((law.at(alpha) - expected).abs() < 1e-12, "{alpha}");
    }
}

#[test]
fn a_probe_outside_has_no_body() {
    let cube = Convex::cuboid([-1.0; 3], [1.0; 3]);
    for probe in [[2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0]] {
        assert!(Body::new(&cube, probe).is_none(), "{probe:?}");
    }
    assert!(Body::new(&cube, [0.5, 0.0, 0.0]).is_some_and(|body| body.nearest() == 0.5));
}
