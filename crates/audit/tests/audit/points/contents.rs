//! Files of several quantities, of sums, averages and encodings: what each channel holds.

use std::process::Output;

use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditedTable, Column, Defect, Encoding, Fit, Fixed, Form, Other, Registration, Scale,
};
use lobefit_audit::foreign::Step;
use lobefit_math::ops;
use lobefit_truth::quantity::{self, SCHLICK_SMITH, Variant, sheen};

use super::{N, a, at, b, e, table};
use crate::common::{lobefit, stderr};
use crate::support::{
    Filled, axes, columns, eight, jitter, reflection_of, refused, rising, run, says, shipped,
};

/// The albedo of Charlie sheen at a texel.
fn charlie(x: usize, y: usize) -> f64 {
    sheen::albedo(at(y) * at(y), at(x))
}

/// Options that say what runs along the axes, at centres: what is looked for is the meaning of channels.
fn of_centres() -> Fixed {
    let axes = Some(vec![(Scale::Mu, false), (Scale::Roughness, false)]);
    Fixed { axes, registrations: Some(vec![Registration::Centre]), ..Fixed::default() }
}

fn meaning(columns: &[Option<Column>]) -> Option<Vec<Option<Column>>> {
    Some(columns.to_vec())
}

/// A channel of Charlie condemned the A and B beside it.
#[test]
fn point_03_a_channel_of_another_quantity_is_judged_as_that() {
    let found = run(&table(&[("R", &a), ("G", &b), ("B", &charlie)]), "ggx-reflection", &of_centres());
    assert_eq!((found.fit, columns(&found)), (Fit::Whole, vec![Some(Column::A), Some(Column::B), None]));
    let Some(Other::Quantity(sheen)) = &found.channels[2].other else {
        panic!("{:?}", found.channels[2].other)
    };
    assert_eq!((sheen.quantity, columns(sheen)), ("sheen-charlie", vec![Some(Column::E)]));
    assert!(found.worst() < 1e-6 && sheen.worst() < 1e-5, "{} {}", found.worst(), sheen.worst());
    let words = ["ggx-reflection A and B", "Channel B(lue) is of another quantity"];
    says(&found.verdict(Some(1e-3)), "PASS", &words);
}

/// The same in a picture, which holds no value above 1.
#[test]
fn point_03_a_channel_of_another_quantity_may_be_clamped() {
    let channels: [Filled; 3] =
        [("R", &|x, y| eight(a(x, y))), ("G", &|x, y| eight(b(x, y))), ("B", &|x, y| eight(charlie(x, y)))];
    let picture = AuditedTable { step: Step::Unorm(8), ..table(&channels) };
    let found = run(&picture, "ggx-reflection", &of_centres());
    let sheen =
        "Channel B(lue) is of another quantity: sheen-charlie E: it stands at 1 where the truth goes on";
    says(&found.verdict(None), "PASS", &["A and B", sheen]);
}

/// Of a channel of nothing known, a limit asks for a word: `-` leaves it out.
#[test]
fn point_03_a_channel_of_nothing_known_is_left_out_by_a_dash() {
    let shipped = table(&[("R", &e), ("G", &|x, y| 0.5 + 0.5 * jitter(x, y))]);
    let found = run(&shipped, "ggx-reflection", &of_centres());
    assert_eq!((found.fit, columns(&found)), (Fit::Whole, vec![Some(Column::E), None]));
    assert_eq!(found.channels[1].other, Some(Other::Unknown));
    says(&found.verdict(Some(1e-3)), "UNKNOWN", &["ggx-reflection E"]);
    assert!(found.unjudged().is_some_and(|why| why.contains("--meaning E,-")), "{:?}", found.unjudged());
    let dashed = Fixed { meanings: meaning(&[Some(Column::E), None]), ..Fixed::default() };
    says(&run(&shipped, "ggx-reflection", &dashed).verdict(Some(1e-6)), "PASS", &["ggx-reflection E"]);
    let none = Fixed { meanings: meaning(&[None; 2]), ..Fixed::default() };
    assert!(refused(&shipped, "ggx-reflection", &none).contains("every channel is left out"));
    // Under another shadowing, too, that is found without the channel.
    let schlick = |k: usize| {
        let at = |x: usize, y: usize| [at(y) * at(y), at(x)];
        move |x: usize, y: usize| SCHLICK_SMITH[0].at(&Smith::Separable.into(), &at(x, y), 1e-7).unwrap()[k]
    };
    let (e, b) = (schlick(0), schlick(2));
    let shipped = table(&[("R", &e), ("G", &b), ("B", &|x, y| 0.5 + 0.5 * jitter(x, y))]);
    let dashed = Fixed { meanings: meaning(&[Some(Column::E), Some(Column::B), None]), ..Fixed::default() };
    let found = run(&shipped, "ggx-reflection", &dashed);
    assert_eq!(found.best().lobe.form.word, "schlick");
    says(&found.verdict(None), "PASS", &["E and B", "Schlick-Smith with k = alpha/2"]);
}

/// `:E` of a table of A and B was exit 1.
#[test]
fn point_05_e_of_a_table_of_a_and_b_is_their_sum() {
    let fixed = Fixed { column: Some(Column::E), ..Fixed::default() };
    let judged = |found: &Audit| -> Vec<String> {
        found.channels.iter().filter(|c| c.column.is_some()).map(|c| c.name.clone()).collect()
    };
    type F<'a> = &'a dyn Fn(usize, usize) -> f64;
    // A channel of E itself goes before sums.
    for (channels, own) in [([("R", &a as F), ("G", &b)], "R + G"), ([("R", &b), ("G", &e)], "G")] {
        let found = run(&table(&channels), "ggx-reflection", &fixed);
        assert_eq!(judged(&found), [own]);
        says(&found.verdict(Some(1e-6)), "PASS", &["ggx-reflection E:"]);
    }
}

fn encoding(word: &str) -> Fixed {
    Fixed { encoding: Encoding::find(word), ..Fixed::default() }
}

/// Floats of 11, 11 and 10 bits: what the last of them holds is coarser.
#[test]
fn small_floats_leave_what_their_bits_cannot_hold() {
    let held = |bits: u32, x: f64| {
        let unit = 1_u32 << (10 - bits);
        let half = u32::from(half::f16::from_f64(x).to_bits());
        half::f16::from_bits(((half + unit / 2) / unit * unit) as u16).to_f64()
    };
    let channels: [Filled; 3] =
        [("R", &|x, y| held(6, a(x, y))), ("G", &|x, y| held(6, b(x, y))), ("B", &|x, y| held(5, e(x, y)))];
    let found = reflection_of(&AuditedTable { step: Step::Small(6), ..table(&channels) });
    let left = |bits: u32| format!("what rounding to floats of {bits} bits of mantissa leaves");
    says(&found.verdict(None), "PASS", &["A, B and E", &left(6), &left(5)]);
}

/// RGBE as four channels of eight bits.
#[test]
fn point_05_rgbe_in_a_picture_of_four_channels_is_found() {
    let exponent = |x: usize, y: usize| ops::log2(a(x, y).max(b(x, y))).floor() + 1.0;
    let scaled = |v: f64, e: f64| eight(v / ops::pow(2.0, e) * 256.0 / 255.0);
    let mut rgbe = table(&[
        ("R", &|x, y| scaled(a(x, y), exponent(x, y))),
        ("G", &|x, y| scaled(b(x, y), exponent(x, y))),
        ("B", &|_, _| 0.0),
        ("A", &|x, y| (exponent(x, y) + 128.0) / 255.0),
    ]);
    rgbe.step = Step::Unorm(8);
    let found = reflection_of(&rgbe);
    assert!(found.fit == Fit::Whole && found.worst() < 0.005, "{}", found.worst());
    says(&found.verdict(Some(0.01)), "FAIL", &["decoded from RGBE", "R = A"]);
    // Said to be encoded so, it is what it is meant to be, and what cannot be encoded so is refused.
    let meanings = meaning(&[Some(Column::A), Some(Column::B)]);
    let meant = run(&rgbe, "ggx-reflection", &Fixed { meanings, ..encoding("rgbe") });
    says(&meant.verdict(Some(0.01)), "PASS", &["ggx-reflection A and B"]);
    assert!(refused(&table(&[("R", &a)]), "ggx-reflection", &encoding("rgbe")).contains("--encoding"));
}

/// RGBD beside a channel of Charlie: colours are (value alpha)^(1/2.2), alpha is the largest that keeps them
/// below 1.
#[test]
fn point_05_rgbd_with_a_channel_of_another_quantity_is_found() {
    let alpha = |x: usize, y: usize| (1.0 / charlie(x, y).max(1.0) * 255.0).floor() / 255.0;
    let stored = |v: f64, alpha: f64| eight(ops::pow(v * alpha, 1.0 / 2.2));
    let mut rgbd = table(&[
        ("R", &|x, y| stored(b(x, y), alpha(x, y))),
        ("G", &|x, y| stored(e(x, y), alpha(x, y))),
        ("B", &|x, y| stored(charlie(x, y), alpha(x, y))),
        ("A", &alpha),
    ]);
    rgbd.step = Step::Unorm(8);
    let found = run(&rgbd, "ggx-reflection", &of_centres());
    assert!(found.fit == Fit::Whole && found.worst() < 0.01, "{}", found.worst());
    says(&found.verdict(None), "FAIL", &["decoded from RGBD of gamma 2.2", "R = B (", "G = E ("]);
}

/// Eight bits of sRGB in one channel and in two, where each value has its own step.
#[test]
fn point_05_srgb_in_a_picture_of_several_channels_is_found() {
    let srgb = |v: f64| if v <= 0.0031308 { 12.92 * v } else { 1.055 * ops::pow(v, 1.0 / 2.4) - 0.055 };
    let stored = |v: f64| eight(srgb(v));
    let of = |channels: &[Filled]| AuditedTable { step: Step::Unorm(8), ..table(channels) };
    let found = reflection_of(&of(&[("R", &|x, y| stored(a(x, y))), ("G", &|x, y| stored(b(x, y)))]));
    let plain = found.plain.as_ref().expect("nobody assumes it");
    assert!(plain.options == "--encoding srgb" && plain.max > 0.1, "{plain:?}");
    assert!(found.worst() < 0.005, "{}", found.worst());
    says(&found.verdict(Some(0.05)), "FAIL", &["decoded from sRGB", "R = A"]);
    let one = of(&[("R", &|x, y| stored(e(x, y)))]);
    let found = run(&one, "ggx-reflection", &encoding("srgb"));
    let defects = &found.channels[0].defects;
    assert!(defects.iter().any(|d| matches!(d, Defect::Steps { step: Step::Srgb(255), .. })), "{defects:?}");
    says(&found.verdict(Some(0.005)), "PASS", &["ggx-reflection E"]);
    // Channels called A and B are those, and A no plane of alpha.
    let named = of(&[("A", &|x, y| stored(a(x, y))), ("B", &|x, y| stored(b(x, y)))]);
    let found = run(&named, "ggx-reflection", &encoding("srgb"));
    assert_eq!(columns(&found), [Some(Column::A), Some(Column::B)]);
    says(&found.verdict(Some(0.005)), "PASS", &["ggx-reflection A and B"]);
    let noise = |x: usize, y: usize| ((7 * x + 13 * y * y) as f64 * 0.618).fract();
    let spoilt = of(&[("A", &noise), ("B", &|x, y| stored(b(x, y)))]);
    says(&run(&spoilt, "ggx-reflection", &encoding("srgb")).verdict(Some(0.005)), "UNKNOWN", &["A"]);
    // The same values of a Radiance picture are not encoded.
    let picture = AuditedTable { step: Step::Rgbe, ..one };
    assert!(refused(&picture, "ggx-reflection", &encoding("srgb")).contains("--encoding"));
}

/// A power in place of the curve of sRGB, from which it is nowhere farther than 0.01.
#[test]
fn a_gamma_is_not_taken_for_srgb() {
    for (gamma, word) in [(2.2, "2.2"), (2.0, "2")] {
        let stored = |v: f64| eight(ops::pow(v, 1.0 / gamma));
        let picture = table(&[("R", &|x, y| stored(a(x, y))), ("G", &|x, y| stored(b(x, y)))]);
        let found = reflection_of(&AuditedTable { step: Step::Unorm(8), ..picture });
        let said = [format!("values encoded as gamma {word}"), format!("`--encoding gamma-{word}`")];
        let said = [said[0].as_str(), said[1].as_str()];
        let left = format!("what rounding to 8-bit gamma {word} leaves");
        says(&found.verdict(None), "FAIL", &[said[0], said[1], &left]);
        says(&found.verdict(Some(0.05)), "FAIL", &said);
    }
    // The root of E alone was taken for sRGB shifted by a texel.
    let found = reflection_of(&table(&[("0", &|x, y| e(x, y).sqrt())]));
    says(&found.verdict(None), "FAIL", &["values encoded as gamma 2", "at texel centres", "E is exact"]);
}

/// A constant factor, as of a division by pi that was left to the shader, is named.
#[test]
fn a_constant_factor_is_found() {
    use std::f64::consts::PI;
    for (factor, word, step) in [
        (1.0 / PI, "times=1/pi", "divide its values by 1/pi"),
        (PI, "times=pi", "divide its values by pi"),
        (0.5, "times=1/2", "divide its values by 1/2"),
        (0.25, "times=1/4", "divide its values by 1/4"),
        (2.0, "times=2", "divide its values by 2"),
        (0.9, "times=0.9", "divide its values by 0.9"),
    ] {
        let scaled = table(&[("R", &|x, y| factor * a(x, y)), ("G", &|x, y| factor * b(x, y))]);
        let found = reflection_of(&scaled);
        says(&found.verdict(None), "FAIL", &[step, &format!("`--encoding {word}`"), "R = A (", "G = B ("]);
        // What a reader of the stored values is off by.
        let largest = (0..N * N).map(|i| a(i % N, i / N).max(b(i % N, i / N))).fold(0.0, f64::max);
        let plain = found.plain.as_ref().unwrap();
        assert!((plain.max - (factor - 1.0).abs() * largest).abs() < 2e-3 * factor, "{plain:?}");
        says(&run(&scaled, "ggx-reflection", &encoding(word)).verdict(None), "PASS", &[]);
    }
    // Half a loss has no texel that is 1 without the factor.
    let found = reflection_of(&table(&[("R", &|x, y| 0.5 * (1.0 - e(x, y)))]));
    says(&found.verdict(None), "FAIL", &["ggx-reflection 1-E", "`--encoding times=1/2`"]);
    // Steps are of what is stored.
    let stored = table(&[("R", &|x, y| eight(a(x, y) / PI)), ("G", &|x, y| eight(b(x, y) / PI))]);
    let stored = AuditedTable { step: Step::Unorm(8), ..stored };
    let rounded = "That is what rounding to 8-bit unorm leaves";
    says(&run(&stored, "ggx-reflection", &encoding("times=1/pi")).verdict(None), "PASS", &[rounded]);
}

/// Averages, which had no convention: of sheen over roughness, by midpoints over the root of the cosine.
#[test]
fn point_05_an_average_of_sheen_is_one() {
    let average = |alpha: f64| -> f64 {
        let one = |i: usize| {
            let root = (i as f64 + 0.5) / 1000.0;
            4.0 * root * root * root * sheen::albedo(alpha, root * root) / 1000.0
        };
        (0..1000).map(one).sum()
    };
    let values = (0..N).map(|i| average(at(i) * at(i))).collect();
    let given = Fixed { form: Form::find("neubelt"), ..Fixed::default() };
    let found = run(&shipped(&[N], vec![("0", values)]), "sheen-charlie", &given);
    assert_eq!((found.fit, columns(&found)), (Fit::Whole, vec![Some(Column::Average)]));
    assert_eq!(axes(&found), rising(&[Scale::Roughness], Registration::Centre));
    assert!(found.worst() < 1e-4, "{}", found.worst());
    says(&found.verdict(None), "PASS", &["sheen-charlie E_avg"]);
}

/// One slice of a table of three axes, which `--layer` took from an EXR alone.
#[test]
fn point_05_a_slice_is_chosen_in_text_and_in_raw_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let value = |i: usize| {
        let (x, y) = (i % N, i / N % N);
        if i / (N * N) == 2 { e(x, y) } else { 0.1 * (at(x) + at(y)) }
    };
    let values: Vec<f64> = (0..4 * N * N).map(value).collect();
    let rows: Vec<String> = values.iter().map(|v| format!("{v:.6}")).collect();
    std::fs::write(folder.path().join("t.h"), format!("float t[4][16][16] = {{{}}};", rows.join(",")))
        .unwrap();
    let raw: Vec<u8> = values.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect();
    std::fs::write(folder.path().join("t.bin"), raw).unwrap();
    let with = |file: &str, more: &[&str]| {
        let all = [&["audit", file, "--as", "ggx-reflection:E", "--limit", "1e-5"], more].concat();
        lobefit(folder.path(), &all, b"")
    };
    let refused = |output: Output, words: &str| {
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    };
    // What is said of all slices is what the option takes.
    for (file, size) in [("t.h", &[][..]), ("t.bin", &["--size", "16x16x4"])] {
        refused(with(file, size), "--layer takes one of its slices, 0 to 3");
        let one = with(file, &[&["--layer", "2"], size].concat());
        let said = String::from_utf8_lossy(&one.stdout);
        assert_eq!(one.status.code(), Some(0), "{said}{}", stderr(&one));
        assert!(said.starts_with("PASS ggx-reflection E: "), "{said}");
    }
    refused(with("t.h", &["--layer", "4"]), "they are 0 to 3");
    refused(with("t.h", &["--layer", "albedo"]), "number of a slice");
}

/// One channel of nothing that is known beside one of B: no PASS until it is left out.
#[test]
fn a_channel_of_nothing_is_no_pass() {
    let odd = table(&[("R", &|x, y| 0.5 + 0.3 * ops::sin(5.0 * x as f64 + 3.0 * y as f64)), ("G", &b)]);
    let verdict = reflection_of(&odd).verdict(None);
    says(
        &verdict,
        "UNKNOWN",
        &["channel R follows nothing that is known: give --meaning -,B to leave it out"],
    );
    let meanings = meaning(&[None, Some(Column::B)]);
    let left_out = run(&odd, "ggx-reflection", &Fixed { meanings, ..Fixed::default() });
    says(&left_out.verdict(None), "PASS", &["ggx-reflection B"]);
}

/// One channel of two with a factor of its own: it is named, and none that divides both.
#[test]
fn a_factor_of_one_channel_is_none_of_the_table() {
    // With a factor far from 1 a channel is nearer to other columns, as B/E, or to none.
    for (factor, of_b) in
        [(0.95, false), (0.995, false), (0.995, true), (1.02, true), (1.1, true), (2.0, true)]
    {
        let [own, other] = if of_b { [1.0, factor] } else { [factor, 1.0] };
        let found = reflection_of(&table(&[("R", &|x, y| own * a(x, y)), ("G", &|x, y| other * b(x, y))]));
        let name = if of_b { "B" } else { "A" };
        let words = [
            format!("All of its values are {factor} times those of {name}."),
            format!("Remedy: divide {name} by {factor}"),
            format!(" has {factor} times {name}: "),
        ];
        let verdict = found.verdict(None);
        says(&verdict, "FAIL", &words.each_ref().map(String::as_str));
        assert_eq!((columns(&found), verdict.remedy.len()), (vec![Some(Column::A), Some(Column::B)], 1));
    }
    // Rounding leaves more than a factor that is near to 1.
    let stored = table(&[("R", &|x, y| eight(0.9995 * a(x, y))), ("G", &|x, y| eight(b(x, y)))]);
    says(&reflection_of(&AuditedTable { step: Step::Unorm(8), ..stored }).verdict(None), "PASS", &[]);
}

/// E beside its average over the cosine, the same in every column, "follows nothing that is known".
#[test]
fn an_average_beside_what_it_is_of_is_one() {
    let average = quantity::find("ggx-average").unwrap();
    let variant = Variant { smith: Some(Smith::Correlated), ..Variant::default() };
    let rows: Vec<f64> = (0..N).map(|y| average.at(&variant, &[at(y) * at(y)], 1e-7).unwrap()[0]).collect();
    let found = reflection_of(&table(&[("R", &e), ("G", &|_, y| rows[y])]));
    let Some(Other::Quantity(other)) = &found.channels[1].other else {
        panic!("{:?}", found.channels[1].other)
    };
    assert_eq!((other.quantity, columns(other)), ("ggx-average", vec![Some(Column::Average)]));
    says(
        &found.verdict(None),
        "PASS",
        &["ggx-reflection E: ", "Channel G is of another quantity: ggx-average E_avg"],
    );
}

/// 1 - E where E is asked for is said to be that.
#[test]
fn a_loss_where_an_albedo_is_asked_for_is_said() {
    let column = Some(Column::E);
    let fixed = Fixed { column, ..Fixed::default() };
    let loss = table(&[("R", &|x, y| 1.0 - e(x, y))]);
    assert_eq!(run(&loss, "ggx-reflection", &fixed).fit, Fit::None);
    let all = fixed.without(&loss);
    let (_, free) = all.iter().find(|(without, _)| *without == "the column of --as").unwrap();
    says(&run(&loss, "ggx-reflection", free).verdict(None), "PASS", &["ggx-reflection 1-E"]);
}
