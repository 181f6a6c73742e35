//! Printed functions: Rust compiles alone and returns the tape's bits, WGSL is a hypothesis with
//! the same values.

use crate::code_support;
use crate::fit_support;

use std::path::Path;
use std::process::Command;

use code_support::{POINTS, all, columns, named, points, starts, values};
use fit_support::{hypothesis, parse};
use lobefit_shade::Hypothesis;
use lobefit_shade::code::{CodeError, Language, Printed, print};

fn print_rust(hypothesis: &Hypothesis) -> Printed {
    let header = [format!("The function {}.", hypothesis.name())];
    print(Language::Rust, hypothesis, &starts(hypothesis), &header).unwrap()
}

fn print_wgsl(hypothesis: &Hypothesis, coefficients: &[f32], header: &[&str]) -> Printed {
    let header: Vec<String> = header.iter().map(ToString::to_string).collect();
    print(Language::Wgsl, hypothesis, coefficients, &header).unwrap()
}

fn rustc(arguments: &[&str], source: &Path, out: &Path) {
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_string());
    let result = Command::new(compiler)
        .args(arguments)
        .args(["-D", "warnings", "-o"])
        .arg(out)
        .arg(source)
        .output()
        .expect("rustc runs");
    let text = std::fs::read_to_string(source).unwrap();
    assert!(result.status.success(), "{}\n{text}", String::from_utf8_lossy(&result.stderr));
}

#[test]
fn rust_compiles_alone_and_without_std_where_it_can() {
    let folder = tempfile::tempdir().unwrap();
    // Each in a module of its own, where it sees no other; those that need no std without it.
    let mut alone = [("plain.rs", "#![no_std]\n//! Alone.\n"), ("with_std.rs", "//! Alone.\n")]
        .map(|(file, head)| (file, head.to_string(), 0));
    let mut both = String::from("//! All.\n");
    for hypothesis in all() {
        let printed = print_rust(&hypothesis);
        let (_, text, count) = &mut alone[usize::from(printed.needs_std)];
        *text += &format!("/// One.\npub mod {} {{\n{}}}\n", hypothesis.name(), printed.text);
        *count += 1;
        both.push_str(&printed.text);
    }
    for (file, text, count) in alone {
        assert!(count > 5, "{file}: {count} functions");
        let source = folder.path().join(file);
        std::fs::write(&source, text).unwrap();
        let out = folder.path().join(format!("lib{file}.rmeta"));
        rustc(
            &["--crate-type", "lib", "--edition", "2021", "--emit", "metadata", "-W", "missing-docs"],
            &source,
            &out,
        );
    }
    let source = folder.path().join("all.rs");
    std::fs::write(&source, both).unwrap();
    rustc(
        &["--crate-type", "lib", "--edition", "2024", "--emit", "metadata", "-W", "missing-docs"],
        &source,
        &folder.path().join("liball.rmeta"),
    );
}

/// Runs all printed functions in one program; their values at the points, function by function.
fn run_rust(hypotheses: &[Hypothesis]) -> Vec<Vec<f32>> {
    let folder = tempfile::tempdir().unwrap();
    let mut source = String::from(
        "use std::io::Write;
fn main() {
    let bytes = std::fs::read(std::env::args().nth(2).unwrap()).unwrap();
    let numbers: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    let points: Vec<[f32; 4]> = numbers.chunks_exact(4).map(|p| p.try_into().unwrap()).collect();
    let mut out = std::io::BufWriter::new(std::fs::File::create(std::env::args().nth(1).unwrap()).unwrap());
",
    );
    for hypothesis in hypotheses {
        let arguments: Vec<String> = (0..hypothesis.inputs().len()).map(|k| format!("point[{k}]")).collect();
        source.push_str(&format!(
            "    for point in &points {{ out.write_all(&{}({}).to_bits().to_le_bytes()).unwrap(); }}\n",
            hypothesis.name(),
            arguments.join(", ")
        ));
    }
    source.push_str("}\n");
    hypotheses.iter().for_each(|h| source.push_str(&print_rust(h).text));
    let (path, program) = (folder.path().join("harness.rs"), folder.path().join("harness"));
    std::fs::write(&path, source).unwrap();
    rustc(&["-O", "--edition", "2021"], &path, &program);
    let (out, inputs) = (folder.path().join("values"), folder.path().join("points"));
    std::fs::write(&inputs, points()).unwrap();
    assert!(Command::new(program).arg(&out).arg(&inputs).status().unwrap().success());
    let bytes = std::fs::read(out).unwrap();
    let values: Vec<f32> =
        bytes.chunks_exact(4).map(|b| f32::from_bits(u32::from_le_bytes(b.try_into().unwrap()))).collect();
    values.chunks_exact(POINTS).map(<[f32]>::to_vec).collect()
}

#[test]
fn rust_returns_the_bits_of_the_tape() {
    let hypotheses = all();
    let printed = run_rust(&hypotheses);
    assert_eq!(printed.len(), hypotheses.len());
    for (hypothesis, found) in hypotheses.iter().zip(printed) {
        let expected = values(hypothesis);
        let exact = print_rust(hypothesis).exact;
        for (i, (a, b)) in expected.iter().zip(&found).enumerate() {
            // exp2 and powf are the platform's: 8 ulp, through a well-conditioned formula
            let same =
                a.to_bits() == b.to_bits() || (!exact && (a - b).abs() <= 8.0 * f32::EPSILON * a.abs());
            assert!(
                same,
                "{}, point {i}: {a:?} and {b:?}\n{}",
                hypothesis.name(),
                print_rust(hypothesis).text
            );
        }
    }
}

/// `let k = 0.5;`
fn names_a_literal(line: &str) -> bool {
    let value = line.trim().strip_prefix("let ").and_then(|rest| rest.split_once(" = "));
    value.is_some_and(|(_, value)| value.trim_end_matches([';', 'f']).parse::<f32>().is_ok())
}

#[test]
fn wgsl_is_a_hypothesis_with_the_same_values() {
    for hypothesis in all() {
        let printed = print_wgsl(&hypothesis, &starts(&hypothesis), &["Printed."]);
        let again = Hypothesis::parse("printed.wgsl", &printed.text)
            .unwrap_or_else(|e| panic!("{e}\n{}", printed.text));
        assert_eq!(again.name(), hypothesis.name());
        assert_eq!(again.inputs(), hypothesis.inputs());
        assert_eq!(again.doc(), ["Printed."]);
        assert!(again.parameters().is_empty());
        let bits = |values: Vec<f32>| values.into_iter().map(f32::to_bits).collect::<Vec<_>>();
        let expected = bits(values(&hypothesis));
        let found = bits(again.tape().evaluate(&columns(&hypothesis), &[]).unwrap());
        assert!(expected == found, "{}", printed.text);
        // Printing what was printed changes nothing more, but that a named literal loses its name
        // in the front end.
        let twice = print_wgsl(&again, &[], &["Printed."]);
        let named = printed.text.lines().any(names_a_literal);
        assert!(twice.text == printed.text || named, "{}\n{}", twice.text, printed.text);
    }
}

#[test]
fn lines_stay_readable() {
    for hypothesis in named() {
        for language in Language::ALL {
            let text = print(language, &hypothesis, &starts(&hypothesis), &[]).unwrap().text;
            // A line of the function's head is not broken.
            let longest = text.lines().map(str::len).max().unwrap();
            assert!(longest <= 120, "{longest}: {text}");
        }
    }
}

#[test]
fn q13_is_printed_as_a_person_would_write_it() {
    let hypothesis = hypothesis("ggx_norm_q13");
    let header = ["Furnace normalisation.".to_string(), String::new(), "Generated.".to_string()];
    let rust = print(Language::Rust, &hypothesis, &starts(&hypothesis), &header).unwrap();
    assert!(rust.exact && !rust.needs_std);
    assert_eq!(
        rust.text,
        "/// Furnace normalisation.
///
/// Generated.
pub fn ggx_norm_q13(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (0.38909 + 2.92899 * a2);
    let divisor = a2 + mu * (1.18097 * alpha + mu * (1.61408 - 2.35779 * alpha));
    1.0 + loss / divisor
}
"
    );
    let wgsl = print(Language::Wgsl, &hypothesis, &starts(&hypothesis), &header).unwrap();
    assert_eq!(
        wgsl.text,
        "/// Furnace normalisation.
///
/// Generated.
fn ggx_norm_q13(alpha: f32, mu: f32) -> f32 {
    let a2 = alpha * alpha;
    let loss = alpha * mu * (0.38909 + 2.92899 * a2);
    let divisor = a2 + mu * (1.18097 * alpha + mu * (1.61408 - 2.35779 * alpha));
    return 1.0 + loss / divisor;
}
"
    );
}

#[test]
fn what_cannot_be_printed_is_refused() {
    let line = parse("override a: f32 = 1.0; fn line(x: f32) -> f32 { return a * x; }");
    let infinite = parse("override a: f32 = 1.0; fn f(x: f32) -> f32 { return x + 1.0 / a; }");
    for language in Language::ALL {
        let tiny = print(language, &line, &[1e-31], &[]);
        assert!(matches!(tiny, Err(CodeError::Tiny { value, .. }) if value == 1e-31));
        assert!(matches!(print(language, &line, &[f32::NAN], &[]), Err(CodeError::Fit(_))));
        assert!(matches!(print(language, &line, &[], &[]), Err(CodeError::Fit(_))));
        assert!(matches!(print(language, &infinite, &[0.0], &[]), Err(CodeError::Fit(_))));
    }
    let named = |name: &str| parse(&format!("fn {name}(x: f32) -> f32 {{ return x; }}"));
    for (language, word) in [
        (Language::Rust, "dyn"),
        (Language::Wgsl, "saturate"),
        (Language::Hlsl, "Technique"),
        (Language::Hlsl, "lerp"),
        (Language::Glsl, "sample"),
        (Language::Glsl, "vec3"),
        (Language::Msl, "kernel"),
        (Language::C, "double"),
        (Language::C, "y0"),
    ] {
        let refused = print(language, &named(word), &[], &[]);
        assert!(matches!(refused, Err(CodeError::Name { .. })), "{word}: {refused:?}");
    }
    for language in [Language::Hlsl, Language::Glsl, Language::Msl, Language::C] {
        for name in ["größe", "two__bars", "_First"] {
            let refused = print(language, &named(name), &[], &[]);
            assert!(matches!(refused, Err(CodeError::Letters { .. })), "{name}: {refused:?}");
        }
    }
}
