//! The search: at every cost the best forms so far are built upon, until nothing new is found or the sweeps are over.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::Progress;
use super::form::{Form, Term};
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

/// A dearer form is kept to be built upon if its error is below this multiple of the best of the cheaper ones.
const WORSE: f64 = 1.6;

/// The best forms of every cost.
pub(super) struct Beam<'a> {
    space: &'a Space,
    data: Data<'a>,
    levels: BTreeMap<u32, Vec<Entry>>,
    seen: BTreeSet<Form>,
    tried: u64,
}

impl<'a> Beam<'a> {
    pub fn new(space: &'a Space, data: Data<'a>) -> Beam<'a> {
        Beam { space, data, levels: BTreeMap::new(), seen: BTreeSet::new(), tried: 0 }
    }

    /// Runs the search; the best forms of every cost, best first.
    pub fn run(mut self, progress: &dyn Fn(&Progress)) -> BTreeMap<u32, Vec<Entry>> {
        let seeds = seeds(self.space);
        self.take(seeds.into_iter().map(|form| (form, None)).collect());
        for sweep in 0..self.space.sweeps {
            let mut any = false;
            for ops in 0..=self.space.max_ops {
                any |= self.expand(ops);
                let best = self.levels.range(..=ops).filter_map(|(_, l)| l.first()).map(|e| e.score.max);
                let best = best.fold(f64::INFINITY, f64::min);
                progress(&Progress {
                    sweep,
                    sweeps: self.space.sweeps,
                    ops,
                    max_ops: self.space.max_ops,
                    forms: self.tried,
                    best,
                });
            }
            if !any {
                break;
            }
        }
        self.levels
    }

    /// Tries the neighbours of all forms of a cost that have not been built upon.
    fn expand(&mut self, ops: u32) -> bool {
        let Some(level) = self.levels.get_mut(&ops) else { return false };
        let mut parents = Vec::new();
        for entry in level.iter_mut().filter(|e| !e.expanded) {
            entry.expanded = true;
            parents.push(entry.clone());
        }
        let mut candidates = Vec::new();
        for (k, parent) in parents.iter().enumerate() {
            for form in parent.form.neighbours(self.space) {
                candidates.push((form, Some(k)));
            }
        }
        let candidates: Vec<_> = candidates.into_iter().map(|(f, k)| (f, k.map(|k| &parents[k]))).collect();
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
        let cutoffs: Vec<f64> = (0..=self.space.max_ops).map(|ops| self.cutoff(ops)).collect();
        let measured: Vec<Option<Entry>> =
            fresh.par_iter().map(|(form, parent)| self.measure(form, *parent, &cutoffs)).collect();
        for entry in measured.into_iter().flatten() {
            self.levels.entry(entry.ops).or_default().push(entry);
        }
        let width = self.space.width;
        for level in self.levels.values_mut() {
            level.sort_by(|a, b| a.score.max.total_cmp(&b.score.max).then_with(|| a.form.cmp(&b.form)));
            level.truncate(width);
        }
    }

    fn measure(&self, form: &Form, parent: Option<&Entry>, cutoffs: &[f64]) -> Option<Entry> {
        // The cost first: it is exact but for the unit, whose coefficient must not be 0.
        let cheapest = layout(self.space, form, |_| true)?.ops;
        let cutoff = *cutoffs.get(cheapest as usize)?;
        let known = parent.map(|p| Known { form: &p.form, coefficients: &p.score.coefficients });
        let score = self.data.score(form, known.as_ref(), cutoff)?;
        let ops = layout(self.space, form, |k| usable(form, &score, k))?.ops;
        (ops <= self.space.max_ops && score.max < cutoffs[ops as usize]).then(|| Entry {
            form: form.clone(),
            ops,
            score,
            expanded: false,
        })
    }

    /// What a form of this cost must be better than.
    fn cutoff(&self, ops: u32) -> f64 {
        let cheaper = self.levels.range(..ops).filter_map(|(_, l)| l.first()).map(|e| WORSE * e.score.max);
        let own = self.levels.get(&ops).filter(|l| l.len() >= self.space.width).and_then(|l| l.last());
        cheaper.chain(own.map(|e| e.score.max)).fold(f64::INFINITY, f64::min)
    }
}

/// A coefficient below this part of the largest is not divided by.
const SMALL: f64 = 1e-4;

/// Whether the form can be scaled so that the coefficient of this term is 1: it is not next to 0, and positive in Q.
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
