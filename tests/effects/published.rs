//! The published fits of the catalogue have the errors that the published comparison prints: on its
//! grid of 200 x 200, within 2 % or one unit of the last digit.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use crate::published_support;

use std::sync::LazyLock;

use lobefit::approximate::Entry;
use lobefit::data::Smith;
use lobefit::effects::reflection::{PUBLISHED, PUBLISHED_AVERAGES, PUBLISHED_BLENDS, SEEDS};
use lobefit::effects::sheen;
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::reflection::{TOLERANCE, average, reflection};
use lobefit_truth::quantity::sheen::albedo as charlie;
use published_support::forms::{BIASES, NORMALISATIONS};
use published_support::page::{CORRELATED_B, Fed, ROWS, Row, SEPARABLE};
use published_support::{Column, Grid, differs, evaluate, figures};

static CORRELATED: LazyLock<Grid> = LazyLock::new(|| Grid::new(Smith::Correlated));
static SEPARATE: LazyLock<Grid> = LazyLock::new(|| Grid::new(Smith::Separable));

/// The values of a formula by name and prefix.
fn entry(prefix: &str, name: &str) -> &'static Entry {
    let full = format!("{prefix}_{name}");
    let known = PUBLISHED
        .iter()
        .chain(&PUBLISHED_BLENDS)
        .chain(&PUBLISHED_AVERAGES)
        .chain(&SEEDS)
        .chain(&sheen::PUBLISHED);
    let find = known.into_iter().find(|entry| entry.name() == full);
    find.copied()
        .map(|e| &*Box::leak(Box::new(e)))
        .unwrap_or_else(|| panic!("{full} is not in the catalogue"))
}

/// The grid's roughness as an input of a formula.
fn feed(fed: Fed) -> fn(&str, f64) -> f64 {
    match fed {
        Fed::Right => |name, r| if name == "alpha" { r * r } else { r },
        Fed::SquareRoot => |_, r| r * r,
        Fed::FourthPower => |_, r| {
            let gloss = (1.0 - r).powi(4);
            (1.0 - gloss) * (1.0 - gloss)
        },
        Fed::Roughness => |_, r| r,
        Fed::Squared => |_, r| r * r * r * r,
        Fed::Both => |name, r| if name == "alpha" { r } else { r.sqrt() },
    }
}

/// E and B (empty: none) of a row's formula.
fn albedos(row: &Row, grid: &Grid) -> (Vec<f64>, Vec<f64>) {
    let feed = feed(row.fed);
    if row.blend.is_empty() {
        let n = evaluate(entry("ggx_norm", row.norm), grid, 0.0, feed);
        return (n.iter().map(|n| 1.0 / n).collect(), Vec::new());
    }
    let blend = entry("ggx_blend", row.blend);
    (evaluate(blend, grid, 1.0, feed), evaluate(blend, grid, 0.0, feed))
}

fn three(what: &str, column: Column, printed: &str, out: &mut Vec<String>) {
    for (figure, (name, measured)) in
        figures(printed).into_iter().zip([("max", column.max), ("rms", column.rms), ("p99", column.p99)])
    {
        out.extend(differs(&format!("{what} {name}"), measured, figure));
    }
}

/// Figures of the page that are not met, what is measured in their place, and why;
/// [`exceptions_have_their_reason`] shows it.
const EXCEPTIONS: [&str; 3] = [
    // The page left out the clamp of A that MaterialX has.
    "M1 A rms: 0.01200, printed .013",
    // These rows of the page were made on 60 x 60 points, where the edges weigh more.
    "G B rms, separable: 0.00582, printed .0060",
    "I E, separable rms: 0.04375, printed .045",
];

/// No differences but the known ones, of which `known` belong here.
fn assert_known(differences: &[String], known: &[&str]) {
    assert!(differences.iter().map(String::as_str).eq(known.iter().copied()), "{}", differences.join("\n"));
}

fn correlated(row: &Row) -> Vec<String> {
    let grid = &*CORRELATED;
    let (e, b) = albedos(row, grid);
    let mut out = Vec::new();
    three(&format!("{} E", row.id), Column::of(&e, &grid.e), row.e, &mut out);
    if !b.is_empty() {
        three(&format!("{} B", row.id), Column::of(&b, &grid.b), row.b, &mut out);
        let difference = |e: &[f64], b: &[f64]| -> Vec<f64> { e.iter().zip(b).map(|(e, b)| e - b).collect() };
        let a = Column::of(&difference(&e, &b), &difference(&grid.e, &grid.b));
        three(&format!("{} A", row.id), a, row.a, &mut out);
    }
    let n: Vec<f64> = if row.norm.is_empty() {
        e.iter().map(|e| 1.0 / e).collect()
    } else {
        evaluate(entry("ggx_norm", row.norm), grid, 0.0, feed(row.fed))
    };
    let exact: Vec<f64> = grid.e.iter().map(|e| 1.0 / e).collect();
    out.extend(differs(&format!("{} 1/E", row.id), Column::of(&n, &exact).max, row.inverse));
    let kept: Vec<f64> = n.iter().zip(&grid.e).map(|(n, e)| n * e).collect();
    let furnace = Column::of(&kept, &vec![1.0; kept.len()]);
    three(&format!("{} furnace", row.id), furnace, row.furnace, &mut out);
    let (r, mu) = row.worst.split_once(',').expect("two numbers");
    out.extend(differs(&format!("{} worst r", row.id), grid.roughness[furnace.worst], r));
    out.extend(differs(&format!("{} worst mu", row.id), grid.mu[furnace.worst], mu));
    out
}

#[test]
fn error_columns_against_correlated_smith() {
    let differences: Vec<String> = ROWS.iter().flat_map(correlated).collect();
    assert_known(&differences, &EXCEPTIONS[..1]);
}

fn separable(grid: &Grid) -> Vec<String> {
    let mut out = Vec::new();
    for (id, e_printed, b_printed) in SEPARABLE {
        let (e, b) = albedos(row(id), grid);
        three(&format!("{id} E, separable"), Column::of(&e, &grid.e), e_printed, &mut out);
        for printed in figures(b_printed) {
            out.extend(differs(&format!("{id} B rms, separable"), Column::of(&b, &grid.b).rms, printed));
        }
    }
    out
}

fn row(id: &str) -> &'static Row {
    ROWS.iter().find(|row| row.id == id).expect("a row")
}

#[test]
fn errors_against_separable_smith() {
    assert_known(&separable(&SEPARATE), &EXCEPTIONS[1..]);
    let rms = |(id, printed): (&str, &str)| {
        let (_, b) = albedos(row(id), &CORRELATED);
        differs(&format!("{id} B rms"), Column::of(&b, &CORRELATED.b).rms, printed)
    };
    assert_known(&CORRELATED_B.into_iter().filter_map(rms).collect::<Vec<_>>(), &[]);
}

#[test]
fn exceptions_have_their_reason() {
    assert_known(&separable(&Grid::of(Smith::Separable, 60)), &[]);
    let clamped = entry("ggx_blend", "materialx_m1");
    let source = clamped.source.replace("saturate(r1 / r3)", "(r1 / r3)");
    assert_ne!(source, clamped.source);
    let free = Entry { source: source.leak(), ..*clamped };
    let [e, b] = [1.0, 0.0].map(|f0| evaluate(&free, &CORRELATED, f0, feed(Fed::Right)));
    let a = |e: &[f64], b: &[f64]| -> Vec<f64> { e.iter().zip(b).map(|(e, b)| e - b).collect() };
    let column = Column::of(&a(&e, &b), &a(&CORRELATED.e, &CORRELATED.b));
    let mut out = Vec::new();
    three("M1 A without its clamp", column, ".112/.013/.056", &mut out);
    assert_known(&out, &[]);
}

/// Values of a formula of one input.
fn curve(entry: &Entry, inputs: &[f64]) -> Vec<f64> {
    let hypothesis = Hypothesis::parse(entry.file, entry.source).expect("parses");
    let column: Vec<f32> = inputs.iter().map(|x| *x as f32).collect();
    let columns = vec![column; hypothesis.inputs().len()];
    hypothesis.tape().evaluate(&columns, &[]).expect("finite").into_iter().map(f64::from).collect()
}

#[test]
fn averages_and_what_is_taken_for_one() {
    let roughness: Vec<f64> = (0..200).map(|i| 0.02 + 0.98 * f64::from(i) / 199.0).collect();
    let alpha: Vec<f64> = roughness.iter().map(|r| r * r).collect();
    let mean = |a: &f64| average(Smith::Correlated, *a, TOLERANCE).expect("in the domain").e_avg;
    let facing = |a: &f64| reflection(Smith::Correlated, *a, 1.0, TOLERANCE).expect("in the domain").e;
    let (mean, facing): (Vec<f64>, Vec<f64>) = alpha.iter().map(|a| (mean(a), facing(a))).unzip();
    let refit = |r: f64| 1.0 + r * r * r * (-0.297_094 + r * (-3.085_49 + r * (4.398_58 - 1.606_95 * r)));
    let mut out = Vec::new();
    let mut judge = |what: &str, found: &[f64], exact: &[f64], printed: [&str; 2]| {
        let column = Column::of(found, exact);
        out.extend(differs(&format!("{what} max"), column.max, printed[0]));
        if !printed[1].is_empty() {
            out.extend(differs(&format!("{what} rms"), column.rms, printed[1]));
        }
    };
    let dassault = entry("ggx_eavg", "dassault");
    let squares: Vec<f64> = alpha.iter().map(|a| a * a).collect();
    judge("Dassault", &curve(dassault, &alpha), &mean, [".0046", ".0027"]);
    judge("Dassault fed r", &curve(dassault, &roughness), &mean, [".18", ""]);
    judge("Dassault fed alpha^2", &curve(dassault, &squares), &mean, [".18", ""]);
    judge("C7", &curve(entry("ggx_eavg", "chebyshev"), &alpha), &mean, [".00037", ".00017"]);
    let refitted: Vec<f64> = roughness.iter().map(|r| refit(*r)).collect();
    judge("re-fit", &refitted, &mean, [".00009", ".00005"]);
    let cycles = curve(entry("ggx_eavg", "cycles"), &alpha);
    judge("Cycles against E(1, alpha)", &cycles, &facing, [".00033", ""]);
    judge("Cycles against E_avg", &cycles, &mean, [".10", ""]);
    assert!(out.is_empty(), "{}", out.join("\n"));
}

/// The page's sheen rows are those of roughness from 0.1, of which it does not speak, with the
/// truth clamped to 1 as the formula is: without the clamp its largest error there is 2.9. (The row
/// of three.js before November 2025 is of a formula that it does not print.)
#[test]
fn sheen_of_three_js() {
    let grid = Grid::over(0.1, 200);
    let found = evaluate(&sheen::PUBLISHED[0], &grid, 0.0, feed(Fed::Right));
    let whole = grid.map(|r, mu| charlie(r * r, mu));
    let clamped: Vec<f64> = whole.iter().map(|e| e.min(1.0)).collect();
    let mut out = Vec::new();
    three("three.js", Column::of(&found, &clamped), ".82/.16", &mut out);
    assert_known(&out, &[]);
    let unclamped = Column::of(&found, &whole);
    assert!((2.89..2.92).contains(&unclamped.max) && unclamped.worst == 0, "{unclamped:?}");
}

#[test]
fn forms_with_their_printed_coefficients() {
    let grid = &*CORRELATED;
    let ones = vec![1.0; grid.e.len()];
    let ratio: Vec<f64> = grid.b.iter().zip(&grid.e).map(|(b, e)| b / e).collect();
    let mut out = Vec::new();
    for (id, form, printed) in NORMALISATIONS {
        let n = grid.map(|r, mu| form(r, r * r, mu));
        let kept: Vec<f64> = n.iter().zip(&grid.e).map(|(n, e)| n * e).collect();
        three(id, Column::of(&kept, &ones), printed, &mut out);
    }
    for (id, form, of_b, of_ratio) in BIASES {
        let found = grid.map(|r, mu| form(r, r * r, mu));
        three(&format!("{id} B"), Column::of(&found, &grid.b), of_b, &mut out);
        three(&format!("{id} b"), Column::of(&found, &ratio), of_ratio, &mut out);
    }
    assert_known(&out, &[]);
}
