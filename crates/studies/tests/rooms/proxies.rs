//! Proxies of rooms: where they must agree with one another, and that nothing about them is not a
//! number or jumps.

use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled};
use lobefit_studies::study::parallax::room::proxies::{Body, Eased, NEAREST};
use lobefit_studies::study::parallax::room::{Convex, Meeting, Plane, Proxy, Room, octagon, room_a, room_b};

const POINTS: u32 = 3000;

fn body(room: &Room) -> Body {
    Body::new(&room.shape(), room.probe).expect("a probe inside")
}

fn rooms() -> [Room; 3] {
    [room_a(), room_b(), octagon()]
}

/// Sharp edges, and those of emitted lookups.
fn families(room: &Room) -> [(&'static str, Box<dyn Proxy>); 2] {
    [("planes", Box::new(body(room))), ("eased", Box::new(Eased { body: body(room) }))]
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
                    check(name, *ray, alpha, &met);
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
            for (i, &(place, ray)) in rays.iter().enumerate().filter(|(_, (p, _))| length(*p) < 20.0) {
                let [x, y, z, a, b, c] = numbers(i as u32 + 17);
                let next =
                    (plus(place, scaled([x, y, z], STEP)), normalise(plus(ray, scaled([a, b, c], STEP))));
                let [here, there] = [(place, ray), next].map(|ray| looked_up(&*proxy, &room, ray));
                // the steepest: grazing a plane from its nearest distance, which rounds the edges of
                // the others too where they are eased
                let steep = 1.0 / NEAREST;
                let moved = length(minus(here.0, there.0)).max((here.1 / there.1 - 1.0).abs());
                let allowed = STEP * steep * if name == "eased" { 10.0 } else { 1.0 };
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

#[test]
fn a_probe_outside_has_no_body() {
    let cube = Convex::cuboid([-1.0; 3], [1.0; 3]);
    for probe in [[2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0]] {
        assert!(Body::new(&cube, probe).is_none(), "{probe:?}");
    }
    assert!(Body::new(&cube, [0.5, 0.0, 0.0]).is_some());
}
