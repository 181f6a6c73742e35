//! Tables of three axes, and of sheen, with the defects that published ones have.

use lobefit::data::Smith;
use lobefit_audit::audit::{
    AuditedTable, Column, Defect, Fit, Fixed, Form, Grade, Input, Registration, Scale,
};
use lobefit_truth::integrate::Path;
use lobefit_truth::integrate::aniso::fast::{Place, many};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};
use lobefit_truth::quantity::sheen;

use crate::support::{axes, refused, run, said, shipped};

/// A table of one channel.
fn solid(size: &[usize], values: Vec<f64>) -> AuditedTable {
    shipped(size, vec![("0", values)])
}

const N: usize = 10;

/// Rough glass as Cycles lays it out: x roughness, y mu, z the fourth root of F0, end points; the
/// side's E, changed by `f`.
fn glass(side: usize, f: impl Fn(f64, [usize; 3]) -> f64) -> Vec<f64> {
    glass_from(1.0, side, f)
}

/// The same, of no index below `least`.
fn glass_from(least: f64, side: usize, f: impl Fn(f64, [usize; 3]) -> f64) -> Vec<f64> {
    let kernel = Kernel::new(Smith::Correlated, 1e-7).unwrap();
    let at = |i: usize| i as f64 / (N - 1) as f64;
    let ior = |z: usize| {
        let root = at(z) * at(z);
        ((1.0 + root) / (1.0 - root).max(1e-9)).clamp(least, 3.0)
    };
    let iors: Vec<f64> = (0..N).map(ior).collect();
    let mut values = vec![0.0; N * N * N];
    for y in 0..N {
        for x in 0..N {
            let mut out = vec![Energies::default(); N];
            kernel.energies((at(x) * at(x)).max(4e-4), at(y).max(1e-3), &iors, &mut out).unwrap();
            for (z, e) in out.iter().enumerate() {
                values[(z * N + y) * N + x] = f(e.e()[side], [x, y, z]);
            }
        }
    }
    values
}

/// Cycles' axes; with the corners that its clamps change left to a share of the texels.
const CYCLES: [(Scale, Registration, bool); 3] = [
    (Scale::Roughness, Registration::Endpoint, false),
    (Scale::Mu, Registration::Endpoint, false),
    (Scale::FourthRootF0, Registration::Endpoint, false),
];

/// A slice was read as an average of two inputs, and nothing said which it is of.
#[test]
fn a_slice_of_glass_is_judged_at_its_index() {
    let z = N / 2;
    let root = (z as f64 / (N - 1) as f64) * (z as f64 / (N - 1) as f64);
    let ior = (1.0 + root) / (1.0 - root);
    let all = glass(0, |e, _| e);
    let slice = solid(&[N; 2], all[z * N * N..(z + 1) * N * N].to_vec());
    let open = run(&slice, "ggx-glass", &Fixed::default());
    assert_eq!(open.verdict(None).grade, Grade::Unknown);
    assert!(said(&open).contains("say of which (`--at ior=1.5`)"), "{}", said(&open));
    let laid_out = vec![(Scale::Roughness, false), (Scale::Mu, false)];
    let at = |ior| Fixed { at: Some((Input::Ior, ior)), axes: Some(laid_out.clone()), ..Fixed::default() };
    let found = run(&slice, "ggx-glass", &at(ior));
    assert_eq!(axes(&found), CYCLES[..2]);
    assert!(found.best().lobe.side == Some(Side::Outside) && found.worst() < 2e-3, "{}", found.worst());
    assert_eq!(found.verdict(Some(2e-3)).grade, Grade::Pass);
    assert!(said(&found).contains(&format!("rays from outside, at ior {ior}, with ")), "{}", said(&found));
    assert_ne!(run(&slice, "ggx-glass", &at(ior + 0.3)).verdict(Some(2e-3)).grade, Grade::Pass);
    assert!(refused(&slice, "ggx-glass", &at(3.5)).contains("judged above 1 to 3"));
    assert!(refused(&slice, "ggx-reflection", &at(1.5)).contains("no table of two axes at one ior"));
}

#[test]
fn glass_from_outside_is_read_as_it_is() {
    let found =
        run(&solid(&[N; 3], glass(0, |e, _| (e * 1e6).round() / 1e6)), "ggx-glass", &Fixed::default());
    assert_eq!(axes(&found), CYCLES);
    assert_eq!(found.best().lobe.side, Some(Side::Outside));
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Correlated));
    assert_eq!(found.best().columns, [Some(Column::RT)]);
    assert!(found.channels[0].errors.as_ref().unwrap().median < 1e-6);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.judged < errors.all, "indices above 3 are not judged");
    let told = "460 lie at mu below 2e-4, of which no truth is had, or at ior 1, where there is no interface, or at ior above 3, of which";
    assert!(said(&found).contains(told), "{}", said(&found));
}

/// Lobes have no index of 1, so that makers of tables begin a little above.
#[test]
fn an_index_that_is_clamped_above_1_is_judged() {
    let form = Form::find("correlated");
    let axes = CYCLES.map(|(scale, _, reversed)| (scale, reversed)).to_vec();
    let registrations = Some(vec![Registration::Endpoint]);
    let fixed =
        Fixed { form, axes: Some(axes), registrations, side: Some(Side::Outside), ..Fixed::default() };
    let found = run(&solid(&[N; 3], glass_from(1.0001, 0, |e, _| e)), "ggx-glass", &fixed);
    assert_eq!((found.best().axes[2].floor, found.fit), (1.0001, Fit::Whole));
    let errors = found.channels[0].errors.as_ref().unwrap();
    // The view along the surface is not judged, nor what is above 3.
    assert!(errors.max < 1e-4 && errors.judged == N * (N - 1) * 7, "{errors:?}");
    assert!(!said(&found).contains("no interface"), "{}", said(&found));
}

#[test]
fn a_stale_part_of_glass_from_inside_is_found() {
    // A table from before its renderer rejected rays that leave on the wrong side: too high where
    // z >= 4 and the surface is rough.
    let stale =
        |e: f64, [x, y, z]: [usize; 3]| if z >= 4 && x >= 5 && y <= 6 { (e + 0.25).min(1.0) } else { e };
    let form = Form::find("correlated");
    let table = solid(&[N; 3], glass(1, stale));
    let found = run(&table, "ggx-glass", &Fixed { form, ..Fixed::default() });
    assert_eq!(axes(&found), CYCLES);
    assert_eq!(found.best().lobe.side, Some(Side::Inside));
    assert_eq!(found.fit, Fit::Part);
    let part = found.channels[0].defects.iter().find_map(|d| match d {
        Defect::Part { texels, mean, extent, .. } => Some((*texels, *mean, extent.range.clone())),
        _ => None,
    });
    let (texels, mean, range) = part.expect("the part is named");
    assert!(mean > 0.1 && texels[0] > 80, "{texels:?} {mean}");
    assert_eq!(range[2][0], 4);
    assert!(
        said(&found).contains("too high") && said(&found).contains("leave open fits as a whole"),
        "{}",
        said(&found)
    );
    assert!(!found.passes(Some(0.5)));
}

/// The path tracer's table of these sizes over mu, alpha and the square root of the anisotropy,
/// nodes i/n.
fn of_the_path_tracer(size: [usize; 3]) -> Vec<f64> {
    let at = |i: usize, n: usize| i as f64 / n as f64;
    let place = |i: usize| {
        let mu = at(i % size[0], size[0]).clamp(1e-4, 0.9999);
        let alpha = at(i / size[0] % size[1], size[1]).clamp(1e-4, 1.0);
        let aspect = (1.0 - 0.9 * at(i / size[0] / size[1], size[2]).sqrt()).sqrt();
        Place { alpha: [(alpha / aspect).max(1e-4), (alpha * aspect).max(1e-4)], mu, phi: None }
    };
    let places: Vec<Place> = (0..size.iter().product()).map(place).collect();
    many(Path::Best, Smith::Separable, &places, 1e-7).unwrap().e
}

/// Their coordinates.
const SOURCES: [(Scale, Registration, bool); 3] = [
    (Scale::Mu, Registration::Left, false),
    (Scale::Alpha, Registration::Left, false),
    (Scale::AnisotropySquared, Registration::Left, false),
];

#[test]
fn the_anisotropic_table_of_the_path_tracer_is_read_as_it_is() {
    let found =
        run(&solid(&[12, 12, 6], of_the_path_tracer([12, 12, 6])), "ggx-reflection-aniso", &Fixed::default());
    assert_eq!(axes(&found), SOURCES);
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Separable));
    assert_eq!(found.fit, Fit::Whole);
    let plain = found.plain.as_ref().map(|p| p.texels);
    assert_eq!(plain, Some([864; 2]), "the plain reading is judged at every texel too");
}

#[test]
fn unequal_sizes_and_other_orders_of_axes_are_read() {
    let size = [10, 8, 6];
    let e = of_the_path_tracer(size);
    let form = Form::find("separable");
    for order in [[1, 2, 0], [2, 1, 0]] {
        let sides = order.map(|k| size[k]);
        let value = |i: usize| {
            let along = [i % sides[0], i / sides[0] % sides[1], i / (sides[0] * sides[1])];
            let mut own = [0; 3];
            order.iter().zip(along).for_each(|(k, at)| own[*k] = at);
            e[(own[2] * size[1] + own[1]) * size[0] + own[0]]
        };
        let table = solid(&sides, (0..e.len()).map(value).collect());
        let found = run(&table, "ggx-reflection-aniso", &Fixed { form, ..Fixed::default() });
        assert_eq!(axes(&found), order.map(|k| SOURCES[k]), "{order:?}");
        assert_eq!(
            (found.best().lobe.form.smith, found.fit),
            (Some(Smith::Separable), Fit::Whole),
            "{order:?}"
        );
        assert!(found.margin > 5.0 && found.worst() < 1e-4, "{order:?}: {}", found.worst());
    }
}

#[test]
fn an_axis_of_the_inverse_index_is_found() {
    // Adobe's tables have 1/ior along half of an axis; here all of it, from 1/2 to 1.
    let kernel = Kernel::new(Smith::Correlated, 1e-7).unwrap();
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let size = [10, 12, 14];
    let iors: Vec<f64> = (0..size[0]).map(|i| 2.0 / (1.0 + at(i, size[0]))).collect();
    let mut values = Vec::new();
    for z in 0..size[2] {
        for y in 0..size[1] {
            let mut out = vec![Energies::default(); size[0]];
            let alpha = at(y, size[1]);
            kernel.energies(alpha * alpha, at(z, size[2]), &iors, &mut out).unwrap();
            values.extend(out.iter().map(|e| e.r[0]));
        }
    }
    let (form, side) = (Form::find("correlated"), Some(Side::Outside));
    let fixed = Fixed { form, side, ..Fixed::default() };
    let found = run(&solid(&size, values), "ggx-glass", &fixed);
    let wanted =
        [Scale::IorInverseTwo, Scale::Roughness, Scale::Mu].map(|s| (s, Registration::Centre, false));
    assert_eq!(axes(&found), wanted);
    assert_eq!((found.best().columns.clone(), found.fit), (vec![Some(Column::R)], Fit::Whole));
}

#[test]
fn sheen_that_is_clamped_and_sheen_of_a_wrong_weight() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let value = |i: usize| sheen::albedo(at(i / 16) * at(i / 16), at(i % 16));
    let clamped = (0..256).map(|i| (value(i).min(1.0) * 255.0).round() / 255.0).collect();
    let found = run(&solid(&[16, 16], clamped), "sheen-charlie", &Fixed::default());
    assert_eq!(
        axes(&found),
        [(Scale::Mu, Registration::Centre, false), (Scale::Roughness, Registration::Centre, false)]
    );
    let stuck = found.channels[0].defects.iter().find_map(|d| match d {
        Defect::Clamped { value, texels, truth, .. } => Some((*value, *texels, *truth)),
        _ => None,
    });
    let (end, texels, truth) = stuck.expect("the clamp is named");
    assert!(end == 1.0 && texels >= 2 && truth > 1.2, "{texels} {truth}");
    // Half vectors drawn by D but weighted as if drawn uniformly, with roughness for alpha: the
    // ratio to the truth runs from 0.4 to 1.4.
    let wrong = (0..256).map(|i| value(i) * (0.4 + at(i % 16)) * (1.6 - at(i / 16))).collect();
    let found = run(&solid(&[16, 16], wrong), "sheen-charlie", &Fixed::default());
    assert_eq!(found.fit, Fit::None);
}

#[test]
fn an_end_that_is_wrong_does_not_condemn_the_rest() {
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    // The first row is too low, as samples that miss a sharp lobe leave it; the rest is as noisy as its
    // quantiser makes it, so that no error stands out.
    let value = |i: usize| {
        let e = (sheen::albedo(at(i / 16), at(i % 16)) * 16.0).round() / 16.0;
        if i < 16 { 0.2 * e } else { e }
    };
    let axes = Some(vec![(Scale::Mu, false), (Scale::Alpha, false)]);
    let fixed = Fixed {
        axes,
        registrations: Some(vec![Registration::Centre]),
        form: Form::find("neubelt"),
        ..Fixed::default()
    };
    let table = solid(&[16, 16], (0..256).map(value).collect());
    let found = run(&table, "sheen-charlie", &fixed);
    assert_eq!(found.fit, Fit::Part);
    assert!(said(&found).contains("y = 0; the others leave RMS 0.02"), "{}", said(&found));
}

#[test]
fn texels_that_are_not_sampled_are_told_and_pass_no_limit() {
    let size = [8200, 8, 8];
    let values = (0..8200 * 64).map(|i| 1.0 - 0.3 * ((i / 8200 % 8) as f64 / 8.0)).collect();
    // One reading is enough: what is counted is texels.
    let axes = [Scale::Mu, Scale::Roughness, Scale::Anisotropy].map(|scale| (scale, false));
    let registrations = Some(vec![Registration::Centre]);
    let fixed =
        Fixed { axes: Some(axes.to_vec()), registrations, form: Form::find("separable"), ..Fixed::default() };
    let mut found = run(&solid(&size, values), "ggx-reflection-aniso", &fixed);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert_eq!(errors.unsampled, 8200 * 64 - 64 * 64);
    assert!(
        said(&found).contains("520704 were not looked at") && said(&found).contains("64 of 8200 along x"),
        "{}",
        said(&found)
    );
    found.fit = Fit::Whole;
    assert!(!found.passes(Some(f64::MAX)));
}
