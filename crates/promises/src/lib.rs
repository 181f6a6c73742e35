//! What lobefit promises, as data: `docs/promises.json` has an entry for every quantity, every public
//! function of numbers and every formula. Tests take their bars from it, and `docs/promises.md` is
//! printed from it ([`page`]).

use std::fmt::Write as _;
use std::sync::LazyLock;

use serde::Deserialize;

/// An input: its name, its least and its largest value.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Range(pub String, pub f64, pub f64);

/// What is promised of a function of numbers.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Function {
    /// Its path, as `truth::optics::ggx::lambda`.
    pub name: String,
    /// Its domain.
    pub inputs: Vec<Range>,
    /// Largest distance from the truth, as a part of it.
    #[serde(default)]
    pub relative: f64,
    /// What may be added to the distance.
    #[serde(default)]
    pub absolute: f64,
    /// Whether what it gives outside of its domain has no meaning; else a NaN of any input gives a NaN.
    #[serde(default)]
    pub inside_alone: bool,
    /// A remark for who reads the page.
    #[serde(default)]
    pub remark: String,
}

/// What every function may be off by in addition: products of numbers that small are not resolved.
pub const FLOOR: f64 = 1e-60;

/// A public function, or all of a module, of which nothing is promised here.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exception {
    /// The path, or its beginning.
    pub name: String,
    /// Why, and which test holds it instead.
    pub reason: String,
}

/// What is promised of a quantity, in the widest variant that is promised.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Its name, as `ggx-reflection`.
    pub name: String,
    /// The domain of the promise, within that of the quantity.
    pub inputs: Vec<Range>,
    /// Largest `error` of every output.
    pub absolute: f64,
    /// Largest error of an output named `loss` as a part of it, where there is one.
    #[serde(default)]
    pub loss_relative: Option<f64>,
    /// What the values are compared with, and the tests that do it.
    pub oracles: Vec<Oracle>,
}

/// An independent truth and the test that compares with it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Oracle {
    /// What.
    pub what: String,
    /// Path of the test.
    pub test: String,
}

/// What is promised of a formula: over the usual range of its quantity, after its coefficients are
/// rounded, in f32.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Formula {
    /// Its name, as `ggx_norm_i14`.
    pub name: String,
    /// Its operations.
    pub ops: u32,
    /// Largest error of its use when fitted for the maximum.
    pub max_error: f64,
    /// Largest error as a part of the truth; none where the truth comes next to 0 and the error is all of it
    /// or more.
    #[serde(default)]
    pub relative: Option<f64>,
    /// The domain of the promise.
    pub inputs: Vec<Range>,
    /// The test that fits it.
    pub test: String,
}

/// What is promised of a lookup in a table of the committed files.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// Its name, as `ggx-dfg-correlated-32x32`.
    pub name: String,
    /// The ranges of its axes; a lookup clamps outside.
    pub inputs: Vec<Range>,
    /// Format of its texels.
    pub format: String,
    /// Largest error of a lookup by f32 weights.
    pub max_error: f64,
    /// The same as a part of the truth.
    pub relative: f64,
    /// That by the weights of eight bits that hardware filters with.
    pub max_error_8_bit_weights: f64,
}

/// How the program behaves.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conduct {
    /// The promise.
    pub promise: String,
    /// The tests that hold it.
    pub tests: Vec<String>,
}

/// All promises.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Promises {
    /// Functions of numbers.
    pub functions: Vec<Function>,
    /// Functions without one.
    pub exceptions: Vec<Exception>,
    /// Quantities.
    pub quantities: Vec<Quantity>,
    /// Formulas that are fitted.
    pub formulas: Vec<Formula>,
    /// Tables of the committed files.
    pub tables: Vec<Table>,
    /// Emitted functions that are below 0 somewhere beyond the domains that they state.
    pub beyond: Vec<Exception>,
    /// The conduct of the program.
    pub conduct: Vec<Conduct>,
    /// What is not promised.
    pub not_promised: Vec<String>,
}

/// The promises of this version.
pub fn promises() -> &'static Promises {
    static PROMISES: LazyLock<Promises> = LazyLock::new(|| {
        let text = include_str!("../../../docs/promises.json");
        serde_json::from_str(text).unwrap_or_else(|error| panic!("docs/promises.json: {error}"))
    });
    &PROMISES
}

/// The promise of a function.
pub fn function(name: &str) -> &'static Function {
    let found = promises().functions.iter().find(|function| function.name == name);
    found.unwrap_or_else(|| panic!("docs/promises.json: no function {name}"))
}

/// The promise of a quantity.
pub fn quantity(name: &str) -> &'static Quantity {
    let found = promises().quantities.iter().find(|quantity| quantity.name == name);
    found.unwrap_or_else(|| panic!("docs/promises.json: no quantity {name}"))
}

/// The promise of a formula.
pub fn formula(name: &str) -> &'static Formula {
    let found = promises().formulas.iter().find(|formula| formula.name == name);
    found.unwrap_or_else(|| panic!("docs/promises.json: no formula {name}"))
}

/// The formulas that a test fits.
pub fn formulas_of(test: &str) -> impl Iterator<Item = &'static Formula> {
    promises().formulas.iter().filter(move |formula| formula.test == test)
}

/// A formula as a test has fitted it for the largest error.
#[derive(Clone, Debug)]
pub struct Fitted<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its operations.
    pub ops: u32,
    /// Its certified error.
    pub error: f64,
    /// Its largest error as a part of the truth.
    pub relative: f64,
    /// Where it is certified.
    pub domain: Vec<Range>,
}

/// What the formulas that a test has fitted break of their promises: each that the list names with the
/// test is there, takes what it says, and errs there by no more, nor by so much less that the list is stale.
/// Of a promise that is broken, and of a formula that the list lacks, the line that holds.
pub fn broken(test: &str, found: &[Fitted]) -> Vec<String> {
    let line = |fit: &Fitted| {
        let Fitted { name, ops, error, relative, domain } = fit;
        let input = |Range(name, low, high): &Range| format!(r#"["{name}", {low}, {high}]"#);
        let inputs = domain.iter().map(input).collect::<Vec<_>>().join(", ");
        let relative = if *relative < ALL { format!(r#""relative": {relative}, "#) } else { String::new() };
        format!(
            r#"{{"name": "{name}", "ops": {ops}, "max_error": {error}, {relative}"inputs": [{inputs}], "test": "{test}"}}"#
        )
    };
    let of = |promise: &Formula| {
        let named = found.iter().filter(|fit| fit.name == promise.name);
        let worst = named.max_by(|a, b| a.error.total_cmp(&b.error));
        let Some(fit) = worst else { return Some(format!("{} is not fitted", promise.name)) };
        let holds = |error: f64, promised: f64| error <= promised && error >= STALE * promised;
        let is_kept = fit.ops == promise.ops
            && holds(fit.error, promise.max_error)
            && promise.relative.map_or(fit.relative >= ALL, |promised| holds(fit.relative, promised))
            && fit.domain == promise.inputs;
        (!is_kept).then(|| line(fit))
    };
    let unknown = found.iter().filter(|fit| promises().formulas.iter().all(|f| f.name != fit.name));
    formulas_of(test).filter_map(of).chain(unknown.map(line)).collect()
}

/// The error that is all of the truth.
const ALL: f64 = 1.0;

/// Part of a promised error below which what is kept is another figure.
const STALE: f64 = 0.95;

/// `docs/promises.md`.
pub fn page() -> String {
    let list = promises();
    let mut page = String::from(HEAD);
    page += "\n## Quantities\n\n| quantity | inputs | `error` at most | compared with |\n|---|---|---|---|\n";
    for Quantity { name, inputs, absolute, loss_relative, oracles } in &list.quantities {
        let loss = loss_relative.map(|r| format!(", loss within {r:e} of itself")).unwrap_or_default();
        let with: Vec<String> = oracles.iter().map(|o| format!("{} (`{}`)", o.what, o.test)).collect();
        let _ =
            writeln!(page, "| `{name}` | {} | {absolute:e}{loss} | {} |", ranges(inputs), with.join("; "));
    }
    page += FORMULAS;
    for Formula { name, ops, max_error, relative, inputs, test } in &list.formulas {
        let relative = relative.map_or("–".into(), |relative| relative.to_string());
        let over = ranges(inputs);
        let _ = writeln!(page, "| `{name}` | {ops} | {max_error} | {relative} | {over} | `{test}` |");
    }
    page += TABLES;
    for Table { name, inputs, format, max_error, relative, max_error_8_bit_weights } in &list.tables {
        let over = ranges(inputs);
        let _ = writeln!(
            page,
            "| `{name}` | {format} | {over} | {max_error} | {relative} | {max_error_8_bit_weights} |"
        );
    }
    page += BEYOND;
    for Exception { name, reason } in &list.beyond {
        let _ = writeln!(page, "- `{name}`: {reason}");
    }
    page += FUNCTIONS;
    for Function { name, inputs, relative, absolute, inside_alone, remark } in &list.functions {
        let bars = [(relative, " of itself"), (absolute, "")];
        let bars = bars.iter().filter(|(bar, _)| **bar > 0.0).map(|(bar, of)| format!("{bar:e}{of}"));
        let outside = if *inside_alone { "outside without meaning" } else { "" };
        let remarks: Vec<&str> = [outside, remark].into_iter().filter(|text| !text.is_empty()).collect();
        let within = bars.collect::<Vec<_>>().join(" and ");
        let _ = writeln!(page, "| `{name}` | {} | {within} | {} |", ranges(inputs), remarks.join("; "));
    }
    page += "\nWithout an entry:\n\n";
    for Exception { name, reason } in &list.exceptions {
        let _ = writeln!(page, "- `{name}`: {reason}");
    }
    page += "\n## Conduct\n\n| promise | held by |\n|---|---|\n";
    for Conduct { promise, tests } in &list.conduct {
        let tests: Vec<String> = tests.iter().map(|test| format!("`{test}`")).collect();
        let _ = writeln!(page, "| {promise} | {} |", tests.join(", "));
    }
    page += "\n## Not promised\n\n";
    for line in &list.not_promised {
        let _ = writeln!(page, "- {line}");
    }
    page
}

/// Inputs with their ranges.
fn ranges(inputs: &[Range]) -> String {
    let number =
        |x: &f64| if *x != 0.0 && !(1e-3..1e5).contains(&x.abs()) { format!("{x:e}") } else { x.to_string() };
    let one = |Range(name, low, high): &Range| format!("{name} {} to {}", number(low), number(high));
    inputs.iter().map(one).collect::<Vec<_>>().join(", ")
}

const HEAD: &str = "\
# What is promised, and by which test

`cargo run --release -p lobefit-promises > docs/promises.md` prints this page from `docs/promises.json`, which the tests read their bars
from. A public function of numbers, a quantity or a formula without an entry fails `crates/promises/tests/complete.rs`. `cargo test --release
--workspace` runs all of the tests, and `.ci/nightly` what takes longer.

Every quantity has a value all over its inputs, with no negative energy; where it has a second opinion by Monte Carlo both agree within the
sum of their errors; what lies outside is an error that names the input (`crates/promises/tests/attack/quantities.rs`). Alpha 0 is a mirror,
and has a value too where the domain begins at 0.
";

const FORMULAS: &str = "
## Formulas

Largest error of the use that each is fitted for (`eval --help` and the manifest name it), and the largest as a part of the truth (– where that comes
next to 0 and the error is all of it or more), in f32, with coefficients rounded. The certificate of a scene's own domain, and that in half precision, stand in its manifest.

| formula | operations | largest error | of the truth | over | fitted by |
|---|---|---|---|---|---|
";

const TABLES: &str = "
## Tables

Largest error of a lookup in what the built-in scene bakes, n_dot_v from 0.001 on. `crates/promises/tests/complete.rs` holds
the manifest to these and to the errors of formulas, `tests/effects/lookup.rs`, `tests/emitted/sliced.rs` and `lobefit check` the files to it.
With weights of 8 bits no E lies above 1, and no B above E, by more than this error (`tests/emitted/hardware.rs`).

| table | texels | axes | f32 weights | of the truth | weights of 8 bits |
|---|---|---|---|---|---|
";

const BEYOND: &str = "
## Emitted functions

Emitted functions of numbers as GPUs may run them, in f32 with subnormal numbers flushed, sums of products fused or not, quotients and roots
2.5 ulp off either way: each value moves by less than 3e-6 of 1 and its size; the normal of a probe's proxy, in an edge of width `bend`, by less than
3e-7 over that width. A NaN among the arguments gives a NaN, or a finite number where min and max drop it; one in a ray may make an infinity.
With mu down to 1e-4, roughness 0 to 1, ior 1 to 3 and rho 1e-3 to 1000 they are finite (`tests/emitted/hardware.rs`). These alone may be below 0:

- directions and texture coordinates
";

const FUNCTIONS: &str = "
## Functions

In f64, beside textbook forms in 320 bits at 100 000 points each, crowded within twelve decades of both ends, on them and beside them, below the least normal number, and on the diagonals
(`crates/promises/tests/attack/main.rs`). To every bar 1e-60 is added. A NaN of an input that the value depends on gives a NaN. Samplers of
visible normals have the density of Smith's theory by chi-square, for alpha down to 1e-4 (`crates/promises/tests/attack/samplers.rs`).

| function | inputs | within | |
|---|---|---|---|
";
