//! The search: at every cost the best forms of each family so far are built upon, until nothing new
//! is found or the sweeps are over.
//!
//! Families keep apart what would crowd one another out: a small quotient is worse than a
//! polynomial of its cost, and grows into something better.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::Progress;
use super::form::{Form, Term};
use super::helper::Helper;
use super::score::{Data, Known, Score};
use super::space::{SLOTS, Space};
use super::write::layout;

/// A form that has been measured.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub form: Form,
    pub ops: u32,
    pub score: Score,
    /// Whether its neighbours have been tried.
    expanded: bool,
}

/// A dearer form is kept to be built upon if its error is below this multiple of the best of the
/// cheaper ones, and of what is known to be reached at its cost.
const WORSE: f64 = 1.6;

/// The cost from which on forms are measured by what else is known: cheaper ones grow into good ones
/// that are found in no other way.
const DEAR: u32 = 14;

/// Entries of each cost and family, best first.
type Levels = BTreeMap<(u32, Family), Vec<Entry>>;

/// Polynomial or quotient, and the kinds of its helpers.
type Family = (bool, Vec<Helper>);

fn family(form: &Form) -> Family {
    let mut helpers: Vec<Helper> = form.helpers.iter().map(|h| h.kind).collect();
    helpers.sort_unstable();
    (form.under.is_empty(), helpers)
}

/// The best forms of every cost and family.
pub(super) struct Beam<'a> {
    space: &'a Space,
    data: Data<'a>,
    /// Least errors of forms that are no quotients, by cost; none beyond the end.
    least: &'a [f64],
    levels: Levels,
    seen: BTreeSet<Form>,
    tried: u64,
}

impl<'a> Beam<'a> {
    pub fn new(space: &'a Space, data: Data<'a>, least: &'a [f64]) -> Beam<'a> {
        Beam { space, data, least, levels: BTreeMap::new(), seen: BTreeSet::new(), tried: 0 }
    }

    /// Runs the search: the best forms of every cost, of all families.
    pub fn run(mut self, progress: &dyn Fn(&Progress)) -> Vec<Vec<Entry>> {
        let seeds = seeds(self.space);
        self.take(seeds.into_iter().map(|form| (form, None)).collect());
        for sweep in 0..self.space.sweeps {
            let mut any = false;
            for ops in 0..=self.space.max_ops {
                any |= self.expand(ops);
                self.report(sweep, ops, progress);
            }
            if !any {
                break;
            }
        }
        let all = |ops: u32| {
            let mut all: Vec<Entry> = self.families(ops).flat_map(|l| l.iter().cloned()).collect();
            all.sort_by(better);
            all
        };
        (0..=self.space.max_ops).map(all).collect()
    }

    /// The entries of every family of a cost.
    fn families(&self, ops: u32) -> impl Iterator<Item = &Vec<Entry>> {
        self.levels.iter().filter(move |((o, _), _)| *o == ops).map(|(_, level)| level)
    }

    fn report(&self, sweep: usize, ops: u32, progress: &dyn Fn(&Progress)) {
        let all = (0..=ops).flat_map(|ops| self.families(ops)).filter_map(|level| level.first());
        let best = all.map(|e| e.score.max).fold(f64::INFINITY, f64::min);
        let (sweeps, max_ops) = (self.space.sweeps, self.space.max_ops);
        progress(&Progress { trial: None, sweep, sweeps, ops, max_ops, forms: self.tried, best });
    }

    /// Tries the neighbours of all forms of a cost that have not been built upon.
    fn expand(&mut self, ops: u32) -> bool {
        let mut parents = Vec::new();
        for (_, level) in self.levels.iter_mut().filter(|((o, _), _)| *o == ops) {
            for entry in level.iter_mut().filter(|e| !e.expanded) {
                entry.expanded = true;
                parents.push(entry.clone());
            }
        }
        let pairs =
            parents.iter().flat_map(|p| p.form.neighbours(self.space).into_iter().map(move |f| (f, Some(p))));
        let candidates: Vec<_> = pairs.collect();
        let any = !candidates.is_empty();
        self.take(candidates);
        any
    }

    /// Measures new forms and keeps the good ones.
    fn take(&mut self, candidates: Vec<(Form, Option<&Entry>)>) {
        let mut fresh: Vec<(Form, Option<&Entry>)> = Vec::new();
        for (form, parent) in candidates {
            if let Some(form) = form.canonical(self.space)
                && self.seen.insert(form.clone())
            {
                fresh.push((form, parent));
            }
        }
        self.tried += fresh.len() as u64;
        let measured: Vec<Option<Entry>> =
            fresh.par_iter().map(|(form, parent)| self.measure(form, *parent)).collect();
        for entry in measured.into_iter().flatten() {
            self.levels.entry((entry.ops, family(&entry.form))).or_default().push(entry);
        }
        for level in self.levels.values_mut() {
            level.sort_by(better);
            level.truncate(self.space.width);
        }
    }

    fn measure(&self, form: &Form, parent: Option<&Entry>) -> Option<Entry> {
        let family = family(form);
        // The cost first: it is exact but for the unit, whose coefficient must not be 0.
        let cheapest = layout(self.space, form, |_| true)?.ops;
        if cheapest > self.space.max_ops {
            return None;
        }
        let known = parent.map(|p| Known { form: &p.form, coefficients: &p.score.coefficients });
        let score = self.data.score(form, known.as_ref(), self.cutoff(cheapest, &family))?;
        let ops = layout(self.space, form, |k| usable(form, &score, k))?.ops;
        (ops <= self.space.max_ops && (ops == cheapest || score.max < self.cutoff(ops, &family)))
            .then(|| Entry { form: form.clone(), ops, score, expanded: false })
    }

    /// What a form of this cost and family must be better than.
    fn cutoff(&self, ops: u32, family: &Family) -> f64 {
        let at = |ops: u32| self.levels.get(&(ops, family.clone()));
        let cheaper = (0..ops).filter_map(at).filter_map(|l| l.first()).map(|e| WORSE * e.score.max);
        let own = at(ops).filter(|l| l.len() >= self.space.width).and_then(|l| l.last());
        let known = self.least.get(ops as usize).filter(|_| ops >= DEAR).map(|max| WORSE * max);
        cheaper.chain(own.map(|e| e.score.max)).chain(known).fold(f64::INFINITY, f64::min)
    }
}

/// By error, and by form where that is the same.
fn better(a: &Entry, b: &Entry) -> std::cmp::Ordering {
    a.score.max.total_cmp(&b.score.max).then_with(|| a.form.cmp(&b.form))
}

/// A coefficient below this part of the largest is not divided by.
const SMALL: f64 = 1e-4;

/// Whether the form can be scaled so that the coefficient of this term is 1: it is not next to 0,
/// and positive in Q.
pub(super) fn usable(form: &Form, score: &Score, term: usize) -> bool {
    let top = score.coefficients.iter().fold(0.0_f64, |t, c| t.max(c.abs()));
    let value = score.coefficients[term];
    let size = if term < form.under.len() { value } else { value.abs() };
    size > SMALL * top
}

/// One term above; nothing, or two terms below.
fn seeds(space: &Space) -> Vec<Form> {
    let low = low_terms(space);
    let mut found = Vec::new();
    for over in &low {
        found.push(Form { over: vec![*over], under: Vec::new(), helpers: Vec::new() });
        for (k, first) in low.iter().enumerate() {
            for second in &low[..k] {
                found.push(Form { over: vec![*over], under: vec![*first, *second], helpers: Vec::new() });
            }
        }
    }
    found
}

/// Highest power of an axis in a seed.
const SEED: u8 = 4;

/// Terms of low powers.
fn low_terms(space: &Space) -> Vec<Term> {
    let mut terms = vec![[0; SLOTS]];
    for (slot, axis) in space.axes.iter().enumerate() {
        let step = if axis.arguments.len() > 1 { SEED } else { SEED / 2 };
        let more = |t: &Term| {
            (0..=axis.degree.min(step))
                .map(|p| {
                    let mut t = *t;
                    t[slot] = p;
                    t
                })
                .collect::<Vec<_>>()
        };
        terms = terms.iter().flat_map(more).collect();
    }
    terms
}
