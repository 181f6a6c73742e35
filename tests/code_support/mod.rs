//! Formulas that use everything in the dialect, and their values: what the tests of printed code
//! share.
#![allow(dead_code, reason = "each test binary uses its part")]

use lobefit_shade::Hypothesis;

use crate::fit_support::{folder, hypothesis, parse};

/// Points compared.
pub const POINTS: usize = 65_536;

/// Formulas that use everything in the dialect; inputs in (0, 1].
pub const FEATURES: [(&str, &str); 15] = [
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
        // Each transcendental function away from its zeros, and sums of one sign: errors of some
        // ulp stay some ulp.
        "transcendental functions",
        "fn transcendental(x: f32, y: f32) -> f32 {
            return exp(-x) + exp2(y) + log(1.5 + x) + log2(1.5 + y) + pow(0.5 + x, 1.7) + sin(0.5 + x) + cos(y);
        }",
    ),
    (
        "names that other languages take",
        "fn y0(x: f32, y1: f32) -> f32 { return x - y1; }
        fn taken(half: f32, input: f32) -> f32 {
            let double = half + input; let float4 = double * 0.5; let sample = float4 - half; let α = sample * sample;
            let linux = α + 1.0; let fabsf = linux / 2.0; let mad = fabsf * 3.0; let this_ = mad - 1.0; let a__b = this_ + mad;
            let out = a__b * 0.25; let technique = out; let NAN = technique + 0.5; let rsqrt = NAN * y0(linux, α); return rsqrt;
        }",
    ),
    (
        "negations and truths",
        "fn odd(a: bool, b: bool, unused: f32) -> bool { return !a == b; }
        fn truths(x: f32, y: f32) -> f32 {
            let small = x < 0.5;
            var late = false;
            if odd(small, y < 0.5, x) { late = true; }
            return select(-(-x), y, late != small) + select(1.0, 2.0, !(small && late) || x == y);
        }",
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
pub fn all() -> Vec<Hypothesis> {
    named().into_iter().chain((0..60).map(|seed| parse(&random_source(seed)))).collect()
}

/// The hypotheses' files.
pub fn files() -> Vec<Hypothesis> {
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
    names.iter().map(|n| hypothesis(n)).collect()
}

/// The hypotheses' files and the formulas above.
pub fn named() -> Vec<Hypothesis> {
    files().into_iter().chain(FEATURES.iter().map(|(_, source)| parse(source))).collect()
}

/// A random formula whose values are finite.
fn random_source(seed: u64) -> String {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
    let lets: Vec<String> =
        (0..3).map(|i| format!("    let v{i} = {};\n", random.expression(3, i))).collect();
    let c = random.number();
    let [change, other, result] = [2, 2, 3].map(|depth| random.expression(depth, 3));
    format!(
        "override c: f32 = {c};
fn random_{seed}(x: f32, y: f32) -> f32 {{
{}    var w = v0;
    if v1 < x || !(v2 > w) {{ w = w + ({change}); }} else if y >= 0.5 {{ w = {other}; }}
    return c * ({result}) + w;
}}",
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

    fn number_below_half(&mut self) -> String {
        format!("{:?}f", self.below(1000) as f32 / 2000.0)
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
        match self.below(22) {
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
            13 => format!("pow(saturate({a}), {}.0)", 2 + self.below(15)),
            14 => format!("sign({a})"),
            15 => format!("step({a}, {b})"),
            16 => format!("smoothstep({}, 0.75 + abs({b}), {a})", self.number_below_half()),
            17 => format!("floor(4.0 * ({a}))"),
            18 => format!("clamp({a}, {b}, {d})"),
            19 => format!("clamp({a}, -0.5, 0.75)"),
            20 => format!("inverseSqrt(0.5 + abs({a}))"),
            _ => format!("mix({a}, {b}, {d})"),
        }
    }
}

pub fn starts(hypothesis: &Hypothesis) -> Vec<f32> {
    hypothesis.parameters().iter().map(|p| p.start).collect()
}

/// Inputs of every point.
pub const INPUTS: usize = 4;

/// Input `k` of point `i`, in (0, 1]: first every combination of some edges, then scattered.
pub fn input(i: usize, k: usize) -> f32 {
    let edges = [f32::EPSILON / 2.0, 1e-3, 0.5, 1.0];
    if i < edges.len().pow(INPUTS as u32) {
        return edges[(i >> (2 * k)) % edges.len()];
    }
    let mixed = ((i * 31 + k + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((mixed >> 40) as f32 + 1.0) / 16_777_216.0
}

/// The inputs of every point, one point after another, as a program reads them.
pub fn points() -> Vec<u8> {
    (0..POINTS * INPUTS).flat_map(|n| input(n / INPUTS, n % INPUTS).to_le_bytes()).collect()
}

pub fn columns(hypothesis: &Hypothesis) -> Vec<Vec<f32>> {
    let inputs = hypothesis.inputs().len();
    assert!(inputs <= INPUTS, "{}: {inputs} inputs", hypothesis.name());
    (0..inputs).map(|k| (0..POINTS).map(|i| input(i, k)).collect()).collect()
}

/// Values of the tape at every point.
pub fn values(hypothesis: &Hypothesis) -> Vec<f32> {
    hypothesis.tape().evaluate(&columns(hypothesis), &starts(hypothesis)).unwrap()
}
