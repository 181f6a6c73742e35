//! Tables as they are made: of samples, with ends that were never filled, of slices that are apart, of
//! both sides of a surface.

use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditedTable, Channel, Column, Defect, Fit, Fixed, Form, Grade, Registration, Scale, Source, audit,
};
use lobefit_audit::foreign::Step;
use lobefit_math::ops;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};
use lobefit_truth::integrate::reflection::{Effort, split};
use lobefit_truth::quantity;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

fn shipped(size: &[usize], values: Vec<f64>) -> AuditedTable {
    AuditedTable {
        what: "shipped".into(),
        size: size.to_vec(),
        axes: AuditedTable::axes_of(size.len()),
        source: Source::Table,
        channels: vec![Channel { name: "0".into(), values }],
        step: Step::None,
        dead: Vec::new(),
    }
}

fn run(shipped: &AuditedTable, quantity: &str, fixed: &Fixed) -> Audit {
    let found = audit(shipped, quantity::find(quantity).unwrap(), fixed, &|_| ()).unwrap();
    eprintln!("{}", found.verdict(None));
    found
}

fn read(found: &Audit) -> Vec<(Scale, Registration, bool)> {
    found.best().axes.iter().map(|a| (a.scale, a.registration, a.reversed)).collect()
}

fn parts(found: &Audit) -> usize {
    found.channels[0].defects.iter().filter(|d| matches!(d, Defect::Part { .. })).count()
}

/// E of GGX, height-correlated, by independent samples of D: the spread of the weights is largest at
/// grazing view and nothing on smooth surfaces.
fn sampled(alpha: f64, mu: f64, samples: u32, random: &mut Pcg64) -> f64 {
    let uniform = |random: &mut Pcg64| random.next_u32() as f64 / 4294967296.0;
    let lambda = |c: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - c * c) / (c * c)).sqrt() - 1.0);
    let mut sum = 0.0;
    for _ in 0..samples {
        let (phi, v) = (2.0 * std::f64::consts::PI * uniform(random), uniform(random));
        let cosine = ((1.0 - v) / (1.0 + (alpha * alpha - 1.0) * v)).sqrt();
        let y = (1.0 - mu * mu).sqrt() * (1.0 - cosine * cosine).sqrt() * ops::cos(phi) + mu * cosine;
        let light = 2.0 * y * cosine - mu;
        if light > 0.0 && y > 0.0 {
            sum += y / (cosine * mu) / (1.0 + lambda(mu) + lambda(light));
        }
    }
    sum / f64::from(samples)
}

#[test]
fn what_samples_leave_is_no_part_of_other_code() {
    let at = |i: usize| (i as f64 + 0.5) / 24.0;
    let mut random = Pcg64::seed_from_u64(3);
    let values = (0..576).map(|i| sampled(at(i / 24) * at(i / 24), at(i % 24), 8192, &mut random)).collect();
    let table = shipped(&[24, 24], values);
    let found = run(&table, "ggx-reflection", &Fixed::default());
    assert_eq!((found.fit, parts(&found)), (Fit::Whole, 0));
    assert_eq!(found.verdict(None).grade, Grade::Pass, "{}", found.verdict(None));
    // Samples that are stated are held against what so many leave.
    let over = |samples: u32| {
        let found = run(&table, "ggx-reflection", &Fixed { samples: Some(samples), ..Fixed::default() });
        let said = found.channels[0].defects.iter().find_map(|d| match d {
            Defect::Sampled { texels, .. } => Some(texels[0]),
            _ => None,
        });
        said.expect("samples are spoken of")
    };
    assert!(over(64) == 0 && over(1 << 20) > 50, "{} {}", over(64), over(1 << 20));
}

/// A normalisation is off by the error of E over E^2, of the same samples.
#[test]
fn what_samples_leave_is_in_the_unit_of_the_column() {
    let at = |i: usize| (i as f64 + 0.5) / 24.0;
    let mut random = Pcg64::seed_from_u64(3);
    let e: Vec<f64> =
        (0..576).map(|i| sampled(at(i / 24) * at(i / 24), at(i % 24), 8192, &mut random)).collect();
    let over = |values: Vec<f64>| {
        let fixed = Fixed { samples: Some(1 << 18), ..Fixed::default() };
        let found = run(&shipped(&[24, 24], values), "ggx-reflection", &fixed);
        let said = found.channels[0].defects.iter().find_map(|d| match d {
            Defect::Sampled { texels, .. } => Some(texels[0]),
            _ => None,
        });
        said.expect("samples are spoken of")
    };
    let inverse = over(e.iter().map(|e| 1.0 / e).collect());
    let plain = over(e);
    assert!(plain > 20 && inverse.abs_diff(plain) <= 2, "{plain} {inverse}");
}

#[test]
fn what_the_format_holds_is_no_part_of_other_code() {
    // Smooth surfaces are exact in any format; in ten bits the rest is off by up to a step.
    let at = |i: usize| (i as f64 + 0.5) / 24.0;
    let e = |i: usize| split(Smith::Correlated, at(i / 24) * at(i / 24), at(i % 24), &Effort::ladder()[1]).0;
    for (step, steps) in [(Step::Unorm8, 255.0), (Step::Unorm10, 1023.0), (Step::Unorm16, 65535.0)] {
        let values = (0..576).map(|i| (e(i) * steps).floor() / steps).collect();
        let found = run(&shipped(&[24, 24], values), "ggx-reflection", &Fixed::default());
        assert_eq!((found.fit, parts(&found)), (Fit::Whole, 0), "{step:?}");
        let cut = (0..576).map(|i| (e(i) * steps).round() / steps).collect();
        let found = run(&shipped(&[24, 24], cut), "ggx-reflection", &Fixed::default());
        let rounded = |d: &Defect| matches!(d, Defect::Steps { step: own, .. } if *own == step);
        assert!(found.channels[0].defects.iter().any(rounded), "{step:?}");
    }
}

#[test]
fn a_column_that_was_never_filled_is_named_and_the_rest_is_read() {
    let at = |i: usize| i as f64 / 32.0;
    let e = |i: usize| match i % 33 {
        0 => 0.0,
        x => split(Smith::Separable, at(i / 33) * at(i / 33), at(x), &Effort::ladder()[1]).0,
    };
    let found = run(&shipped(&[33, 33], (0..33 * 33).map(e).collect()), "ggx-reflection", &Fixed::default());
    let axis = |scale| (scale, Registration::Endpoint, false);
    assert_eq!(read(&found), [axis(Scale::Mu), axis(Scale::Roughness)]);
    assert_eq!(found.best().lobe.form.word, "separable");
    assert!(found.channels[0].defects.contains(&Defect::Dead { line: [0, 0], value: 0.0 }));
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.max < 1e-6 && (errors.judged, errors.all) == (32 * 33, 32 * 33), "{errors:?}");
    let said = found.verdict(None).to_string();
    assert!(said.starts_with("FAIL") && said.contains("fill column x = 0"), "{said}");
    assert!(!found.passes(Some(1.0)));
}

const N: usize = 8;

/// Energies at the ends of axes of mu (x) and roughness (y) for some indices of refraction (z), in the
/// table's order.
fn glass(smith: Smith, iors: &[f64], value: impl Fn(&Energies, usize) -> f64) -> Vec<f64> {
    let kernel = Kernel::new(smith, 1e-6).unwrap();
    let at = |i: usize| i as f64 / (N - 1) as f64;
    let mut values = vec![0.0; N * N * iors.len()];
    for i in 0..N * N {
        let mut out = vec![Energies::default(); iors.len()];
        let (x, y) = (i % N, i / N);
        if (x, y) == (0, 0) {
            // A mirror at grazing view.
            out.fill(Energies { r: [1.0; 2], t: [0.0; 2] });
        } else {
            kernel.energies((at(y) * at(y)).max(4e-4), at(x).max(1e-3), iors, &mut out).unwrap();
        }
        for (z, e) in out.iter().enumerate() {
            values[z * N * N + i] = value(e, z);
        }
    }
    values
}

/// Axes of such a table.
fn ends(ior: Scale) -> Vec<(Scale, Registration, bool)> {
    [Scale::Mu, Scale::Roughness, ior].map(|scale| (scale, Registration::Endpoint, false)).to_vec()
}

fn of(form: &str, side: Option<Side>) -> Fixed {
    Fixed {
        form: Form::find(form),
        side,
        registrations: Some(vec![Registration::Endpoint]),
        ..Fixed::default()
    }
}

#[test]
fn an_axis_over_both_sides_is_read() {
    // 1 - E: from inside with the index falling from 2.5 to 1, then from outside with the index rising.
    let half = |k: usize| 1.0 + 1.5 * k as f64 / 3.0;
    let iors: Vec<f64> = (0..8).map(|z| if z < 4 { half(3 - z) } else { half(z - 4) }).collect();
    let values = glass(Smith::Separable, &iors, |e, z| 1.0 - e.e()[usize::from(z < 4)]);
    let found = run(&shipped(&[N; 3], values), "ggx-glass", &of("separable", None));
    assert_eq!(read(&found), ends(Scale::IorBothSides));
    assert!(found.best().lobe.both && found.fit == Fit::Whole);
    assert_eq!(found.best().columns, [Some(Column::LossRT)]);
    // The corner of grazing light on a mirror is clamped in its own way.
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.rms < 0.01 && errors.median < 1e-5, "{errors:?}");
}

#[test]
fn an_index_from_1_05_on_is_read() {
    for (scale, step) in [(Scale::IorFromTwo, 2.0), (Scale::IorFromToThree, 1.95)] {
        let iors: Vec<f64> = (0..N).map(|z| (1.05 + step * z as f64 / (N - 1) as f64).min(3.0)).collect();
        let values = glass(Smith::Correlated, &iors, |e, _| 1.0 - e.r[0]);
        let fixed = Fixed { column: Some(Column::LossR), ..of("correlated", Some(Side::Outside)) };
        let found = run(&shipped(&[N; 3], values), "ggx-glass", &fixed);
        assert_eq!((read(&found), found.fit), (ends(scale), Fit::Whole));
    }
}

#[test]
fn a_slice_that_is_apart_is_named_and_one_without_an_interface_is_nothing() {
    let iors: Vec<f64> = (0..N).map(|z| 1.0 + z as f64 / (N - 1) as f64).collect();
    let of_design = |e: &Energies, z: usize| if z == 0 { 1.0 } else { e.e()[0] };
    let fixed = of("correlated", Some(Side::Outside));
    let sound = run(&shipped(&[N; 3], glass(Smith::Correlated, &iors, of_design)), "ggx-glass", &fixed);
    assert_eq!((read(&sound), sound.fit), (ends(Scale::IorUnit), Fit::Whole));
    assert_eq!((parts(&sound), sound.verdict(None).grade), (0, Grade::Pass));
    let errors = sound.channels[0].errors.as_ref().unwrap();
    assert!(errors.judged <= N * N * (N - 1) && errors.median < 1e-5, "{errors:?}");
    let stale = |e: &Energies, z: usize| if z == 5 { 0.7 * e.e()[0] } else { of_design(e, z) };
    let found = run(&shipped(&[N; 3], glass(Smith::Correlated, &iors, stale)), "ggx-glass", &fixed);
    let said = found.verdict(None).to_string();
    assert!(found.fit == Fit::Part && said.contains("all at slice z = 5"), "{said}");
    assert!(said.contains("make the texels at slice z = 5 again"), "{said}");
}

#[test]
fn averages_of_glass_are_some() {
    // Over roughness (x) and index (y), from inside; the average by the midpoint rule over sqrt(mu).
    let kernel = Kernel::new(Smith::Correlated, 1e-6).unwrap();
    let at = |i: usize| (i as f64 + 0.5) / 10.0;
    let iors: Vec<f64> = (0..10).map(|y| 1.0 + at(y)).collect();
    let mut values = vec![0.0; 100];
    for x in 0..10 {
        for k in 0..400 {
            let root = (f64::from(k) + 0.5) / 400.0;
            let mut out = vec![Energies::default(); 10];
            kernel.energies(at(x) * at(x), (root * root).max(2e-4), &iors, &mut out).unwrap();
            for (y, e) in out.iter().enumerate() {
                values[y * 10 + x] += 4.0 * root * root * root * e.e()[1] / 400.0;
            }
        }
    }
    let found = run(&shipped(&[10, 10], values), "ggx-glass", &Fixed::default());
    let wanted = [Scale::Roughness, Scale::IorUnit].map(|scale| (scale, Registration::Centre, false));
    assert_eq!(read(&found), wanted);
    assert_eq!((found.best().lobe.side, found.fit), (Some(Side::Inside), Fit::Whole));
    assert_eq!(found.best().columns, [Some(Column::AverageRT)]);
    assert!(found.worst() < 5e-5, "{}", found.worst());
}
