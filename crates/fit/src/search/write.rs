//! A form as operations: the cheapest nesting that is found, and its text.

use super::form::{Form, Term};
use super::graph::{Graph, Node};
use super::helper::Instance;
use super::space::{SLOTS, Space};
use super::writer::Writer;
use lobefit_shade::tape::{BinaryOp, UnaryOp};

/// How a form is nested: the slots that are taken out first, above and below, and the term whose
/// coefficient is 1 (terms of P are counted after those of Q).
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub over: Vec<usize>,
    pub under: Vec<usize>,
    /// None for a polynomial.
    pub unit: Option<usize>,
    pub ops: u32,
}

/// A written form.
pub(super) struct Written {
    pub graph: Graph,
    pub result: Node,
    /// Names of the arguments, all of the space's.
    pub arguments: Vec<String>,
    /// Part and term, as counted by [`Layout::unit`], in the order of their coefficients.
    pub order: Vec<(usize, usize)>,
    /// Helpers in the order of their constants, which follow the coefficients.
    pub constants: Vec<Instance>,
    /// Names of the coefficients and constants.
    pub names: Vec<String>,
}

/// The cheapest layout among: each order of slots for each of the sums by itself, then each unit.
/// `may_be_unit` excludes terms whose coefficient is not a number to divide by.
pub(super) fn layout(space: &Space, form: &Form, may_be_unit: impl Fn(usize) -> bool) -> Option<Layout> {
    let alone = |terms: &[Term]| -> Vec<usize> {
        let mut orders = orders(&varying(terms));
        match orders.len() {
            1 => orders.remove(0),
            _ => {
                let cost = |order: &Vec<usize>| Writer::cost(space, form, terms, order);
                orders.into_iter().min_by_key(cost).unwrap_or_default()
            }
        }
    };
    let (over, under) = (alone(&form.over), alone(&form.under));
    let base = Layout { over, under, unit: None, ops: 0 };
    let priced = |unit: Option<usize>| {
        let layout = Layout { unit, ..base.clone() };
        let written = write(space, form, &layout, false);
        Layout { ops: written.graph.cost(written.result), ..layout }
    };
    if form.under.is_empty() {
        return Some(priced(None));
    }
    let units = (0..form.over.len() + form.under.len()).filter(|k| may_be_unit(*k));
    units.map(|k| priced(Some(k))).min_by_key(|l| l.ops)
}

/// Writes a form; `negative`: the quotient is subtracted.
pub(super) fn write(space: &Space, form: &Form, layout: &Layout, negative: bool) -> Written {
    let mut writer = Writer::new(space);
    let sums = writer.sums(form, layout, &NAMES[0]);
    let value = sums.value(&mut writer.graph, space.base(), negative);
    let value = space.link.map_or(value, |link| link.write(&mut writer.graph, value));
    let Some(argument) = &space.faded else { return writer.finish(value) };
    let (t, one) = (writer.further(), writer.graph.number(1.0));
    let rest = writer.graph.binary(BinaryOp::Subtract, one, t);
    let faded = writer.graph.times(rest, value);
    let mut written = writer.finish(faded);
    written.arguments.push(argument.clone());
    written
}

/// Letters of the coefficients above and below, and the names of both sums.
pub(super) struct Names {
    pub letters: [&'static str; 2],
    pub sums: [&'static str; 2],
}

/// Names in the first or only part of a formula, and in the second.
pub(super) const NAMES: [Names; 2] = [
    Names { letters: ["c", "d"], sums: ["dividend", "divisor"] },
    Names { letters: ["a", "b"], sums: ["part", "whole"] },
];

/// P and Q as written; Q only of a quotient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums {
    pub over: Node,
    pub under: Option<Node>,
}

impl Sums {
    /// base + P/Q, or base - P/Q.
    pub fn value(self, graph: &mut Graph, base: Option<f32>, negative: bool) -> Node {
        let value = match self.under {
            Some(under) => graph.binary(BinaryOp::Divide, self.over, under),
            None => self.over,
        };
        let base = base.map(|base| graph.number(base));
        signed(graph, base, value, negative)
    }

    /// The same as one quotient, (base Q + P) / Q or (base Q - P) / Q; none of a polynomial.
    pub fn quotient(self, graph: &mut Graph, base: Option<f32>, negative: bool) -> Option<[Node; 2]> {
        let under = self.under?;
        let base = base.map(|base| {
            let factor = graph.number(base);
            graph.times(factor, under)
        });
        Some([signed(graph, base, self.over, negative), under])
    }
}

/// A value added to a base, or subtracted.
fn signed(graph: &mut Graph, base: Option<Node>, value: Node, negative: bool) -> Node {
    match (base, negative) {
        (Some(base), true) => graph.binary(BinaryOp::Subtract, base, value),
        (Some(base), false) => graph.binary(BinaryOp::Add, base, value),
        (None, true) => graph.unary(UnaryOp::Negate, value),
        (None, false) => value,
    }
}

/// The slots that terms have different powers of: a power that all have is a factor of the sum, whatever
/// the order.
fn varying(terms: &[Term]) -> Vec<usize> {
    let varies = |slot: &usize| terms.iter().any(|term| term[*slot] != terms[0][*slot]);
    (0..SLOTS).filter(varies).collect()
}

/// All orders of slots, which ascend.
fn orders(slots: &[usize]) -> Vec<Vec<usize>> {
    let mut orders = vec![Vec::new()];
    for _ in slots {
        let longer = |order: &Vec<usize>| {
            let rest = slots.iter().filter(|k| !order.contains(k)).collect::<Vec<_>>();
            rest.into_iter().map(|k| order.iter().copied().chain([*k]).collect()).collect::<Vec<Vec<usize>>>()
        };
        orders = orders.iter().flat_map(longer).collect();
    }
    orders
}
