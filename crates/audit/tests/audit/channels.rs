//! Files of several quantities, of sums, averages, encodings and clamps: what each channel holds.

use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditedTable, Channel, Column, Defect, ENCODINGS, Fit, Fixed, Input, Other, Registration, Scale,
    Source, audit,
};
use lobefit_audit::foreign::Step;
use lobefit_math::ops;
use lobefit_truth::integrate::reflection::{Effort, split};
use lobefit_truth::quantity;
use lobefit_truth::quantity::sheen;

const N: usize = 16;

fn at(i: usize) -> f64 {
    (i as f64 + 0.5) / N as f64
}

fn ggx(x: usize, y: usize) -> (f64, f64) {
    split(Smith::Correlated, at(y) * at(y), at(x), &Effort::ladder()[1])
}

/// A fixed scramble in [-1, 1] of a texel.
fn jitter(i: usize, j: usize) -> f64 {
    let h = (i as u64 * 0x9e37_79b9 + j as u64 * 0x85eb_ca6b + 1).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (h >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A channel: its name, and its value at a column and a row.
pub(crate) type Filled<'a> = (&'a str, &'a dyn Fn(usize, usize) -> f64);

/// A table as engines ship it, of so many columns and rows.
pub(crate) fn square(side: usize, channels: &[Filled]) -> AuditedTable {
    let channel = |(name, f): &Filled| Channel {
        name: name.to_string(),
        values: (0..side * side).map(|i| f(i % side, i / side)).collect(),
    };
    AuditedTable {
        what: "shipped".into(),
        size: vec![side, side],
        axes: AuditedTable::axes_of(2),
        source: Source::Table,
        channels: channels.iter().map(channel).collect(),
        step: Step::None,
        dead: Vec::new(),
    }
}

fn table(channels: &[Filled]) -> AuditedTable {
    square(N, channels)
}

pub(crate) fn run(shipped: &AuditedTable, quantity: &str, fixed: &Fixed) -> Audit {
    let found = audit(shipped, quantity::find(quantity).unwrap(), fixed, &|_| ()).unwrap();
    eprintln!(
        "{}\n{:?}",
        found.verdict(None),
        found.tried.iter().take(2).map(|t| &t.convention.axes).collect::<Vec<_>>()
    );
    found
}

fn axes(found: &Audit) -> Vec<(Scale, Registration, bool)> {
    found.best().axes.iter().map(|a| (a.scale, a.registration, a.reversed)).collect()
}

#[test]
fn a_foreign_channel_does_not_condemn_the_others() {
    let a = |x: usize, y: usize| ggx(x, y).0 - ggx(x, y).1;
    let b = |x: usize, y: usize| ggx(x, y).1;
    let charlie = |x: usize, y: usize| sheen::albedo(at(y) * at(y), at(x));
    // The axes are given: what is looked for is the meaning of the channels.
    let axes = Some(vec![(Scale::Mu, false), (Scale::Roughness, false)]);
    let given = Fixed { axes, registrations: Some(vec![Registration::Centre]), ..Fixed::default() };
    let found = run(&table(&[("R", &a), ("G", &b), ("B", &charlie)]), "ggx-reflection", &given);
    assert_eq!(
        (found.fit, found.best().columns.clone()),
        (Fit::Whole, vec![Some(Column::A), Some(Column::B), None])
    );
    let Some(Other::Quantity(sheen)) = &found.channels[2].other else {
        panic!("{:?}", found.channels[2].other)
    };
    assert_eq!((sheen.quantity, sheen.best().columns.clone()), ("sheen-charlie", vec![Some(Column::E)]));
    assert!(found.worst() < 1e-6 && found.passes(Some(1e-3)), "{}", found.worst());
    assert!(
        found.verdict(None).to_string().contains("Channel B is of another quantity"),
        "{}",
        found.verdict(None).to_string()
    );
    // Noise is none: it is left out, and a limit asks for a word about it.
    let noise = table(&[("R", &|x, y| ggx(x, y).0), ("G", &|x, y| 0.5 + 0.5 * jitter(x, y))]);
    let found = run(&noise, "ggx-reflection", &given);
    assert_eq!((found.fit, &found.channels[1].other), (Fit::Whole, &Some(Other::Unknown)));
    assert!(!found.passes(Some(1e-3)));
    assert!(found.unjudged().is_some_and(|why| why.contains("--meaning E,-")), "{:?}", found.unjudged());
    let meanings = Some(vec![Some(Column::E), None]);
    assert!(run(&noise, "ggx-reflection", &Fixed { meanings, ..given.clone() }).passes(Some(1e-3)));
    let meanings = Some(vec![None; 2]);
    let none = Fixed { meanings, ..Fixed::default() };
    let refused = audit(&noise, quantity::find("ggx-reflection").unwrap(), &none, &|_| ()).unwrap_err();
    assert!(refused.to_string().contains("every channel is left out"), "{refused}");
}

#[test]
fn e_of_a_table_of_a_and_b_is_their_sum() {
    let split = table(&[("R", &|x, y| ggx(x, y).0 - ggx(x, y).1), ("G", &|x, y| ggx(x, y).1)]);
    let fixed = Fixed { column: Some(Column::E), ..Fixed::default() };
    let found = run(&split, "ggx-reflection", &fixed);
    let judged: Vec<&str> =
        found.channels.iter().filter(|c| c.column.is_some()).map(|c| c.name.as_str()).collect();
    assert_eq!(judged, ["R + G"]);
    assert!(found.passes(Some(1e-6)), "{}", found.worst());
    // A channel of E itself goes before sums.
    let own = table(&[("R", &|x, y| ggx(x, y).1), ("G", &|x, y| ggx(x, y).0)]);
    let found = run(&own, "ggx-reflection", &fixed);
    assert!(found.channels[1].column == Some(Column::E) && found.passes(Some(1e-6)));
}

#[test]
fn transposed_and_swapped_tables_fail_a_limit_until_they_are_meant() {
    let (a, b) = (|x: usize, y: usize| ggx(x, y).0 - ggx(x, y).1, |x: usize, y: usize| ggx(x, y).1);
    let transposed = table(&[("R", &|x, y| a(y, x)), ("G", &|x, y| b(y, x))]);
    let found = run(&transposed, "ggx-reflection", &Fixed::default());
    let plain = found.plain.as_ref().expect("no reader assumes it");
    assert!(plain.options == "--axes roughness,mu" && plain.max > 0.2, "{plain:?}");
    assert!(found.worst() < 1e-6 && !found.passes(Some(0.1)));
    let meant = Fixed { axes: Some(vec![(Scale::Roughness, false), (Scale::Mu, false)]), ..Fixed::default() };
    assert!(run(&transposed, "ggx-reflection", &meant).passes(Some(1e-6)));
    let swapped = table(&[("R", &b), ("G", &a)]);
    let found = run(&swapped, "ggx-reflection", &Fixed::default());
    let plain = found.plain.as_ref().expect("no reader assumes it");
    assert!(plain.options == "--meaning B,A" && plain.max > 0.5, "{plain:?}");
    assert!(!found.passes(Some(0.1)));
    let meant = Fixed { meanings: Some(vec![Some(Column::B), Some(Column::A)]), ..Fixed::default() };
    assert!(run(&swapped, "ggx-reflection", &meant).passes(Some(1e-6)));
}

#[test]
fn a_biased_quantiser_is_no_shifted_registration() {
    // Mantissas of 8 bits cut off, as an RGBE that truncates: values are too low, like those of a
    // rougher or more grazing place.
    let cut = |x: f64| {
        let exponent = ops::log2(x).floor() + 1.0;
        let step = ops::pow(2.0, exponent - 8.0);
        (x / step).floor() * step
    };
    let truncated = table(&[("R", &|x, y| cut(ggx(x, y).0))]);
    let eight = table(&[("R", &|x, y| (ggx(x, y).0 * 255.0).floor() / 255.0)]);
    for shipped in [truncated, eight] {
        let found = run(&shipped, "ggx-reflection", &Fixed::default());
        assert_eq!(
            axes(&found),
            [(Scale::Mu, Registration::Centre, false), (Scale::Roughness, Registration::Centre, false)]
        );
        assert!(found.plain.is_none() && found.passes(Some(0.01)), "{:?}", found.plain);
    }
}

#[test]
fn a_stated_clamp_is_taken_and_none_is_invented() {
    let e = |alpha: f64, x: usize| split(Smith::Correlated, alpha, at(x), &Effort::ladder()[1]).0;
    let clamped = table(&[("R", &|x, y| e((at(y) * at(y)).max(0.035), x))]);
    let free = run(&clamped, "ggx-reflection", &Fixed::default());
    assert!(free.worst() > 1e-3, "{}", free.worst());
    let fixed = Fixed { floors: vec![(Input::Alpha, 0.035)], ..Fixed::default() };
    let stated = run(&clamped, "ggx-reflection", &fixed);
    assert!(stated.worst() < 1e-6 && stated.passes(Some(1e-6)), "{}", stated.worst());
    assert!(stated.best().axes[1].floor == 0.035 && stated.best().axes[0].floor == 0.0);
    let wrong = Fixed { floors: vec![(Input::Ior, 1.1)], ..Fixed::default() };
    let refused = audit(&clamped, quantity::find("ggx-reflection").unwrap(), &wrong, &|_| ()).unwrap_err();
    assert!(refused.to_string().contains("--clamp"), "{refused}");
}

#[test]
fn an_encoding_of_several_channels_is_found() {
    let (a, b) = (|x: usize, y: usize| ggx(x, y).0 - ggx(x, y).1, |x: usize, y: usize| ggx(x, y).1);
    let eight = |x: f64| (x.clamp(0.0, 1.0) * 255.0).round() / 255.0;
    let e = |x: usize, y: usize| ops::log2(a(x, y).max(b(x, y))).floor() + 1.0;
    let scaled = |v: f64, e: f64| eight(v / ops::pow(2.0, e) * 256.0 / 255.0);
    let mut rgbe = table(&[
        ("R", &|x, y| scaled(a(x, y), e(x, y))),
        ("G", &|x, y| scaled(b(x, y), e(x, y))),
        ("B", &|_, _| 0.0),
        ("A", &|x, y| (e(x, y) + 128.0) / 255.0),
    ]);
    rgbe.step = Step::Unorm8;
    let found = run(&rgbe, "ggx-reflection", &Fixed::default());
    let said = found.verdict(None).to_string();
    assert!(
        found.fit == Fit::Whole && said.contains("decoded from RGBE") && said.contains("R = A"),
        "{said}"
    );
    assert!(found.worst() < 0.005 && !found.passes(Some(0.01)), "{}", found.worst());
    // Said to be encoded so, it is what it is meant to be, and what cannot be encoded so is refused.
    let encoding = ENCODINGS.iter().find(|encoding| encoding.word == "rgbe");
    let meanings = Some(vec![Some(Column::A), Some(Column::B)]);
    let meant = run(&rgbe, "ggx-reflection", &Fixed { encoding, meanings, ..Fixed::default() });
    assert!(meant.plain.is_none() && meant.passes(Some(0.01)), "{:?}", meant.plain);
    let bare = table(&[("R", &a)]);
    let refused = audit(
        &bare,
        quantity::find("ggx-reflection").unwrap(),
        &Fixed { encoding, ..Fixed::default() },
        &|_| (),
    );
    assert!(refused.unwrap_err().to_string().contains("--encoding"));
}

#[test]
fn rgbd_with_a_channel_of_another_quantity_is_found() {
    let (b, e) = (|x: usize, y: usize| ggx(x, y).1, |x: usize, y: usize| ggx(x, y).0);
    let charlie = |x: usize, y: usize| sheen::albedo(at(y) * at(y), at(x));
    let eight = |x: f64| (x.clamp(0.0, 1.0) * 255.0).round() / 255.0;
    // Colours are (value alpha)^(1/2.2), alpha is the largest that keeps them below 1.
    let alpha = |x: usize, y: usize| (1.0 / charlie(x, y).max(1.0) * 255.0).floor() / 255.0;
    let stored = |v: f64, alpha: f64| eight(ops::pow(v * alpha, 1.0 / 2.2));
    let mut rgbd = table(&[
        ("R", &|x, y| stored(b(x, y), alpha(x, y))),
        ("G", &|x, y| stored(e(x, y), alpha(x, y))),
        ("B", &|x, y| stored(charlie(x, y), alpha(x, y))),
        ("A", &alpha),
    ]);
    rgbd.step = Step::Unorm8;
    let axes = Some(vec![(Scale::Mu, false), (Scale::Roughness, false)]);
    let given = Fixed { axes, registrations: Some(vec![Registration::Centre]), ..Fixed::default() };
    let said = run(&rgbd, "ggx-reflection", &given).verdict(None).to_string();
    for words in ["decoded from RGBD of gamma 2.2", "R = B (", "G = E ("] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn an_average_of_sheen_is_one() {
    // Midpoints over the root of the cosine.
    let average = |alpha: f64| -> f64 {
        let one = |i: usize| {
            let root = (i as f64 + 0.5) / 2000.0;
            4.0 * root * root * root * sheen::albedo(alpha, root * root) / 2000.0
        };
        (0..2000).map(one).sum()
    };
    let values = (0..32).map(|i| average(((i as f64 + 0.5) / 32.0) * ((i as f64 + 0.5) / 32.0))).collect();
    let shipped = AuditedTable {
        size: vec![32],
        axes: AuditedTable::axes_of(1),
        channels: vec![Channel { name: "0".into(), values }],
        ..table(&[])
    };
    let found = run(&shipped, "sheen-charlie", &Fixed::default());
    assert_eq!((found.fit, found.best().columns.clone()), (Fit::Whole, vec![Some(Column::Average)]));
    assert_eq!(axes(&found), [(Scale::Roughness, Registration::Centre, false)]);
    assert!(found.worst() < 3e-5, "{}", found.worst());
}

#[test]
fn lookups_are_those_of_every_channel_and_of_the_blend_at_their_worst() {
    let (a, b) = (|x: usize, y: usize| ggx(x, y).0 - ggx(x, y).1, |x: usize, y: usize| ggx(x, y).1);
    let shipped = table(&[("R", &a), ("G", &b)]);
    let found = run(&shipped, "ggx-reflection", &Fixed::default());
    // Lookups of a texture unit on a finer lattice than the audit's, down to its edges.
    let fetch = |values: &[f64], u: f64, v: f64| {
        let place = |t: f64| (t * N as f64 - 0.5).clamp(0.0, (N - 1) as f64);
        let (p, q) = (place(u), place(v));
        let (i, j) = ((p as usize).min(N - 2), (q as usize).min(N - 2));
        let (s, t) = (p - i as f64, q - j as f64);
        let row = |j: usize| values[j * N + i] * (1.0 - s) + values[j * N + i + 1] * s;
        row(j) * (1.0 - t) + row(j + 1) * t
    };
    let mut worst = [0.0_f64; 3];
    for k in 0..=60 {
        for l in 0..=60 {
            let (u, v) = (ops::pow(k as f64 / 60.0, 2.0), ops::pow(l as f64 / 60.0, 2.0));
            let (e, bias) = split(Smith::Correlated, v * v, u.max(1e-7), &Effort::ladder()[1]);
            let [ra, rb] = [0, 1].map(|c: usize| fetch(&shipped.channels[c].values, u, v));
            let off = [ra - (e - bias), rb - bias, (ra + rb - e).abs().max((rb - bias).abs())];
            worst = [0, 1, 2].map(|c: usize| worst[c].max(off[c].abs()));
        }
    }
    let max = |c: usize| found.channels[c].lookup.as_ref().unwrap().max;
    let blend = found.blend.as_ref().unwrap().max;
    eprintln!("{worst:?} {} {} {blend}", max(0), max(1));
    for (own, sampled) in [max(0), max(1), blend].into_iter().zip(worst) {
        assert!(own > 0.97 * sampled, "{own} {sampled}");
    }
}

#[test]
fn rounding_is_claimed_where_it_explains_every_texel() {
    let e = |x: usize, y: usize| ggx(x, y).0;
    let half = |x: f64| half::f16::from_f64(x).to_f64();
    let steps = |shipped: &AuditedTable| {
        let found = run(shipped, "ggx-reflection", &Fixed::default());
        found.channels[0].defects.iter().any(|d| matches!(d, Defect::Steps { .. }))
    };
    assert!(steps(&table(&[("R", &|x, y| half(e(x, y)))])));
    // Errors of two to five steps at a few texels are not what rounding leaves.
    let worse = |x: usize, y: usize| {
        half(e(x, y) + if (x + y).is_multiple_of(9) { 1e-3 * jitter(x, y) } else { 0.0 })
    };
    assert!(!steps(&table(&[("R", &worse)])));
}
