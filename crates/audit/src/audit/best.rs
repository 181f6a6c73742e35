//! The best convention of a table: of the quantity's own lobes, then of the shadowings of others.

use super::column::Column;
use super::convention::Fixed;
use super::errors::Residuals;
use super::found::Audit;
use super::judge::judge;
use super::lobe::Form;
use super::sample::{Candidate, Sample};
use super::screen::Sieved;
use super::table::{AuditedTable, Source};
use super::truth::{self, Truth};
use super::{
    AuditError, QUICK_ROUND, Registration, SIEVE, TOLD, arguments, audited, candidates, check_axes, finish,
    screen,
};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::Quantity;

/// A table with what is known of it.
#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub table: &'a AuditedTable,
    /// The channels that vary, by their place.
    pub live: &'a [usize],
    pub fixed: &'a Fixed,
    pub progress: &'a dyn Fn(&str),
}

/// The best convention.
pub(super) struct Best<'a> {
    pub truth: Truth<'a>,
    pub found: Vec<Candidate>,
    pub sieved: Sieved,
    /// Of the first of those that were found, [`off`].
    pub off: f64,
}

impl Best<'_> {
    /// All that is to be known of it.
    pub fn audit(&self, case: &Case) -> Result<Audit, AuditError> {
        (case.progress)("errors under the best convention");
        finish(&self.truth, case, &self.found, None)
    }
}

/// What is tried on a table.
struct Search<'a> {
    quantity: &'a dyn Quantity,
    forms: Vec<&'static Form>,
    /// Of the quantity's own lobes, or of the form that is given.
    truth: Truth<'a>,
    fixed: Fixed,
    few: Sample,
}

impl<'a> Search<'a> {
    fn new(case: &Case, quantity: &'a dyn Quantity) -> Result<Search<'a>, AuditError> {
        let Case { table, live, fixed, .. } = *case;
        let forms = forms(quantity, fixed)?;
        let own = forms.iter().copied().filter(|form| fixed.form.is_some() || form.integrand.is_none());
        let truth = truth_of(table, quantity, fixed, &own.collect::<Vec<_>>())?;
        check_axes(table, &truth)?;
        fixed.check(&truth, table.size.len(), live.len())?;
        let role = |name: &String| arguments::role(name).filter(|role| truth.spec.inputs.contains(role));
        let mut roles: Vec<_> = table.axes.iter().map(role).collect();
        if fixed.swapped {
            roles.reverse();
        }
        let results: Vec<&str> = live.iter().map(|k| table.channels[*k].name.as_str()).collect();
        let sampled = Fixed {
            registrations: Some(vec![Registration::Centre]),
            roles: Some(roles),
            told: Column::named(&results, truth.spec.columns),
            ..fixed.clone()
        };
        let fixed = if table.source == Source::Function { sampled } else { fixed.clone() };
        let few = Sample::new(table, live, SIEVE[usize::from(table.size.len() == 3)], true);
        Ok(Search { quantity, forms, truth, fixed, few })
    }

    fn own(&self) -> Result<Sieved, AuditError> {
        screen::screen(&self.truth, &self.few, &self.fixed, &self.fixed.lobes(&self.truth))
    }

    /// Whether there are shadowings of others, none of which is given.
    fn has_others(&self) -> bool {
        self.fixed.form.is_none() && self.forms.iter().any(|form| form.integrand.is_some())
    }

    /// The conventions of others' shadowings.
    fn others(&self, table: &AuditedTable) -> Result<Sieved, AuditError> {
        let Search { quantity, forms, fixed, .. } = self;
        let spec = spec_of(table, *quantity, fixed)?;
        let rough = Truth::new(spec, forms, &sides(fixed), true)?.within(&fixed.domain);
        let foreign = |lobe: &usize| rough.lobes[*lobe].form.integrand.is_some();
        let lobes: Vec<usize> = (0..rough.lobes.len()).filter(foreign).collect();
        screen::screen(&rough, &self.few, fixed, &lobes)
    }
}

/// The channels, by their place among those that vary, that may follow a convention of a quantity on
/// their own, as far as a sieve tells.
pub(super) fn promising(case: &Case, quantity: &dyn Quantity) -> Result<Vec<usize>, AuditError> {
    let search = Search::new(case, quantity)?;
    let mut sieved = search.own()?;
    let all = 0..case.live.len();
    if search.has_others() && !sieved.all_promising() {
        sieved = sieved.beside(&search.others(case.table)?);
    }
    Ok(all.filter(|k| sieved.is_promising(*k)).collect())
}

/// The best convention of the quantity's own lobes, and where those leave something to be explained,
/// of the shadowings of others; none where no texel has a truth under any.
pub(super) fn best<'a>(case: &Case, quantity: &'a dyn Quantity) -> Result<Option<Best<'a>>, AuditError> {
    let Case { table, progress, .. } = *case;
    progress("truth");
    let search = Search::new(case, quantity)?;
    let case = &Case { fixed: &search.fixed, ..*case };
    progress("conventions on a few texels");
    let sieved = search.own()?;
    let found = candidates(&search.truth, case, sieved.list.clone())?;
    let Some(first) = found.first() else { return Ok(None) };
    let off = off(&search.truth, case, first)?;
    if !search.has_others() || off <= CLOSE {
        return Ok(Some(Best { truth: search.truth, found, sieved, off }));
    }
    progress("other shadowings");
    let likely = search.others(table)?;
    let sieved = sieved.beside(&likely);
    let worth = likely.all_promising() || table.source == Source::Function;
    if worth && likely.rank() * WORTH_A_TRY < sieved.rank() {
        let all = truth_of(table, quantity, case.fixed, &search.forms)?;
        let mut others = candidates(&all, case, likely.list)?;
        if others.first().is_some_and(|first| first.fitted.rank * BEYOND < found[0].fitted.rank) {
            let first = others.remove(0);
            let off = self::off(&all, case, &first)?;
            others = [vec![first], screen::best([others, found].concat(), TOLD - 1)].concat();
            return Ok(Some(Best { truth: all, found: others, sieved, off }));
        }
    }
    Ok(Some(Best { truth: search.truth, found, sieved, off }))
}

/// How many times better the shadowing of another than the quantity's variants must rank to be
/// told.
const BEYOND: f64 = 1.5;

/// How many times better it must rank in the sieve to be looked at closely.
const WORTH_A_TRY: f64 = 1.2;

/// Root mean square of a table, beside the spread of the truth, that leaves nothing to be explained
/// by another shadowing: sampling noise and rounding leave less.
pub(super) const CLOSE: f64 = 4e-3;

/// The largest misfit of a candidate's channels.
fn off(truth: &Truth, case: &Case, candidate: &Candidate) -> Result<f64, AuditError> {
    let Case { table, live, .. } = *case;
    let sample = Sample::new(table, live, QUICK_ROUND[usize::from(table.size.len() == 3)], false);
    let judgement = judge(truth, &sample, &candidate.axes, candidate.lobe, Truth::ranked)?;
    let channel = |(values, column): (&Vec<f64>, &Option<Column>)| {
        Some(Residuals::new(&sample, &judgement, (*column)?, values).of_all())
    };
    Ok(sample.values.iter().zip(&candidate.fitted.columns).filter_map(channel).fold(0.0, f64::max))
}

/// The shadowing forms that may be meant, of a form that is given and that the quantity's variants
/// do not have with the one that its name stands for, against which it is held.
fn forms(quantity: &dyn Quantity, fixed: &Fixed) -> Result<Vec<&'static Form>, AuditError> {
    let forms = Form::of(quantity);
    match fixed.form {
        Some(form) if forms.contains(&form) && form.integrand.is_some() => Ok(vec![form, forms[0]]),
        Some(form) if forms.contains(&form) => Ok(vec![form]),
        Some(form) => Err(no_form(quantity, form, &forms)),
        None => Ok(forms),
    }
}

/// The truth that the user asks for; only the lobes that may be meant are integrated.
pub(super) fn truth_of<'a>(
    table: &AuditedTable,
    quantity: &'a dyn Quantity,
    fixed: &Fixed,
    forms: &[&'static Form],
) -> Result<Truth<'a>, AuditError> {
    Ok(Truth::new(spec_of(table, quantity, fixed)?, forms, &sides(fixed), false)?.within(&fixed.domain))
}

/// The sides that may be meant.
fn sides(fixed: &Fixed) -> Vec<Side> {
    fixed.side.map_or(vec![Side::Outside, Side::Inside], |side| vec![side])
}

/// What is known of a quantity, of a slice of it, or of its averages: a table without an axis for the cosine
/// may be of those.
fn spec_of<'a>(
    table: &AuditedTable,
    quantity: &'a dyn Quantity,
    fixed: &Fixed,
) -> Result<truth::Spec<'a>, AuditError> {
    let own = truth::spec(quantity);
    if let (Some(own), Some(at)) = (own, fixed.at) {
        return own.slice(at);
    }
    let mean = truth::averaged(quantity).filter(|spec| spec.inputs.len() == table.size.len());
    mean.or(own).ok_or_else(|| AuditError::Option {
        option: "--as",
        value: quantity.name().into(),
        reason: format!("{}: nothing of it can be audited; {} can", table.what, audited()),
    })
}

fn no_form(quantity: &dyn Quantity, form: &Form, forms: &[&Form]) -> AuditError {
    let known = forms.iter().map(|f| f.word).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(", ");
    let reason = match known.as_str() {
        "" => format!("{} has one shadowing form", quantity.name()),
        known => format!("{} has {known}", quantity.name()),
    };
    AuditError::Option { option: "--smith", value: form.word.into(), reason }
}
