//! Lookups of the fitted lobe as emitted where it is hard: at grazing views, from below, and as
//! alpha goes to 0.

use crate::lookup_support::{EMITTED, Emitted, Point, found};
use lobefit_math::ops::{pow, sincos};
use lobefit_math::vector::{Vec3, cross, length, minus, normalise};
use lobefit_shade::code::Language;
use std::f64::consts::FRAC_PI_2;

/// Steps of a path.
const STEPS: usize = 4000;

/// A surface in the middle of a hall and of a box, whose normal is no axis.
const NORMAL: Vec3 = [0.48, 0.6, 0.64];

fn smooth() -> impl Iterator<Item = &'static Emitted> {
    EMITTED.iter().filter(|one| one.lookup.is_fitted() && one.lookup.smooth && one.entry["gives"] == "width")
}

/// What is fetched along a path: the weighted mean of the directions, and that of the widths.
fn fetched(emitted: &Emitted, points: &[Point]) -> Vec<(Vec3, f64)> {
    let taps = emitted.lookup.taps as usize;
    let found = found(Language::Rust, &[(emitted, points)]).expect("rustc is there").concat();
    let mean = |numbers: &[f32]| {
        assert!(numbers.iter().all(|x| x.is_finite()), "{}: {numbers:?}", emitted.name());
        let number = |i: usize| f64::from(numbers[i]);
        let weight = |i: usize| if taps == 1 { 1.0 } else { number(4 * taps + i) };
        let sum = |k: usize| (0..taps).map(|i| weight(i) * number(4 * i + k)).sum::<f64>();
        ([sum(0), sum(1), sum(2)], sum(3))
    };
    found.chunks_exact(emitted.numbers()).map(mean).collect()
}

/// The view on a side of the surface whose cosine to the normal is the sine of `above`.
fn point(side: Vec3, above: f64, alpha: f64) -> Point {
    let (sine, cosine) = sincos(above);
    let view = [0, 1, 2].map(|k| sine * NORMAL[k] + cosine * side[k]);
    let [n, v] = [NORMAL, view].map(|v| v.map(|x| x as f32));
    [0.5, -0.4, 0.2, n[0], n[1], n[2], v[0], v[1], v[2], alpha as f32]
}

/// Two sides of the surface at right angles.
fn sides() -> [Vec3; 2] {
    let side = normalise([NORMAL[1], -NORMAL[0], 0.0]);
    [side, cross(NORMAL, side)]
}

/// Width at alpha = 0: the emitted form takes the reciprocal root of at least 1e-24, and its
/// weights of several fetches sum to 1 to a few ulp of f32.
const FLOOR: f64 = 1.000_001e-12;

/// Widths of the surface on a path.
const ALPHAS: [f64; 7] = [0.0, 0.01, 0.03, 0.1, 0.4, 0.7, 1.0];

/// A path for every width: the view that is `turn` away from an angle above the surface, or on the
/// other side of it.
fn paths(view: impl Fn(f64) -> (Vec3, f64)) -> Vec<Point> {
    let turn = |i: usize| 0.3 - 0.6 * i as f64 / STEPS as f64;
    let points = ALPHAS.iter().flat_map(|alpha| (0..=STEPS).map(move |i| (turn(i), *alpha)));
    points
        .map(|(turn, alpha)| {
            let (side, above) = view(turn);
            point(side, above, alpha)
        })
        .collect()
}

/// Checks that every step of 0.00015 radians changes what is fetched by less than ten times that,
/// and returns what it is at both ends and in the middle.
fn moves_by_little(emitted: &Emitted, paths: &[Point]) -> Vec<[Vec3; 3]> {
    let found = fetched(emitted, paths);
    let path = |(alpha, found): (&f64, &[(Vec3, f64)])| {
        for (i, pair) in found.windows(2).enumerate() {
            let moved = length(minus(pair[0].0, pair[1].0));
            let wider = (pair[0].1 - pair[1].1).abs();
            let text = format!("{}, alpha {alpha}, step {i}: {moved}, {wider}", emitted.name());
            assert!(moved < 0.0015 && wider < 0.0015, "{text}");
        }
        [0, STEPS / 2, STEPS].map(|i| found[i].0)
    };
    ALPHAS.iter().zip(found.chunks_exact(STEPS + 1)).map(path).collect()
}

/// A view that sinks below the surface. Where fetches fade out close to the surface what is fetched
/// changes fastest, by about 4 radians for one of the view.
#[test]
fn nothing_jumps_where_the_view_passes_the_surface() {
    let [side, _] = sides();
    let paths = paths(|turn| (side, turn));
    for emitted in smooth() {
        for (alpha, [first, middle, _]) in ALPHAS.iter().zip(moves_by_little(emitted, &paths)) {
            // below, the ray rises as it sank above; the axis of the widest lobe of one fetch is
            // the normal there
            let whole = length(minus(first, middle));
            assert!(whole > 1e-3 || *alpha == 1.0, "{}, alpha {alpha}: nothing moves", emitted.name());
        }
    }
}

/// A view that comes to the normal, or to its opposite, on one side and leaves it on another: the
/// plane of incidence turns at once by a right angle, about a lobe that is round there.
#[test]
fn nothing_jumps_where_the_plane_of_incidence_turns() {
    let [side, other] = sides();
    for end in [FRAC_PI_2, -FRAC_PI_2] {
        let view = |turn: f64| (if turn > 0.0 { side } else { other }, end - turn.abs().copysign(end));
        let paths = paths(view);
        for emitted in smooth() {
            for (alpha, [first, _, last]) in ALPHAS.iter().zip(moves_by_little(emitted, &paths)) {
                let whole = length(minus(first, last));
                assert!(whole > 1e-3 || *alpha == 1.0, "{}, alpha {alpha}: nothing moves", emitted.name());
            }
        }
    }
}

/// As alpha goes to 0 the direction goes to that of the mirror ray and the width to 0.
#[test]
fn narrow_lobes_are_mirrors() {
    let alphas: Vec<f64> = (0..9).map(|i| pow(10.0, -f64::from(i))).chain([1e-20, 0.0]).collect();
    let views = [1.57, 0.8, 0.1, 1e-3, -0.2, -1.57];
    let [side, _] = sides();
    let points: Vec<Point> =
        views.iter().flat_map(|above| alphas.iter().map(|alpha| point(side, *above, *alpha))).collect();
    for emitted in smooth() {
        let found = fetched(emitted, &points);
        for (above, found) in views.iter().zip(found.chunks_exact(alphas.len())) {
            let mirror = found[alphas.len() - 1];
            assert!(mirror.1 <= FLOOR, "{}: {}", emitted.name(), mirror.1);
            for (alpha, (direction, width)) in alphas.iter().zip(found).skip(1) {
                let off = length(minus(*direction, mirror.0));
                let text = format!("{}, {above}, alpha {alpha}: {off}, {width}", emitted.name());
                assert!(off < 1e-6 + 6.0 * alpha && *width <= 4.0 * alpha + FLOOR, "{text}");
            }
        }
    }
}
