//! Rooms from a place, lookups at the ends of their ranges, what a GGX surface
//! reflects.

use lobefit::effects::parallax::{Corrected, LobeFit, Ratio, Shading, TapRule, Width};
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled, tangents, turned};
use lobefit_studies::study::parallax::room::proxies::{Body, Eased};
use lobefit_studies::study::parallax::room::{
    Fetch, GgxRays, Lookup, Outlook, Patches, Rays, Room, Seen, octagon, practice, room_a, room_b,
};
use lobefit_truth::optics::kernel::Kernel;

const COUNT: u32 = 203;

fn rooms() -> [Room; 4] {
    [room_a(), room_b(), octagon(), practice()]
}

/// Mean radiance over a lobe about `axis` from a place, ray by ray, without those below a surface's
/// `normal` where one is given.
pub(crate) fn lobe(room: &Room, place: Vec3, axis: Vec3, normal: Option<Vec3>, rays: &Rays) -> [f64; 3] {
    let frame = tangents(axis);
    let rays = rays.directions().iter().map(|local| turned(axis, frame, *local));
    let above: Vec<Vec3> = rays.filter(|ray| normal.is_none_or(|normal| dot(normal, *ray) > 0.0)).collect();
    let sum = above.iter().fold([0.0; 3], |sum, ray| plus(sum, room.seen(place, *ray)));
    scaled(sum, 1.0 / above.len() as f64)
}

/// Directions and places of no symmetry.
fn axes() -> [Vec3; 4] {
    [[0.3, -0.5, 0.8], [-0.9, 0.2, -0.1], [0.1, 0.7, -0.6], [0.02, -0.07, -1.0]].map(normalise)
}

#[test]
fn an_outlook_is_the_room_turned() {
    for room in rooms() {
        for axis in axes() {
            let [x, y] = tangents(axis);
            let outlook = Outlook::new(&room, room.probe, [x, y, axis]);
            for towards in axes() {
                let local = [x, y, axis].map(|e| dot(e, towards));
                assert_eq!(outlook.seen(local), room.seen(room.probe, towards), "{}", room.name);
            }
        }
    }
}

/// In a room of one light everything reflects that light, whatever the lobe; of a smooth surface
/// the mirror direction is seen.
#[test]
fn a_surface_reflects_no_more_than_there_is() {
    let mut even = octagon();
    for wall in &mut even.walls {
        wall.checker.radiance = [[0.25, 0.5, 2.0]; 2];
        wall.panels.clear();
    }
    let rays = GgxRays::new(COUNT, 1);
    let normal = normalise([0.1, 0.2, 1.0]);
    for alpha in [1e-4, 0.05, 0.5, 1.0] {
        for view in [[0.0, 0.3, 0.9], [0.9, 0.0, 0.1], [0.1, 0.2, 1.0]].map(normalise) {
            let seen = Seen { place: [0.2, 0.1, -1.0], normal, view, alpha };
            let light = rays.reflected(&even, &seen);
            assert!(length(minus(light, [0.25, 0.5, 2.0])) < 1e-12, "{light:?}");
            if alpha == 1e-4 {
                let room = octagon();
                let mirror = minus(scaled(normal, 2.0 * dot(normal, view)), view);
                let (seen, expected) = (rays.reflected(&room, &seen), room.seen(seen.place, mirror));
                assert!(length(minus(seen, expected)) < 0.02 * length(expected), "{seen:?} {expected:?}");
            }
        }
    }
}

fn corrected(room: &Room, shading: Shading, rule: TapRule, width: Width) -> Corrected<Eased> {
    let body = Body::new(&room.shape(), room.probe).expect("a probe inside");
    let proxy = Eased { body };
    Corrected { proxy, probe: room.probe, shading, rule, ratio: Ratio::Area, width }
}

/// Everywhere inside, on and outside of the walls, at every angle: weights sum to 1, widths are in
/// (0, 1], directions have unit length.
#[test]
fn lookups_are_finite_everywhere() {
    let shadings = [Shading::Mirror, Shading::Dominant, Shading::RootCosine, Shading::Fitted(LobeFit::THREE)];
    for room in rooms() {
        for shading in shadings {
            for rule in [TapRule::one(), TapRule::two(), TapRule::three()] {
                let lookup = corrected(&room, shading, rule, Width::Rational);
                for alpha in [1e-6, 0.01, 0.3, 1.0] {
                    for place in [room.probe, [0.5, -0.4, -1.2], [0.5, 0.4, -1.5], [0.0, 0.0, -1.6]] {
                        for mu in [1.0_f64, 0.5, 0.01, 1e-9, 0.0, -1e-9, -0.5, -1.0] {
                            let view = normalise([((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu]);
                            let seen = Seen { place, normal: [0.0, 0.0, 1.0], view, alpha };
                            let taps = lookup.taps(&seen);
                            let whole: f64 = taps.iter().map(|tap| tap.weight).sum();
                            assert!((whole - 1.0).abs() < 1e-12, "{shading:?} {seen:?}: {taps:?}");
                            for tap in taps {
                                assert!((length(tap.towards) - 1.0).abs() < 1e-9, "{seen:?}: {tap:?}");
                                assert!(tap.alpha > 0.0 && tap.alpha <= 1.0, "{seen:?}: {tap:?}");
                            }
                        }
                    }
                }
            }
        }
    }
}

/// From the probe itself there is nothing to correct: the width of the lobe, along the mirror ray.
#[test]
fn at_the_probe_a_fetch_is_the_lobe() {
    let room = room_a();
    for width in [Width::Same, Width::Frostbite, Width::Scaled, Width::Rational] {
        let proxy = Body::new(&room.shape(), room.probe).expect("a probe inside");
        let (probe, shading, ratio) = (room.probe, Shading::Mirror, Ratio::Area);
        let lookup = Corrected { proxy, probe, shading, rule: TapRule::one(), ratio, width };
        let view = normalise([0.3, 0.4, 0.5]);
        let seen = Seen { place: room.probe, normal: [0.0, 0.0, 1.0], view, alpha: 0.3 };
        let [tap] = lookup.taps(&seen)[..] else { panic!("one fetch") };
        assert!((tap.alpha - 0.3).abs() < 1e-12 && (tap.weight - 1.0).abs() < 1e-15, "{tap:?}");
        assert!(length(minus(tap.towards, [-view[0], -view[1], view[2]])) < 1e-12, "{tap:?}");
    }
}

/// Head on and from straight below a fitted lobe is round and its axis the normal; leaning, its
/// half-axes are at right angles to it and their product is 1. From below it is that of the view
/// mirrored in the surface.
#[test]
fn fitted_lobes_are_lobes() {
    for fit in [LobeFit::ONE, LobeFit::TWO, LobeFit::THREE] {
        for alpha in [0.01, 0.3, 0.9, 1.0] {
            for mu in [1.0, 0.7, 0.1, 0.0, -0.01, -0.7, -1.0] {
                let view = normalise([((1.0_f64 - mu) * (1.0 + mu)).sqrt(), 0.0, mu]);
                let seen = Seen { place: [0.0; 3], normal: [0.0, 0.0, 1.0], view, alpha };
                let lobe = Shading::Fitted(fit).lobe(&seen);
                let [a, b] = lobe.axes;
                assert!((length(lobe.axis) - 1.0).abs() < 1e-12 && lobe.alpha > 0.0 && lobe.alpha <= 1.0);
                assert!((length(a) * length(b) - 1.0).abs() < 1e-9, "{lobe:?}");
                assert!(
                    dot(a, b).abs() < 1e-9
                        && dot(a, lobe.axis).abs() < 1e-9
                        && dot(b, lobe.axis).abs() < 1e-9
                );
                assert!(length(b) <= length(a) + 1e-9, "narrower across");
                assert!(lobe.axis[2] >= -1e-12, "above the surface");
                let mirrored = Seen { view: [view[0], view[1], -view[2]], ..seen };
                let other = Shading::Fitted(fit).lobe(&mirrored);
                assert!(length(minus(lobe.axis, other.axis)) < 1e-12 && lobe.alpha == other.alpha);
                for (a, b) in lobe.axes.iter().zip(other.axes) {
                    assert!(length(minus(*a, b)) < 1e-9, "{lobe:?} {other:?}");
                }
                if mu.abs() == 1.0 {
                    assert!(
                        length(minus(lobe.axis, [0.0, 0.0, 1.0])) < 1e-12 && (length(a) - 1.0).abs() < 1e-12
                    );
                }
            }
        }
    }
}

/// Three fetches along a stretch are nearer to the lobe than one: what the rule is for, in a room.
#[test]
fn more_fetches_are_nearer_to_a_slanted_lobe() {
    let room = room_b();
    let rays = Rays::new(&Kernel::HalfCosine, 0.12, 1024, 2);
    let exact = Patches::new(&room);
    let error = |rule: TapRule| -> f64 {
        let lookup = corrected(&room, Shading::Mirror, rule, Width::Rational);
        let each = (0..40).map(|i| {
            let place = [-5.0 + 0.25 * f64::from(i), 0.6 - 0.03 * f64::from(i), -0.9];
            let mirror = normalise([0.9, 0.3, -0.25]);
            let seen = Seen { place, normal: mirror, view: mirror, alpha: 0.12 };
            let truth = lobe(&room, place, mirror, None, &rays);
            length(minus(exact.sum(&lookup.taps(&seen)), truth))
        });
        each.sum()
    };
    let (one, three) = (error(TapRule::one()), error(TapRule::three()));
    assert!(three < 0.9 * one, "{one} {three}");
}
