//! Tables that an audit may misread: clamped, truncated, encoded, with a channel of nothing known.

use crate::channels::{Filled, run, square};
use crate::common;

use common::{lobefit, stderr};
use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditedTable, Channel, Column, Defect, ENCODINGS, Fit, Fixed, Grade, Input, Other, Registration,
    Scale, Span, audit, declared, sampled,
};
use lobefit_audit::foreign::{Hints, Step, Surroundings, read_functions, read_table};
use lobefit_math::ops;
use lobefit_truth::integrate::reflection::{Effort, split};
use lobefit_truth::quantity::{self, Quantity, SCHLICK_SMITH};
use rayon::prelude::*;

const N: usize = 32;

fn centre(i: usize) -> f64 {
    (i as f64 + 0.5) / N as f64
}

fn end(i: usize) -> f64 {
    i as f64 / (N - 1) as f64
}

/// E and B of roughness and mu.
fn ggx(roughness: f64, mu: f64) -> (f64, f64) {
    split(Smith::Correlated, roughness * roughness, mu.max(1e-4), &Effort::ladder()[1])
}

/// A fixed scramble in [-1, 1] of a texel.
fn jitter(i: usize, j: usize, seed: u64) -> f64 {
    let h = (i as u64 * 0x9e37_79b9 + j as u64 * 0x85eb_ca6b + seed).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let h = (h ^ h >> 31).wrapping_mul(0x94d0_49bb_1331_11eb);
    (h >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn table(channels: &[Filled]) -> AuditedTable {
    square(N, channels)
}

fn registrations(found: &Audit) -> Vec<Registration> {
    found.best().axes.iter().map(|a| a.registration).collect()
}

/// A table of 64 x 64 over mu and roughness, at end points.
fn of_end_points(value: impl Fn(f64, [usize; 2]) -> f64) -> AuditedTable {
    const SIDE: usize = 64;
    let end = |i: usize| (i as f64 / (SIDE - 1) as f64).max(1e-3);
    let texel = |i: usize| value(ggx(end(i / SIDE), end(i % SIDE)).0, [i % SIDE, i / SIDE]);
    let channels = vec![Channel { name: "R".into(), values: (0..SIDE * SIDE).map(texel).collect() }];
    AuditedTable { size: vec![SIDE; 2], channels, ..table(&[]) }
}

/// Where noise is as large as what half a texel makes, centres and end points are open: the plainer is
/// stated, of all axes, and no remedy of a registration.
#[test]
fn no_remedy_is_stated_of_a_registration_that_is_open() {
    let found =
        run(&of_end_points(|e, [x, y]| e + 0.012 * jitter(x, y, 1)), "ggx-reflection", &Fixed::default());
    assert_eq!(registrations(&found), [Registration::Centre; 2]);
    let remedy = found.verdict(None).remedy.join(" ");
    assert!(!remedy.contains("compute texel") && !remedy.contains("sample at"), "{remedy}");
}

/// Mantissas of seven bits that were cut off, of end points, are neither a shift nor a mixture of
/// end points and centres.
#[test]
fn a_truncated_table_of_end_points_is_one() {
    let cut = |x: f64| {
        let step = ops::pow(2.0, ops::log2(x).floor() - 6.0);
        (x / step).floor() * step
    };
    let found = run(&of_end_points(|e, _| cut(e)), "ggx-reflection", &Fixed::default());
    assert_eq!(registrations(&found), [Registration::Endpoint; 2]);
    assert!(found.plain.is_none(), "{:?}", found.plain);
}

/// Conductors clamped at two widths, each stated, are right to rounding; unstated, they are not
/// said to be of other code beyond the clamped rows.
#[test]
fn clamps_are_stated() {
    for clamp in [0.02, 0.035] {
        let e = |x: usize, y: usize| ggx((centre(y) * centre(y)).max(clamp).sqrt(), centre(x)).0;
        let clamped = table(&[("R", &e)]);
        let stated = Fixed { floors: vec![(Input::Alpha, clamp)], ..Fixed::default() };
        let found = run(&clamped, "ggx-reflection", &stated);
        assert!(found.passes(Some(1e-6)), "{clamp}: {}", found.worst());
        assert_eq!(found.best().axes[1].floor, clamp);
    }
}

/// Of three channels the third follows nothing. The others are judged without it, a limit needs
/// `-` for it.
#[test]
fn a_channel_of_nothing_known_is_left_out_by_a_dash() {
    let (a, b) =
        (|x: usize, y: usize| ggx(centre(y), centre(x)).0, |x: usize, y: usize| ggx(centre(y), centre(x)).1);
    let odd = |x: usize, y: usize| 0.5 + 0.5 * ops::sin(9.0 * centre(x)) * ops::cos(7.0 * centre(y));
    let shipped = table(&[("R", &a), ("G", &b), ("B", &odd)]);
    let found = run(&shipped, "ggx-reflection", &Fixed::default());
    assert_eq!(found.best().columns, [Some(Column::E), Some(Column::B), None]);
    assert!(found.channels[2].other == Some(Other::Unknown) && !found.passes(Some(0.01)));
    is_formed(&found);
    let dashed = Fixed { meanings: Some(vec![Some(Column::E), Some(Column::B), None]), ..Fixed::default() };
    assert!(run(&shipped, "ggx-reflection", &dashed).passes(Some(1e-6)));
    // Under another shadowing, too, that is found without the channel.
    let smith = Smith::Separable.into();
    let schlick: Vec<Vec<f64>> = (0..N * N)
        .into_par_iter()
        .map(|i| {
            let (rough, mu) = (centre(i / N), centre(i % N));
            SCHLICK_SMITH[0].at(&smith, &[rough * rough, mu], 1e-7).unwrap()
        })
        .collect();
    let [a, b] = [0, 2].map(|k| {
        let schlick = &schlick;
        move |x: usize, y: usize| schlick[y * N + x][k]
    });
    let shipped = table(&[("R", &a), ("G", &b), ("B", &odd)]);
    let found = run(&shipped, "ggx-reflection", &dashed);
    assert!(found.passes(None) && found.verdict(None).to_string().contains("Schlick-Smith with k = alpha/2"));
}

/// An exact table of E in 8 bits of sRGB is what rounding leaves, at each value
/// the step there.
#[test]
fn a_step_of_srgb_is_that_at_the_value() {
    let encoded = |x: f64| {
        let curve = if x <= 0.04045 / 12.92 { x * 12.92 } else { 1.055 * ops::pow(x, 1.0 / 2.4) - 0.055 };
        (curve * 255.0).round() / 255.0
    };
    let mut shipped = table(&[("R", &|x, y| encoded(ggx(centre(y), centre(x)).0))]);
    shipped.step = Step::Unorm8;
    let encoding = ENCODINGS.iter().find(|encoding| encoding.word == "srgb");
    let found = run(&shipped, "ggx-reflection", &Fixed { encoding, ..Fixed::default() });
    let defects = &found.channels[0].defects;
    assert!(defects.iter().any(|d| matches!(d, Defect::Steps { step: Step::Srgb(255), .. })), "{defects:?}");
    assert!(found.fit == Fit::Whole && found.verdict(None).grade == Grade::Pass);
    // The same values of a Radiance picture are not encoded.
    shipped.step = Step::Rgbe;
    let refused = audit(
        &shipped,
        quantity::find("ggx-reflection").unwrap(),
        &Fixed { encoding, ..Fixed::default() },
        &|_| (),
    );
    assert!(refused.unwrap_err().to_string().contains("--encoding"));
}

/// The first line has the grade, the quantity, the error and the limit; at most five points
/// follow, none of them a page.
#[test]
fn a_verdict_is_a_line_and_five_points() {
    let (e, b) =
        (|x: usize, y: usize| ggx(end(y), end(x)).0, |x: usize, y: usize| ggx(centre(y), centre(x)).1);
    let split = |x: usize, y: usize| ggx(centre(y), centre(x)).0 - b(x, y);
    let wrong = |x: usize, y: usize| 0.5 + 0.4 * ops::sin(20.0 * centre(x) * centre(y));
    for channels in
        [vec![("R", &e as &dyn Fn(usize, usize) -> f64)], vec![("R", &split), ("G", &b)], vec![("R", &wrong)]]
    {
        is_formed(&run(&table(&channels), "ggx-reflection", &Fixed::default()));
    }
}

/// Whether a verdict is a line and at most five points.
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

/// A published fit behind a clamp to [0, 1] is that fit.
#[test]
fn a_saturated_published_fit_is_named() {
    let source = "
float3 karis(float3 f0, float roughness, float nov) {
  const float4 c0 = float4(-1, -0.0275, -0.572, 0.022);
  const float4 c1 = float4(1, 0.0425, 1.04, -0.04);
  float4 r = roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * nov)) * r.x + r.y;
  float2 ab = float2(-1.04, 1.04) * a004 + r.zw;
  return saturate((f0 * ab.x + ab.y) * 1.0);
}";
    let function = read_functions(source.as_bytes(), "f.hlsl", Some("karis"), &Surroundings::default());
    let quantity = quantity::find("ggx-reflection").unwrap();
    let shipped = sampled(&function.unwrap()[0], quantity, &[], &[]).unwrap();
    let found = run(&shipped, "ggx-reflection", &Fixed::default());
    assert_eq!(found.published.map(|p| p.name), Some("ggx_blend_karis"));
}

/// One texel of a table of this tool's own that is off shows whole, though no place between the texels
/// shows it.
#[test]
fn a_single_wrong_texel_of_a_table_of_our_own_is_found() {
    let bytes = include_bytes!("../../../../tables/ggx-dfg-correlated-32x32.exr");
    let read = read_table(bytes, "own.exr", &Hints::default()).unwrap().remove(0);
    let mut table = AuditedTable::from(&read);
    let quantity = quantity::find("ggx-reflection").unwrap();
    let sound = declared(&table, quantity, None, &read.note).unwrap();
    assert!(sound.passes(Some(0.002)) && sound.verdict(None).to_string().contains("sampled"));
    table.channels[0].values[17 * 32 + 9] += 0.003;
    let found = declared(&table, quantity, None, &read.note).unwrap();
    eprintln!("{}", found.verdict(Some(0.002)));
    assert!(found.worst() > 0.0023 && !found.passes(Some(0.002)), "{}", found.worst());
}

/// What a shader includes from beside it needs no option; a chunk in a script lists its functions; and an
/// index without a bound has a page.
#[test]
fn files_are_read_as_they_lie() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("common.glsl", "float sq(float x) { return x * x; }\n");
    write(
        "fit.glsl",
        "#include \"common.glsl\"\nfloat fit(float roughness, float mu) { return 1.0 - sq(roughness) * mu; }\n",
    );
    let run = |arguments: &[&str]| {
        let output = lobefit(folder.path(), arguments, b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
    };
    let (code, out, err) = run(&["audit", "fit.glsl", "--as", "ggx-reflection", "--function", "fit"]);
    assert!(code == Some(0) && out.contains("fit.glsl"), "{out}{err}");
    let chunk = "float one(float roughness, float mu) { return 1.0 - roughness * mu; }\nfloat two(float roughness, float mu) { return mu; }";
    write("chunk.glsl.js", &format!("export default /* glsl */ `\n{chunk}\n`;\n"));
    let (code, _, err) = run(&["audit", "chunk.glsl.js", "--as", "ggx-reflection"]);
    assert!(code == Some(2) && err.contains("one(") && err.contains("two("), "{err}");
    let values: Vec<String> =
        (0..256).map(|i| format!("{:.6}f", 1.0 - 0.3 * f64::from(i / 16) / 15.0)).collect();
    write("t.h", &format!("static const float t[256] = {{ {} }};\n", values.join(", ")));
    let all = ["audit", "t.h", "--as", "ggx-glass", "--size", "16x16", "--axes", "1/ior,roughness", "--json"];
    let (_, out, err) = run(&all);
    assert!(out.starts_with('{'), "{err}");
    // A range of an input that runs evenly may be stated.
    let (code, _, err) = run(&["audit", "no.h", "--as", "ggx-glass", "--axes", "ior=1.1..2.2,roughness"]);
    assert!(code == Some(2) && err.contains("no.h") && !err.contains("--axes"), "{err}");
    let span = Span { input: Input::Ior, ends: [1.1, 2.2], name: "ior=1.1..2.2".into() };
    let scale = Scale::Span(Box::leak(Box::new(span)));
    assert_eq!(
        (scale.input_at(0.0), scale.input_at(0.5), scale.input_at(1.0)),
        (1.1, 1.6500000000000001, 2.2)
    );
}
