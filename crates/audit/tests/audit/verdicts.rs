//! What a first line says, and what about a table is to be mended: planted damage is named by its place and
//! its figure, and what formats, samples and optimisers leave is none.

use std::sync::LazyLock;

use lobefit::data::Smith;
use lobefit::report::Origin;
use lobefit::scene::Scene;
use lobefit_audit::audit::{Audit, AuditedTable, Defect, Fixed, Form, Kind, findings};
use lobefit_audit::foreign::{Hints, read_table};
use lobefit_audit::report::audit_page;
use lobefit_math::ops;
use lobefit_truth::integrate::reflection::average;

use crate::baked_support::bake_scene;
use crate::points::lobes::karis;
use crate::support::{both, eight, jitter, plane, reflection_of, run, says, shipped};

/// Texels along each axis.
const N: usize = 64;

fn at(i: usize) -> f64 {
    (i as f64 + 0.5) / N as f64
}

/// A and B of a column and a row, changed.
type Change<'a> = &'a dyn Fn(usize, usize, [f64; 2]) -> [f64; 2];

fn changed(texels: &[[f64; 2]], change: Change) -> AuditedTable {
    let all: Vec<[f64; 2]> = texels.iter().enumerate().map(|(i, t)| change(i % N, i / N, *t)).collect();
    let channel = |k: usize| all.iter().map(|t| t[k]).collect();
    shipped(&[N; 2], vec![("R", channel(0)), ("G", channel(1)), ("B", vec![0.0; N * N])])
}

/// The exact table, changed.
fn exact(change: Change) -> AuditedTable {
    static EXACT: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
        let texel = |i: usize| {
            let (e, b) = both(Smith::Correlated, at(i / N) * at(i / N), at(i % N));
            [e - b, b]
        };
        (0..N * N).map(texel).collect()
    });
    changed(&EXACT, change)
}

/// Karis' table of 1024 samples, changed.
fn of_karis(change: Change) -> AuditedTable {
    static KARIS: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
        let texel = |i: usize| karis(at(i % N), at(i / N), 0.5 * at(i / N) * at(i / N), 1024);
        (0..N * N).map(texel).collect()
    });
    changed(&KARIS, change)
}

/// The first line of a verdict.
fn line(found: &Audit, limit: Option<f64>) -> String {
    let text = found.verdict(limit).to_string();
    let line = text.lines().next().expect("a line").to_string();
    assert!(line.chars().count() <= 200, "{line}");
    line
}

fn holds(line: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(line.contains(part), "no `{part}` in {line}"));
}

#[test]
fn the_first_line_has_the_figure_that_decides() {
    let found = reflection_of(&of_karis(&|_, _, t| t));
    let plain = found.plain.as_ref().expect("another lobe").max;
    assert!(plain > 0.3 && found.worst() < 0.01, "{plain} {}", found.worst());
    // The limit is not kept read plainly; without one nothing is wrong, and the lobe is said.
    let read = format!("FAIL ggx-reflection A and B: shipped is off by at most {plain:.3} read plainly");
    holds(&line(&found, Some(0.01)), &[&read, "; the limit is 0.01"]);
    let figure = found.figure(Some(0.01)).expect("judged");
    assert_eq!((figure.value, figure.kind), (plain, Kind::Plain));
    let as_both = format!("as Schlick-Smith with k = alpha/2, and by {plain:.3} as height-correlated Smith");
    holds(&line(&found, None), &["PASS ", " in lookups ", &as_both]);
    let lookup = found.blend.as_ref().expect("A and B");
    assert!(lookup.max > 3.0 * lookup.inner, "{lookup:?}");
    holds(&line(&found, None), &[&format!("at most {:.4}", lookup.inner)]);
    // Beside it stand those of A and B over the same places.
    let [a, b] = [0, 1].map(|k| found.channels[k].lookup.as_ref().expect("a lookup").inner);
    holds(&found.verdict(None).to_string(), &[&format!("; A by {a:.5}, B by {b:.4}.")]);
    let meant = Fixed { form: Form::find("schlick"), ..Fixed::default() };
    let meant = run(&of_karis(&|_, _, t| t), "ggx-reflection", &meant);
    let figure = meant.figure(Some(0.01)).expect("judged");
    assert_eq!((meant.plain.is_none(), figure.value, figure.kind), (true, meant.worst(), Kind::Texel));
}

/// Damage that was "PASS", or had the first line of the sound table.
#[test]
fn a_block_is_named_with_its_place_and_its_error() {
    let block = |x: usize, y: usize, [a, b]: [f64; 2]| {
        let off = (10..30).contains(&x) && (20..30).contains(&y);
        [a + if off { 0.03 } else { 0.0 }, b]
    };
    let rows = |_: usize, y: usize, t: [f64; 2]| if y < 32 { t } else { t.map(|v| 0.97 * v) };
    let texel = |x: usize, y: usize, [a, b]: [f64; 2]| [a + if (x, y) == (12, 30) { 0.1 } else { 0.0 }, b];
    let two = |x: usize, y: usize, t| if x == 32 && (32..34).contains(&y) { [0.3; 2] } else { t };
    let three = |x: usize, y: usize, t| match (x, y) {
        (32, 16) | (16, 32) | (32, 32) => [0.4, 0.5],
        _ => t,
    };
    for (table, place, most) in [
        (exact(&block), "of A at x = 10 to 29, y = 20 to 29,", [0.0299, 0.0301]),
        (of_karis(&block), "of A at x = 10 to 29, y = 20 to 29,", [0.029, 0.036]),
        (exact(&rows), "of A at y = 32 to 63,", [0.0270, 0.0280]),
        (exact(&texel), "of A at x = 12, y = 30,", [0.0999, 0.1001]),
        // In a table of samples, whose errors at grazing view are larger in all than those of one texel.
        (of_karis(&texel), "of A at x = 12, y = 30,", [0.09, 0.11]),
        (of_karis(&two), "of A at x = 32, y = 32", [0.41, 0.44]),
        (of_karis(&three), "of A at [32, 16], [16, 32] and [32, 32],", [0.49, 0.52]),
    ] {
        let found = reflection_of(&table);
        holds(&line(&found, None), &["FAIL ggx-reflection A and B: shipped is off by at most ", place]);
        let part = found.channels[0].defects.iter().find_map(|d| match d {
            Defect::Part { most, .. } => Some(*most),
            _ => None,
        });
        let part = part.expect("a part");
        assert!((most[0]..most[1]).contains(&part), "{place}: {part}");
        let said = found.verdict(None).to_string();
        assert!(!said.contains("sampling noise") && !said.contains("mostly a bias"), "{said}");
    }
    // Both channels have the same texels, which are to be made again once.
    let said = reflection_of(&of_karis(&three)).verdict(None).remedy.join("; ");
    assert_eq!(said.matches("make the texels at").count(), 1, "{said}");
}

/// A line that holds what its neighbour holds, whose errors fade and change their sign along it.
#[test]
fn a_line_of_its_neighbour_is_named() {
    let texels = exact(&|_, _, t| t);
    let texel = |x: usize, y: usize| [0, 1].map(|k| texels.channels[k].values[N * y + x]);
    for (row, from) in [(40, 38), (N - 1, N - 2)] {
        let found = reflection_of(&exact(&|x, y, t| if y == row { texel(x, from) } else { t }));
        holds(&line(&found, None), &["FAIL ", &format!("y = {row}, elsewhere by RMS ")]);
    }
}

#[test]
fn a_corner_that_was_never_filled_is_named_in_a_table_of_samples() {
    let corner = |x: usize, y: usize, t| if (x, y) == (0, 0) { [0.0; 2] } else { t };
    let found = reflection_of(&of_karis(&corner));
    holds(&line(&found, None), &["FAIL ", "of B at x = 0, y = 0, elsewhere by RMS "]);
}

#[test]
fn a_gain_of_energy_is_a_failure() {
    let found = reflection_of(&exact(&|_, _, t| t.map(|v| 1.02 * v)));
    holds(&line(&found, None), &["FAIL ", "shipped gains energy: 1.02 of the light comes back at texel ["]);
    // The remedy has a scene, whose table passes.
    let remedy = found.verdict(None).remedy.join("; ");
    let (_, scene) = remedy.split_once("lobefit bake of the scene ").expect("a scene");
    let scene = Scene::from_json(scene.as_bytes(), "remedy").expect("a scene");
    let files = bake_scene(&scene).expect("a bake").files;
    let (_, bytes) = files.iter().find(|(path, _)| path.ends_with(".exr")).expect("a table");
    let table = read_table(bytes, "own.exr", &Hints::default()).expect("a table").remove(0);
    assert_eq!(table.size, [N; 2]);
    says(&reflection_of(&AuditedTable::from(&table)).verdict(None), "PASS", &["ggx-reflection A and B"]);
}

/// A normalisation below 1 takes light: of 1/E, and of 1/E_avg, it was said that more comes back.
#[test]
fn a_normalisation_below_1_gains_no_energy() {
    let inverse = |i: usize| 0.99 / both(Smith::Correlated, at(i / N) * at(i / N), at(i % N)).0;
    let mean = |i: usize| 0.99 / average(Smith::Correlated, at(i) * at(i), 1e-9).expect("an average").e_avg;
    let table = shipped(&[N; 2], vec![("R", (0..N * N).map(inverse).collect())]);
    let line_of = |table, quantity| line(&run(table, quantity, &Fixed::default()), None);
    holds(&line_of(&table, "ggx-reflection"), &["PASS ggx-reflection 1/E"]);
    let table = shipped(&[N], vec![("R", (0..N).map(mean).collect())]);
    holds(&line_of(&table, "ggx-average"), &["PASS ggx-average 1/E_avg"]);
}

#[test]
fn what_has_a_remedy_does_not_pass_until_it_is_meant() {
    let srgb = |v: f64| if v <= 0.0031308 { 12.92 * v } else { 1.055 * ops::pow(v, 1.0 / 2.4) - 0.055 };
    let turned = exact(&|_, _, t| t);
    let turn = |k: usize| (0..N * N).map(|i| turned.channels[k].values[i % N * N + i / N]).collect();
    let turned = shipped(&[N; 2], vec![("R", turn(0)), ("G", turn(1))]);
    let encoded = exact(&|_, _, t| t.map(|v| eight(srgb(v))));
    let split = |x: usize, y: usize| {
        let (e, b) = both(Smith::Correlated, at(y) * at(y), ops::cos(0.5 * std::f64::consts::PI * at(x)));
        [e - b, b]
    };
    let theta = plane([N; 2], &[("R", &|x, y| split(x, y)[0]), ("G", &|x, y| split(x, y)[1])]);
    for (table, option) in
        [(turned, "--axes roughness,mu"), (encoded, "--encoding srgb"), (theta, "--axes theta,roughness")]
    {
        let found = reflection_of(&table);
        let plain = found.plain.as_ref().expect("no reader assumes it");
        assert_eq!(plain.options, option);
        let verdict = found.verdict(None);
        says(&verdict, "FAIL", &["read plainly"]);
        // The first line says how it is misread, and the remedy what to do: no third point.
        let text = verdict.to_string();
        let times = |words: &str| text.matches(words).count();
        assert_eq!([times("read plainly"), times(&format!("say so (`{option}`)"))], [1, 1], "{text}");
        assert_eq!([times("assume"), times("Without options"), times("since")], [0; 3], "{text}");
        let limited = found.verdict(Some(0.1)).to_string();
        assert!(limited.contains(option) && limited.matches("read plainly").count() == 1, "{limited}");
        assert!(
            !verdict.remedy.is_empty() && found.figure(None).expect("judged").value == plain.max,
            "{verdict}"
        );
        let best = found.best().axes.iter().map(|a| (a.scale, a.reversed)).collect();
        let meant = Fixed { axes: Some(best), encoding: found.encoding, ..Fixed::default() };
        let verdict = run(&table, "ggx-reflection", &meant).verdict(None);
        says(&verdict, "PASS", &["ggx-reflection A and B"]);
        assert!(verdict.remedy.is_empty(), "{verdict}");
    }
}

/// Good tables: exact, in eight bits, of noise that samples leave, of Karis' samples in eight bits.
#[test]
fn what_formats_and_samples_leave_passes_under_its_own_name() {
    let rounded = |_: usize, _: usize, t: [f64; 2]| t.map(eight);
    let noisy = |x: usize, y: usize, [a, b]: [f64; 2]| [a + 5e-3 * jitter(x, y), b + 5e-3 * jitter(y + N, x)];
    for (table, told) in [
        (exact(&|_, _, t| t), "Channel B(lue) is constant (0)"),
        (exact(&rounded), "what rounding to 8-bit unorm leaves"),
        (exact(&noisy), "as sampling noise does"),
        (of_karis(&rounded), "as rounding to 8-bit unorm does"),
    ] {
        let found = reflection_of(&table);
        says(&found.verdict(None), "PASS", &[told, "R = A (scale of f0), G = B (bias of f0)"]);
    }
}

/// A table of this tool without its sidecar: its texels are those that lookups are best with.
#[test]
fn a_table_of_this_tool_without_its_sidecar_passes() {
    let scene = r#"{"schema_version":1,"formats":["dds"],"reports":false,"materials":[{"name":"metal","kind":"metal","f0":1,
"roughness":[0,1],"wants":{"tables":[{"size":[64,64],"layout":"plain","serves":"split-sum"}]}}]}"#;
    let scene = Scene::from_json(scene.as_bytes(), "test.json").expect("a scene");
    let files = bake_scene(&scene).expect("a bake").files;
    let (_, bytes) = files.iter().find(|(path, _)| path.ends_with(".dds")).expect("a table");
    let table = read_table(bytes, "plain.dds", &Hints::default()).expect("a table").remove(0);
    let found = reflection_of(&AuditedTable::from(&table));
    let verdict = found.verdict(None);
    says(&verdict, "PASS", &["ggx-reflection A and B: plain.dds"]);
    assert!(verdict.remedy.is_empty() && found.worst() > 0.03, "{verdict}");
}

/// Below the first centre E falls on: a first column that is too low brings lookups nearer to that, and one
/// that is too high takes them away from it.
#[test]
fn texels_that_lookups_are_the_better_for_are_no_defect() {
    let moved = |by: f64| {
        let first = move |x: usize, y: usize, [a, b]: [f64; 2]| {
            [a + if x == 0 && (2..40).contains(&y) { by } else { 0.0 }, b]
        };
        reflection_of(&exact(&first))
    };
    let lower = moved(-0.015);
    says(&lower.verdict(None), "PASS", &["38 texels are off for the sake of lookups, which at even places"]);
    let lookups = lower.channels[0].defects.iter().find_map(|d| match d {
        Defect::Optimised { lookups, .. } => Some(*lookups),
        _ => None,
    });
    let [own, mended] = lookups.expect("texels that are off");
    assert!(own < mended && mended < 1.1 * own, "{own} {mended}");
    says(&moved(0.015).verdict(None), "FAIL", &["of A at x = 0, y = 2 to 39,"]);
}

/// The plain reading may have no truth at any texel: the report is written all the same.
#[test]
fn a_figure_that_is_infinite_is_left_out_of_the_json() {
    let origin = Origin {
        scene: String::new(),
        recipe: String::new(),
        tool: String::new(),
        command: String::new(),
        pages: Vec::new(),
    };
    let mut found = findings(&reflection_of(&exact(&|_, _, t| t)), origin, "lut.exr", "EXR", None);
    found.figure.as_mut().expect("a figure").value = f64::INFINITY;
    let (_, json) = audit_page(&found).expect("a report");
    let json: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    assert!(json["figure"].is_string() && json.get("max_error").is_none(), "{json}");
}
