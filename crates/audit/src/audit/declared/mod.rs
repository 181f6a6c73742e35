//! A table that says itself what it is, as those that this tool writes do: what it says is read,
//! and then held against the truth. It is looked up as its statement says, between its texels too,
//! all over the domain that it claims.

mod domain;
mod findings;
mod formula;
mod nodes;
mod statement;
mod words;

pub use findings::findings as declared_findings;

use super::column::Column;
use super::errors::{TexelErrors, median, rms, spread};
use super::lobe::Form;
use super::lookup::fetch;
use super::table::AuditedTable;
use super::truth::{Truth, Values, with_azimuth};
use super::verdict::{Figure, Kind, Verdict};
use super::{AuditError, FITS};
use domain::Domain;
use formula::Formula;
use lobefit::data::Place;
use lobefit_truth::quantity::Quantity;
use nodes::Inputs;
use statement::{Axis, Statement};

/// The quantity that a table says it is of, by its name; none of a file that is not this tool's.
///
/// Errors: what cannot be understood of what it says, in words.
pub fn stated_quantity(note: &str) -> Result<Option<&str>, String> {
    if note.is_empty() { Ok(None) } else { statement::table(note).map(|(_, quantity)| Some(quantity)) }
}

/// How much larger than claimed an error may be: it is looked for at other places than the file's
/// maker did.
const SLACK: f64 = 1.2;

/// Place of the one lobe of its truth.
const OWN: usize = 0;

/// Error of a column as the statement says that it is looked up.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// Column.
    pub column: Column,
    /// Figures of the errors.
    pub figures: TexelErrors,
    /// Signed errors, in the truth's order of inputs.
    pub errors: Vec<f64>,
    /// The truth at the same places.
    pub truths: Vec<f64>,
}

impl Held {
    /// Whether it is the column at all, whatever its file claims: by the root mean square, as the
    /// columns of any table.
    fn fits(&self, truth_error: f64) -> bool {
        self.figures.rms <= FITS * self.spread() + truth_error
    }

    /// What its column may have of the error that the file claims. The claim is of f0 A + B for
    /// every f0 in [0, 1], that is of B (f0 = 0) and of E (f0 = 1): A = E - B may be off by both.
    fn share(&self) -> f64 {
        if self.column == Column::A { 2.0 } else { 1.0 }
    }

    /// Difference of the largest and the smallest truth.
    pub fn spread(&self) -> f64 {
        spread(self.truths.iter().copied())
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    /// File and array.
    pub what: String,
    /// Quantity.
    pub quantity: &'static str,
    /// Shadowing form and side.
    pub lobe: String,
    /// Every axis: its letter, what runs along it, its registration and its formula.
    pub axes: Vec<[String; 4]>,
    /// Texels along every axis.
    pub size: Vec<usize>,
    /// Columns that it decodes to.
    pub held: Vec<Held>,
    /// Names of the truth's inputs and the places along each.
    pub places: Vec<(&'static str, Vec<f64>)>,
    /// Texels that are judged beside those places.
    pub texels: usize,
    /// What its axes cover without its claiming anything of it, and so is not judged: `alpha below 0.02`.
    pub beyond: Vec<String>,
    /// What it claims where the truth is not had, so that it was not judged.
    pub cut: Vec<String>,
    /// Largest error that it claims.
    pub claimed: f64,
    /// Bound of the truth's own error.
    pub truth_error: f64,
}

impl Declared {
    /// Largest error of any column.
    pub fn worst(&self) -> f64 {
        self.held.iter().map(|h| h.figures.max).fold(0.0, f64::max)
    }

    /// The figure that the verdict is on: the file's own claim, where that alone is over the limit.
    pub fn figure(&self, limit: Option<f64>) -> Option<Figure> {
        let worst = self.held.iter().reduce(|a, b| if b.figures.max > a.figures.max { b } else { a })?;
        let (value, at) = (worst.figures.max, worst.figures.at.clone());
        let of = worst.column.name().to_string();
        let over = |limit| value <= limit && self.claimed > limit;
        if self.holds() && limit.is_some_and(over) {
            return Some(Figure { value: self.claimed, kind: Kind::Claim, of, at: Place::new() });
        }
        Some(Figure { value, kind: Kind::Lookup, of, at })
    }

    /// The verdict; `limit` is the largest error that the user allows.
    pub fn verdict(&self, limit: Option<f64>) -> Verdict {
        words::verdict(self, limit)
    }

    /// Whether it is what it says: it keeps its claim, and is no further off than any table of the
    /// quantity may be.
    pub fn holds(&self) -> bool {
        self.keeps() && self.held.iter().all(|h| h.fits(self.truth_error))
    }

    /// Whether no error is larger than it claims.
    pub fn keeps(&self) -> bool {
        self.held.iter().all(|h| h.figures.max <= SLACK * h.share() * self.claimed + self.truth_error)
    }

    /// Whether it is what it says, and within a limit wherever it claims something, by its own claim too:
    /// the claim was searched at more places.
    pub fn passes(&self, limit: Option<f64>) -> bool {
        let keeps = |limit| self.figure(Some(limit)).is_some_and(|figure| figure.value <= limit);
        self.holds() && limit.is_none_or(keeps)
    }
}

/// Holds a table against the truth as its own `statement` says that it is looked up; of the
/// columns, only `wanted` if it is given.
///
/// # Errors
/// [`AuditError::Statement`] where what it says cannot be read, speaks of another size, depends on
/// more than the quantity's inputs, leaves no range of an input to judge, or decodes to what is no
/// number; a statement of another quantity; a truth that cannot be had.
pub fn declared(
    table: &AuditedTable,
    quantity: &dyn Quantity,
    wanted: Option<Column>,
    statement: &str,
) -> Result<Declared, AuditError> {
    let odd = |reason: String| AuditError::Statement { what: table.what.clone(), reason };
    let said = Statement::parse(statement).map_err(odd)?;
    let audited = agreed(table, quantity, &said)?;
    let own = |form: &&'static Form| {
        form.integrand.is_none() && form.smith.is_none_or(|smith| said.smith == Some(smith))
    };
    let form = Form::of(quantity).into_iter().find(own);
    let form = form.ok_or_else(|| odd("its line `smith` names no shadowing form".into()))?;
    let fixed = super::Fixed { side: said.side, form: Some(form), ..super::Fixed::default() };
    let no_azimuth = || odd(format!("{} does not depend on the azimuth of the view", quantity.name()));
    let truth = &if said.azimuth {
        Truth::new(with_azimuth(quantity).ok_or_else(no_azimuth)?, &[form], &[], false)?
    } else {
        super::truth_of(&audited, quantity, &fixed, &[form])?
    };
    let domain = Domain::new(truth, OWN, &said).map_err(odd)?;
    let places = &domain.places;
    let at: Vec<&[f64]> = places.iter().map(|p| p.1.as_slice()).collect();
    let base = truth.exact(OWN, &at)?;
    let dims: Vec<usize> = places.iter().map(|p| p.1.len()).collect();
    let even = |i: usize| -> Inputs {
        places.iter().zip(super::table::place(i, &dims)).map(|((name, list), k)| (*name, list[k])).collect()
    };
    let look = Look { table: &audited, said: &said, at: &even, wanted };
    let mut held = look.errors(truth, &base).map_err(odd)?;
    let (texels, nodes) = nodes::nodes(&audited, &said, &domain);
    if !nodes.is_empty() {
        let look = Look { at: &|i| nodes[i].clone(), ..look };
        let base = truth.at(OWN, &nodes)?;
        for (held, own) in held.iter_mut().zip(look.errors(truth, &base).map_err(odd)?) {
            if own.figures.max > held.figures.max {
                let TexelErrors { rms, mean, median, .. } = held.figures;
                held.figures = TexelErrors { rms, mean, median, ..own.figures };
            }
        }
    }
    Ok(Declared {
        what: audited.what.clone(),
        quantity: truth.spec.quantity.name(),
        lobe: truth.lobes[OWN].words(),
        axes: said.axes.iter().zip(&audited.axes).map(|(a, letter)| words::axis(a, letter)).collect(),
        size: audited.size.clone(),
        held,
        claimed: said.claimed,
        truth_error: truth.specs[OWN].bound,
        texels,
        places: domain.places,
        beyond: domain.beyond,
        cut: domain.cut,
    })
}

/// The table in the size that the statement gives it, if the file and the question allow it.
fn agreed(
    table: &AuditedTable,
    quantity: &dyn Quantity,
    said: &Statement,
) -> Result<AuditedTable, AuditError> {
    if said.quantity != quantity.name() {
        let reason = format!("{} says that it holds {}: audit it as that", table.what, said.quantity);
        return Err(AuditError::Option { option: "--as", value: quantity.name().into(), reason });
    }
    let size: Vec<usize> = said.axes.iter().map(|a| a.size).collect();
    let texels = size.iter().try_fold(1_usize, |n, s| n.checked_mul(*s));
    if texels != Some(table.size.iter().product()) || size.first() != table.size.first() {
        let reason = format!("it speaks of {size:?} texels, the file holds {:?}", table.size);
        return Err(AuditError::Statement { what: table.what.clone(), reason });
    }
    let axes = AuditedTable::axes_of(size.len());
    AuditedTable { size, axes, ..table.clone() }.checked()
}

/// Lookups as the statement says.
struct Look<'a> {
    table: &'a AuditedTable,
    said: &'a Statement,
    /// The inputs at a place.
    at: &'a dyn Fn(usize) -> Inputs,
    wanted: Option<Column>,
}

impl Look<'_> {
    /// The columns beside the truth.
    fn errors(&self, truth: &Truth, base: &Values) -> Result<Vec<Held>, String> {
        let columns = self.columns(truth)?;
        let mut values = vec![Vec::with_capacity(base.len()); columns.len()];
        for i in 0..base.len() {
            let inputs = (self.at)(i);
            let decoded = self.decoded(&inputs)?;
            for (list, (column, k)) in values.iter_mut().zip(&columns) {
                let value = decoded[*k];
                if !value.is_finite() {
                    let name = column.name();
                    return Err(format!("its `decode` of {name} gives {value} at {inputs:?}"));
                }
                list.push(value);
            }
        }
        let one = |((column, _), values): (&(Column, usize), Vec<f64>)| {
            let truths: Vec<f64> = base.iter().map(|b| column.value(*b)).collect();
            let errors: Vec<f64> = values.iter().zip(&truths).map(|(v, t)| v - t).collect();
            let worst =
                (0..errors.len()).fold(0, |w, i| if errors[i].abs() > errors[w].abs() { i } else { w });
            let n = errors.len() as f64;
            let at = (self.at)(worst).into_iter().map(|(name, x)| (name.to_string(), x));
            let figures = TexelErrors {
                max: errors[worst].abs(),
                rms: rms(errors.iter().copied()),
                mean: errors.iter().sum::<f64>() / n,
                median: median(errors.iter().map(|e| e.abs()).collect()),
                texel: Vec::new(),
                at: at.collect(),
                value: values[worst],
                truth: truths[worst],
                judged: errors.len(),
                all: errors.len(),
                unsampled: 0,
            };
            Held { column: *column, figures, errors, truths }
        };
        Ok(columns.iter().zip(values).map(one).collect())
    }

    /// The columns that are asked for, with their places in `decode`.
    fn columns(&self, truth: &Truth) -> Result<Vec<(Column, usize)>, String> {
        let column = |name: &str| truth.spec.columns.iter().copied().find(|c| c.name() == name);
        let all = self.said.decode.iter().enumerate().filter_map(|(k, (name, _))| Some((column(name)?, k)));
        let found: Vec<(Column, usize)> = all.filter(|(c, _)| self.wanted.is_none_or(|w| w == *c)).collect();
        if found.is_empty() { Err("it decodes to no column that is asked for".into()) } else { Ok(found) }
    }

    /// What the channels decode to at inputs.
    fn decoded(&self, inputs: &[(&'static str, f64)]) -> Result<Vec<f64>, String> {
        let input = |name: &str| inputs.iter().find(|(n, _)| *n == name).map(|(_, x)| *x);
        let roughness = input("alpha").and_then(|alpha| roughness(self.said, alpha));
        let known = |name: &str| if name == "roughness" { roughness } else { input(name) };
        let mut at = Vec::new();
        for (axis, n) in self.said.axes.iter().zip(&self.table.size) {
            let u = coordinate(axis, &known)
                .filter(|u| u.is_finite())
                .ok_or_else(|| format!("its coordinate `{}` has no value at {inputs:?}", axis.text))?;
            at.push(axis.registration.position(u, *n));
        }
        let texel = |name: &str| {
            let channel = self.table.channels.iter().find(|c| c.name == name)?;
            Some(fetch(&channel.values, &self.table.size, &at))
        };
        let excepted = |name: &str| {
            let here = self.said.exceptions.iter().find(|e| e.name == name && input(&e.at.0) == Some(e.at.1));
            here.map(|e| e.value)
        };
        // A channel may bear the name of what it decodes to: `E = E`.
        let made = made(&self.said.decode, &excepted, &|n| texel(n).or_else(|| known(n)));
        let value = |(name, value): (&(String, Formula), Option<f64>)| {
            value.ok_or_else(|| format!("its `decode` of {} names what is not there", name.0))
        };
        self.said.decode.iter().zip(made).map(value).collect()
    }
}

/// The roughness of an alpha: the alpha maps are powers, which rise on [0, 1], so that halving finds it
/// to the last digits.
fn roughness(said: &Statement, alpha: f64) -> Option<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        let of = said.alpha.value(&|name| (name == "roughness").then_some(middle))?;
        if !of.is_finite() {
            return None;
        }
        if of < alpha { low = middle } else { high = middle }
    }
    Some(high)
}

/// u of an axis.
fn coordinate(axis: &Axis, known: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
    made(&axis.coordinate, &|_| None, known).first().copied().flatten()
}

/// Values of definitions, in their order, each of which may use others of them, besides what is
/// `known`; what is `excepted` has that value whatever its formula. Each is made once; none where a
/// name has no value.
fn made(
    definitions: &[(String, Formula)],
    excepted: &dyn Fn(&str) -> Option<f64>,
    known: &dyn Fn(&str) -> Option<f64>,
) -> Vec<Option<f64>> {
    let mut values: Vec<Option<f64>> = vec![None; definitions.len()];
    loop {
        let open: Vec<usize> = (0..values.len()).filter(|k| values[*k].is_none()).collect();
        for k in &open {
            let (name, formula) = &definitions[*k];
            let other =
                |n: &str| definitions.iter().zip(&values).find(|(d, _)| d.0 == n).and_then(|(_, x)| *x);
            values[*k] = excepted(name).or_else(|| formula.value(&|n| other(n).or_else(|| known(n))));
        }
        if open.iter().all(|k| values[*k].is_none()) {
            return values;
        }
    }
}
