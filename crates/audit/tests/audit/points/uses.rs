//! Sound tables of another use than the plain one, which a limit fails unless options say it, and what looked
//! like such a use: copied lines, a half that is missing, energy.

use lobefit::data::Smith;
use lobefit_audit::audit::{AuditedTable, Column, Fixed, Form, Input};
use lobefit_audit::foreign::Step;

use super::{a, at, e, table};
use crate::support::{both, eight, half, plane, reflection_of, run, says, shipped};
use lobefit_truth::quantity::{self, Variant};

/// E of a table whose texels lie at other inputs: of alpha and mu.
fn of(input: impl Fn(f64, f64) -> [f64; 2]) -> AuditedTable {
    let value = |x: usize, y: usize| {
        let [alpha, mu] = input(at(y) * at(y), at(x));
        both(Smith::Correlated, alpha, mu).0
    };
    table(&[("R", &value)])
}

/// They passed a limit, without a word of how far off they are where they are clamped.
#[test]
fn clamps_and_shadowings_count_for_a_limit_unless_they_are_stated() {
    let clamped = of(|alpha, mu| [alpha.max(0.1), mu]);
    let separable = table(&[("R", &|x, y| both(Smith::Separable, at(y) * at(y), at(x)).0)]);
    let floors = Fixed { floors: vec![(Input::Alpha, 0.1)], ..Fixed::default() };
    let form = Fixed { form: Form::find("separable"), ..Fixed::default() };
    let clamp = (clamped, floors, "with alpha clamped to 0.1, and by 0.1", "`--clamp alpha=0.1`");
    let shadowing = (separable, form, ", and by 0.277 as height-correlated Smith", "`--smith separable`");
    for (shipped, stated, line, option) in [clamp, shadowing] {
        let found = reflection_of(&shipped);
        let first = found.verdict(None).to_string().lines().next().unwrap_or_default().to_string();
        assert!(first.starts_with("PASS ") && first.contains(line), "{first}");
        says(&found.verdict(Some(0.01)), "FAIL", &["read plainly", option]);
        says(&run(&shipped, "ggx-reflection", &stated).verdict(Some(0.01)), "PASS", &[]);
    }
}

/// A first column or row that holds the next passed as a clamp at just that texel's centre.
#[test]
fn copied_lines_are_no_clamps() {
    for (copy, line) in [
        (table(&[("R", &|x, y| e(x.max(1), y))]), "at x = 0, "),
        (table(&[("R", &|x, y| e(x.max(2), y))]), "at x = 0 to 1, "),
        (table(&[("R", &|x, y| e(x, y.max(3)))]), "at y = 0 to 2, "),
        (table(&[("R", &|x, y| e(x, y.min(14)))]), "at y = 15, "),
    ] {
        let found = reflection_of(&copy);
        assert!(found.best().axes.iter().all(|axis| axis.floor == 0.0), "{:?}", found.best().axes);
        says(&found.verdict(None), "FAIL", &[line]);
    }
    // In eight bits the errors of the others are those of rounding.
    let copy = table(&[("R", &|x, y| eight(e(x.min(14), y)))]);
    says(&reflection_of(&copy).verdict(None), "FAIL", &["at x = 15, "]);
    // A clamp between two centres is one.
    let found = reflection_of(&of(|alpha, mu| [alpha.max(0.012), mu.max(0.1)]));
    assert_eq!(found.best().axes.iter().filter(|axis| axis.floor > 0.0).count(), 2);
}

/// A beside a constant passed as A; beside E nothing is missing.
#[test]
fn half_of_a_split_sum_is_no_pass() {
    for rest in [0.0, 0.04] {
        let found = reflection_of(&table(&[("R", &a), ("G", &|_, _| rest)]));
        says(&found.verdict(None), "UNKNOWN", &["channel G is constant"]);
    }
    says(&reflection_of(&table(&[("R", &e), ("G", &|_, _| 0.0)])).verdict(None), "PASS", &[]);
    let meanings = Fixed { meanings: Some(vec![Some(Column::A)]), ..Fixed::default() };
    let said = run(&table(&[("R", &a), ("G", &|_, _| 0.0)]), "ggx-reflection", &meanings);
    says(&said.verdict(None), "PASS", &[]);
}

/// The error of a quadrature was told as energy that comes back, and two steps of halves were not.
#[test]
fn gains_are_told_from_the_errors_of_a_quadrature_and_of_formats() {
    let off = |gain: f64| reflection_of(&table(&[("R", &|x, y| e(x, y) + gain)]));
    says(&off(3e-5).verdict(None), "PASS", &[]);
    says(&off(3e-3).verdict(None), "FAIL", &["gains energy"]);
    let steps = |steps: f64| {
        let value = |x: usize, y: usize| half(e(x, y)) + steps * 0.5 * f64::from(f32::EPSILON) * 8192.0;
        reflection_of(&AuditedTable { step: Step::Half, ..table(&[("R", &|x, y| half(value(x, y)))]) })
    };
    says(&steps(0.0).verdict(None), "PASS", &[]);
    says(&steps(4.0).verdict(None), "FAIL", &["gains energy: 1.00"]);
}

/// Bends at the knots of what was made larger are below a step of halves, but for their number.
#[test]
fn enlarged_tables_of_halves_are_named() {
    let small: Vec<f64> = (0..256).map(|i| e(i % 16, i / 16)).collect();
    let larger = |times: usize| {
        let value = |x: usize, y: usize| {
            let place = |i: usize| ((i as f64 + 0.5) / times as f64 - 0.5).clamp(0.0, 15.0);
            let ([u, v], [i, j]) = ([place(x), place(y)], [x, y].map(|k| (place(k) as usize).min(14)));
            let row = |j: usize| {
                let s = u - i as f64;
                small[16 * j + i] * (1.0 - s) + small[16 * j + i + 1] * s
            };
            half(row(j) * (1.0 - (v - j as f64)) + row(j + 1) * (v - j as f64))
        };
        plane([16 * times; 2], &[("R", &value)])
    };
    for times in [4, 8] {
        let shipped = AuditedTable { step: Step::Half, ..larger(times) };
        says(&reflection_of(&shipped).verdict(None), "FAIL", &["is of 16 x 16 texels enlarged"]);
    }
}

/// Of the few bends of a line some are sharper by chance, and those at knots of one of many smaller sizes.
#[test]
fn averages_that_are_rounded_are_not_enlarged() {
    let average = quantity::find("ggx-average").unwrap();
    let variant = Variant { smith: Some(Smith::Correlated), ..Variant::default() };
    for n in [32, 64, 96] {
        let value = |i: usize| {
            let roughness = (i as f64 + 0.5) / n as f64;
            let e = average.at(&variant, &[roughness * roughness], 1e-6).unwrap()[0];
            (e * 255.0).round() / 255.0
        };
        let shipped =
            AuditedTable { step: Step::Unorm(8), ..shipped(&[n], vec![("R", (0..n).map(value).collect())]) };
        says(&run(&shipped, "ggx-average", &Fixed::default()).verdict(None), "PASS", &[]);
    }
}

/// A clamp at a round number may stand at a line: at end points roughness 0.1 is the second of eleven.
#[test]
fn clamps_at_round_numbers_are_clamps() {
    let end = |i: usize| i as f64 / 10.0;
    let value = |x: usize, y: usize| {
        let roughness = end(y).max(0.1);
        both(Smith::Correlated, roughness * roughness, end(x).max(1e-4)).0
    };
    let found = reflection_of(&plane([11; 2], &[("R", &value)]));
    says(&found.verdict(None), "PASS", &["alpha clamped to 0.01."]);
}

/// A clamp that shows in the first line alone was known at round numbers only: any other was of other code.
#[test]
fn clamps_of_one_line_are_found_at_any_number() {
    const SIDE: usize = 24;
    let (end, centre) = (|i: usize| i as f64 / 23.0, |i: usize| (i as f64 + 0.5) / 24.0);
    type Place<'a> = &'a dyn Fn(usize) -> f64;
    let clamped = |place: Place, [least_alpha, least_mu]: [f64; 2]| {
        let of = |x: usize, y: usize| {
            let roughness = place(y);
            both(Smith::Correlated, (roughness * roughness).max(least_alpha), place(x).max(least_mu))
        };
        plane([SIDE; 2], &[("R", &|x, y| of(x, y).0 - of(x, y).1), ("G", &|x, y| of(x, y).1)])
    };
    for (place, clamps) in [
        (&end as Place, [0.0, 0.0134]),
        (&end, [0.0, 0.0041]),
        (&end, [0.0009, 0.0134]),
        (&centre, [0.0, 0.0337]),
        (&centre, [0.0011, 0.0337]),
    ] {
        let found = reflection_of(&clamped(place, clamps));
        says(&found.verdict(None), "PASS", &[]);
        let floors: Vec<f64> = found.best().axes.iter().map(|axis| axis.floor).collect();
        let [alpha, mu] = clamps;
        let off = [floors[0] - mu, floors[1] - alpha].map(f64::abs);
        assert!(off[0] < 1e-4 * mu && off[1] <= 1e-2 * alpha && found.worst() < 1e-5, "{floors:?}");
    }
    // What else is off in one line is no clamp.
    let whole = clamped(&centre, [0.0; 2]);
    for share in [0.97, 1.02] {
        let mut damaged = whole.clone();
        for channel in &mut damaged.channels {
            let values =
                channel.values.iter().enumerate().map(|(i, v)| if i % SIDE == 0 { share * v } else { *v });
            channel.values = values.collect::<Vec<_>>().into();
        }
        let found = reflection_of(&damaged);
        says(&found.verdict(None), "FAIL", &["at x = 0"]);
        assert!(found.best().axes.iter().all(|axis| axis.floor == 0.0), "{:?}", found.best().axes);
    }
}

/// Eight bits hid that a channel, or a part of all, is of the other shadowing.
#[test]
fn a_channel_of_the_other_shadowing_is_named() {
    let split = |form: Smith, x: usize, y: usize| {
        let at = |i: usize| (i as f64 + 0.5) / 32.0;
        let (e, b) = both(form, at(y) * at(y), at(x));
        [e - b, b]
    };
    let exact = |v: f64| v;
    for store in [eight as fn(f64) -> f64, exact] {
        let a = |x: usize, y: usize| store(split(Smith::Separable, x, y)[0]);
        let b = |x: usize, y: usize| store(split(Smith::Correlated, x, y)[1]);
        let found = reflection_of(&plane([32, 32], &[("R", &a), ("G", &b)]));
        says(
            &found.verdict(None),
            "FAIL",
            &["has B of height-correlated Smith beside others that are not", "make B again"],
        );
        let form = |y: usize| if y < 16 { Smith::Correlated } else { Smith::Separable };
        let [a, b] = [0, 1].map(|k: usize| move |x: usize, y: usize| store(split(form(y), x, y)[k]));
        let found = reflection_of(&plane([32, 32], &[("R", &a), ("G", &b)]));
        says(&found.verdict(None), "FAIL", &["is of two lobes", "are of height-correlated Smith"]);
        assert_eq!(found.two_lobes.expect("two parts").extent.range[1][1], 15);
        // All of one shadowing is sound.
        let [a, b] = [0, 1].map(|k: usize| move |x: usize, y: usize| store(split(Smith::Separable, x, y)[k]));
        says(&reflection_of(&plane([32, 32], &[("R", &a), ("G", &b)])).verdict(None), "PASS", &[]);
    }
}
