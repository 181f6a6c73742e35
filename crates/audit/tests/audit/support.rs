//! Tables as engines ship them, made by the tests, and what an audit reads of them.

use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditedTable, Channel, Column, Fixed, Registration, Scale, Source, Verdict, audit,
};
use lobefit_audit::foreign::Step;
use lobefit_truth::integrate::reflection::{Effort, split};
use lobefit_truth::quantity;

/// A channel: its name, and its value at a column and a row.
pub type Filled<'a> = (&'a str, &'a dyn Fn(usize, usize) -> f64);

/// A table of so many texels along each axis, with the values of each channel.
pub fn shipped(size: &[usize], channels: Vec<(&str, Vec<f64>)>) -> AuditedTable {
    let channel = |(name, values): (&str, Vec<f64>)| Channel { name: name.into(), values: values.into() };
    AuditedTable {
        what: "shipped".into(),
        size: size.to_vec(),
        axes: AuditedTable::axes_of(size.len()),
        source: Source::Table,
        channels: channels.into_iter().map(channel).collect(),
        step: Step::None,
        scale: 1.0,
        dead: Vec::new(),
    }
}

/// The same of two axes, of so many columns and rows.
pub fn plane([width, height]: [usize; 2], channels: &[Filled]) -> AuditedTable {
    let values =
        |f: &dyn Fn(usize, usize) -> f64| (0..width * height).map(|i| f(i % width, i / width)).collect();
    shipped(&[width, height], channels.iter().map(|(name, f)| (*name, values(f))).collect())
}

/// A value in eight bits.
pub fn eight(x: f64) -> f64 {
    (x.clamp(0.0, 1.0) * 255.0).round() / 255.0
}

/// The audit of a table; a test that fails shows what it says.
pub fn run(shipped: &AuditedTable, quantity: &str, fixed: &Fixed) -> Audit {
    let found = audit(shipped, quantity::find(quantity).unwrap(), fixed, &|_| ()).unwrap();
    eprintln!("{}\n{:#?}\n{}", said(&found), found.tried.iter().take(2).collect::<Vec<_>>(), found.margin);
    found
}

/// The same as E, A or B of GGX, with nothing stated.
pub fn reflection_of(shipped: &AuditedTable) -> Audit {
    run(shipped, "ggx-reflection", &Fixed::default())
}

/// Why a table is not audited.
pub fn refused(shipped: &AuditedTable, quantity: &str, fixed: &Fixed) -> String {
    audit(shipped, quantity::find(quantity).unwrap(), fixed, &|_| ()).unwrap_err().to_string()
}

/// The verdict as it is printed.
pub fn said(found: &Audit) -> String {
    found.verdict(None).to_string()
}

/// The verdict as it is printed, of a grade, with each of some words in it.
pub fn says(verdict: &Verdict, grade: &str, words: &[&str]) {
    let text = verdict.to_string();
    assert!(text.starts_with(&format!("{grade} ")), "not {grade}: {text}");
    words.iter().for_each(|word| assert!(text.contains(word), "no `{word}` in {text}"));
}

/// Scale, registration and direction of every axis.
pub fn axes(found: &Audit) -> Vec<(Scale, Registration, bool)> {
    found.best().axes.iter().map(|a| (a.scale, a.registration, a.reversed)).collect()
}

/// Rising axes of these coordinates, all of one registration.
pub fn rising(scales: &[Scale], registration: Registration) -> Vec<(Scale, Registration, bool)> {
    scales.iter().map(|scale| (*scale, registration, false)).collect()
}

pub fn columns(found: &Audit) -> Vec<Option<Column>> {
    found.best().columns.clone()
}

/// E and B of GGX.
pub fn both(smith: Smith, alpha: f64, mu: f64) -> (f64, f64) {
    split(smith, alpha, mu, &Effort::ladder()[1])
}

/// A value as an f16 holds it.
pub fn half(x: f64) -> f64 {
    half::f16::from_f64(x).to_f64()
}

/// A fixed scramble in [-1, 1] of a texel.
pub fn jitter(i: usize, j: usize) -> f64 {
    let mut h =
        (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (j as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
    h ^= h >> 29;
    h = h.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h ^= h >> 32;
    (h >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
