//! Rules of several fetches: what they are off by against the study's figures, and what holds
//! whatever the constants are.

use std::f64::consts::PI;

use lobefit::effects::parallax::taps::expected::{EXPECTED_UP_TO, Expected, expected};
use lobefit::effects::parallax::taps::fit::{fit, situations, slants};
use lobefit::effects::parallax::taps::horizon::fade;
use lobefit::effects::parallax::{Corrected, Ratio, RuleTap, Shading, Stretch, TapRule, Width, width};
use lobefit_math::ops::{log, sincos};
use lobefit_math::vector::{dot, length, normalise};
use lobefit_studies::study::parallax::room::proxies::{Body, Eased};
use lobefit_studies::study::parallax::room::{Lookup, Plane, Proxy, Seen, room_b};
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::slant::{Case, Resolution, Slant, Stand};

const RULES: [fn() -> TapRule; 3] = [TapRule::one, TapRule::two, TapRule::three];

fn degrees(x: f64) -> f64 {
    x * PI / 180.0
}

fn slant(psi_s: f64, psi_p: f64, azimuth: f64, distance: f64) -> Slant {
    Slant {
        shading: Stand { distance, slant: degrees(psi_s) },
        probe: Stand { distance: 1.0, slant: degrees(psi_p) },
        azimuth: degrees(azimuth),
    }
}

fn variation(rule: &TapRule, alpha: f64, slant: Slant) -> f64 {
    let case = Case::new(Kernel::HalfCosine, alpha, slant, Resolution::COARSE).expect("a case");
    let taps = rule.taps(&case.stretch, alpha);
    case.off(&case.fetched(&taps).expect("fetches")).tv
}

/// Slant, and what the study's tables of 1, 2 and 3 fetches leave in the mean over alpha .06 to
/// .45.
const STUDY: [(f64, [f64; 3]); 5] = [
    (20.0, [0.060, 0.033, 0.039]),
    (40.0, [0.147, 0.071, 0.057]),
    (55.0, [0.244, 0.125, 0.100]),
    (65.0, [0.335, 0.174, 0.146]),
    (75.0, [0.461, 0.251, 0.237]),
];

#[test]
fn rules_leave_what_the_study_says_or_less() {
    let alphas = [0.06, 0.12, 0.25, 0.45];
    for (psi, stated) in STUDY {
        for (rule, stated) in RULES.iter().zip(stated) {
            let all = alphas.map(|alpha| variation(&rule(), alpha, Slant::in_front(degrees(psi))));
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            // the H^-1 norm is what is minimised: at 40 degrees three fetches give up some of the
            // total variation for it
            let leeway = if psi == 40.0 { 1.13 } else { 1.025 };
            assert!(mean < stated * leeway, "{} fetches at {psi}: {mean} against {stated}", rule().count());
        }
    }
}

#[test]
fn walls_at_every_slant_are_among_those_of_a_set() {
    for seed in [1, 2, 9, 77] {
        let shares: Vec<[f64; 4]> = slants(256, seed)
            .iter()
            .map(|slant| {
                let cosine = |stand: Stand| (sincos(stand.slant).1 - 0.15) / 0.85;
                let ratio = log(slant.shading.distance / 0.15) / log(2.0 / 0.15);
                [cosine(slant.shading), cosine(slant.probe), slant.azimuth / PI, ratio]
            })
            .collect();
        for (a, b) in (0..4).flat_map(|a| (0..a).map(move |b| (a, b))) {
            let mut cells = [0; 16];
            for share in &shares {
                cells[(4.0 * share[a]) as usize * 4 + (4.0 * share[b]) as usize] += 1;
            }
            assert!(cells.iter().all(|count| *count >= 4), "seed {seed}, {a} over {b}: {cells:?}");
        }
    }
}

/// Of a number of fetches: the share of the sum of the total variation that they leave, the walls
/// that they serve worse than one by more than 0.001, and the most that they are worse by.
type Left = (usize, f64, usize, [f64; 2]);

const LEFT: [(Kernel, [Left; 2]); 3] = [
    (Kernel::HalfCosine, [(2, 0.735, 5, [0.025, 0.027]), (3, 0.625, 2, [0.005, 0.01])]),
    (Kernel::Half, [(2, 0.737, 6, [0.06, 0.063]), (3, 0.631, 1, [0.006, 0.007])]),
    (Kernel::Ndf, [(2, 0.769, 8, [0.043, 0.045]), (3, 0.652, 0, [0.0, 0.001])]),
];

#[test]
fn more_fetches_are_nearer_on_walls_at_any_slant_but_a_few() {
    let alphas = [0.01, 0.03, 0.08, 0.18, 0.35, 0.6];
    for (kernel, stated) in LEFT {
        let all = situations(&kernel, &alphas, 3000, 5, Resolution::COARSE).expect("walls");
        let one: f64 = all.iter().map(|situation| situation.one).sum();
        for (fetches, share, walls, [least, most]) in stated {
            let rule = TapRule::of(&kernel, fetches).expect("a rule");
            let (mut sum, mut worse, mut worst) = (0.0, 0, 0.0_f64);
            for situation in &all {
                let tv = situation.variation(&rule);
                sum += tv;
                worse += usize::from(tv > situation.one + 1e-3);
                worst = worst.max(tv - situation.one);
            }
            let told =
                format!("{fetches} fetches of {kernel:?}: leave {}, worse on {worse} by {worst}", sum / one);
            println!("{told}");
            assert!(sum < share * one && sum > (share - 0.01) * one, "{told}");
            assert!(worse <= walls && (worse > 0) == (walls > 0), "{told}");
            assert!((least..most).contains(&worst), "{told}");
        }
    }
}

#[test]
fn constants_are_at_a_minimum() {
    let alphas = [0.02, 0.05, 0.1, 0.2, 0.35, 0.55, 0.8];
    for kernel in Kernel::ALL {
        let all = situations(&kernel, &alphas, 140, 1, Resolution::COARSE).expect("walls");
        for (fetches, apart) in [(2, 1), (3, 3)] {
            let rule = TapRule::of(&kernel, fetches).expect("a rule");
            let found = fit(&rule, &all, 1).expect("a fit");
            assert!(found.sums[1] <= found.sums[0] && found.sums[1] > 0.99 * found.sums[0], "{found:?}");
            // other constants are worse
            let mut moved = rule.constants().to_vec();
            moved[apart] *= 1.3;
            let moved = rule.with(&moved).expect("as many");
            assert!(fit(&moved, &all, 0).expect("a fit").sums[0] > 1.2 * found.sums[0]);
        }
    }
}

#[test]
fn what_is_expected_is_off_by_what_is_stated() {
    let alphas = [0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.6, 0.8];
    for kernel in Kernel::ALL {
        let [all, fitted] =
            [5, 3].map(|seed| situations(&kernel, &alphas, 1600, seed, Resolution::COARSE).expect("walls"));
        for rule in [1, 2, 3].map(|fetches| TapRule::of(&kernel, fetches).expect("a rule")) {
            let Expected { constants, off } = *rule.expectation();
            for (up_to, stated) in EXPECTED_UP_TO.into_iter().zip(off) {
                let rms = |alpha: f64| {
                    let off: Vec<f64> = all
                        .iter()
                        .filter(|s| s.case.alpha == alpha)
                        .map(|s| rule.expected(&s.case.stretch, alpha) - s.variation(&rule))
                        .collect();
                    (off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64).sqrt()
                };
                let most = alphas.into_iter().filter(|alpha| *alpha <= up_to).map(rms).fold(0.0, f64::max);
                assert!(
                    (0.85 * stated..=stated).contains(&most),
                    "{kernel:?}, {} to {up_to}: {most}",
                    rule.count()
                );
            }
            // the constants are those of least squares over other walls, and the fit finds them
            // from elsewhere
            let found = expected(&rule, &constants, &fitted, 30).expect("a fit");
            assert!(found.off[1] <= found.off[0] && found.off[1] > 0.999 * found.off[0], "{found:?}");
            let elsewhere = expected(&rule, &constants.map(|c| 1.3 * c), &fitted, 30).expect("a fit");
            assert!((elsewhere.off[1] / found.off[1] - 1.0).abs() < 1e-3, "{elsewhere:?} {found:?}");
        }
    }
}

/// No rule of several fetches is fitted for a table; one fetch needs none.
#[test]
fn rules_are_for_lobes_with_a_formula() {
    let theta: Vec<f64> = (0..8).map(|i| 0.2 * f64::from(i)).collect();
    let density = theta.iter().map(|theta| 1.5 - theta).collect();
    let lobe = lobefit_truth::optics::kernel::TableLobe { alpha: 1.0, theta, density };
    let table = lobefit_truth::optics::kernel::tabulated("cone", &[lobe]).expect("a kernel");
    assert_eq!([1, 2, 3].map(|fetches| TapRule::of(&table, fetches).is_some()), [true, false, false]);
    assert_eq!([0, 4].map(|fetches| TapRule::of(&Kernel::Half, fetches)), [None, None]);
}

#[test]
fn weights_sum_to_one_and_nothing_is_infinite_anywhere() {
    for (psi_s, psi_p) in
        (0..8).flat_map(|i| (0..8).map(move |j| (12.25 * f64::from(i), 12.25 * f64::from(j))))
    {
        for (azimuth, distance) in [(0.0, 1.0), (90.0, 0.02), (180.0, 1.0), (133.0, 300.0)] {
            for alpha in [1e-6, 0.01, 0.3, 1.0] {
                let Some(stretch) = slant(psi_s, psi_p, azimuth, distance).stretch(alpha) else {
                    panic!("no stretch at {psi_s} {psi_p}")
                };
                assert!(
                    stretch.kappa >= 1.0 && (0.0..1.0).contains(&stretch.length) && stretch.growth >= 0.0
                );
                for rule in RULES.map(|rule| rule()) {
                    let taps = rule.taps(&stretch, alpha);
                    let place = format!("{psi_s} {psi_p} {azimuth} {distance} {alpha}: {taps:?} {stretch:?}");
                    assert_eq!(taps.len(), rule.count());
                    assert!((taps.iter().map(|tap| tap.weight).sum::<f64>() - 1.0).abs() < 1e-12, "{place}");
                    for tap in &taps {
                        // wider than any lobe where the probe is hundreds of times nearer: the
                        // fetch is then the widest there is
                        assert!(tap.weight >= 0.0 && tap.width >= 0.1 && tap.width.is_finite(), "{place}");
                        assert!(tap.tilt.is_finite() && tap.tilt * stretch.slope < 1.0, "{place}");
                    }
                    let expected = rule.expected(&stretch, alpha);
                    assert!((0.0..=1.0).contains(&expected), "{place}");
                }
            }
        }
    }
}

/// In front of the probe what is expected is what is, within a tenth; it rises with the slant from
/// 0, and falls with the number of fetches.
#[test]
fn what_is_expected_orders_slants_and_rules() {
    let stretch = |psi: f64| Slant::in_front(degrees(psi)).stretch(0.1).expect("a stretch");
    for rule in RULES.map(|rule| rule()) {
        let over: Vec<f64> = (0..=80).map(|psi| rule.expected(&stretch(f64::from(psi)), 0.1)).collect();
        assert!(over.is_sorted() && over[0] < 1e-9, "{} fetches: {over:?}", rule.count());
    }
    let [one, two, three] = RULES.map(|rule| rule().expected(&stretch(72.0), 0.1));
    assert!(one > two && two > three, "{one} {two} {three}");
    for psi in [20.0, 40.0, 60.0, 75.0] {
        for rule in RULES.map(|rule| rule()) {
            let (expected, tv) =
                (rule.expected(&stretch(psi), 0.1), variation(&rule, 0.1, Slant::in_front(degrees(psi))));
            assert!((expected - tv).abs() < 0.1, "{} at {psi}: {expected} {tv}", rule.count());
        }
    }
}

/// What a rule fetches, as moments that do not depend on the order of fetches nor on the sign of
/// the axis.
fn moments(rule: &TapRule, alpha: f64, slant: Slant) -> [f64; 4] {
    let stretch = slant.stretch(alpha).expect("a stretch");
    let taps = rule.taps(&stretch, alpha);
    let along = |axis: usize, power: u32| -> f64 {
        let at = |tilt: f64| tilt * stretch.major[axis] / alpha;
        taps.iter().map(|t| t.weight * if power == 1 { at(t.tilt) } else { at(t.tilt) * at(t.tilt) }).sum()
    };
    let width = taps.iter().map(|t| t.weight * t.width).sum();
    [along(1, 1), along(1, 2), along(0, 2), width]
}

/// Steps along a path: near a round footprint its long axis turns by all of its angle within a
/// hundredth of a turn of the probe.
const STEPS: u32 = 40_000;

#[test]
fn nothing_jumps() {
    let near = |a: [f64; 4], b: [f64; 4], place: &str| {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 5e-3 * (1.0 + a.abs()), "{place}: {a} {b}");
        }
    };
    for rule in RULES.map(|rule| rule()) {
        for alpha in [0.05, 0.3, 0.8] {
            // along paths through kappa = 1, and through walls towards both sides of which the
            // footprint grows alike
            for i in 0..STEPS {
                let (t, next) = (f64::from(i) / f64::from(STEPS), f64::from(i + 1) / f64::from(STEPS));
                let pass = |t: f64| slant(40.0 + 20.0 * t, 50.0, 150.0, 1.0);
                near(
                    moments(&rule, alpha, pass(t)),
                    moments(&rule, alpha, pass(next)),
                    &format!("pass {alpha} {t}"),
                );
                let turn = |t: f64| slant(50.0, 60.0, 180.0 * t, 0.7);
                near(
                    moments(&rule, alpha, turn(t)),
                    moments(&rule, alpha, turn(next)),
                    &format!("turn {alpha} {t}"),
                );
            }
            // no slant: the one fetch
            let straight = rule.taps(&slant(0.0, 0.0, 0.0, 0.6).stretch(alpha).expect("a stretch"), alpha);
            for tap in straight.iter().filter(|tap| tap.weight > 1e-9) {
                assert!(tap.tilt.abs() < 1e-9 && (tap.width - 1.0).abs() < 1e-9, "{straight:?}");
            }
        }
    }
}

#[test]
fn the_stretch_is_that_of_differences() {
    let slant = slant(55.0, 35.0, 70.0, 0.6);
    let stretch = slant.stretch(0.0).expect("a stretch");
    let (s, p, ray) = (slant.place(), slant.probe_place(), slant.ray());
    let mapped = |axis: [f64; 3], t: f64| {
        let v = normalise([0, 1, 2].map(|i| ray[i] + t * axis[i]));
        let q = [0, 1, 2].map(|i| s[i] - v[i] * s[2] / v[2]);
        (
            normalise([0, 1, 2].map(|i| q[i] - p[i])),
            length([0, 1, 2].map(|i| q[i] - s[i])) / length([0, 1, 2].map(|i| q[i] - p[i])),
        )
    };
    let minor = lobefit_math::vector::cross(ray, stretch.major);
    let rate = |axis| {
        let (a, b) = (mapped(axis, 1e-5), mapped(axis, -1e-5));
        (length([0, 1, 2].map(|i| a.0[i] - b.0[i])) / 2e-5, log(a.1 / b.1) / 2e-5)
    };
    let ((long, growth), (short, _)) = (rate(stretch.major), rate(minor));
    assert!((long / short / stretch.kappa - 1.0).abs() < 1e-6, "{long} {short} {stretch:?}");
    assert!(((long * short).sqrt() / stretch.area - 1.0).abs() < 1e-6);
    assert!((growth - stretch.growth).abs() < 1e-5 && stretch.growth > 0.0, "{growth} {stretch:?}");
    assert!(dot(stretch.major, ray).abs() < 1e-12);
}

/// Our lookup of a round lobe about the mirror ray.
fn corrected<P: Proxy>(proxy: P, probe: [f64; 3], rule: TapRule) -> Corrected<P> {
    let (shading, ratio, width) = (Shading::Mirror, Ratio::Area, Width::Rational);
    Corrected { proxy, probe, shading, rule, ratio, width }
}

#[test]
fn a_lookup_drops_what_leaves_below_the_surface() {
    let room = room_b();
    let (s, c) = sincos(degrees(88.0));
    let seen = Seen { place: [1.0, 0.1, -1.25], normal: [0.0, 0.0, 1.0], view: [s, 0.0, c], alpha: 0.5 };
    for rule in RULES.map(|rule| rule()) {
        let lookup =
            corrected(Body::new(&room.shape(), room.probe).expect("a probe inside"), room.probe, rule);
        let taps = lookup.taps(&seen);
        assert!(!taps.is_empty() && taps.len() <= rule.count());
        assert!((taps.iter().map(|tap| tap.weight).sum::<f64>() - 1.0).abs() < 1e-12);
        for tap in &taps {
            assert!((length(tap.towards) - 1.0).abs() < 1e-12 && tap.alpha > 0.0 && tap.alpha <= 1.0);
        }
    }
    // a probe that stands at the shading point needs one fetch: nothing is stretched
    let plane = Plane::through([0.0, 0.0, 2.0], [0.0, 0.0, 1.0]);
    let shape = lobefit_studies::study::parallax::room::Convex { planes: vec![plane] };
    let body = Body::new(&shape, [0.0; 3]).expect("a probe inside");
    let seen =
        Seen { place: [0.0; 3], normal: [0.0, 0.0, 1.0], view: normalise([0.6, 0.0, 0.8]), alpha: 0.2 };
    for rule in RULES.map(|rule| rule()) {
        let taps = corrected(body.clone(), [0.0; 3], rule).taps(&seen);
        for tap in taps.iter().filter(|tap| tap.weight > 1e-9) {
            assert!((tap.alpha - 0.2).abs() < 1e-9 && (tap.towards[2] - 0.8).abs() < 1e-9, "{tap:?}");
        }
    }
    assert!((width(0.2, 1.0) - 0.2).abs() < 1e-15);
    assert!(
        Stretch::of(
            [0.0; 3],
            lobefit_truth::optics::footprint::Hit { place: [0.0; 3], normal: [0.0, 0.0, 1.0] },
            [1.0; 3]
        )
        .is_none()
    );
}

/// The direction of fetches, and what they weigh the fetch that is nearest to it by.
fn blended(lookup: &dyn Lookup, elevation: f64, azimuth: f64, alpha: f64) -> [f64; 4] {
    let ((height, across), (y, x)) = (sincos(degrees(elevation)), sincos(degrees(azimuth)));
    let view = [across * x, across * y, height];
    let seen = Seen { place: [0.7, 0.3, -1.4], normal: [0.0, 0.0, 1.0], view, alpha };
    let mut sum = [0.0; 4];
    for tap in lookup.taps(&seen) {
        for (axis, x) in tap.towards.into_iter().chain([tap.alpha]).enumerate() {
            sum[axis] += tap.weight * x;
        }
    }
    sum
}

/// As an eye comes down to the floor, the rays of fetches leave below it one by one: nothing jumps
/// in directions and widths.
#[test]
fn nothing_jumps_where_rays_leave_below_the_surface() {
    let room = room_b();
    let proxy = Eased { body: Body::new(&room.shape(), room.probe).expect("a probe inside") };
    let step = 2e-3;
    for rule in [TapRule::two(), TapRule::three()] {
        let probe = room.probe;
        let corrected = |rule| corrected(proxy.clone(), probe, rule);
        let (taps, one) = (corrected(rule), corrected(TapRule::one()));
        for (alpha, azimuth) in
            [0.1, 0.4].into_iter().flat_map(|alpha| [10.0, 100.0, 215.0].map(|azimuth| (alpha, azimuth)))
        {
            let (mut last, mut faded) = (None::<[f64; 4]>, 0.0_f64);
            for i in 0..12_000 {
                let elevation = 1e-5 + step * f64::from(i);
                let next = blended(&taps, elevation, azimuth, alpha);
                if let Some(last) = last {
                    let jump =
                        [0, 1, 2, 3].map(|k| (next[k] - last[k]).abs()).into_iter().fold(0.0, f64::max);
                    assert!(
                        jump < 4e-3,
                        "{} fetches, {alpha}, {azimuth} at {elevation}: {jump}",
                        rule.count()
                    );
                }
                let single = blended(&one, elevation, azimuth, alpha);
                let off = [0, 1, 2].map(|k| next[k] - single[k]);
                faded = faded.max(length(off));
                last = Some(next);
            }
            assert!(faded > 1e-3, "{} fetches, {alpha}, {azimuth}: as one fetch: {faded}", rule.count());
        }
    }
}

#[test]
fn what_fades_at_the_horizon_keeps_the_sum_of_weights() {
    let (axis, major) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let taps =
        [RuleTap { tilt: -0.5, width: 0.5, weight: 0.4 }, RuleTap { tilt: 0.5, width: 0.8, weight: 0.6 }];
    for i in 0..=200 {
        let (s, c) = sincos(degrees(0.9 * f64::from(i)));
        let mut faded = taps;
        fade(&mut faded, axis, major, [c, 0.0, s]);
        assert!((faded.iter().map(|tap| tap.weight).sum::<f64>() - 1.0).abs() < 1e-12, "{faded:?}");
        assert!(faded.iter().all(|tap| tap.weight >= 0.0 && tap.tilt.abs() <= 0.5), "{faded:?}");
    }
    let over = |normal| {
        let mut faded = taps;
        fade(&mut faded, axis, major, normal);
        faded
    };
    assert_eq!(over([1.0, 0.0, 0.0]), taps);
    // half of it is above
    let [below, above] = over([0.0, 0.0, 1.0]);
    assert_eq!((below.weight, above.weight), (0.0, 1.0));
    assert_eq!((above.tilt, above.width), (taps[1].tilt, taps[1].width));
    assert_eq!((below.tilt, below.width), (0.0, 1.0));
    // nothing is above: the one fetch
    for tap in over([-1.0, 0.0, 0.0]) {
        assert_eq!((tap.tilt, tap.width), (0.0, 1.0));
    }
}
