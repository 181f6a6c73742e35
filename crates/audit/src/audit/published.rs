//! Published fits by name: a function with the values of a published formula is that formula,
//! whoever ships it.

use super::arguments::role;
use super::axis::{AxisReading, Registration, Scale};
use super::column::{Base, Column};
use super::convention::{COLUMN, MEANING};
use super::lobe::Form;
use super::table::{AuditedTable, Source, place};
use super::verdict::number;
use super::{Audit, AuditError, Fit, Fixed, Input};
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
    /// What its channels hold; none of one that is constant and no value of it.
    pub columns: Vec<Option<Column>>,
}

/// One point in so many is compared.
const STRIDE: usize = 7;

/// Notes in an audit which published formula the function is. Returns an audit of it under what that formula
/// is known to hold, and where it fits no shadowing, under the one that is stated or that of its use; nothing
/// where the audit at hand is that one (to which it adds how far the formula is from its own lobe), or the
/// function is no such formula.
pub(super) fn again(
    done: &mut Audit,
    table: &AuditedTable,
    (fixed, quantity): (&Fixed, &dyn Quantity),
    audit: &dyn Fn(&Fixed) -> Result<Audit, AuditError>,
) -> Result<Option<Audit>, AuditError> {
    done.published = of_axes(table, done.quantity, &done.best().axes);
    let Some(known) = &done.published else {
        let meant = if fixed.axes.is_none() { meant(table, done.quantity) } else { None };
        let of_usual =
            |meant| Ok(Audit { fixed: done.fixed, ..audit(&Fixed { axes: Some(meant), ..fixed.clone() })? });
        return meant.map(of_usual).transpose();
    };
    let fits = done.fit != Fit::None;
    if fits && known.columns == done.best().columns {
        return Ok(None);
    }
    let read = || done.best().axes.iter().map(|axis| (axis.scale, axis.reversed)).collect();
    // Those of the channels that are judged.
    let live = table.live(None)?;
    let columns = || live.iter().map(|k| known.columns[*k]).collect();
    let columns = fixed.column.is_none().then(columns);
    let used = Fixed {
        form: fixed.form.or_else(|| (!fits).then(|| Form::of(quantity)[0])),
        axes: Some(fixed.axes.clone().unwrap_or_else(read)),
        meanings: fixed.meanings.clone().or(columns),
        ..fixed.clone()
    };
    if used != *fixed {
        let used = audit(&used)?;
        return Ok(Some(Audit { fixed: done.fixed, excused: done.excused, form: fixed.form, ..used }));
    }
    // What is stated of every channel, or of those that are judged.
    let own = |k: usize, meanings: &[_]| {
        known.columns[if meanings.len() == known.columns.len() { k } else { live[k] }]
    };
    let is_other = |meanings: &Vec<Option<Column>>| {
        (0..meanings.len()).any(|k| meanings[k].is_some() && meanings[k] != own(k, meanings))
    };
    if fixed.meanings.as_ref().is_some_and(is_other) {
        done.excluded = Some(MEANING);
    } else if fixed.column.is_some_and(|column| !known.columns.contains(&Some(column))) {
        done.excluded = Some(COLUMN);
    }
    if let Some(own) = known.made_for.filter(|own| fixed.form != Some(*own)) {
        let off = number(audit(&Fixed { form: Some(own), ..fixed.clone() })?.worst());
        let remark = format!("It was made for {}: held against that it is off by at most {off}.", own.words);
        done.remarks.push(remark);
    }
    Ok(None)
}

/// The inputs, within what the names of its arguments say, under which a function is a published formula:
/// roughness or alpha, rising or falling, before mu or behind it.
fn meant(table: &AuditedTable, quantity: &str) -> Option<Vec<(Scale, bool)>> {
    if table.size.len() != 2 {
        return None;
    }
    let is_open =
        |(name, (scale, _)): (&String, &(Scale, bool))| role(name).is_none_or(|said| said == scale.input());
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
    let (entry, columns) =
        known.into_iter().find_map(|entry| Some((entry, columns(entry, table, &points)?)))?;
    let (name, publication) = (entry.name(), entry.publication?);
    let made_for = MADE_FOR.iter().find(|(known, _)| *known == name);
    Some(Published { name, publication, made_for: made_for.and_then(|(_, form)| Form::find(form)), columns })
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

/// Which column of a formula every channel is, where each is one: of f0 A + B, of N, or of E.
fn columns(entry: &Entry, table: &AuditedTable, points: &[(usize, [f64; 2])]) -> Option<Vec<Option<Column>>> {
    let formula = Hypothesis::parse(entry.file, entry.source).ok()?;
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
        return None;
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
    let mut found = Vec::new();
    for channel in &table.channels {
        let column = COLUMNS.into_iter().find(|column| holds(&channel.values, column));
        if column.is_none() && channel.varies() {
            return None;
        }
        found.push(column);
    }
    found.iter().any(Option::is_some).then_some(found)
}
