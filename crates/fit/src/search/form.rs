//! A form: anchor + P/Q, P and Q sums of terms with free coefficients; and its neighbours.

use super::helper::Instance;
use super::space::{SLOTS, Space};

/// A product of powers of the axes and helpers.
pub(super) type Term = [u8; SLOTS];

/// Terms of P and Q, sorted; Q is empty for a polynomial. One coefficient of a quotient is fixed by
/// scaling.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Form {
    pub over: Vec<Term>,
    pub under: Vec<Term>,
    pub helpers: Vec<Instance>,
}

/// Highest power of a helper in a term.
const HELPER_DEGREE: u8 = 5;

/// Highest sum of powers in a term.
const TOTAL: u8 = 12;

impl Form {
    /// Free coefficients.
    pub fn coefficients(&self) -> usize {
        self.over.len() + self.under.len().saturating_sub(1)
    }

    /// Sorted, without what cancels, if it is a form of the space: some terms above, not a lone one
    /// below, exact where the anchor asks, helpers used.
    pub fn canonical(mut self, space: &Space) -> Option<Form> {
        for terms in [&mut self.over, &mut self.under] {
            terms.sort_unstable();
            terms.dedup();
        }
        if self.over.is_empty() || self.under.len() == 1 {
            return None;
        }
        if !self.under.is_empty() {
            let common = least(&[least(&self.over), least(&self.under)]);
            self.over.iter_mut().chain(&mut self.under).for_each(|t| *t = less(t, &common));
        }
        self.drop_unused_helpers(space.axes.len());
        let (over, under) = (least(&self.over), least(&self.under));
        let anchored = space.anchor.iter().flat_map(|a| &a.zeros).all(|&k| over[k] > 0);
        // A factor common to Q alone is a pole at its 0.
        let whole = self.under.is_empty() || under.iter().all(|p| *p == 0);
        let all = self.over.iter().chain(&self.under);
        let allowed = all.clone().all(|t| self.allowed(space, t));
        (anchored && whole && allowed && self.coefficients() <= space.coefficients).then_some(self)
    }

    fn allowed(&self, space: &Space, term: &Term) -> bool {
        let within = |(slot, power): (usize, &u8)| match space.axes.get(slot) {
            Some(axis) => *power <= axis.degree,
            None => *power <= HELPER_DEGREE,
        };
        term.iter().enumerate().all(within) && term.iter().sum::<u8>() <= TOTAL
    }

    fn drop_unused_helpers(&mut self, axes: usize) {
        for slot in (0..self.helpers.len()).rev() {
            let at = axes + slot;
            if self.over.iter().chain(&self.under).all(|t| t[at] == 0) {
                self.helpers.remove(slot);
                for term in self.over.iter_mut().chain(&mut self.under) {
                    term[at..].rotate_left(1);
                }
            }
        }
    }

    /// Forms that differ from this one by one step, not all of them canonical.
    pub fn neighbours(&self, space: &Space) -> Vec<Form> {
        let mut found = Vec::new();
        let slots = space.axes.len() + self.helpers.len();
        for under in [false, true] {
            let terms = if under { &self.under } else { &self.over };
            let with = |terms: Vec<Term>| {
                if under {
                    Form { under: terms, ..self.clone() }
                } else {
                    Form { over: terms, ..self.clone() }
                }
            };
            for term in additions(terms, &self.over, &self.under, slots) {
                found.push(with(terms.iter().copied().chain([term]).collect()));
            }
            for k in 0..terms.len() {
                let rest = || terms.iter().copied().enumerate().filter(move |(i, _)| *i != k).map(|(_, t)| t);
                found.push(with(rest().collect()));
                for moved in steps(&terms[k], slots) {
                    found.push(with(rest().chain([moved]).collect()));
                }
            }
            for slot in 0..slots {
                found.extend(shifted(terms, slot).into_iter().map(with));
            }
        }
        found.extend(self.other_helpers(space));
        found
    }

    /// The same with other constants, and with another helper in every place of an axis.
    fn other_helpers(&self, space: &Space) -> Vec<Form> {
        let mut found = Vec::new();
        for (k, helper) in self.helpers.iter().enumerate() {
            for other in helper.neighbours() {
                let mut form = self.clone();
                form.helpers[k] = other;
                found.push(form);
            }
        }
        let slot = space.axes.len() + self.helpers.len();
        if self.helpers.len() >= 2 || slot >= SLOTS {
            return found;
        }
        for helper in space.helpers.iter().flat_map(|h| h.instances()) {
            if self.helpers.iter().any(|own| own.kind == helper.kind) {
                continue;
            }
            let mut base = self.clone();
            base.helpers.push(helper);
            // As a factor of all of P, and of one term of either.
            let factor = |t: &mut Term| t[slot] += 1;
            let mut all = base.clone();
            all.over.iter_mut().for_each(factor);
            found.push(all);
            for k in 0..base.over.len() {
                let mut one = base.clone();
                factor(&mut one.over[k]);
                found.push(one);
            }
            for k in 0..base.under.len() {
                let mut one = base.clone();
                factor(&mut one.under[k]);
                found.push(one);
            }
        }
        found
    }
}

/// Terms that may be added: those of either sum, and those one or two steps from one.
fn additions(terms: &[Term], over: &[Term], under: &[Term], slots: usize) -> Vec<Term> {
    let mut found: Vec<Term> = Vec::new();
    for term in over.iter().chain(under) {
        found.push(*term);
        for one in steps(term, slots) {
            found.push(one);
            found.extend(steps(&one, slots));
        }
    }
    found.sort_unstable();
    found.dedup();
    found.retain(|t| !terms.contains(t));
    found
}

/// A term with one power changed by one or two.
fn steps(term: &Term, slots: usize) -> Vec<Term> {
    let mut found = Vec::new();
    for slot in 0..slots {
        for change in [-2_i8, -1, 1, 2] {
            if let Some(power) = term[slot].checked_add_signed(change) {
                let mut other = *term;
                other[slot] = power;
                found.push(other);
            }
        }
    }
    found
}

/// All terms times or by one factor.
fn shifted(terms: &[Term], slot: usize) -> Vec<Vec<Term>> {
    let by = |change: i8| {
        let one = |t: &Term| {
            let mut other = *t;
            other[slot] = t[slot].checked_add_signed(change)?;
            Some(other)
        };
        terms.iter().map(one).collect::<Option<Vec<Term>>>()
    };
    if terms.is_empty() { Vec::new() } else { [-1, 1].into_iter().filter_map(by).collect() }
}

/// The powers that all terms share; none of no terms.
pub(super) fn least(terms: &[Term]) -> Term {
    let mut common = terms.first().copied().unwrap_or([0; SLOTS]);
    for term in terms {
        common.iter_mut().zip(term).for_each(|(c, t)| *c = (*c).min(*t));
    }
    common
}

/// A term without a factor that it has.
pub(super) fn less(term: &Term, factor: &Term) -> Term {
    let mut rest = *term;
    rest.iter_mut().zip(factor).for_each(|(r, f)| *r -= f);
    rest
}
