//! Published fits by name: a function with the values of a published formula is that formula,
//! whoever ships it.

use super::arguments::role;
use super::axis::{AxisReading, Registration, Scale};
use super::column::{Base, Column};
use super::lobe::Form;
use super::table::{AuditedTable, Source, place};
use super::verdict::number;
use super::{Audit, AuditError, Input};
use lobefit::approximate::Entry;
use lobefit::effects::{eon, reflection, sheen};
use lobefit_shade::Hypothesis;
use lobefit_truth::quantity::Quantity;

/// Largest difference from a published formula, or from what of it is above 0, or in [0, 1]: those who
/// ship one round its constants and order its operations in their own way, and clamp what it gives.
const SAME: f64 = 2e-3;

/// Formulas that were fitted to a lobe that the quantity's variants do not have: name, form.
const MADE_FOR: [(&str, &str); 1] = [("ggx_blend_karis", "schlick")];

/// A published formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// Its name here.
    pub name: &'static str,
    /// Where it was published.
    pub publication: &'static str,
    /// The shadowing that it was fitted to, if that is none of the quantity's own.
    pub made_for: Option<&'static Form>,
}

/// One point in so many is compared.
const STRIDE: usize = 7;

/// The published formula that a function is; none of a table, or of what is published by nobody that is
/// known here.
pub(super) fn named(table: &AuditedTable, done: &Audit) -> Option<Published> {
    of_axes(table, done.quantity, &done.best().axes)
}

/// The inputs that arguments are given whose names say nothing, under which a function is a published
/// formula: roughness or alpha, rising or falling, before mu or behind it.
pub(super) fn meant(table: &AuditedTable, quantity: &str) -> Option<Vec<(Scale, bool)>> {
    if table.size.len() != 2 {
        return None;
    }
    let is_open = |(name, (scale, _)): (&String, &(Scale, bool))| {
        role(name).is_none_or(|said| said == Input::Mu && *scale == Scale::Mu)
    };
    let readings = [Scale::Roughness, Scale::Alpha].into_iter().flat_map(|scale| {
        let rough = [false, true].map(|falls| (scale, falls));
        rough.into_iter().flat_map(|rough| [vec![rough, (Scale::Mu, false)], vec![(Scale::Mu, false), rough]])
    });
    readings.filter(|meant| table.axes.iter().zip(meant).all(is_open)).find(|meant| {
        let axes = meant.iter().map(|(scale, falls)| AxisReading::new(*scale, Registration::Centre, *falls));
        of_axes(table, quantity, &axes.collect::<Vec<_>>()).is_some()
    })
}

fn of_axes(table: &AuditedTable, quantity: &str, axes: &[AxisReading]) -> Option<Published> {
    if table.source != Source::Function {
        return None;
    }
    let known: Vec<&Entry> = match quantity {
        "ggx-reflection" => reflection::PUBLISHED_BLENDS.iter().chain(&reflection::PUBLISHED).collect(),
        "ggx-average" => reflection::PUBLISHED_AVERAGES.iter().collect(),
        "sheen-charlie" => sheen::PUBLISHED.iter().collect(),
        "eon-single" => eon::PUBLISHED.iter().collect(),
        _ => Vec::new(),
    };
    let points = points(table, axes);
    let entry = known.into_iter().find(|entry| is_same(entry, table, &points))?;
    let (name, publication) = (entry.name(), entry.publication?);
    let made_for = MADE_FOR.iter().find(|(known, _)| *known == name);
    Some(Published { name, publication, made_for: made_for.and_then(|(_, form)| Form::find(form)) })
}

/// What is said of a formula for a lobe that is not the quantity's: how far it is from either.
pub(super) fn held(
    known: &Published,
    quantity: &dyn Quantity,
    worst: impl Fn(&'static Form) -> Result<f64, AuditError>,
) -> Result<Option<String>, AuditError> {
    let Some(made_for) = known.made_for else { return Ok(None) };
    let [own, usual] = [made_for, Form::of(quantity)[0]];
    let (near, far) = (number(worst(own)?), number(worst(usual)?));
    Ok(Some(format!(
        "It was made for {}: held against that it is off by at most {near}, against {} by {far}.",
        own.words, usual.words
    )))
}

/// Places of the points that are compared, with alpha and mu there; mu of an average is 1.
fn points(table: &AuditedTable, axes: &[AxisReading]) -> Vec<(usize, [f64; 2])> {
    let count: usize = table.size.iter().product();
    let at = |i: usize| {
        let mut inputs = [1.0; 2];
        for ((axis, k), n) in axes.iter().zip(place(i, &table.size)).zip(&table.size) {
            match axis.scale.input() {
                Input::Alpha => inputs[0] = axis.node(k, *n),
                Input::Mu => inputs[1] = axis.node(k, *n),
                _ => {}
            }
        }
        (i, inputs)
    };
    (0..count).step_by(STRIDE).map(at).collect()
}

/// Whether every channel is a column of a formula: of f0 A + B, of N, or of E.
fn is_same(entry: &Entry, table: &AuditedTable, points: &[(usize, [f64; 2])]) -> bool {
    let Ok(formula) = Hypothesis::parse(entry.file, entry.source) else { return false };
    let at = |f0: f64| {
        let column = |name: &String| -> Vec<f64> {
            let input = |[alpha, mu]: [f64; 2]| match name.as_str() {
                "roughness" => alpha.sqrt(),
                "alpha" => alpha,
                "f0" => f0,
                _ => mu,
            };
            points.iter().map(|(_, inputs)| input(*inputs)).collect()
        };
        let columns: Vec<Vec<f64>> = formula.inputs().iter().map(column).collect();
        let constants: Vec<f64> = formula.starts();
        formula.tape().evaluate(&columns, &constants).unwrap_or_default()
    };
    let blend = formula.inputs().iter().any(|name| name == "f0");
    let [zero, one] = [0.0, 1.0].map(at);
    if zero.len() != points.len() || one.len() != points.len() {
        return false;
    }
    let inverse = entry.name().contains("_norm_");
    let bases: Vec<Base> = zero
        .into_iter()
        .zip(one)
        .map(|(zero, one)| [if inverse { 1.0 / one } else { one }, if blend { zero } else { f64::NAN }, 1.0])
        .collect();
    const COLUMNS: [Column; 5] = [Column::E, Column::B, Column::A, Column::Inverse, Column::Loss];
    let holds = |values: &[f64], column: &Column| {
        let off = |((i, _), base): (&(usize, [f64; 2]), &Base)| {
            let (own, known) = (values[*i], column.value(*base));
            let held = [known, known.max(0.0), known.clamp(0.0, 1.0)];
            held.iter().map(|known| (own - known).abs()).fold(f64::INFINITY, f64::min)
        };
        points.iter().zip(&bases).map(off).all(|off| off <= SAME)
    };
    let mut channels = table.channels.iter().filter(|channel| channel.varies()).peekable();
    channels.peek().is_some()
        && channels.all(|channel| COLUMNS.iter().any(|column| holds(&channel.values, column)))
}
