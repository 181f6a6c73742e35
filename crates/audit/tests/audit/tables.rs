//! Tables made from the truth under the conventions that published tables have: an audit finds each from the
//! numbers alone.

use std::sync::Arc;

use lobefit::data::Smith;
use lobefit_audit::audit::{
    AuditError, AuditedTable, Column, Defect, Fit, Fixed, Form, Input, Registration, Scale, audit,
};
use lobefit_audit::foreign::Step;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::reflection::{self, Effort, albedo, split_of};
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::quantity::{self, Choice, Variant};
use rayon::prelude::*;

use crate::support::{axes, both, columns, half, jitter, plane, reflection_of, run, said, shipped};

#[test]
fn a_sound_table_is_read_as_it_is() {
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y, 32) * at(y, 32), at(x, 16));
    let found = reflection_of(&plane(
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
    let table = plane([16, 32], &[("R", &|x, y| half(e(x, y)))]);
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
    let found = reflection_of(&plane(
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
        let shipped = plane([32, 32], &[("R", value)]);
        let found = reflection_of(&shipped);
        let plain = found.plain.as_ref().expect("no reader assumes it");
        assert!(found.worst() < 1e-6 && plain.max > least, "{} {}", found.worst(), plain.max);
        assert_eq!(plain.options, option);
        assert!(!found.passes(Some(0.5 * least)) && found.passes(Some(1.0)), "the plain reading is judged");
        let meant = format!("if it is meant so, say so (`{option}`)");
        assert!(said(&found).contains(&meant) && said(&found).contains(": it has "), "{}", said(&found));
        let meant = run(&shipped, "ggx-reflection", &fixed);
        assert!(meant.plain.is_none() && meant.passes(Some(1e-6)), "{:?}", meant.plain);
    }
    let sound = reflection_of(&plane([32, 32], &[("R", &|x, y| both(Smith::Correlated, at(y), at(x)).0)]));
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
        let found = reflection_of(&plane([32, 32], &[("0", &value)]));
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
        let found = reflection_of(&plane([32, 32], &[("0", &value)]));
        assert_eq!(columns(&found), [Some(column)]);
        assert!(said(&found).contains(&format!("f0={f0}")), "{}", said(&found));
    }
    // A bias alone is none, though all of those are near to it.
    let bias = reflection_of(&plane(
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
    let found = reflection_of(&plane(
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
    let found = reflection_of(&plane(
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
    let normal = shipped(&[32], vec![("0", values)]);
    let found = run(&normal, "ggx-average", &Fixed::default());
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
    assert!(run(&normal, "ggx-average", &asked).passes(Some(1e-3)));
    // The same as an average: what is fixed is measured.
    let fixed = Fixed { column: Some(Column::Average), ..Fixed::default() };
    let fixed = run(&normal, "ggx-average", &fixed);
    assert!(fixed.channels[0].errors.as_ref().unwrap().max > 0.02);
    // And a true average is reported as an average.
    let mean = |i: usize| reflection::average(Smith::Correlated, at(i) * at(i), 1e-9).unwrap().e_avg;
    let values = (0..32).map(mean).collect();
    let sound = shipped(&[32], vec![("0", values)]);
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
            reflection_of(&plane([32, 32], &[("B", &|x, y| both(Smith::Separable, alpha(y), at(x)).1)]));
        assert_eq!(
            axes(&found),
            [(Scale::Mu, Registration::Centre, false), (scale, Registration::Centre, reversed)]
        );
        assert_eq!(columns(&found), [Some(Column::B)]);
        assert_eq!(said(&found).contains("gloss"), reversed, "{}", said(&found));
        assert_eq!(
            said(&found).contains("or store the rows in the other order"),
            reversed,
            "{}",
            said(&found)
        );
    }
}

#[test]
fn rows_the_other_way_round_are_told() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(31 - y) * at(31 - y), at(x)).0;
    let found = reflection_of(&plane([32, 32], &[("R", &value)]));
    assert!(said(&found).contains("the rows are flipped"), "{}", said(&found));
    assert_eq!(found.plain.as_ref().map(|p| p.options.as_str()), Some("--axes mu,1-roughness"));
}

#[test]
fn a_wrong_guess_is_measured_and_refused() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let shipped = plane([16, 16], &[("0", &|x, y| both(Smith::Correlated, at(y) * at(y), at(x)).0)]);
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
    let sound = plane([8, 8], &[("R", &|x, y| (x + y) as f64)]);
    let mut bad = sound.clone();
    Arc::make_mut(&mut bad.channels[0].values)[19] = f64::NAN;
    assert!(refused(&bad).contains("texel [3, 2]: NaN"), "{}", refused(&bad));
    let mut bad = sound.clone();
    Arc::make_mut(&mut bad.channels[0].values).pop();
    assert!(refused(&bad).contains("63 values"), "{}", refused(&bad));
    assert!(refused(&plane([8, 8], &[("R", &|_, _| 0.5)])).contains("constant (0.5)"));
    assert!(refused(&plane([3, 8], &[("R", &|x, _| x as f64)])).contains("too few"));
    assert!(refused(&plane([1, 8], &[("R", &|_, y| y as f64)])).contains("ggx-average"));
    let large = AuditedTable { size: vec![1 << 40, 1 << 40], ..sound };
    assert!(refused(&large).contains("at most"));
}

#[test]
fn every_texel_is_judged() {
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(x, 5000), at(y, 4)).0;
    let mut shipped = plane([5000, 4], &[("R", &value)]);
    // The rounds that rank conventions pass over this column.
    Arc::make_mut(&mut shipped.channels[0].values)[5005] += 0.5;
    let found = reflection_of(&shipped);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert_eq!((errors.judged, errors.all, errors.unsampled), (20000, 20000, 0));
    assert_eq!(errors.texel, [5, 1]);
    assert!((errors.max - 0.5).abs() < 1e-3 && !found.passes(Some(0.1)), "{}", errors.max);
    assert_eq!(found.channels[0].map.len(), 4096 * 4);
}

/// Truths by interpolation keep the error that they state, at the ends and where no knot is.
#[test]
fn a_truth_keeps_the_error_that_it_states() {
    use Registration::{Centre, Endpoint};
    use Scale::{IorTwo, Mu, RootMu, Roughness, RoughnessFourth};
    let below = |input: Input, to: f64| Scale::between(input, [0.0, to], true);
    let ends = [below(Input::Mu, 2.1e-6), below(Input::Alpha, 7e-6)];
    for (name, form, column, output, registration, n, scales) in [
        ("ggx-reflection", "correlated", Column::E, "E", Centre, 29_usize, &[Mu, Roughness][..]),
        ("ggx-reflection", "separable", Column::B, "B", Endpoint, 29, &[RootMu, RoughnessFourth]),
        ("ggx-reflection", "separable", Column::E, "E", Endpoint, 29, &[RootMu, RoughnessFourth]),
        ("ggx-reflection", "correlated", Column::E, "E", Endpoint, 8, &ends),
        ("ggx-reflection", "correlated", Column::B, "B", Endpoint, 8, &[Mu, below(Input::Alpha, 7e-9)]),
        ("beckmann-reflection", "separable", Column::E, "E", Centre, 29, &[Mu, Roughness]),
        ("beckmann-reflection", "separable", Column::B, "B", Endpoint, 29, &[RootMu, RoughnessFourth]),
        ("ggx-average", "correlated", Column::Average, "E_avg", Centre, 29, &[Roughness]),
        ("ggx-average", "correlated", Column::Average, "E_avg", Endpoint, 29, &[RoughnessFourth]),
        ("ggx-average", "correlated", Column::Normal, "E", Endpoint, 29, &[RoughnessFourth]),
        ("sheen-charlie", "neubelt", Column::E, "E", Centre, 29, &[Mu, Roughness]),
        ("sheen-charlie", "neubelt", Column::E, "E", Endpoint, 13, &[Mu, Roughness]),
        ("ggx-glass", "correlated", Column::R, "R", Endpoint, 4, &[IorTwo, Roughness, Mu]),
        ("ggx-glass", "correlated", Column::T, "T", Endpoint, 4, &[IorTwo, below(Input::Alpha, 2e-3), Mu]),
    ] {
        // E at normal incidence is no output of the average.
        let of = if column == Column::Normal { "ggx-reflection" } else { name };
        let (own, form) = (quantity::find(of).unwrap(), Form::find(form).unwrap());
        let side = own.has(Choice::Side).then_some(Side::Outside);
        let variant = Variant { smith: form.smith, side, ..Variant::default() };
        let place = own.outputs().iter().position(|o| *o == output).unwrap();
        let value = |i: usize| {
            let at = |k: usize| scales[k].input_at(registration.coordinate(i / n.pow(k as u32) % n, n));
            let axis = |name: &str| scales.iter().position(|s| s.input().name() == name);
            // A narrower lobe than the least counts as a mirror.
            let moved =
                |name: &str, x: f64| if name == "alpha" && x < own.smallest_alpha() { 0.0 } else { x };
            let of = |name: &str| moved(name, axis(name).map_or(1.0, at));
            let x: Vec<f64> = own.inputs().iter().map(|input| of(input.name)).collect();
            // Texels at which there is no value are not judged.
            own.at(&variant, &x, 1e-8).map_or(0.5, |values| values[place])
        };
        let size = vec![n; scales.len()];
        let values: Vec<f64> = (0..size.iter().product()).into_par_iter().map(value).collect();
        let fixed = Fixed {
            axes: Some(scales.iter().map(|scale| (*scale, false)).collect()),
            registrations: Some(vec![registration]),
            form: Some(form),
            column: Some(column),
            side,
            ..Fixed::default()
        };
        let found = run(&shipped(&size, vec![("0", values)]), name, &fixed);
        let errors = found.channels[0].errors.as_ref().unwrap();
        let worst = found.worst();
        assert!(worst <= found.truth_error, "{name} {output}: {worst:e} of {:e}", found.truth_error);
        assert!(4 * errors.judged >= 3 * errors.all && errors.all > 20, "{name} {output}: {errors:?}");
    }
}
