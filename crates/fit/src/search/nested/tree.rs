//! Connected monomials: every one is another one times a step, so that their sum is one nested
//! Horner tree in which each costs a multiply-add.

use std::collections::BTreeMap;

use super::super::form::Term;
use super::super::helper::{Helper, multiply};
use super::super::space::{SLOTS, SearchSamples, Space};

/// What monomials are multiplied by to give others: the arguments, a reciprocal, and products of
/// these that are computed once.
#[derive(Clone, Debug)]
pub(super) struct Steps {
    pub helper: Helper,
    /// By name, with the powers of axes and, behind them, of the reciprocal.
    pub steps: Vec<(String, Term)>,
    /// Products: name, and the two steps that it is made of.
    pub products: Vec<(String, [usize; 2])>,
    /// Operations of the reciprocal and the products.
    pub ops: u32,
}

/// Operations of a reciprocal of x + k y, or of its root.
const RECIPROCAL: u32 = 5;

impl Steps {
    /// The arguments and the reciprocal; none if it is of no arguments.
    pub fn of(space: &Space, helper: Helper) -> Option<Steps> {
        reciprocal(space, helper)?;
        let mut steps = Vec::new();
        for (axis, own) in space.axes.iter().enumerate() {
            for (name, power) in &own.arguments {
                let mut term = [0; SLOTS];
                term[axis] = *power as u8;
                steps.push((name.clone(), term));
            }
        }
        let mut term = [0; SLOTS];
        term[space.axes.len()] = 1;
        steps.push((helper.name().to_string(), term));
        Some(Steps { helper, steps, products: Vec::new(), ops: RECIPROCAL })
    }

    /// With the product of two steps in addition.
    pub fn with(&self, pair: [usize; 2]) -> Steps {
        let mut more = self.clone();
        let [(first, a), (second, b)] = pair.map(|k| &self.steps[k]);
        let name = format!("{first}_{second}");
        more.steps.push((name.clone(), times(a, b)));
        more.products.push((name, pair));
        more.ops += 1;
        more
    }

    /// Index of a step by its powers.
    pub fn place(&self, term: &Term) -> Option<usize> {
        self.steps.iter().position(|(_, own)| own == term)
    }
}

/// Names of x and y of a reciprocal of x + k y; none if they are no arguments.
pub(super) fn reciprocal(space: &Space, helper: Helper) -> Option<[&str; 2]> {
    let (Helper::Reciprocal { x, y, power } | Helper::RootReciprocal { x, y, power }) = helper else {
        return None;
    };
    let named = |axis: u8, power: u32| {
        let arguments = &space.axes[usize::from(axis)].arguments;
        arguments.iter().find(|(_, own)| *own == power).map(|(name, _)| name.as_str())
    };
    Some([named(x, 1)?, named(y, u32::from(power))?])
}

/// The monomials of a sum, in rising order. The 1 that all grow from is among them where it has a
/// coefficient: where nothing is anchored.
pub(super) type Terms = Vec<Term>;

/// Terms that are one step away.
pub(super) fn additions(space: &Space, steps: &Steps, terms: &Terms) -> Terms {
    let root = [0; SLOTS];
    let mut found: Terms = Vec::new();
    for from in terms.iter().chain([&root]) {
        for (_, step) in &steps.steps {
            let term = times(from, step);
            if !terms.contains(&term) && allowed(space, &term) {
                found.push(term);
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Highest power of the reciprocal.
const DEGREE: u8 = 6;

fn allowed(space: &Space, term: &Term) -> bool {
    let zeros = space.anchor.iter().flat_map(|a| &a.zeros);
    // Factors of the reciprocal take powers of the inputs back.
    let inverse = term[space.axes.len()];
    let within = space.axes.iter().zip(term).all(|(axis, power)| *power <= axis.degree + inverse);
    within && inverse <= DEGREE && zeros.into_iter().all(|k| term[*k] > 0)
}

/// How a monomial is reached: from which term, `None` being 1, and by which step.
pub(super) type Place = (Option<usize>, usize);

/// The places of terms, of 1 itself none; none at all where a term is not reached.
pub(super) fn nested(steps: &Steps, terms: &Terms) -> Option<Vec<Option<Place>>> {
    let reached = reached(steps, terms);
    let whole = terms.iter().zip(&reached).all(|(term, place)| place.is_some() || *term == [0; SLOTS]);
    whole.then_some(reached)
}

/// The places of the terms that are reached.
fn reached(steps: &Steps, terms: &Terms) -> Vec<Option<Place>> {
    let root = [0; SLOTS];
    let mut reached: Vec<Option<Place>> = vec![None; terms.len()];
    let mut order: Vec<(Option<usize>, Term)> = vec![(None, root)];
    let mut next = 0;
    while next < order.len() {
        let (parent, from) = order[next];
        next += 1;
        for (k, (_, step)) in steps.steps.iter().enumerate() {
            let term = times(&from, step);
            if let Some(at) = terms.iter().position(|own| *own == term)
                && reached[at].is_none()
            {
                reached[at] = Some((parent, k));
                order.push((Some(at), term));
            }
        }
    }
    reached
}

/// Of additions those with which every term is reached.
pub(super) fn connecting(steps: &Steps, terms: &Terms, additions: Terms) -> Terms {
    let reached = reached(steps, terms);
    let places = terms.iter().zip(&reached);
    let lost = places.filter(|(term, place)| place.is_none() && **term != [0; SLOTS]);
    let lost: Vec<&Term> = lost.map(|(term, _)| term).collect();
    let leads = |from: &Term| steps.steps.iter().any(|(_, step)| lost.contains(&&times(from, step)));
    let connects = |term: &Term| {
        leads(term) && {
            let all: Terms = terms.iter().chain([term]).copied().collect();
            nested(steps, &all).is_some()
        }
    };
    if lost.is_empty() { additions } else { additions.into_iter().filter(connects).collect() }
}

/// A monomial times a step.
fn times(term: &Term, step: &Term) -> Term {
    let mut product = *term;
    product.iter_mut().zip(step).for_each(|(t, p)| *t += p);
    product
}

/// The values of monomials at samples, each computed once.
pub(super) struct Monomials<'a> {
    samples: &'a SearchSamples,
    inverse: Vec<f64>,
    columns: BTreeMap<Term, Vec<f64>>,
}

impl<'a> Monomials<'a> {
    /// Of the samples' axes and the reciprocal's values there.
    pub fn new(samples: &'a SearchSamples, inverse: Vec<f64>) -> Monomials<'a> {
        Monomials { samples, inverse, columns: BTreeMap::new() }
    }

    /// Computes those that are missing.
    pub fn compute<'t>(&mut self, terms: impl IntoIterator<Item = &'t Term>) {
        for term in terms {
            let computed = || {
                let mut column = self.samples.scale.clone();
                for (factor, power) in self.samples.axes.iter().chain([&self.inverse]).zip(term) {
                    if *power > 0 {
                        multiply(&mut column, factor, *power);
                    }
                }
                column
            };
            self.columns.entry(*term).or_insert_with(computed);
        }
    }

    /// One that has been computed.
    pub fn of(&self, term: &Term) -> &[f64] {
        &self.columns[term]
    }
}

/// The sum as WGSL: lets, then the nested tree; coefficients `c0, c1, ...` by term, `k0` inside the
/// reciprocal.
pub(super) fn text(space: &Space, steps: &Steps, terms: &Terms) -> Option<String> {
    let tree = nested(steps, terms)?;
    let [x, y] = reciprocal(space, steps.helper)?;
    let name = steps.helper.name();
    let mut text = match steps.helper {
        Helper::Reciprocal { .. } => format!("    let {name} = 1.0 / ({x} + k0 * {y});\n"),
        _ => format!("    let {name} = inverseSqrt({x} + k0 * {y});\n"),
    };
    for (name, pair) in &steps.products {
        let [first, second] = pair.map(|k| &steps.steps[k].0);
        text += &format!("    let {name} = {first} * {second};\n");
    }
    let root = terms.iter().position(|t| *t == [0; SLOTS]).map(|k| format!("c{k}"));
    let anchored = space.base().map(|base| format!("{base:?}"));
    let branches = branches(steps, &tree, None);
    let sum: Vec<String> = anchored.into_iter().chain(root).chain(branches).collect();
    Some(format!("{text}    return {};\n", sum.join(" + ")))
}

/// What is added to a monomial's coefficient: step (coefficient + ...) of everything that is
/// reached from it.
fn branches(steps: &Steps, tree: &[Option<Place>], from: Option<usize>) -> Vec<String> {
    let own = tree.iter().enumerate().filter_map(|(k, place)| place.map(|(parent, step)| (k, parent, step)));
    let branch = |(k, _, step): (usize, Option<usize>, usize)| {
        let inner = branches(steps, tree, Some(k));
        let name = &steps.steps[step].0;
        match inner.is_empty() {
            true => format!("{name} * c{k}"),
            false => format!("{name} * (c{k} + {})", inner.join(" + ")),
        }
    };
    own.filter(|(_, parent, _)| *parent == from).map(branch).collect()
}
