//! Printed functions: Rust compiles alone and returns the tape's bits, WGSL is a hypothesis with the same values.

mod fit_support;

use std::path::Path;
use std::process::Command;

use fit_support::{folder, hypothesis, parse};
use lobefit::emit::code::{CodeError, Language, Printed, print};
use lobefit::fit::Hypothesis;

/// Points compared.
const POINTS: usize = 65_536;

/// Formulas that use everything in the dialect; inputs in (0, 1].
const FEATURES: [(&str, &str); 12] = [
    (
        "minimum and maximum",
        "override c: f32 = -0.25;
        fn minmax(x: f32, y: f32) -> f32 { return min(x, y + c) * max(x, 0.5) - clamp(x - y, -0.3, 0.2) + clamp(x, y, 1.5); }",
    ),
    (
        "saturation, magnitude, sign",
        "fn signs(x: f32, y: f32) -> f32 { return saturate(2.0 * x - 0.5) + abs(x - y) - sign(y - 0.5) + step(0.5, x) * floor(3.0 * y); }",
    ),
    (
        "mixing",
        "override a: f32 = 2.0;
        fn mixing(x: f32, y: f32) -> f32 { return mix(x, a * y, x * y) + smoothstep(0.1, 0.9, x) - fma(x, y, -0.125); }",
    ),
    ("roots", "fn roots(x: f32, y: f32) -> f32 { return sqrt(x) * inverseSqrt(x + y) / (1.0 + sqrt(x * y)); }"),
    (
        "powers",
        "fn powers(x: f32, y: f32) -> f32 {
            let m = 1.0 - x;
            return pow(m, 5.0) + pow(y, 2.0) * pow(x - y, 7.0) - pow(y, 16.0) + pow(x, 3.0) + pow(m, 4.0);
        }",
    ),
    (
        "branches that return",
        "override edge: f32 = 0.4;
        fn early(x: f32, y: f32) -> f32 {
            if x < edge { return x * y; }
            if y > 0.5 && x > 0.7 || y < 0.1 { return y - x; } else if y == 0.25 { return 1.0; }
            let z = x - y;
            return z * z;
        }",
    ),
    (
        "variables",
        "fn loops_not(x: f32, y: f32) -> f32 {
            var sum = x;
            var weight: f32;
            if x > y { weight = 0.5; sum += y; } else { weight = 2.0 * y; }
            sum *= weight;
            { let sum_2 = sum * sum; sum = sum - sum_2 / 3.0; }
            var late = 1.0;
            if !(y > 0.3) { late = sum; sum -= 0.5; }
            return sum + late;
        }",
    ),
    (
        "helpers",
        "override f: f32 = 0.04;
        const TWO = 2.0;
        fn inside(a: bool, x: f32) -> bool { return a || x * TWO < 1.0; }
        fn schlick(f0: f32, mu: f32) -> f32 { return f0 + (1.0 - f0) * pow(1.0 - mu, 5.0); }
        fn helper_user(x: f32, y: f32) -> f32 {
            let r = schlick(f, x) - schlick(f * 2.0, y);
            return select(r, -r, inside(x < y, y)) * schlick(0.5, x);
        }",
    ),
    (
        "constants only",
        "override a: f32 = 3.0;
        override b: f32 = 0.1;
        fn constants_only(x: f32) -> f32 { let k = a * b; let s = sqrt(a); return select(k, s, x < 0.5) + abs(select(1.0, -2.0, x > 0.25)); }",
    ),
    (
        "signs and parentheses",
        "override c: f32 = -1.5;
        override d: f32 = -0.5;
        fn parentheses(x: f32, y: f32) -> f32 {
            return -(x - y) - (c + (x - (d * y - -x))) * -(-(y)) / (x / (y / (2.0 + c * x * x + d))) + (-c) * x - abs(-x) + 1.0 / (3.0 + c);
        }",
    ),
    (
        "names that Rust takes",
        "fn naming(in_: f32, mut_: f32) -> f32 { let box = in_ * 2.0; let dyn = box + mut_; let Upper = dyn * dyn; let mix_ = mix(box, dyn, in_); let pow2 = pow(Upper, 2.0); return mix_ * pow2; }",
    ),
    (
        "a long sum",
        "override c0: f32 = 0.123456789;
        fn long_sum(x: f32, y: f32, unused_input: f32) -> f32 {
            return c0 * x * x * x * x + 1.23456789 * y * y * y - 0.987654321 * x * y * x + 3.1415927 * x * (y + 2.7182817) * (x - 0.5772157) - (x + y) * 1.6180339 + 7e-7 * x;
        }",
    ),
];

/// The hypotheses' files, the formulas above, and random ones.
fn all() -> Vec<Hypothesis> {
    named().into_iter().chain((0..60).map(|seed| parse(&random_source(seed)))).collect()
}

fn named() -> Vec<Hypothesis> {
    let mut names = Vec::new();
    for (prefix, path) in [("", folder()), ("published/", folder().join("published"))] {
        for entry in std::fs::read_dir(path).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "wgsl") {
                names.push(format!("{prefix}{}", path.file_stem().unwrap().to_string_lossy()));
            }
        }
    }
    names.sort();
    let files = names.iter().map(|n| hypothesis(n));
    files.chain(FEATURES.iter().map(|(_, source)| parse(source))).collect()
}

/// A random formula whose values are finite.
fn random_source(seed: u64) -> String {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
    let lets: Vec<String> =
        (0..3).map(|i| format!("    let v{i} = {};\n", random.expression(3, i))).collect();
    let c = random.number();
    let result = random.expression(3, 3);
    format!(
        "override c: f32 = {c};\nfn random_{seed}(x: f32, y: f32) -> f32 {{\n{}    return c * ({result});\n}}",
        lets.concat()
    )
}

struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % n
    }

    fn number(&mut self) -> String {
        format!("{:?}f", (self.below(4000) as f32 - 2000.0) / 777.0)
    }

    /// An expression of x, y, c and the first `lets` variables; divisors are above 1.
    fn expression(&mut self, depth: u32, lets: u64) -> String {
        if depth == 0 {
            return match self.below(4 + lets) {
                0 => "x".to_string(),
                1 => "y".to_string(),
                2 => "c".to_string(),
                3 => self.number(),
                n => format!("v{}", n - 4),
            };
        }
        let mut sub = || self.expression(depth - 1, lets);
        let (a, b, d) = (sub(), sub(), sub());
        match self.below(15) {
            0 | 1 => format!("({a}) + ({b})"),
            2 | 3 => format!("({a}) - ({b})"),
            4 | 5 => format!("({a}) * ({b})"),
            6 => format!("({a}) / (1.5 + abs({b}))"),
            7 => format!("-({a})"),
            8 => format!("min({a}, {b})"),
            9 => format!("max({a}, {b})"),
            10 => format!("saturate({a})"),
            11 => format!("select({a}, {b}, ({d}) < ({a}) && !(({b}) >= 0.25 || ({d}) == 1.0))"),
            12 => format!("sqrt(abs({a}))"),
            13 => format!("pow(saturate({a}), 3.0)"),
            _ => format!("mix({a}, {b}, {d})"),
        }
    }
}

fn starts(hypothesis: &Hypothesis) -> Vec<f32> {
    hypothesis.parameters().iter().map(|p| p.start).collect()
}

fn print_rust(hypothesis: &Hypothesis) -> Printed {
    let header = [format!("The function {}.", hypothesis.name())];
    print(Language::Rust, hypothesis, &starts(hypothesis), &header).unwrap()
}

fn print_wgsl(hypothesis: &Hypothesis, coefficients: &[f32], header: &[&str]) -> Printed {
    let header: Vec<String> = header.iter().map(ToString::to_string).collect();
    print(Language::Wgsl, hypothesis, coefficients, &header).unwrap()
}

/// Input `k` of point `i`, in (0, 1]; the harness has the same lines.
fn input(i: usize, k: usize) -> f32 {
    let mixed = ((i * 31 + k + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((mixed >> 40) as f32 + 1.0) / 16_777_216.0
}

fn columns(hypothesis: &Hypothesis) -> Vec<Vec<f32>> {
    (0..hypothesis.inputs().len()).map(|k| (0..POINTS).map(|i| input(i, k)).collect()).collect()
}

fn values(hypothesis: &Hypothesis) -> Vec<f32> {
    hypothesis.tape().evaluate(&columns(hypothesis), &starts(hypothesis)).unwrap()
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
    let mut both = String::from("//! All.\n");
    for hypothesis in all() {
        let printed = print_rust(&hypothesis);
        let name = hypothesis.name();
        let start = if printed.needs_std { "" } else { "#![no_std]\n" };
        let source = folder.path().join(format!("{name}.rs"));
        std::fs::write(&source, format!("{start}//! One.\n{}", printed.text)).unwrap();
        let out = folder.path().join(format!("lib{name}.rmeta"));
        rustc(
            &["--crate-type", "lib", "--edition", "2021", "--emit", "metadata", "-W", "missing-docs"],
            &source,
            &out,
        );
        both.push_str(&printed.text);
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
fn input(i: usize, k: usize) -> f32 {
    let mixed = ((i * 31 + k + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((mixed >> 40) as f32 + 1.0) / 16_777_216.0
}
fn main() {
    let mut out = std::io::BufWriter::new(std::fs::File::create(std::env::args().nth(1).unwrap()).unwrap());
",
    );
    for hypothesis in hypotheses {
        let arguments: Vec<String> =
            (0..hypothesis.inputs().len()).map(|k| format!("input(std::hint::black_box(i), {k})")).collect();
        source.push_str(&format!(
            "    for i in 0..{POINTS} {{ out.write_all(&{}({}).to_bits().to_le_bytes()).unwrap(); }}\n",
            hypothesis.name(),
            arguments.join(", ")
        ));
    }
    source.push_str("}\n");
    hypotheses.iter().for_each(|h| source.push_str(&print_rust(h).text));
    let (path, program) = (folder.path().join("harness.rs"), folder.path().join("harness"));
    std::fs::write(&path, source).unwrap();
    rustc(&["-O", "--edition", "2021"], &path, &program);
    let out = folder.path().join("values");
    assert!(Command::new(program).arg(&out).status().unwrap().success());
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
        // Printing what was printed changes nothing more, but that a named literal loses its name in the front end.
        let twice = print_wgsl(&again, &[], &["Printed."]);
        assert!(twice.text == printed.text || hypothesis.name() == "constants_only", "{}", twice.text);
    }
}

#[test]
fn lines_stay_readable() {
    for hypothesis in named() {
        for language in Language::ALL {
            let text = print(language, &hypothesis, &starts(&hypothesis), &[]).unwrap().text;
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
        for name in ["größe", "two__bars", "_first"] {
            let refused = print(language, &named(name), &[], &[]);
            assert!(matches!(refused, Err(CodeError::Letters { .. })), "{name}: {refused:?}");
        }
    }
}
