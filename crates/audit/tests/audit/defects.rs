//! What is wrong with tables that are read rightly: losses without a tail, clamps, parts of other code or of
//! another lobe, lines that were never filled, channels that are constant.

use std::sync::Arc;

use lobefit::data::Smith;
use lobefit_audit::audit::{Column, Defect, Fit, Fixed, Registration, Scale};
use lobefit_math::ops;
use lobefit_truth::integrate::reflection::{self, Effort};

use crate::support::{axes, both, columns, half, plane, reflection_of, run, said, says, shipped};

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
    let found = reflection_of(&plane([32, 32], &[("0", &loss)]));
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
    // It is missing in a split sum, too, neither half of which is a loss.
    let b = |x: usize, y: usize| both(Smith::Separable, at(y) * at(y), at(x)).1;
    let halves = plane([32, 32], &[("R", &|x, y| 1.0 - loss(x, y) - b(x, y)), ("G", &b)]);
    let found = reflection_of(&halves);
    assert_eq!(columns(&found), [Some(Column::A), Some(Column::B)]);
    says(&found.verdict(None), "FAIL", &["tail of the lobe", "by sampling visible normals"]);
}

#[test]
fn a_clamped_and_a_stale_part_are_found() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y), at(x)).0;
    let stale = reflection_of(&plane(
        [32, 32],
        &[("0", &|x, y| if y >= 24 && x < 16 { value(x, y) + 0.3 } else { value(x, y) })],
    ));
    assert_eq!(stale.fit, Fit::Part);
    let part = stale.channels[0].defects.iter().find_map(|d| match d {
        Defect::Part { texels, mean, extent, .. } => Some((*texels, *mean, extent.range.clone())),
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
    let clamped = reflection_of(&plane([32, 32], &[("0", &inverse)]));
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
        let found = reflection_of(&plane([32, 32], &[("R", &value)]));
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
        assert!(parts.extent.range[1][0] >= rows[0] && parts.extent.range[1][1] == rows[1], "{parts:?}");
        for told in ["height-correlated Smith", "separable Smith", "made in two parts", "(all at "] {
            assert!(said(&found).contains(told), "{told}: {}", said(&found));
        }
        assert!(!found.passes(Some(1.0)) && found.passes(None));
    }
    // Of a quarter the texels of one lobe alone fit one convention, all of them none.
    let quarter = |x: usize, y: usize| {
        let form = if x < 16 && y < 16 { Smith::Separable } else { Smith::Correlated };
        both(form, at(y) * at(y), at(x)).0
    };
    let found = reflection_of(&plane([32, 32], &[("R", &quarter)]));
    assert!(found.two_lobes.is_some() && found.margin > 100.0, "{}", found.margin);
    // A part that is of neither form is no such part.
    let damaged = |x: usize, y: usize| {
        both(Smith::Correlated, at(y) * at(y), at(x)).0 - if y < 16 { 0.05 * at(x) } else { 0.0 }
    };
    assert_eq!(reflection_of(&plane([32, 32], &[("R", &damaged)])).two_lobes, None);
}

#[test]
fn a_constant_channel_is_judged_or_named() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let value = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y), at(x));
    let shipped = plane([16, 16], &[("R", &|x, y| value(x, y).0 - value(x, y).1), ("G", &|_, _| 0.0)]);
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
    // Beside both halves it fills a pixel up, as the blue of a picture does; 0.5 would be no filling.
    let (a, b) = (|x, y| value(x, y).0 - value(x, y).1, |x, y| value(x, y).1);
    let picture = |fill: f64| plane([16, 16], &[("R", &a), ("G", &b), ("B", &move |_, _| fill)]);
    assert!(
        reflection_of(&picture(0.0)).passes(Some(1e-3)) && !reflection_of(&picture(0.5)).passes(Some(1e-3))
    );
    assert!(with(&[Column::A]).passes(Some(1e-3)));
    let judged = with(&[Column::A, Column::B]);
    assert!(judged.worst() > 0.1 && !judged.passes(Some(1e-3)), "{}", judged.worst());
}

#[test]
fn a_furnace_with_a_dark_texel_is_infinite_there() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let mut shipped = plane([16, 16], &[("R", &|x, y| both(Smith::Correlated, at(y) * at(y), at(x)).0)]);
    Arc::make_mut(&mut shipped.channels[0].values)[37] = 0.0;
    let found = reflection_of(&shipped);
    let furnace = found.furnace.as_ref().unwrap();
    assert!(furnace.range[1] == f64::INFINITY && furnace.dark == 1, "{furnace:?}");
    assert!((furnace.at["mu"] - at(5)).abs() < 1e-12, "{furnace:?}");
    assert!(said(&found).contains("0 or less at 1 texels"), "{}", said(&found));
}

#[test]
fn a_wrong_weight_fits_nothing() {
    // Samples of the lobe weighted as if drawn uniformly: no albedo of anything.
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let wrong =
        |x: usize, y: usize| both(Smith::Correlated, at(y), at(x)).0 * (0.4 + 1.3 * at(x) * (1.0 - at(y)));
    let found = reflection_of(&plane([32, 32], &[("0", &wrong)]));
    assert_eq!(found.fit, Fit::None);
    assert!(found.channels[0].errors.as_ref().unwrap().rms > 0.03);
    assert!(said(&found).contains("fits no convention"), "{}", said(&found));
}

#[test]
fn a_column_that_was_never_filled_is_named_and_the_rest_is_read() {
    let at = |i: usize| i as f64 / 32.0;
    let e = |i: usize| match i % 33 {
        0 => 0.0,
        x => both(Smith::Separable, at(i / 33) * at(i / 33), at(x)).0,
    };
    let found = run(
        &shipped(&[33, 33], vec![("0", (0..33 * 33).map(e).collect())]),
        "ggx-reflection",
        &Fixed::default(),
    );
    let axis = |scale| (scale, Registration::Endpoint, false);
    assert_eq!(axes(&found), [axis(Scale::Mu), axis(Scale::Roughness)]);
    assert_eq!(found.best().lobe.form.word, "separable");
    assert!(found.channels[0].defects.contains(&Defect::Dead { line: [0, 0], value: 0.0 }));
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.max < 1e-6 && (errors.judged, errors.all) == (32 * 33, 32 * 33), "{errors:?}");
    let said = found.verdict(None).to_string();
    assert!(said.starts_with("FAIL") && said.contains("fill column x = 0"), "{said}");
    assert!(!found.passes(Some(1.0)));
}

/// A slice of HIPRT's table of thin glass (`40GGX_Thin_Glass_Ess_Correlated_32x32x96.hdr`) is no quantity
/// here: what goes through both walls leaves by a lobe of another width. It is of nothing, under either
/// name.
#[test]
fn a_slice_of_thin_glass_is_of_nothing_known() {
    let at = |i: usize| (i as f64 + 0.5) / 24.0;
    // Ior 1.83 at normal incidence; the transmitted lobe of 0.35 alpha.
    let reflected = |mu: f64| 0.086 + 0.914 * ops::pow(1.0 - mu, 5.0);
    let e = |x: usize, y: usize| {
        let [own, through] = [1.0, 0.35].map(|share| both(Smith::Correlated, share * at(y) * at(y), at(x)).0);
        let r = 2.0 * reflected(at(x)) / (1.0 + reflected(at(x)));
        r * own + (1.0 - r) * through
    };
    let table = plane([24; 2], &[("R", &e), ("G", &e), ("B", &e)]);
    for quantity in ["ggx-reflection", "ggx-glass"] {
        let found = run(&table, quantity, &Fixed::default());
        assert_eq!(found.fit, Fit::None, "{quantity}");
        says(
            &found.verdict(Some(0.5)),
            "UNKNOWN",
            &["fits no convention", "Channel G is the same as R", "do not ship it"],
        );
    }
}
