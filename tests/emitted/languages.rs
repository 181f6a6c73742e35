//! Printed functions in the languages of C's family: compilers take them without a word, and where
//! they run they return the tape's bits.

use crate::code_support;
use crate::emit_support;
use crate::fit_support;

use code_support::{INPUTS, POINTS, all, points, starts, values};
use emit_support::compilers::{Contraction, Target, glslang, includes_in_cpp, loops, run};
use emit_support::languages::{FAMILY, compile};
use emit_support::programs::compile_library;
use emit_support::say;
use fit_support::parse;
use lobefit_shade::Hypothesis;
use lobefit_shade::code::{Float, Language, Printed, pair_of, print, print_pair};
use lobefit_shade::comment::comment;

/// How far, in ulp, functions may lie from the tape whose transcendental functions are the
/// platform's.
const TRANSCENDENTAL: f64 = 4.0;

/// The formulas with numbers of half precision.
fn halves() -> Vec<Hypothesis> {
    all().into_iter().map(|hypothesis| hypothesis.in_float(Float::F16)).collect()
}

fn printed(language: Language, hypothesis: &Hypothesis) -> Printed {
    let header = [format!("The function {}.", hypothesis.name())];
    print(language, hypothesis, &starts(hypothesis), &header).unwrap()
}

/// A file of them all.
fn file(language: Language, hypotheses: &[Hypothesis]) -> String {
    let preamble = language.preamble(hypotheses[0].float());
    let functions: Vec<String> = hypotheses.iter().map(|h| printed(language, h).text).collect();
    format!("{} All.\n{preamble}{}", language.comment(), functions.join("\n"))
}

/// Calls every function at every point.
fn program(hypotheses: &[Hypothesis]) -> String {
    let call = |hypothesis: &Hypothesis| {
        let arguments: Vec<String> = (0..hypothesis.inputs().len()).map(|k| format!("p[{k}]")).collect();
        format!("        put({}({}));\n", hypothesis.name(), arguments.join(", "))
    };
    loops(INPUTS, &hypotheses.iter().map(call).collect::<Vec<_>>())
}

/// Units in the last place of the expected value, and no less than those of 1: sums that cancel
/// keep the errors of their terms.
fn ulps(expected: f32, found: f32) -> f64 {
    let unit = f64::from(expected.abs().max(1.0)) * f64::from(f32::EPSILON);
    (f64::from(expected) - f64::from(found)).abs() / unit
}

/// Runs functions of a language and compares with their tapes: to the bit, or within `limit` ulp
/// where bits are not promised.
fn compare(language: Language, hypotheses: &[Hypothesis], limit: f64) -> Option<()> {
    let (code, main) = (file(language, hypotheses), program(hypotheses));
    let found = run(language, &code, &main, &points(), Contraction::Off)?;
    assert_eq!(found.len(), hypotheses.len() * POINTS);
    let mut worst = (0.0, "none");
    for (hypothesis, found) in hypotheses.iter().zip(found.chunks_exact(POINTS)) {
        let exact = printed(language, &hypothesis.clone().in_float(Float::F32)).exact;
        for (i, (a, b)) in values(hypothesis).into_iter().zip(found).enumerate() {
            let same = a.to_bits() == b.to_bits() || (!exact && ulps(a, *b) <= limit);
            let text = || printed(language, hypothesis).text;
            assert!(same, "{}, point {i}: {a:?} and {b:?}\n{}", hypothesis.name(), text());
            if ulps(a, *b) > worst.0 {
                worst = (ulps(a, *b), hypothesis.name());
            }
        }
    }
    let (count, name) = (hypotheses.len(), language.title());
    say(&format!("{name}: {count} functions, {POINTS} points each: worst {:.2} ulp, {}", worst.0, worst.1));
    Some(())
}

#[test]
fn c_returns_the_bits_of_the_tape() {
    compare(Language::C, &all(), TRANSCENDENTAL);
}

#[test]
fn c_is_included_from_cpp() {
    includes_in_cpp(&file(Language::C, &all()));
}

#[test]
fn shaders_read_as_cpp_return_the_bits_of_the_tape() {
    for language in [Language::Hlsl, Language::Glsl, Language::Msl] {
        compare(language, &all(), TRANSCENDENTAL);
    }
}

/// A compiler may keep f32 for types of half precision; then their functions are those of f32.
#[test]
fn functions_of_half_precision_are_those_of_f32_where_a_compiler_keeps_32_bits() {
    for language in [Language::Hlsl, Language::Glsl, Language::Msl] {
        compare(language, &halves(), TRANSCENDENTAL);
    }
}

#[test]
fn compilers_take_half_precision() {
    let half = halves();
    for language in [Language::Hlsl, Language::Glsl] {
        assert!(compile(language, &file(language, &half)).is_none_or(|functions| functions >= half.len()));
    }
    valid_in_half(&file(Language::Wgsl, &half));
}

fn valid_in_half(text: &str) {
    assert!(text.contains("enable f16;") && !text.contains("f32"), "{text}");
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let capabilities = naga::valid::Capabilities::SHADER_FLOAT16;
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities);
    validator.validate(&module).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
}

/// A file of the formulas that have pairs, two evaluations at once, and those formulas.
fn pairs(language: Language) -> (String, Vec<Hypothesis>) {
    let pair = |h: &Hypothesis| print_pair(language, h, &starts(h), &["A pair.".into()]).expect("a function");
    let printed: Vec<(String, Hypothesis)> =
        halves().into_iter().filter_map(|h| pair(&h).map(|text| (text, h))).collect();
    let (texts, hypotheses): (Vec<String>, Vec<Hypothesis>) = printed.into_iter().unzip();
    (format!("{}{}", language.preamble(Float::F16), texts.join("\n")), hypotheses)
}

/// Each component is an evaluation, whatever the other is, where a compiler keeps 32 bits.
#[test]
fn pairs_are_two_evaluations() {
    for (language, vector) in
        [(Language::Hlsl, "min16float2"), (Language::Glsl, "vec2"), (Language::Msl, "half2")]
    {
        let (code, hypotheses) = pairs(language);
        assert!(hypotheses.len() > halves().len() / 3, "{} of {}", hypotheses.len(), halves().len());
        let call = |h: &Hypothesis| {
            let both = |components: [&str; 2]| {
                let [x, y] = components;
                let arguments: Vec<String> = (0..h.inputs().len())
                    .map(|k| format!("{vector}({x}, {y})").replace('#', &k.to_string()))
                    .collect();
                format!("{}({})", pair_of(h).expect("a pair"), arguments.join(", "))
            };
            let (x, y) = (both(["p[#]", "0.5f"]), both(["0.25f", "p[#]"]));
            [format!("        put({x}.x);\n"), format!("        put({y}.y);\n")].concat()
        };
        let main = loops(INPUTS, &hypotheses.iter().map(call).collect::<Vec<_>>());
        let Some(found) = run(language, &code, &main, &points(), Contraction::Off) else { continue };
        assert_eq!(found.len(), 2 * hypotheses.len() * POINTS);
        let each = found.chunks_exact(2 * POINTS);
        for (hypothesis, found) in hypotheses.iter().zip(each) {
            let exact = printed(language, &hypothesis.clone().in_float(Float::F32)).exact;
            for (i, a) in values(hypothesis).into_iter().enumerate() {
                for b in [found[2 * i], found[2 * i + 1]] {
                    let same = a.to_bits() == b.to_bits() || (!exact && ulps(a, b) <= TRANSCENDENTAL);
                    assert!(
                        same,
                        "{} in {}, point {i}: {a:?} and {b:?}",
                        hypothesis.name(),
                        language.title()
                    );
                }
            }
        }
    }
}

#[test]
fn compilers_take_pairs() {
    for language in [Language::Hlsl, Language::Glsl] {
        let (text, hypotheses) = pairs(language);
        assert!(compile(language, &text).is_none_or(|functions| functions >= hypotheses.len()));
    }
    valid_in_half(&pairs(Language::Wgsl).0);
    for language in [Language::Rust, Language::C] {
        assert!(pairs(language).1.is_empty());
    }
}

/// Lines that would end a comment, swallow the line after it, or hide what it is.
const HOSTILE: [&str; 16] = [
    "a line\nfloat x = 1.0f;",
    "carriage\rreturn",
    "next\u{85}line",
    "separators\u{2028}float x;\u{2029}",
    "feed\u{0c}and\u{0b}tab\t",
    "end */ of a comment",
    "/* start of one",
    "// another //",
    "#include <none.h>",
    "*/ fn evil() {} /*",
    "right \u{202e}to\u{202c} left \u{2066}isolated",
    "\u{200f}\u{feff}marked",
    "nothing\0",
    "trigraph ??/",
    "splice and blanks \\ \t ",
    "splice \\",
];

#[test]
fn hostile_comments_change_nothing() {
    let hypothesis = parse("fn two_inputs(x: f32, y: f32) -> f32 { return x - 0.25 * y; }");
    // One of them is the last before the function: the first, and each of those that might splice.
    for last in [0, HOSTILE.len() - 3, HOSTILE.len() - 2, HOSTILE.len() - 1] {
        let mut header: Vec<String> = HOSTILE.iter().map(ToString::to_string).collect();
        header.swap(last, HOSTILE.len() - 1);
        let text = |language| {
            let printed = print(language, &hypothesis, &[], &header).unwrap().text;
            assert_eq!(printed.lines().count(), HOSTILE.len() + 3, "{printed}");
            format!("{}{}{printed}", comment(language.comment(), &header), language.opening())
        };
        compile_library(&text(Language::Rust));
        let read = Hypothesis::parse("hostile.wgsl", &text(Language::Wgsl)).unwrap();
        assert_eq!(read.tape().evaluate::<f32>(&[vec![0.75], vec![1.0]], &[]).unwrap(), [0.5]);
        let main = loops(2, &["        put(two_inputs(p[0], p[1]));\n".to_string()]);
        let point: Vec<u8> = [0.75_f32, 1.0].into_iter().flat_map(f32::to_le_bytes).collect();
        for language in FAMILY {
            let found = run(language, &text(language), &main, &point, Contraction::Off);
            assert!(found.is_none_or(|values| values == [0.5]), "{}", language.title());
        }
        for language in [Language::Hlsl, Language::Glsl] {
            assert!(compile(language, &text(language)).is_none_or(|functions| functions == 1));
        }
    }
}

/// Calls of every function with arguments `p.x`, `p.y`, ..., each assigned by `put`.
fn calls(hypotheses: &[Hypothesis], put: impl Fn(usize, String) -> String) -> String {
    let call = |(n, hypothesis): (usize, &Hypothesis)| {
        let arguments = &["p.x", "p.y", "p.z", "p.w"][..hypothesis.inputs().len()];
        put(n, format!("{}({})", hypothesis.name(), arguments.join(", ")))
    };
    hypotheses.iter().enumerate().map(call).collect()
}

#[test]
fn glslang_compiles_glsl_for_vulkan_and_opengl() {
    let hypotheses = all();
    let code = file(Language::Glsl, &hypotheses);
    let sums = calls(&hypotheses, |_, call| format!("    sum += {call};\n"));
    let main = format!("void main() {{\n    float sum = 0.0;\n{sums}    result = vec4(sum);\n}}\n");
    for (version, target) in [
        ("450", Target::Vulkan),
        ("450", Target::OpenGl),
        ("330", Target::OpenGl),
        ("310 es", Target::Vulkan),
        ("300 es", Target::OpenGl),
    ] {
        let precision = if version.ends_with("es") { "precision highp float;\n" } else { "" };
        let place = |n: u32| {
            if version == "330" || version == "300 es" {
                String::new()
            } else {
                format!("layout(location = {n}) ")
            }
        };
        let declared = format!(
            "{}in vec4 p;\n{}out vec4 result;\n",
            if version == "300 es" { String::new() } else { place(0) },
            place(0)
        );
        let source = format!("#version {version}\n{precision}{declared}{code}{main}");
        if glslang(Language::Glsl, &source, "frag", target).is_none() {
            return;
        }
    }
}

#[test]
fn glslang_compiles_hlsl() {
    let hypotheses = all();
    let sums = calls(&hypotheses, |_, call| format!("    sum += {call};\n"));
    let source = format!(
        "{}\nfloat4 main(float4 p : TEXCOORD0) : SV_Target {{\n    float sum = 0.0f;\n{sums}    return float4(sum, sum, sum, sum);\n}}\n",
        file(Language::Hlsl, &hypotheses)
    );
    glslang(Language::Hlsl, &source, "frag", Target::Vulkan);
}
