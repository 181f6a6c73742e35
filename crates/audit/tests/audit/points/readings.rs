//! Tables of GGX that were misread: their lookups, clamps, quantisers, the order of axes and channels,
//! rounding.

use lobefit::data::Smith;
use lobefit_audit::audit::{AuditedTable, Column, Defect, Fit, Fixed, Input, Registration, Scale};
use lobefit_audit::foreign::Step;
use lobefit_math::ops;

use super::{N, a, at, b, e, table};
use crate::support::{
    Filled, axes, both, columns, eight, half, jitter, plane, reflection_of, refused, rising, run, said, says,
};

/// Mu along x and roughness along y, of a registration.
fn plain(registration: Registration) -> Vec<(Scale, Registration, bool)> {
    rising(&[Scale::Mu, Scale::Roughness], registration)
}

/// The largest errors of A, of B and of f0 A + B over lookups of a texture unit, on a finer lattice than the
/// audit's, down to the edges.
fn largest_of_lookups(shipped: &AuditedTable) -> [f64; 3] {
    let fetch = |values: &[f64], u: f64, v: f64| {
        let place = |t: f64| (t * N as f64 - 0.5).clamp(0.0, (N - 1) as f64);
        let (p, q) = (place(u), place(v));
        let (i, j) = ((p as usize).min(N - 2), (q as usize).min(N - 2));
        let (s, t) = (p - i as f64, q - j as f64);
        let row = |j: usize| values[j * N + i] * (1.0 - s) + values[j * N + i + 1] * s;
        row(j) * (1.0 - t) + row(j + 1) * t
    };
    let mut worst = [0.0_f64; 3];
    for place in 0..61 * 61 {
        let [u, v] = [place / 61, place % 61].map(|k| ops::pow(k as f64 / 60.0, 2.0));
        let (e, bias) = both(Smith::Correlated, v * v, u.max(1e-7));
        let [ra, rb] = [0, 1].map(|c: usize| fetch(&shipped.channels[c].values, u, v));
        let off = [ra - (e - bias), rb - bias, (ra + rb - e).abs().max((rb - bias).abs())];
        worst = [0, 1, 2].map(|c: usize| worst[c].max(off[c].abs()));
    }
    worst
}

/// The headline was of the first channel alone, and "at most" of the worst of some samples.
#[test]
fn point_01_lookups_are_those_of_every_channel_and_of_the_blend_at_their_worst() {
    let shipped = table(&[("R", &a), ("G", &b)]);
    let found = reflection_of(&shipped);
    assert_eq!(
        (axes(&found), columns(&found)),
        (plain(Registration::Centre), vec![Some(Column::A), Some(Column::B)])
    );
    let max = |c: usize| found.channels[c].lookup.as_ref().unwrap().max;
    let own = [max(0), max(1), found.blend.as_ref().unwrap().max];
    let sampled = largest_of_lookups(&shipped);
    for (own, sampled) in own.into_iter().zip(sampled) {
        assert!(own > 0.97 * sampled && own < 1.2 * sampled, "{own} {sampled}");
    }
    // What lies between the outermost texels stands in the first line, what lies beyond in the errors.
    let inner = found.blend.as_ref().unwrap().inner;
    assert!(inner < own[2], "{inner}");
    let line = format!("A and B: shipped is off by at most {inner:.4} of f0 A + B in lookups (alpha");
    let beyond = format!(", and by {:.3} beyond those (", own[2]);
    // Each over the same places as the first.
    let inner = |c: usize| found.channels[c].lookup.as_ref().unwrap().inner;
    let each = format!("; A by {:.4}, B by {:.4}.", inner(0), inner(1));
    says(&found.verdict(None), "PASS", &[&line, &beyond, &each]);
}

/// A table from roughness 0.04 on was read as one of right edges, "in no doubt".
#[test]
fn a_range_of_roughness_that_is_not_stated_is_inferred() {
    let share = |k: usize| k as f64 / (N - 1) as f64;
    let end: fn(usize) -> f64 = |x| (x as f64 / (N - 1) as f64).max(1e-7);
    for ([from, to], mu) in [([0.04, 1.0], at as fn(usize) -> f64), ([0.9, 0.1], end), ([0.137, 0.83], end)] {
        let roughness = |y: usize| from + (to - from) * share(y);
        let of = |x: usize, y: usize| both(Smith::Correlated, ops::pow(roughness(y), 2.0), mu(x));
        let made = table(&[("R", &|x, y| of(x, y).0 - of(x, y).1), ("G", &|x, y| of(x, y).1)]);
        let found = reflection_of(&made);
        let alphas = (0..N).map(|k| found.best().axes[1].node(k, N));
        let off = alphas.enumerate().map(|(k, alpha)| (alpha.sqrt() - roughness(k)).abs());
        assert!(off.fold(0.0, f64::max) < 2e-3, "{:?}", found.best().axes);
        let stated = format!("it has roughness={from}..{to} along y");
        let why = [&stated, "by its slices, as no range is stated", "--axes mu,roughness="];
        says(&found.verdict(None), "FAIL", &why);
        let scales = [Scale::Mu, Scale::between_roughnesses([from, to], true)];
        let axes = Some(scales.map(|scale| (scale, false)).to_vec());
        let meant = run(&made, "ggx-reflection", &Fixed { axes, ..Fixed::default() });
        says(&meant.verdict(None), "PASS", &[]);
    }
    let whole = reflection_of(&table(&[("R", &a), ("G", &b)]));
    assert_eq!(axes(&whole), plain(Registration::Centre));
}

/// An average of a table that is off by more in rougher rows was read over a roughness of 0 to 0.99, half as
/// far off, with that as its remedy.
#[test]
fn an_error_that_grows_with_roughness_is_no_range_of_it() {
    let of = |x: usize, y: usize| {
        let (roughness, mu) = ((y as f64 + 0.5) / N as f64, at(x));
        let [own, smoother] =
            [1.0, 0.97].map(|part| both(Smith::Correlated, ops::pow(part * roughness, 2.0), mu).0);
        own + (smoother - own) * (1.8 - 1.6 * mu)
    };
    let found = reflection_of(&table(&[("R", &of)]));
    assert_eq!(axes(&found), plain(Registration::Centre), "{}", said(&found));
}

/// Of one flipped channel the other was blamed, under rows that all fall; of both it is how rows are read.
#[test]
fn one_flipped_channel_is_named() {
    let last = N - 1;
    let flips: [Filled; 2] = [
        ("has B flipped along y", &|x, y| b(x, last - y)),
        ("has B flipped along x", &|x, y| b(last - x, y)),
    ];
    for (line, falls) in flips {
        let found = reflection_of(&table(&[("R", &a), ("G", falls)]));
        assert_eq!(columns(&found), [Some(Column::A), Some(Column::B)]);
        says(&found.verdict(None), "FAIL", &[line, "turn B round along"]);
    }
    let both = reflection_of(&table(&[("R", &|x, y| a(x, last - y)), ("G", &|x, y| b(x, last - y))]));
    says(&both.verdict(None), "FAIL", &["gloss"]);
    assert!(!said(&both).contains("flipped along"), "{}", said(&both));
}

/// Clamps of 0.02 and 0.035 were guessed as 0.01, and an error of 0.05 called other code; of a table without
/// a clamp one was invented. One that nobody states is looked for between two rows.
#[test]
fn point_02_a_stated_clamp_is_taken_and_none_is_invented() {
    let clamped =
        |clamp: f64| table(&[("R", &|x, y| both(Smith::Correlated, (at(y) * at(y)).max(clamp), at(x)).0)]);
    for clamp in [0.02, 0.035] {
        let stated = Fixed { floors: vec![(Input::Alpha, clamp)], ..Fixed::default() };
        let found = run(&clamped(clamp), "ggx-reflection", &stated);
        assert!(found.worst() < 1e-6, "{clamp}: {}", found.worst());
        assert_eq!(found.best().axes.iter().map(|axis| axis.floor).collect::<Vec<_>>(), [0.0, clamp]);
        says(&found.verdict(Some(1e-6)), "PASS", &["ggx-reflection E", &format!("clamped to {clamp}")]);
    }
    let free = reflection_of(&clamped(0.035));
    assert!(free.worst() < 1e-4, "{}: it is found between two rows", free.worst());
    let sound = reflection_of(&table(&[("R", &e)]));
    assert!(sound.best().axes.iter().all(|axis| axis.floor == 0.0) && sound.worst() < 1e-6);
    let wrong = Fixed { floors: vec![(Input::Ior, 1.1)], ..Fixed::default() };
    assert!(refused(&clamped(0.035), "ggx-reflection", &wrong).contains("--clamp"));
}

/// A value cut off to so many bits of mantissa.
fn cut(x: f64, bits: f64) -> f64 {
    let step = ops::pow(2.0, ops::log2(x).floor() + 1.0 - bits);
    (x / step).floor() * step
}

/// Mantissas of 8 bits that are cut off, as RGBE's, leave values too low, like those of a rougher or more
/// grazing place: the remedy "move the rows" would have harmed.
#[test]
fn point_06_a_biased_quantiser_is_no_shifted_registration() {
    let end = |i: usize| (i as f64 / (N - 1) as f64).max(1e-3);
    let of_ends = |x: usize, y: usize| both(Smith::Correlated, end(y) * end(y), end(x)).0;
    for (shipped, registration, most) in [
        (table(&[("R", &|x, y| cut(e(x, y), 8.0))]), Registration::Centre, 0.004),
        (table(&[("R", &|x, y| (e(x, y) * 255.0).floor() / 255.0)]), Registration::Centre, 0.004),
        (table(&[("R", &|x, y| cut(of_ends(x, y), 7.0))]), Registration::Endpoint, 0.008),
    ] {
        let found = reflection_of(&shipped);
        assert_eq!((axes(&found), columns(&found)), (plain(registration), vec![Some(Column::E)]));
        assert!(found.plain.is_none() && found.worst() < most, "{:?} {}", found.plain, found.worst());
        assert!(!found.verdict(None).remedy.join(" ").contains("compute texel"), "{}", said(&found));
        says(&found.verdict(Some(0.01)), "PASS", &["ggx-reflection E"]);
    }
}

/// Where noise is as large as what half a texel makes, centres and end points are open: the plainer is
/// stated, of all axes, and no remedy of a registration.
#[test]
fn point_06_no_remedy_is_stated_of_a_registration_that_is_open() {
    const SIDE: usize = 64;
    let end = |i: usize| (i as f64 / (SIDE - 1) as f64).max(1e-3);
    let e = |x: usize, y: usize| both(Smith::Correlated, end(y) * end(y), end(x)).0 + 0.012 * jitter(x, y);
    let found = reflection_of(&plane([SIDE; 2], &[("R", &e)]));
    assert_eq!(axes(&found), plain(Registration::Centre));
    let remedy = found.verdict(None).remedy.join(" ");
    assert!(!remedy.contains("compute texel") && !remedy.contains("sample at"), "{remedy}");
}

/// Both passed a limit without a word, and a broken texture was shipped.
#[test]
fn point_08_transposed_and_swapped_tables_fail_a_limit_until_they_are_meant() {
    let transposed = table(&[("R", &|x, y| a(y, x)), ("G", &|x, y| b(y, x))]);
    let swapped = table(&[("R", &b), ("G", &a)]);
    let turned = Some(vec![(Scale::Roughness, false), (Scale::Mu, false)]);
    let meanings = Some(vec![Some(Column::B), Some(Column::A)]);
    for (shipped, option, held, off, meant) in [
        (
            transposed,
            "--axes roughness,mu",
            "it has roughness along x, mu along y",
            0.2,
            Fixed { axes: turned, ..Fixed::default() },
        ),
        (swapped, "--meaning B,A", "it has B before A", 0.5, Fixed { meanings, ..Fixed::default() }),
    ] {
        let found = reflection_of(&shipped);
        let plain = found.plain.as_ref().expect("no reader assumes it");
        assert!(plain.options == option && plain.max > off, "{plain:?}");
        assert!(found.worst() < 1e-6);
        says(
            &found.verdict(Some(0.1)),
            "FAIL",
            &[
                "ggx-reflection ",
                "shipped is off by at most ",
                " read plainly, at alpha ",
                held,
                &format!("say so (`{option}`)"),
            ],
        );
        let meant = run(&shipped, "ggx-reflection", &meant);
        says(&meant.verdict(Some(1e-6)), "PASS", &["ggx-reflection"]);
    }
}

/// "What rounding to half leaves" was said of errors of two to five steps.
#[test]
fn point_13_rounding_is_claimed_where_it_explains_every_texel() {
    let steps = |shipped: &AuditedTable| {
        let found = reflection_of(shipped);
        assert_eq!((found.fit, axes(&found)), (Fit::Whole, plain(Registration::Centre)));
        let named = found.channels[0].defects.iter().any(|d| matches!(d, Defect::Steps { .. }));
        assert_eq!(said(&found).contains("what rounding to half leaves"), named, "{}", said(&found));
        (named, found.worst())
    };
    let (named, worst) = steps(&table(&[("R", &|x, y| half(e(x, y)))]));
    assert!(named && worst <= 0.25e-3, "half a step of a half below 1: {worst}");
    let worse = |x: usize, y: usize| {
        half(e(x, y) + if (x + y).is_multiple_of(9) { 1e-3 * jitter(x, y) } else { 0.0 })
    };
    let (named, worst) = steps(&table(&[("R", &worse)]));
    assert!(!named && worst > 0.5e-3, "{worst}");
}

/// A roughness that is held from below at 0.2, which no list of clamps has.
#[test]
fn clamps_are_seen() {
    let held = |y: usize| at(y).max(0.2) * at(y).max(0.2);
    let of = |y: usize, x: usize| both(Smith::Correlated, held(y), at(x));
    let clamped = table(&[("R", &|x, y| of(y, x).0 - of(y, x).1), ("G", &|x, y| of(y, x).1)]);
    let found = reflection_of(&clamped);
    let [mu, roughness] = [0, 1].map(|k| found.best().axes[k].floor);
    assert!(mu == 0.0 && (0.03..0.06).contains(&roughness), "{mu} {roughness}");
    assert!(found.fit == Fit::Whole && found.worst() < 0.02, "{}", found.worst());
}

/// The same under the noise of some thousand samples, where lines that the clamp makes one differ: it was
/// found at 0.005, a number of the list, or at one between.
#[test]
fn clamps_are_seen_under_noise() {
    let centre = |i: usize| (i as f64 + 0.5) / 32.0;
    for (least, noise, within) in [(4e-3, 1e-3, 1e-9), (4.6e-3, 5e-4, 3e-4)] {
        let value = |x: usize, y: usize| {
            let alpha = (centre(y) * centre(y)).max(least);
            (both(Smith::Correlated, alpha, centre(x)).0 + noise * jitter(x, y)).min(1.0)
        };
        let found = reflection_of(&plane([32; 2], &[("R", &value)]));
        let floor = found.best().axes[1].floor;
        assert!((floor - least).abs() <= within, "{floor}, {least}");
        says(&found.verdict(None), "PASS", &["alpha clamped to 0.00"]);
    }
}

/// A cosine and an alpha with a floor each, of which some show in a corner alone and some in one line, near
/// to it: the texels there were "of other code".
#[test]
fn clamps_of_two_inputs_are_told_apart() {
    let ends = |i: usize| i as f64 / 31.0;
    let centres = |i: usize| (i as f64 + 0.5) / 32.0;
    for (place, mu, alpha) in [
        (&ends as &dyn Fn(usize) -> f64, 1e-4, 1e-3),
        (&ends, 1e-6, 0.089 * 0.089),
        (&centres, 0.02, 1e-3),
        (&centres, 0.02, 0.089 * 0.089),
    ] {
        let of =
            |x: usize, y: usize| both(Smith::Correlated, (place(y) * place(y)).max(alpha), place(x).max(mu));
        let clamped = plane([32; 2], &[("R", &|x, y| of(x, y).0 - of(x, y).1), ("G", &|x, y| of(x, y).1)]);
        let found = reflection_of(&clamped);
        assert!(found.worst() < 1e-3, "{mu} {alpha}: {}", found.worst());
        says(&found.verdict(None), "PASS", &["A and B"]);
    }
}

/// Fresnel's term of another power, and a gamma: they passed, one as B/E.
#[test]
fn what_no_convention_explains_is_no_pass() {
    // B of a power over that of the fifth, by one set of facets for both.
    let share = |alpha: f64, mu: f64, power: f64| {
        let mut sums = [0.0; 2];
        for k in 0..48 * 48 {
            let [v, phi] = [k / 48, k % 48].map(|i| (f64::from(i) + 0.5) / 48.0);
            let cosine = ((1.0 - v) / (1.0 + (alpha * alpha - 1.0) * v)).sqrt();
            let sine = (1.0 - cosine * cosine).sqrt();
            let y = (1.0 - mu * mu).sqrt() * sine * ops::cos(std::f64::consts::PI * phi) + mu * cosine;
            let light = 2.0 * y * cosine - mu;
            if y > 0.0 && light > 0.0 {
                let weight = y / cosine / (mu + light);
                sums = [(0, 5.0), (1, power)]
                    .map(|(k, p): (usize, f64)| sums[k] + weight * ops::pow(1.0 - y.min(1.0), p));
            }
        }
        sums[1] / sums[0]
    };
    type Change<'a> = &'a dyn Fn(usize, usize) -> [f64; 2];
    let of_power = |power: f64| {
        move |x: usize, y: usize| {
            let bias = b(x, y) * share(at(y) * at(y), at(x), power);
            [e(x, y) - bias, bias]
        }
    };
    let [low, high, six] = [4.5, 5.5, 6.0].map(of_power);
    let gamma = |x: usize, y: usize| [a(x, y), b(x, y)].map(|v| ops::pow(v, 1.1));
    let changes: [Change; 4] = [&low, &high, &six, &gamma];
    for of in changes {
        let found = reflection_of(&table(&[("R", &|x, y| of(x, y)[0]), ("G", &|x, y| of(x, y)[1])]));
        says(&found.verdict(None), "UNKNOWN", &["neither noise nor rounding explains them: --limit says"]);
        says(&found.verdict(Some(0.2)), "PASS", &[]);
        // Noise explains no more than itself.
        let noisy = |x: usize, y: usize, k: usize| of(x, y)[k] + 0.02 * jitter(x + 20 * k, y);
        let found = reflection_of(&table(&[("R", &|x, y| noisy(x, y, 0)), ("G", &|x, y| noisy(x, y, 1))]));
        says(&found.verdict(None), "UNKNOWN", &[]);
    }
}

/// A table that was made larger, by each of the ways that image tools have: it has no clamp, no damaged part
/// and no noise, but the error of the smaller.
#[test]
fn enlarged_tables_are_named_with_what_they_were_made_from() {
    let small = |i: usize| (i as f64 + 0.5) / 8.0;
    let lattice: Vec<f64> =
        (0..64).map(|i| both(Smith::Correlated, small(i / 8) * small(i / 8), small(i % 8)).0).collect();
    let of = |place: &dyn Fn(usize) -> f64| {
        let enlarged = |x: usize, y: usize| {
            let (i, j) = ((place(x) as usize).min(6), (place(y) as usize).min(6));
            let (s, t) = (place(x) - i as f64, place(y) - j as f64);
            let row = |j: usize| lattice[8 * j + i] * (1.0 - s) + lattice[8 * j + i + 1] * s;
            row(j) * (1.0 - t) + row(j + 1) * t
        };
        reflection_of(&plane([32; 2], &[("R", &enlarged)]))
    };
    let linear = "is of 8 x 8 texels enlarged by linear interpolation: off by at most";
    let store = "store the 8 x 8 texels that it was made from";
    let ends = of(&|i| 7.0 * i as f64 / 31.0);
    let centres = of(&|i| ((i as f64 + 0.5) / 4.0 - 0.5).clamp(0.0, 7.0));
    let repeated = of(&|i| (i / 4) as f64);
    for (found, how) in [
        (ends, linear),
        (centres, linear),
        (repeated, "is of 8 x 8 texels enlarged by repeating them: off by at most"),
    ] {
        says(&found.verdict(None), "FAIL", &[how, store]);
        assert!(found.best().axes.iter().all(|axis| axis.floor == 0.0), "{:?}", found.best().axes);
    }
    // Of two channels; along one axis alone; and a table of its own size is none, however smooth.
    let columns = |x: usize, y: usize| e(x / 2 * 2, y);
    let found = reflection_of(&table(&[("R", &columns)]));
    says(&found.verdict(None), "FAIL", &["is of 8 x 16 texels enlarged by repeating them"]);
    let twice = |f: &dyn Fn(usize, usize) -> f64, x: usize, y: usize| f(x / 4, y / 4);
    let both = plane([4 * N; 2], &[("R", &|x, y| twice(&a, x, y)), ("G", &|x, y| twice(&b, x, y))]);
    says(&reflection_of(&both).verdict(None), "FAIL", &["is of 16 x 16 texels enlarged by repeating them"]);
    assert!(!said(&reflection_of(&table(&[("R", &e)]))).contains("enlarged"));
    // Nor one of 8 bits at end points, over alpha: each bend is within some steps.
    let end = |i: usize| (i as f64 / 31.0).max(1e-4);
    let rounded = |x: usize, y: usize| eight(crate::support::both(Smith::Correlated, end(y), end(x)).0);
    let picture = AuditedTable { step: Step::Unorm(8), ..plane([32; 2], &[("R", &rounded)]) };
    assert!(!said(&reflection_of(&picture)).contains("enlarged"));
}

/// alpha = roughness^3, which is no convention of engines.
#[test]
fn a_cube_of_roughness_is_found() {
    let cubed = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y) * at(y), at(x));
    let found = reflection_of(&table(&[("R", &|x, y| cubed(x, y).0)]));
    assert_eq!(axes(&found), rising(&[Scale::Mu, Scale::RoughnessThird], Registration::Centre));
    says(&found.verdict(None), "FAIL", &["it has alpha^(1/3) along y", "`--axes mu,alpha^(1/3)`"]);
}

/// A and B in the first and the last of three channels: a reader takes them from the first two.
#[test]
fn channels_that_do_not_stand_together_are_said() {
    let found = reflection_of(&table(&[("R", &a), ("G", &|_, _| 0.0), ("B", &b)]));
    let said = ["read plainly", "B in the third channel, A in the first", "`--meaning A,-,B`"];
    says(&found.verdict(None), "FAIL", &said);
    assert!(found.plain.as_ref().unwrap().max > 0.5, "{:?}", found.plain);
    let meanings = Some(vec![Some(Column::A), None, Some(Column::B)]);
    let meant = run(
        &table(&[("R", &a), ("G", &|_, _| 0.0), ("B", &b)]),
        "ggx-reflection",
        &Fixed { meanings, ..Fixed::default() },
    );
    says(&meant.verdict(None), "PASS", &["ggx-reflection A and B"]);
}

/// Rows that hold those before them: their errors are of both signs, and end at their edges.
#[test]
fn rows_that_hold_those_before_them_are_named() {
    let of = |y: usize| if (6..9).contains(&y) { y - 1 } else { y };
    let found = reflection_of(&table(&[("R", &|x, y| a(x, of(y))), ("G", &|x, y| b(x, of(y)))]));
    says(&found.verdict(None), "FAIL", &["at y = 6 to 8", "make the texels at y = 6 to 8 again"]);
}
