//! Tables of glass: axes over both sides and from an index above 1, 1 - R, radiance, averages, a slice apart.

use lobefit::data::Smith;
use lobefit_audit::audit::{AuditedTable, Column, Fit, Fixed, Form, Input, Registration, Scale};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};
use rayon::prelude::*;

use super::samples::parts;
use crate::common::{lobefit, stderr};
use crate::support::{axes, columns, rising, run, says, shipped};

const N: usize = 8;

/// Energies at the ends of axes of mu (x) and roughness (y) for some indices of refraction (z), in the
/// table's order.
fn energies(smith: Smith, iors: &[f64], value: impl Fn(&Energies, usize) -> f64) -> Vec<f64> {
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
    rising(&[Scale::Mu, Scale::Roughness, ior], Registration::Endpoint)
}

fn solid(values: Vec<f64>) -> AuditedTable {
    shipped(&[N; 3], vec![("0", values)])
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
fn point_05_an_axis_over_both_sides_is_read() {
    // 1 - E: from inside with the index falling from 2.5 to 1, then from outside with the index rising.
    let half = |k: usize| 1.0 + 1.5 * k as f64 / 3.0;
    let iors: Vec<f64> = (0..8).map(|z| if z < 4 { half(3 - z) } else { half(z - 4) }).collect();
    let values = energies(Smith::Separable, &iors, |e, z| 1.0 - e.e()[usize::from(z < 4)]);
    let found = run(&solid(values), "ggx-glass", &of("separable", None));
    assert_eq!(axes(&found), ends(Scale::IorBothSides));
    assert!(found.best().lobe.both && found.fit == Fit::Whole);
    assert_eq!(columns(&found), [Some(Column::LossRT)]);
    // The corner of grazing light on a mirror is clamped in its own way.
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.rms < 0.01 && errors.median < 1e-5, "{errors:?}");
    says(&found.verdict(None), "PASS", &["ggx-glass 1-E", "1/ior..ior"]);
}

#[test]
fn point_05_an_index_from_1_05_on_and_1_less_r_are_read() {
    for (scale, step) in [(Scale::IorFromTwo, 2.0), (Scale::IorFromToThree, 1.95)] {
        let iors: Vec<f64> = (0..N).map(|z| (1.05 + step * z as f64 / (N - 1) as f64).min(3.0)).collect();
        let values = energies(Smith::Correlated, &iors, |e, _| 1.0 - e.r[0]);
        let fixed = Fixed { column: Some(Column::LossR), ..of("correlated", Some(Side::Outside)) };
        let found = run(&solid(values), "ggx-glass", &fixed);
        assert_eq!((axes(&found), found.fit), (ends(scale), Fit::Whole));
        assert_eq!(columns(&found), [Some(Column::LossR)]);
        says(&found.verdict(None), "PASS", &["ggx-glass 1-R", "from outside"]);
    }
}

#[test]
fn point_07_a_slice_that_is_apart_is_named_and_one_without_an_interface_is_nothing() {
    let iors: Vec<f64> = (0..N).map(|z| 1.0 + z as f64 / (N - 1) as f64).collect();
    let of_design = |e: &Energies, z: usize| if z == 0 { 1.0 } else { e.e()[0] };
    let fixed = of("correlated", Some(Side::Outside));
    let sound = run(&solid(energies(Smith::Correlated, &iors, of_design)), "ggx-glass", &fixed);
    assert_eq!((axes(&sound), sound.fit), (ends(Scale::IorUnit), Fit::Whole));
    assert_eq!((parts(&sound), columns(&sound)), (0, vec![Some(Column::RT)]));
    says(&sound.verdict(None), "PASS", &["ggx-glass E"]);
    let errors = sound.channels[0].errors.as_ref().unwrap();
    assert!(errors.judged <= N * N * (N - 1) && errors.median < 1e-5, "{errors:?}");
    let stale = |e: &Energies, z: usize| if z == 5 { 0.7 * e.e()[0] } else { of_design(e, z) };
    let found = run(&solid(energies(Smith::Correlated, &iors, stale)), "ggx-glass", &fixed);
    assert!(found.fit == Fit::Part && parts(&found) == 1);
    let words = ["all at slice z = 5", "make the texels at slice z = 5 again"];
    says(&found.verdict(None), "FAIL", &words);
}

#[test]
fn point_05_averages_of_glass_are_some() {
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
    let found = run(&shipped(&[10, 10], vec![("0", values)]), "ggx-glass", &Fixed::default());
    assert_eq!(axes(&found), rising(&[Scale::Roughness, Scale::IorUnit], Registration::Centre));
    assert_eq!((found.best().lobe.side, found.fit), (Some(Side::Inside), Fit::Whole));
    assert_eq!(columns(&found), [Some(Column::AverageRT)]);
    assert!(found.worst() < 5e-5, "{}", found.worst());
    says(&found.verdict(None), "PASS", &["ggx-glass E_avg"]);
}

#[test]
fn point_05_transmitted_radiance_is_not_taken_for_energy() {
    let kernel = Kernel::new(Smith::Correlated, 1e-7).unwrap();
    let (n, at) = (6, |i: usize| (i as f64 + 0.5) / 6.0);
    let iors: Vec<f64> = (0..n).map(|z| 1.0 + at(z)).collect();
    let mut values = vec![0.0; n * n * n];
    for i in 0..n * n {
        let (x, y) = (i % n, i / n);
        let mut out = vec![Energies::default(); n];
        kernel.energies(at(y) * at(y), at(x), &iors, &mut out).unwrap();
        for (z, e) in out.iter().enumerate() {
            // Radiance rises by the square of the index on the way out.
            values[(z * n + y) * n + x] = e.r[1] + e.t[1] * iors[z] * iors[z];
        }
    }
    let given = Some([Scale::Mu, Scale::Roughness, Scale::IorUnit].map(|scale| (scale, false)).to_vec());
    let (form, side) = (Form::find("correlated"), Some(Side::Inside));
    let registrations = Some(vec![Registration::Centre]);
    let fixed = Fixed { axes: given, registrations, form, side, ..Fixed::default() };
    let found = run(&shipped(&[n; 3], vec![("0", values)]), "ggx-glass", &fixed);
    assert_eq!((columns(&found), found.fit), (vec![Some(Column::Radiance)], Fit::Whole));
    assert!(found.worst() < 1e-5, "{}", found.worst());
    says(&found.verdict(None), "PASS", &["ggx-glass R+T/eta^2"]);
}

/// R and T in two channels of a file were each below 1, and nobody held their sum against it.
#[test]
fn the_sum_of_r_and_t_gains_energy_where_it_is_above_1() {
    let iors: Vec<f64> = (0..N).map(|z| 1.05 + z as f64 / (N - 1) as f64).collect();
    let of_both = |gain: f64| {
        let channel = |k: usize| energies(Smith::Correlated, &iors, |e, _| gain * [e.r[0], e.t[0]][k]);
        let ior = Scale::between(Input::Ior, [1.05, 2.05], true);
        let axes = Some([Scale::Mu, Scale::Roughness, ior].map(|scale| (scale, false)).to_vec());
        let fixed = Fixed { axes, ..of("correlated", Some(Side::Outside)) };
        let found = run(&shipped(&[N; 3], vec![("R", channel(0)), ("G", channel(1))]), "ggx-glass", &fixed);
        assert_eq!(columns(&found), [Some(Column::R), Some(Column::T)]);
        found
    };
    let sound = of_both(1.0);
    says(&sound.verdict(None), "PASS", &["ggx-glass R and T"]);
    let furnace = sound.furnace.as_ref().expect("R + T");
    assert!(furnace.range.iter().all(|off| off.abs() < 0.02), "{furnace:?}");
    says(&of_both(1.02).verdict(None), "FAIL", &["gains energy: 1.02 of the light comes back at texel ["]);
}

/// R over indices of a range that no convention has passed as R/E, or failed as a texel too high, also with a
/// slice of another index: its slices show the range.
#[test]
fn a_range_that_is_not_stated_is_inferred() {
    let at = |k: usize, from: f64, to: f64| from + (to - from) * k as f64 / (N - 1) as f64;
    let reflected = |iors: &[f64]| {
        let reflected = energies(Smith::Correlated, iors, |energies, _| energies.r[0]);
        run(&solid(reflected), "ggx-glass", &Fixed::default())
    };
    for [from, to] in [[1.1, 2.2], [1.8, 1.2], [1.137, 1.83]] {
        let iors: Vec<f64> = (0..N).map(|k| at(k, from, to)).collect();
        let found = reflected(&iors);
        let nodes = (0..N).map(|k| found.best().axes[2].node(k, N));
        assert!(nodes.zip(&iors).all(|(node, ior)| (node - ior).abs() < 2e-3), "{:?}", found.best().axes);
        says(&found.verdict(None), "PASS", &["by its slices, as no range is stated"]);
    }
    let mut stale: Vec<f64> = (0..N).map(|k| at(k, 1.1, 2.2)).collect();
    stale[5] = stale[3];
    says(&reflected(&stale).verdict(None), "FAIL", &["slice z = 5"]);
}

/// An axis of an index had one of a few ranges: ends may be stated, and an index may have no bound.
#[test]
fn point_05_an_axis_of_any_range_is_read() {
    let scale = Scale::between(Input::Ior, [1.1, 2.2], true);
    assert_eq!([0.0, 0.5, 1.0].map(|x| scale.input_at(x)), [1.1, 1.6500000000000001, 2.2]);
    let folder = tempfile::tempdir().unwrap();
    let values: Vec<String> =
        (0..256).map(|i| format!("{:.6}f", 1.0 - 0.3 * f64::from(i / 16) / 15.0)).collect();
    std::fs::write(folder.path().join("t.h"), format!("float t[256] = {{ {} }};\n", values.join(", ")))
        .unwrap();
    for axes in ["ior=1.1..2.2,roughness", "1/ior,roughness"] {
        let all = ["audit", "t.h", "--as", "ggx-glass", "--size", "16x16", "--axes", axes, "--json"];
        let stated = ["--registration", "endpoint", "--smith", "correlated", "--side", "outside"];
        let output = lobefit(folder.path(), &[&all[..], &stated].concat(), b"");
        let found: serde_json::Value =
            serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", stderr(&output)));
        assert_eq!(found["conventions"][0]["axes"][0]["coordinate"], axes.split(',').next().unwrap());
    }
}

/// Texels at centres in slices at end points, from a baker that samples: all at centres fits several times
/// worse, but lookups next to an index of 1 are off by as much there as anywhere.
#[test]
fn slices_may_lie_otherwise_than_their_texels() {
    let kernel = Kernel::new(Smith::Correlated, 1e-6).unwrap();
    let iors: Vec<f64> = (0..N).map(|z| 1.0 + z as f64 / (N - 1) as f64).collect();
    let at = |i: usize| (i as f64 + 0.5) / N as f64;
    let mut values = vec![0.0; N * N * N];
    for i in 0..N * N {
        let mut out = vec![Energies::default(); N];
        kernel.energies(at(i / N) * at(i / N), at(i % N), &iors, &mut out).unwrap();
        out.iter().enumerate().for_each(|(z, e)| values[z * N * N + i] = e.e()[1]);
    }
    // Errors of a standard deviation of 5e-4, of either sign.
    let noise = |k: usize| 1e-3 * ((k as f64 * 0.618_033_988_749_895).fract() - 0.5) * 3.0_f64.sqrt();
    let noisy = values.iter().enumerate().map(|(k, value)| value + noise(k)).collect();
    let found = run(&solid(noisy), "ggx-glass", &Fixed::default());
    let lies: Vec<Registration> = axes(&found).into_iter().map(|(_, registration, _)| registration).collect();
    assert_eq!(lies, [Registration::Centre, Registration::Centre, Registration::Endpoint]);
    says(&found.verdict(None), "PASS", &["ior-1 along z at end points"]);
}

/// Slices of one cosine each, where all tables that are shipped have slices of one index, kept any limit.
#[test]
fn slices_of_one_cosine_are_transposed() {
    let iors: Vec<f64> = (0..N).map(|z| 1.0 + z as f64 / (N - 1) as f64).collect();
    let values = energies(Smith::Correlated, &iors, |e, _| e.e()[0]);
    let turned = |i: usize| values[(i % N * N + i / N % N) * N + i / (N * N)];
    let found = run(&solid((0..N * N * N).map(turned).collect()), "ggx-glass", &Fixed::default());
    for limit in [None, Some(0.01)] {
        let told = ["it has ior-1 along x, mu along z", "`--axes ior-1,roughness,mu`"];
        says(&found.verdict(limit), "FAIL", &told);
    }
}

/// The largest error of a lookup lies beside the first slice or the first row, midway along the other axes:
/// by as many places as there are texels, which were these, it was said to be a third of this.
#[test]
fn lookups_of_three_axes_err_by_no_more_than_is_said() {
    const SIDE: usize = 16;
    const DENSE: usize = 45;
    let kernel = Kernel::new(Smith::Correlated, 1e-6).unwrap();
    let at = |x: f64| (x + 0.5) / SIDE as f64;
    let transmitted = |[mu, roughness]: [f64; 2], iors: &[f64]| -> Vec<f64> {
        let mut out = vec![Energies::default(); iors.len()];
        kernel.energies(roughness * roughness, mu, iors, &mut out).unwrap();
        out.iter().map(|energies| energies.t[0]).collect()
    };
    let iors: Vec<f64> = (0..SIDE).map(|z| 1.0 + at(z as f64)).collect();
    let mut values = vec![0.0; SIDE * SIDE * SIDE];
    for i in 0..SIDE * SIDE {
        let column = transmitted([at((i % SIDE) as f64), at((i / SIDE) as f64)], &iors);
        column.into_iter().enumerate().for_each(|(z, t)| values[z * SIDE * SIDE + i] = t);
    }
    let found = run(&shipped(&[SIDE; 3], vec![("0", values.clone())]), "ggx-glass", &Fixed::default());
    let said = found.channels[0].lookup.as_ref().expect("a table of texels").clone();
    // Between the outermost texels, in texels.
    let places: Vec<f64> = (0..DENSE).map(|k| (SIDE - 1) as f64 * k as f64 / (DENSE - 1) as f64).collect();
    let dense: Vec<f64> = places.iter().map(|z| 1.0 + at(*z)).collect();
    let looked_up = |place: [f64; 3]| -> f64 {
        let corner = |corner: usize| {
            let along = |k: usize| {
                let low = (place[k] as usize).min(SIDE - 2);
                let share = place[k] - low as f64;
                if corner >> k & 1 == 1 { (low + 1, share) } else { (low, 1.0 - share) }
            };
            let [x, y, z] = [0, 1, 2].map(along);
            x.1 * y.1 * z.1 * values[(z.0 * SIDE + y.0) * SIDE + x.0]
        };
        (0..8).map(corner).sum()
    };
    let error = |x: f64, y: f64| {
        let truths = transmitted([at(x), at(y)], &dense);
        let of = |(z, truth): (&f64, f64)| (looked_up([x, y, *z]) - truth).abs();
        places.iter().zip(truths).map(of).fold(0.0, f64::max)
    };
    let worst = places.par_iter().map(|y| places.iter().map(|x| error(*x, *y)).fold(0.0, f64::max));
    let worst = worst.reduce(|| 0.0, f64::max);
    assert!(said.inner >= worst && said.inner < 1.1 * worst, "{} said, {worst} found", said.inner);
    assert!(said.rms > 1e-3, "{}", said.rms);
}
