//! Shapes that are not guessed, what is said first, large files.

use std::path::Path;
use std::sync::Arc;

use lobefit::data::Smith;
use lobefit_audit::audit::{Audit, AuditedTable, Fit, Fixed, Registration, Scale};
use lobefit_math::ops;

use super::{a, at, b, e, table};
use crate::common::{lobefit, stderr};
use crate::support::{Filled, both, plane, reflection_of, run, said, says};

/// What `lobefit audit` of a file as E of GGX gives: exit code, verdict, messages.
fn audited(folder: &Path, file: &str, more: &[&str]) -> (Option<i32>, String, String) {
    let output = lobefit(folder, &[&["audit", file, "--as", "ggx-reflection:E"], more].concat(), b"");
    (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
}

/// An array in C of E, so many times over.
fn array(name: &str, times: usize) -> String {
    let texels = (0..times).flat_map(|_| (0..256).map(|i| format!("{:.6}f", e(i % 16, i / 16))));
    let rows: Vec<String> = texels.collect();
    format!("static const float {name}[{}] = {{ {} }};\n", 256 * times, rows.join(", "))
}

/// Shapes were guessed: 1024 numbers at `--size 16x16` as four channels, 4096 as one of two shapes;
/// another array of the file failed `--size` without a word of `--symbol`.
#[test]
fn point_10_no_shape_is_guessed_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    let weights = "static const float weights[12] = { .1, .2, .3, .4, .5, .6, .7, .8, .9, 1.0, 1.1, 1.2 };\n";
    write("two.h", (weights.to_string() + &array("lut", 1)).as_bytes());
    write("flat.h", array("lut", 16).as_bytes());
    let four = (0..1024).flat_map(|i| (e(i / 4 % 16, i / 64) as f32).to_le_bytes());
    write("four.bin", &four.collect::<Vec<u8>>());
    let (code, _, err) = audited(folder.path(), "two.h", &["--size", "16x16"]);
    assert!(code == Some(2) && err.contains("weights: 12 values") && err.contains("--symbol"), "{err}");
    let (code, _, err) = audited(folder.path(), "flat.h", &[]);
    assert!(code == Some(2) && err.contains("64 x 64 or 16 x 16 x 16: state the size"), "{err}");
    let (code, out, err) =
        audited(folder.path(), "two.h", &["--size", "16x16", "--symbol", "lut", "--limit", "1e-5"]);
    assert_eq!(code, Some(0), "{out}{err}");
    assert!(out.starts_with("PASS ggx-reflection E: two.h (lut) is off by at most"), "{out}");
    assert!(out.contains("mu along x at texel centres"), "{out}");
    // The four channels are said, and are what is asked for where they are stated.
    let read =
        ["--size", "16x16", "--axes", "mu,roughness", "--registration", "centre", "--smith", "correlated"];
    let (_, out, err) = audited(folder.path(), "four.bin", &read);
    assert!(
        err.contains("256 texels of 4 channels in the size that is given; --channels states another"),
        "{err}"
    );
    assert!(out.starts_with("PASS ggx-reflection E"), "{out}");
    let stated = [&read[..], &["--channels", "4"]].concat();
    assert_eq!(audited(folder.path(), "four.bin", &stated).2, "");
}

/// Whether a verdict is a line with the grade, the quantity and the limit, and at most five short points.
fn is_formed(found: &Audit) {
    let verdict = found.verdict(Some(1e-9));
    let text = verdict.to_string();
    let mut lines = text.lines();
    let first = lines.next().unwrap();
    assert!(first.starts_with(&format!("{} ggx-reflection", verdict.grade.word())), "{first}");
    assert!(first.ends_with("; the limit is 1e-9"), "{first}");
    let points: Vec<&str> = lines.collect();
    assert!(points.len() <= 5 && points.iter().all(|p| p.starts_with("- ")), "{text}");
    let long = points.iter().map(|p| p.chars().count()).max().unwrap();
    assert!(long <= 700, "{long}: {text}");
}

/// A verdict was a paragraph of 900 to 1400 characters. One of a sound table, of a table with a channel
/// of nothing known, and of one that follows nothing.
#[test]
fn point_15_a_verdict_is_a_line_and_five_points() {
    let wrong = |x: usize, y: usize| 0.5 + 0.4 * ops::sin(20.0 * at(x) * at(y));
    let off = |x: usize, y: usize| e(x, y) + 0.003;
    let sound = [("R", &a as &dyn Fn(usize, usize) -> f64), ("G", &b)];
    let odd = [("R", &off as &dyn Fn(usize, usize) -> f64), ("G", &wrong)];
    let nothing = [("R", &wrong as &dyn Fn(usize, usize) -> f64)];
    let of = |channels: &[Filled]| reflection_of(&table(channels));
    let (sound, odd, nothing) = (of(&sound), of(&odd), of(&nothing));
    [&sound, &odd, &nothing].into_iter().for_each(is_formed);
    says(&sound.verdict(None), "PASS", &["ggx-reflection A and B: shipped is off by at most "]);
    says(
        &odd.verdict(Some(1e-3)),
        "FAIL",
        &[
            "ggx-reflection E: shipped is off by at most 0.003 at texels (",
            "; the limit is 0.001\n",
            "Looked up with linear interpolation",
        ],
    );
    says(&nothing.verdict(None), "UNKNOWN", &["shipped fits no convention; the nearest leaves "]);
    let fields = serde_json::to_value(sound.verdict(None)).unwrap();
    assert!(
        fields["grade"] == "PASS" && fields["errors"].is_array() && fields["convention"].is_string(),
        "{fields}"
    );
}

/// E of texels that lie between those of a lattice of a fortieth of the size.
fn between(size: [usize; 2]) -> AuditedTable {
    let nodes = size.map(|n| n / 40);
    let at = |i: usize, n: usize| (i as f64 / (n - 1) as f64).clamp(0.02, 1.0);
    let texel = |i: usize| {
        let (mu, roughness) = (at(i % nodes[0], nodes[0]), at(i / nodes[0], nodes[1]));
        both(Smith::Correlated, roughness * roughness, mu).0
    };
    let lattice: Vec<f64> = (0..nodes[0] * nodes[1]).map(texel).collect();
    let value = |x: usize, y: usize| {
        let place = |i: usize, k: usize| {
            let x = (i as f64 + 0.5) / size[k] as f64 * (nodes[k] - 1) as f64;
            let below = (x as usize).min(nodes[k] - 2);
            (below, x - below as f64)
        };
        let ((i, u), (j, v)) = (place(x, 0), place(y, 1));
        let row = |j: usize| lattice[j * nodes[0] + i] * (1.0 - u) + lattice[j * nodes[0] + i + 1] * u;
        row(j) * (1.0 - v) + row(j + 1) * v
    };
    plane(size, &[("R", &value)])
}

/// Single texels of such a table are found, though no lattice has them.
#[test]
fn single_texels_of_a_table_that_is_too_large_to_be_held_are_named() {
    let size = [1024, 544];
    let mut table = between(size);
    let sound = reflection_of(&table);
    assert_eq!(sound.fit, Fit::Whole, "{}", said(&sound));
    assert!(!said(&sound).contains("again"), "{}", said(&sound));
    let values = Arc::make_mut(&mut table.channels[0].values);
    values[333 * size[0] + 702] -= 0.3;
    values[41 * size[0] + 333] = 0.0;
    // One that the lattice has.
    values[212 * size[0] + 308] -= 0.2;
    let found = reflection_of(&table);
    let all = " at [333, 41], [308, 212] and [702, 333], elsewhere";
    says(&found.verdict(None), "FAIL", &[all, "3 of 557056 texels"]);
}

/// A table of more than is held at once took minutes. It is ranked on a lattice, and all of it is looked
/// through for the largest error (`tests/budget.rs` counts the work on files that follow nothing).
#[test]
fn point_16_all_of_a_table_that_is_too_large_to_be_held_is_looked_through() {
    let size = [1024, 544];
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let value = |x: usize, y: usize| 1.0 - 0.4 * at(y, size[1]) * (1.0 - at(x, size[0]));
    let mut shipped = plane(size, &[("R", &value)]);
    // Beside every lattice of 256 places.
    Arc::make_mut(&mut shipped.channels[0].values)[333 * size[0] + 702] = 3.0;
    let axes = Some(vec![(Scale::Mu, false), (Scale::Roughness, false)]);
    let fixed = Fixed { axes, registrations: Some(vec![Registration::Centre]), ..Fixed::default() };
    let found = run(&shipped, "ggx-reflection", &fixed);
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert_eq!((errors.judged, errors.all, errors.unsampled), (size[0] * size[1], size[0] * size[1], 0));
    says(&found.verdict(None), "UNKNOWN", &["E: shipped fits no convention", "at texel [702, 333]"]);
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
