//! Tables made from the truth with the defects that published tables have: an audit finds each from
//! the numbers alone.

use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditError, AuditedTable, Channel, Column, Defect, Fit, Fixed, Registration, Scale, Source, audit,
};
use lobefit_audit::foreign::Step;
use lobefit_math::ops;
use lobefit_truth::integrate::reflection::{self, Effort, albedo, split, split_of};
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::quantity;

/// A channel: its name and its value at a texel.
type Filled<'a> = (&'a str, &'a dyn Fn(usize, usize) -> f64);

/// The verdict as it is printed.
fn said(found: &Audit) -> String {
    found.verdict(None).to_string()
}

/// A table over (mu, alpha) of several functions.
fn table(size: [usize; 2], channels: &[Filled]) -> AuditedTable {
    let texels = |f: &dyn Fn(usize, usize) -> f64| {
        (0..size[0] * size[1]).map(|i| f(i % size[0], i / size[0])).collect()
    };
    let channel = |(name, f): &(&str, &dyn Fn(usize, usize) -> f64)| Channel {
        name: name.to_string(),
        values: texels(f),
    };
    AuditedTable {
        what: "planted".into(),
        size: size.to_vec(),
        axes: AuditedTable::axes_of(2),
        source: Source::Table,
        channels: channels.iter().map(channel).collect(),
        step: Step::None,
        dead: Vec::new(),
    }
}

fn both(smith: Smith, alpha: f64, mu: f64) -> (f64, f64) {
    split(smith, alpha, mu, &Effort::ladder()[1])
}

fn run(shipped: &AuditedTable, quantity: &str, fixed: &Fixed) -> Audit {
    let found = audit(shipped, quantity::find(quantity).unwrap(), fixed, &|_| ()).unwrap();
    eprintln!("{}\n{:#?}\n{:?}", said(&found), found.tried.iter().take(3).collect::<Vec<_>>(), found.margin);
    found
}

fn reflection_of(shipped: &AuditedTable) -> Audit {
    run(shipped, "ggx-reflection", &Fixed::default())
}

/// Scale, registration and direction of every axis.
fn axes(found: &Audit) -> Vec<(Scale, Registration, bool)> {
    found.best().axes.iter().map(|a| (a.scale, a.registration, a.reversed)).collect()
}

fn columns(found: &Audit) -> Vec<Option<Column>> {
    found.best().columns.clone()
}

/// The error of a value in an f16.
fn half(x: f64) -> f64 {
    half::f16::from_f64(x).to_f64()
}

/// A fixed scramble in [-1, 1] of a texel.
fn jitter(i: usize, j: usize) -> f64 {
    let mut h =
        (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (j as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
    h ^= h >> 29;
    h = h.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h ^= h >> 32;
    (h >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[test]
fn a_sound_table_is_read_as_it_is() {
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y, 32) * at(y, 32), at(x, 16));
    let found = reflection_of(&table(
        [16, 32],
        &[("R", &|x, y| half(value(x, y).0 - value(x, y).1)), ("G", &|x, y| half(value(x, y).1))],
    ));
    assert_eq!(found.fit, Fit::Whole);
    assert_eq!(
        axes(&found),
        [(Scale::Mu, Registration::Centre, false), (Scale::Roughness, Registration::Centre, false)]
    );
    assert_eq!(columns(&found), [Some(Column::A), Some(Column::B)]);
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Correlated));
    assert!(found.margin > 20.0, "{}", found.margin);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.max < 2.5e-4 && errors.max > 1e-5, "half rounding, {}", errors.max);
    assert!(found.furnace.is_some());
    assert!(said(&found).contains("in no doubt"), "{}", said(&found));
}

#[test]
fn a_table_of_beckmann_is_one_and_no_table_of_ggx() {
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let e = |x: usize, y: usize| {
        split_of(Smith::Separable, Beckmann(at(y, 32) * at(y, 32)), at(x, 16), &Effort::ladder()[2]).0
    };
    let table = table([16, 32], &[("R", &|x, y| half(e(x, y)))]);
    let max = |quantity| {
        let found = run(&table, quantity, &Fixed::default());
        (found.best().lobe.form.smith, found.channels[0].errors.as_ref().map_or(f64::INFINITY, |e| e.max))
    };
    let (smith, own) = max("beckmann-reflection");
    assert!(smith == Some(Smith::Separable) && own < 2.6e-4, "{smith:?} {own}");
    assert!(max("ggx-reflection").1 > 10.0 * own);
}

#[test]
fn rows_one_texel_off_are_found() {
    // Rows of roughness (r + 1.5)/64 clamped to 1, looked up at (r + 0.5)/64; noise of 1024
    // samples.
    let roughness = |y: usize| ((y as f64 + 1.5) / 64.0).min(1.0);
    let value =
        |x: usize, y: usize| both(Smith::Correlated, roughness(y) * roughness(y), (x as f64 + 0.5) / 64.0);
    let found = reflection_of(&table(
        [64, 64],
        &[("R", &|x, y| half(value(x, y).1)), ("G", &|x, y| half(value(x, y).0 + 2e-3 * jitter(x, y)))],
    ));
    assert_eq!(
        axes(&found),
        [(Scale::Mu, Registration::Centre, false), (Scale::Roughness, Registration::OneHigh, false)]
    );
    assert_eq!(columns(&found), [Some(Column::B), Some(Column::E)]);
    assert_eq!(found.fit, Fit::Whole);
    assert!(found.margin > 2.0, "{}", found.margin);
    let (own, plain) =
        (found.channels[1].errors.as_ref().unwrap(), found.channels[1].plain_lookup.as_ref().unwrap());
    assert!(own.rms < 1.5e-3 && plain.rms > 5e-3, "{} {}", own.rms, plain.rms);
    assert!(
        found.channels[1]
            .defects
            .iter()
            .any(|d| matches!(d, Defect::Noise { rms, .. } if (rms - 1.15e-3).abs() < 2e-4))
    );
    assert!(said(&found).contains("one texel above the centres"), "{}", said(&found));
    assert!(said(&found).contains("that of texel i + 1"), "{}", said(&found));
}

#[test]
fn a_limit_holds_for_the_table_as_it_will_be_read() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let one = |i: usize| ((i as f64 + 1.5) / 32.0).min(1.0);
    let fourth = |x: f64| x * x * x * x;
    // Rows one texel off, and a gloss that is the fourth root of alpha: right to rounding as they
    // are best read.
    let shifted = |x: usize, y: usize| both(Smith::Correlated, one(y) * one(y), at(x)).0;
    let gloss = |x: usize, y: usize| both(Smith::Correlated, fourth(1.0 - at(y)), at(x)).0;
    let registrations = vec![Registration::Centre, Registration::OneHigh];
    let axes = vec![(Scale::Mu, false), (Scale::RoughnessFourth, true)];
    for (value, least, option, fixed) in [
        (
            &shifted as &dyn Fn(usize, usize) -> f64,
            0.02,
            "--registration centre,one-high",
            Fixed { registrations: Some(registrations), ..Fixed::default() },
        ),
        (&gloss, 0.3, "--axes mu,1-alpha^(1/4)", Fixed { axes: Some(axes), ..Fixed::default() }),
    ] {
        let shipped = table([32, 32], &[("R", value)]);
        let found = reflection_of(&shipped);
        let plain = found.plain.as_ref().expect("no reader assumes it");
        assert!(found.worst() < 1e-6 && plain.max > least, "{} {}", found.worst(), plain.max);
        assert_eq!(plain.options, option);
        assert!(!found.passes(Some(0.5 * least)) && found.passes(Some(1.0)), "the plain reading is judged");
        assert!(said(&found).contains("unless the file says so"), "{}", said(&found));
        let meant = run(&shipped, "ggx-reflection", &fixed);
        assert!(meant.plain.is_none() && meant.passes(Some(1e-6)), "{:?}", meant.plain);
    }
    let sound = reflection_of(&table([32, 32], &[("R", &|x, y| both(Smith::Correlated, at(y), at(x)).0)]));
    assert!(sound.plain.is_none() && sound.passes(Some(1e-6)));
}

#[test]
fn end_points_one_texel_off_are_found() {
    let at = |i: usize| i as f64 / 31.0;
    for (registration, shift, word) in [
        (Registration::EndHigh, 1.0, "that of texel i + 1"),
        (Registration::EndLow, -1.0, "that of texel i - 1"),
    ] {
        let shifted = |i: usize| ((i as f64 + shift) / 31.0).clamp(0.0, 1.0);
        let value = |x: usize, y: usize| both(Smith::Correlated, shifted(y) * shifted(y), at(x).max(1e-4)).0;
        let found = reflection_of(&table([32, 32], &[("0", &value)]));
        assert_eq!(
            axes(&found),
            [(Scale::Mu, Registration::Endpoint, false), (Scale::Roughness, registration, false)]
        );
        let plain = found.plain.as_ref().expect("a shift");
        assert_eq!(plain.convention.axes[1].registration, Registration::Endpoint);
        assert!(plain.max > 0.01 && !found.passes(Some(0.01)), "{}", plain.max);
        assert!(said(&found).contains(word) && said(&found).contains("end points"), "{}", said(&found));
    }
}

#[test]
fn a_split_sum_at_one_f0_is_told() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    for (f0, column) in [(0.02, Column::At(2)), (0.04, Column::At(4)), (0.08, Column::At(8))] {
        let value = |x: usize, y: usize| {
            let (e, b) = both(Smith::Correlated, at(y) * at(y), at(x));
            half(f0 * (e - b) + b)
        };
        let found = reflection_of(&table([32, 32], &[("0", &value)]));
        assert_eq!(columns(&found), [Some(column)]);
        assert!(said(&found).contains(&format!("f0={f0}")), "{}", said(&found));
    }
    // A bias alone is none, though all of those are near to it.
    let bias = reflection_of(&table(
        [32, 32],
        &[("0", &|x, y| half(both(Smith::Correlated, at(y), at(x)).1 + 3e-3 * jitter(x, y)))],
    ));
    assert_eq!(columns(&bias), [Some(Column::B)]);
}

#[test]
fn nodes_at_left_edges_of_a_separable_lobe_are_found() {
    // A slice of the path tracer's table: nodes i/64 clamped to [1e-4, 0.9999], roughness is alpha,
    // separable.
    let at = |i: usize| (i as f64 / 64.0).clamp(1e-4, 0.9999);
    let found = reflection_of(&table(
        [64, 64],
        &[("L", &|x, y| both(Smith::Separable, at(y), at(x)).0 + 1.7e-4 * jitter(x, y))],
    ));
    assert_eq!(
        axes(&found),
        [(Scale::Mu, Registration::Left, false), (Scale::Alpha, Registration::Left, false)]
    );
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Separable));
    assert_eq!(columns(&found), [Some(Column::E)]);
    assert!(found.best().axes.iter().all(|a| a.floor == 1e-4), "{:?}", found.best().axes);
    let plain = found.channels[0].plain_lookup.as_ref().unwrap();
    assert!(
        (plain.mean - 5.4e-3).abs() < 1e-3,
        "the published bias of this mistake is 5.4e-3: {}",
        plain.mean
    );
    assert!(
        said(&found).contains("separable Smith") && said(&found).contains("left edges"),
        "{}",
        said(&found)
    );
}

#[test]
fn transposed_end_points_with_six_decimals_are_found() {
    // Cycles' ggx_E: x is roughness, y is mu, end points, clamped to 1e-4, printed with six
    // decimals.
    let at = |i: usize| (i as f64 / 31.0).clamp(1e-4, 1.0);
    let found = reflection_of(&table(
        [32, 32],
        &[("0", &|x, y| (both(Smith::Correlated, at(x) * at(x), at(y)).0 * 1e6).round() / 1e6)],
    ));
    assert_eq!(
        axes(&found),
        [(Scale::Roughness, Registration::Endpoint, false), (Scale::Mu, Registration::Endpoint, false)]
    );
    assert!(found.channels[0].errors.as_ref().unwrap().max < 6e-7);
    let lookup = found.channels[0].lookup.as_ref().unwrap();
    assert!(lookup.max > 0.09 && lookup.max < 0.11, "published: 0.101, {}", lookup.max);
    assert!(
        found.channels[0].defects.iter().any(|d| matches!(d, Defect::Steps { step: Step::Decimals(6), .. }))
    );
}

#[test]
fn an_average_that_is_normal_incidence_is_found() {
    let at = |i: usize| i as f64 / 31.0;
    let e = |i: usize| {
        if i == 0 { 1.0 } else { albedo(Smith::Correlated, at(i) * at(i), 1.0, &Effort::ladder()[1].outer) }
    };
    let values = (0..32).map(|i| e(i) + 3e-4 * jitter(i, 0)).collect();
    let shipped = AuditedTable {
        what: "mf_ggx_albedo".into(),
        size: vec![32],
        axes: AuditedTable::axes_of(1),
        source: Source::Table,
        channels: vec![Channel { name: "0".into(), values }],
        step: Step::None,
        dead: Vec::new(),
    };
    let found = run(&shipped, "ggx-average", &Fixed::default());
    assert_eq!(columns(&found), [Some(Column::Normal)]);
    assert_eq!(found.fit, Fit::Whole);
    assert!(found.channels[0].errors.as_ref().unwrap().max < 3.1e-4);
    assert!(said(&found).contains("no average"), "{}", said(&found));
    assert!(said(&found).contains("average over the cosine"), "{}", said(&found));
    // It is no average, so that a limit fails it, unless that is what is asked for.
    let plain = found.plain.as_ref().expect("an average is meant");
    assert!(plain.max > 0.02 && plain.convention.columns == [Some(Column::Average)], "{plain:?}");
    assert!(!found.passes(Some(1e-2)));
    let asked = Fixed { column: Some(Column::Normal), ..Fixed::default() };
    assert!(run(&shipped, "ggx-average", &asked).passes(Some(1e-3)));
    // The same as an average: what is fixed is measured.
    let fixed = Fixed { column: Some(Column::Average), ..Fixed::default() };
    let fixed = run(&shipped, "ggx-average", &fixed);
    assert!(fixed.channels[0].errors.as_ref().unwrap().max > 0.02);
    // And a true average is reported as an average.
    let mean = |i: usize| reflection::average(Smith::Correlated, at(i) * at(i), 1e-9).unwrap().e_avg;
    let values = (0..32).map(mean).collect();
    let sound = AuditedTable { channels: vec![Channel { name: "0".into(), values }], ..shipped };
    assert_eq!(columns(&run(&sound, "ggx-average", &Fixed::default())), [Some(Column::Average)]);
}

#[test]
fn gloss_is_told_from_roughness_and_its_powers() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let fourth = |x: f64| x * x * x * x;
    for (alpha, scale, reversed) in [
        (&(|y| fourth(1.0 - at(y))) as &dyn Fn(usize) -> f64, Scale::RoughnessFourth, true),
        (&|y| (1.0 - at(y)) * (1.0 - at(y)), Scale::Roughness, true),
        (&|y| fourth(at(y)), Scale::RoughnessFourth, false),
        (&|y| at(y), Scale::Alpha, false),
    ] {
        let found =
            reflection_of(&table([32, 32], &[("B", &|x, y| both(Smith::Separable, alpha(y), at(x)).1)]));
        assert_eq!(
            axes(&found),
            [(Scale::Mu, Registration::Centre, false), (scale, Registration::Centre, reversed)]
        );
        assert_eq!(columns(&found), [Some(Column::B)]);
        assert_eq!(said(&found).contains("gloss"), reversed, "{}", said(&found));
    }
}

#[test]
fn a_loss_without_its_tail_is_found() {
    // 1 - E in unorm16 over sqrt(alpha), end points, separable; the tail of smooth lobes is lost.
    let at = |i: usize| i as f64 / 31.0;
    let loss = |x: usize, y: usize| {
        let alpha = at(y) * at(y);
        let loss = if alpha == 0.0 {
            0.0
        } else {
            reflection::loss(Smith::Separable, alpha, at(x).max(1e-4), &Effort::ladder()[1].outer)
        };
        let kept = if alpha < 0.12 { 0.1 + 0.9 * (alpha / 0.12) * (alpha / 0.12) } else { 1.0 };
        (loss * kept * 65535.0).round() / 65535.0
    };
    let found = reflection_of(&table([32, 32], &[("0", &loss)]));
    assert_eq!(columns(&found), [Some(Column::Loss)]);
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Separable));
    assert_eq!(
        axes(&found),
        [(Scale::Mu, Registration::Endpoint, false), (Scale::Roughness, Registration::Endpoint, false)]
    );
    let missing = found.channels[0].defects.iter().find_map(|d| match d {
        Defect::MissingLoss { stored, worst, .. } => Some((*stored, *worst)),
        _ => None,
    });
    let (stored, [kept, truth]) = missing.expect("the audit names the missing loss");
    assert!(stored > 0.1 && stored < 0.7 && kept < truth, "{stored} {kept} {truth}");
    assert!(said(&found).contains("tail of the lobe"), "{}", said(&found));
}

#[test]
fn a_wrong_weight_fits_nothing() {
    // Samples of the lobe weighted as if drawn uniformly: no albedo of anything.
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let wrong =
        |x: usize, y: usize| both(Smith::Correlated, at(y), at(x)).0 * (0.4 + 1.3 * at(x) * (1.0 - at(y)));
    let found = reflection_of(&table([32, 32], &[("0", &wrong)]));
    assert_eq!(found.fit, Fit::None);
    assert!(found.channels[0].errors.as_ref().unwrap().rms > 0.03);
    assert!(said(&found).contains("fits no convention"), "{}", said(&found));
}

#[test]
fn a_clamped_and_a_stale_part_are_found() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y), at(x)).0;
    let stale = reflection_of(&table(
        [32, 32],
        &[("0", &|x, y| if y >= 24 && x < 16 { value(x, y) + 0.3 } else { value(x, y) })],
    ));
    assert_eq!(stale.fit, Fit::Part);
    let part = stale.channels[0].defects.iter().find_map(|d| match d {
        Defect::Part { texels, mean, range, .. } => Some((*texels, *mean, range.clone())),
        _ => None,
    });
    let (texels, mean, range) = part.expect("the audit names the part");
    assert_eq!((texels, range), ([128, 1024], vec![[0, 15], [24, 31]]));
    assert!((mean - 0.3).abs() < 1e-6, "{mean}");
    assert!(
        said(&stale).contains("128 of 1024 texels") && said(&stale).contains("y = 24 to 31"),
        "{}",
        said(&stale)
    );
    let inverse = |x: usize, y: usize| (1.0 / value(x, y)).min(1.8);
    let clamped = reflection_of(&table([32, 32], &[("0", &inverse)]));
    assert_eq!(columns(&clamped), [Some(Column::Inverse)]);
    assert!(
        clamped.channels[0]
            .defects
            .iter()
            .any(|d| matches!(d, Defect::Clamped { value, truth, .. } if *value == 1.8 && *truth > 2.5))
    );
}

#[test]
fn a_part_of_the_other_shadowing_form_is_told() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    // Rows from `first` on are of the other form: half of the table, and more than half.
    for (own, other, first) in
        [(Smith::Correlated, Smith::Separable, 16), (Smith::Separable, Smith::Correlated, 20)]
    {
        let value =
            |x: usize, y: usize| half(both(if y < first { own } else { other }, at(y) * at(y), at(x)).0);
        let found = reflection_of(&table([32, 32], &[("R", &value)]));
        assert_eq!(found.fit, Fit::Part);
        assert_eq!(
            axes(&found),
            [(Scale::Mu, Registration::Centre, false), (Scale::Roughness, Registration::Centre, false)]
        );
        let parts = found.two_lobes.as_ref().expect("two parts");
        let [most, fewer, all] = parts.texels;
        assert!(most >= fewer && fewer > 60 && all == 1024, "{parts:?}");
        assert!(parts.max < 3e-4 && found.margin > 4.0, "{parts:?} {}", found.margin);
        let rows = if found.best().lobe.form.smith == Some(own) { [first, 31] } else { [0, first - 1] };
        assert!(parts.range[1][0] >= rows[0] && parts.range[1][1] == rows[1], "{parts:?}");
        for told in ["height-correlated Smith", "separable Smith", "made in two parts", "(all at "] {
            assert!(said(&found).contains(told), "{told}: {}", said(&found));
        }
        assert!(!found.passes(Some(1.0)) && found.passes(None));
    }
    // A part that is of neither form is no such part.
    let damaged = |x: usize, y: usize| {
        both(Smith::Correlated, at(y) * at(y), at(x)).0 - if y < 16 { 0.05 * at(x) } else { 0.0 }
    };
    assert_eq!(reflection_of(&table([32, 32], &[("R", &damaged)])).two_lobes, None);
}

#[test]
fn values_that_were_encoded_for_display_are_told() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let srgb = |v: f64| if v <= 0.0031308 { 12.92 * v } else { 1.055 * ops::pow(v, 1.0 / 2.4) - 0.055 };
    let eight = |v: f64| (v * 255.0).round() / 255.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y), at(x));
    let found = reflection_of(&table(
        [32, 32],
        &[
            ("R", &|x, y| eight(srgb(value(x, y).0 - value(x, y).1))),
            ("G", &|x, y| eight(srgb(value(x, y).1))),
        ],
    ));
    assert_eq!(found.fit, Fit::Whole);
    assert!(said(&found).contains("decoded from sRGB") && said(&found).contains("R = A"), "{}", said(&found));
    let plain = found.plain.as_ref().expect("nobody assumes it");
    assert!(plain.options == "--encoding srgb" && plain.max > 0.1, "{plain:?}");
    assert!(!found.passes(Some(0.05)));
}

#[test]
fn rows_the_other_way_round_are_told() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(31 - y) * at(31 - y), at(x)).0;
    let found = reflection_of(&table([32, 32], &[("R", &value)]));
    assert!(said(&found).contains("the rows are flipped"), "{}", said(&found));
    assert_eq!(found.plain.as_ref().map(|p| p.options.as_str()), Some("--axes mu,1-roughness"));
}

#[test]
fn a_wrong_guess_is_measured_and_refused() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let shipped = table([16, 16], &[("0", &|x, y| both(Smith::Correlated, at(y) * at(y), at(x)).0)]);
    let fixed = Fixed { axes: Some(vec![(Scale::Roughness, false), (Scale::Mu, false)]), ..Fixed::default() };
    let found = run(&shipped, "ggx-reflection", &fixed);
    assert_eq!(found.fit, Fit::None);
    assert!(
        said(&found).contains("no convention of those that the options leave open fits"),
        "{}",
        said(&found)
    );
    let refused = |fixed: Fixed| {
        audit(&shipped, quantity::find("ggx-reflection").unwrap(), &fixed, &|_| ()).unwrap_err()
    };
    let one = refused(Fixed { axes: Some(vec![(Scale::Roughness, false)]), ..Fixed::default() });
    assert!(matches!(one, AuditError::Option { option: "--axes", .. }), "{one}");
    let twice =
        refused(Fixed { axes: Some(vec![(Scale::Mu, false), (Scale::Theta, false)]), ..Fixed::default() });
    assert!(twice.to_string().contains("alpha, mu"), "{twice}");
    let three = refused(Fixed { registrations: Some(vec![Registration::Left; 3]), ..Fixed::default() });
    assert!(matches!(three, AuditError::Option { option: "--registration", .. }), "{three}");
    let column = refused(Fixed { column: Some(Column::T), ..Fixed::default() });
    assert!(column.to_string().contains("E, A, B"), "{column}");
}

#[test]
fn bad_tables_are_named_errors() {
    let quantity = quantity::find("ggx-reflection").unwrap();
    let refused = |shipped: &AuditedTable| {
        audit(shipped, quantity, &Fixed::default(), &|_| ()).unwrap_err().to_string()
    };
    let sound = table([8, 8], &[("R", &|x, y| (x + y) as f64)]);
    let mut bad = sound.clone();
    bad.channels[0].values[19] = f64::NAN;
    assert!(refused(&bad).contains("texel [3, 2]: NaN"), "{}", refused(&bad));
    let mut bad = sound.clone();
    bad.channels[0].values.pop();
    assert!(refused(&bad).contains("63 values"), "{}", refused(&bad));
    assert!(refused(&table([8, 8], &[("R", &|_, _| 0.5)])).contains("constant (0.5)"));
    assert!(refused(&table([3, 8], &[("R", &|x, _| x as f64)])).contains("too few"));
    assert!(refused(&table([1, 8], &[("R", &|_, y| y as f64)])).contains("ggx-average"));
    let large = AuditedTable { size: vec![1 << 40, 1 << 40], ..sound };
    assert!(refused(&large).contains("at most"));
}

#[test]
fn every_texel_is_judged() {
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(x, 5000), at(y, 4)).0;
    let mut shipped = table([5000, 4], &[("R", &value)]);
    // The rounds that rank conventions pass over this column.
    shipped.channels[0].values[5005] += 0.5;
    let found = reflection_of(&shipped);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert_eq!((errors.judged, errors.all, errors.unsampled), (20000, 20000, 0));
    assert_eq!(errors.texel, [5, 1]);
    assert!((errors.max - 0.5).abs() < 1e-3 && !found.passes(Some(0.1)), "{}", errors.max);
    assert_eq!(found.channels[0].map.len(), 4096 * 4);
}

#[test]
fn all_of_a_table_that_is_too_large_to_be_held_is_looked_through() {
    let size = [1024, 544];
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let value = |x: usize, y: usize| 1.0 - 0.4 * at(y, size[1]) * (1.0 - at(x, size[0]));
    let mut shipped = table(size, &[("R", &value)]);
    // Beside every lattice of 256 places.
    shipped.channels[0].values[333 * size[0] + 702] = 3.0;
    let axes = Some(vec![(Scale::Mu, false), (Scale::Roughness, false)]);
    let fixed = Fixed { axes, registrations: Some(vec![Registration::Centre]), ..Fixed::default() };
    let found = run(&shipped, "ggx-reflection", &fixed);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert_eq!((errors.judged, errors.all, errors.unsampled), (size[0] * size[1], size[0] * size[1], 0));
    let smith = found.best().lobe.form.smith.unwrap();
    let truth = |x: usize, y: usize| both(smith, at(y, size[1]) * at(y, size[1]), at(x, size[0])).0;
    assert_eq!((errors.texel.as_slice(), errors.value), (&[702, 333][..], 3.0));
    assert!((errors.truth - truth(702, 333)).abs() < 1e-6, "{errors:?}");
    // The mean over every 32nd texel of both axes.
    let some = (0..size[0] / 32 * (size[1] / 32)).map(|i| [16 + 32 * (i % 32), 16 + 32 * (i / 32)]);
    let off: Vec<f64> = some.map(|[x, y]| value(x, y) - truth(x, y)).collect();
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    assert!((errors.mean - mean).abs() < 1e-3 && errors.mean.abs() > 0.02, "{} {mean}", errors.mean);
}

#[test]
fn a_constant_channel_is_judged_or_named() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y), at(x));
    let shipped = table([16, 16], &[("R", &|x, y| value(x, y).0 - value(x, y).1), ("G", &|_, _| 0.0)]);
    let free = reflection_of(&shipped);
    assert!(said(&free).contains("Channel G is constant (0)"), "{}", said(&free));
    assert!(!free.passes(Some(1.0)) && free.unjudged().is_some_and(|why| why.contains("channel G")));
    let with = |list: &[Column]| {
        run(
            &shipped,
            "ggx-reflection",
            &Fixed { meanings: Some(list.iter().copied().map(Some).collect()), ..Fixed::default() },
        )
    };
    assert!(with(&[Column::A]).passes(Some(1e-3)));
    let judged = with(&[Column::A, Column::B]);
    assert!(judged.worst() > 0.1 && !judged.passes(Some(1e-3)), "{}", judged.worst());
}

#[test]
fn a_furnace_with_a_dark_texel_is_infinite_there() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let mut shipped = table([16, 16], &[("R", &|x, y| both(Smith::Correlated, at(y) * at(y), at(x)).0)]);
    shipped.channels[0].values[37] = 0.0;
    let found = reflection_of(&shipped);
    let furnace = found.furnace.as_ref().unwrap();
    assert!(furnace.range[1] == f64::INFINITY && furnace.dark == 1, "{furnace:?}");
    assert!((furnace.at["mu"] - at(5)).abs() < 1e-12, "{furnace:?}");
    assert!(said(&found).contains("0 or less at 1 texels"), "{}", said(&found));
}
