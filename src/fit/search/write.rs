//! A form as operations: the cheapest nesting that is found, and its text.

use super::form::{Form, Term, least, less};
use super::graph::{Graph, Node};
use super::helper::Helper;
use super::space::{SLOTS, Space};
use crate::fit::tape::{BinaryOp, UnaryOp};

/// How a form is nested: the slots that are taken out first, above and below, and the term whose coefficient is 1 (terms of P
/// are counted after those of Q).
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    over: Vec<usize>,
    under: Vec<usize>,
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
    /// Terms, as counted by [`Layout::unit`], in the order of their coefficients.
    pub order: Vec<usize>,
    /// Helpers in the order of their constants, which follow the coefficients.
    pub constants: Vec<usize>,
    /// Names of the coefficients and constants.
    pub names: Vec<String>,
}

/// The cheapest layout among: each order of slots for each of the sums by itself, then each unit. `may_be_unit` excludes terms
/// whose coefficient is not a number to divide by.
pub(super) fn layout(space: &Space, form: &Form, may_be_unit: impl Fn(usize) -> bool) -> Option<Layout> {
    let slots = space.axes.len() + form.helpers.len();
    let orders = orders(slots);
    let alone = |terms: &[Term]| -> Vec<usize> {
        let cost = |order: &Vec<usize>| {
            let mut writer = Writer::new(space, form);
            let numbered: Vec<(Term, Option<usize>)> =
                terms.iter().enumerate().map(|(k, t)| (*t, Some(k))).collect();
            let node = writer.sum(&numbered, order, "c");
            writer.graph.cost(node)
        };
        orders.iter().min_by_key(|order| cost(order)).cloned().unwrap_or_default()
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
    let mut writer = Writer::new(space, form);
    let numbered = |terms: &[Term], first: usize| -> Vec<(Term, Option<usize>)> {
        let one = |(k, t): (usize, &Term)| (*t, (layout.unit != Some(first + k)).then_some(first + k));
        terms.iter().enumerate().map(one).collect()
    };
    let over = numbered(&form.over, form.under.len());
    let mut value = writer.sum(&over, &layout.over, "c");
    if !form.under.is_empty() {
        let under = numbered(&form.under, 0);
        let divisor = writer.sum(&under, &layout.under, "d");
        writer.graph.name(value, "dividend");
        writer.graph.name(divisor, "divisor");
        value = writer.graph.binary(BinaryOp::Divide, value, divisor);
    }
    let graph = &mut writer.graph;
    let result = match (&space.anchor, negative) {
        (Some(anchor), _) => {
            let base = graph.number(anchor.value);
            graph.binary(if negative { BinaryOp::Subtract } else { BinaryOp::Add }, base, value)
        }
        (None, true) => graph.unary(UnaryOp::Negate, value),
        (None, false) => value,
    };
    writer.finish(result)
}

/// All orders of the first `n` slots.
fn orders(n: usize) -> Vec<Vec<usize>> {
    let mut orders = vec![Vec::new()];
    for _ in 0..n {
        let longer = |order: &Vec<usize>| {
            let rest = (0..n).filter(|k| !order.contains(k)).collect::<Vec<_>>();
            rest.into_iter().map(|k| order.iter().copied().chain([k]).collect()).collect::<Vec<Vec<usize>>>()
        };
        orders = orders.iter().flat_map(longer).collect();
    }
    orders
}

struct Writer<'a> {
    space: &'a Space,
    form: &'a Form,
    graph: Graph,
    /// Terms in the order in which their coefficients are met.
    met: Vec<usize>,
    names: Vec<String>,
    /// Helpers in the order in which their constants are met.
    constants: Vec<usize>,
}

/// Where the numbers of the helpers' constants begin: after those of all terms.
const CONSTANTS: usize = 100;

impl<'a> Writer<'a> {
    fn new(space: &'a Space, form: &'a Form) -> Writer<'a> {
        Writer {
            space,
            form,
            graph: Graph::default(),
            met: Vec::new(),
            names: Vec::new(),
            constants: Vec::new(),
        }
    }

    /// A sum of terms with coefficients (none: 1), nested by the slots in order.
    fn sum(&mut self, terms: &[(Term, Option<usize>)], order: &[usize], letter: &str) -> Node {
        if let [(term, coefficient)] = terms {
            let product = self.product(term);
            let Some(k) = coefficient else { return product };
            let c = self.coefficient(*k, letter);
            return self.graph.times(c, product);
        }
        let bare: Vec<Term> = terms.iter().map(|(t, _)| *t).collect();
        let common = least(&bare);
        if common.iter().any(|p| *p > 0) {
            let rest: Vec<_> = terms.iter().map(|(t, c)| (less(t, &common), *c)).collect();
            let inner = self.sum(&rest, order, letter);
            let factor = self.product(&common);
            return self.graph.times(factor, inner);
        }
        let with = |slot: &&usize| terms.iter().any(|(t, _)| t[**slot] > 0);
        let Some(&slot) = order.iter().find(with) else { return self.graph.number(0.0) };
        let (inside, outside): (Vec<_>, Vec<_>) = terms.iter().copied().partition(|(t, _)| t[slot] > 0);
        let b = self.sum(&outside, order, letter);
        let a = self.sum(&inside, order, letter);
        self.graph.binary(BinaryOp::Add, b, a)
    }

    fn coefficient(&mut self, term: usize, letter: &str) -> Node {
        let index = self.met.iter().position(|k| *k == term).unwrap_or_else(|| {
            let count = self.names.iter().filter(|n| n.starts_with(letter)).count();
            self.met.push(term);
            self.names.push(format!("{letter}{count}"));
            self.met.len() - 1
        });
        self.graph.coefficient(index)
    }

    /// A product of powers: arguments first, then helpers.
    fn product(&mut self, term: &Term) -> Node {
        let mut product = self.graph.number(1.0);
        for slot in 0..SLOTS {
            if term[slot] == 0 {
                continue;
            }
            let factor = match self.space.axes.get(slot) {
                Some(_) => self.axis_power(slot, u32::from(term[slot])),
                None => self.helper_power(slot - self.space.axes.len(), u32::from(term[slot])),
            };
            product = self.graph.times(product, factor);
        }
        product
    }

    /// x^n from the arguments that are powers of x: the highest as often as it goes, then the rest.
    fn axis_power(&mut self, axis: usize, mut n: u32) -> Node {
        let mut product = self.graph.number(1.0);
        let before: usize = self.space.axes[..axis].iter().map(|a| a.arguments.len()).sum();
        for (k, (name, power)) in self.space.axes[axis].arguments.iter().enumerate().rev() {
            let base = self.graph.argument(before + k);
            let factor = self.repeated(base, n / power, name);
            product = self.graph.times(factor, product);
            n %= power;
        }
        product
    }

    /// base^n by squaring.
    fn repeated(&mut self, base: Node, n: u32, name: &str) -> Node {
        let mut product = self.graph.number(1.0);
        let mut square = base;
        let mut bit = 1;
        while bit <= n {
            if n & bit != 0 {
                product = self.graph.times(product, square);
            }
            bit *= 2;
            if bit <= n {
                square = self.graph.times(square, square);
                self.graph.name(square, &format!("{name}{bit}"));
            }
        }
        product
    }

    fn helper_power(&mut self, helper: usize, n: u32) -> Node {
        let instance = self.form.helpers[helper];
        let constant = |writer: &mut Self| {
            let known = writer.constants.iter().position(|k| *k == helper).unwrap_or_else(|| {
                writer.constants.push(helper);
                writer.constants.len() - 1
            });
            writer.graph.coefficient(CONSTANTS + known)
        };
        let value = match instance.kind {
            Helper::Complement { axis } => {
                let (one, x) = (self.graph.number(1.0), self.axis_power(axis.into(), 1));
                self.graph.binary(BinaryOp::Subtract, one, x)
            }
            Helper::Root { axis } => {
                let x = self.axis_power(axis.into(), 1);
                self.graph.unary(UnaryOp::Sqrt, x)
            }
            Helper::Decay { axis, power } => {
                let x = self.axis_power(axis.into(), power.into());
                let k = constant(self);
                let scaled = self.graph.times(k, x);
                let negative = self.graph.unary(UnaryOp::Negate, scaled);
                self.graph.unary(UnaryOp::Exp2, negative)
            }
            Helper::Reciprocal { x, y, power } => {
                let (x, y) = (self.axis_power(x.into(), 1), self.axis_power(y.into(), power.into()));
                let k = constant(self);
                let scaled = self.graph.times(k, y);
                let sum = self.graph.binary(BinaryOp::Add, x, scaled);
                let one = self.graph.number(1.0);
                self.graph.binary(BinaryOp::Divide, one, sum)
            }
            Helper::RootReciprocal { x, y, power } => {
                let (x, y) = (self.axis_power(x.into(), 1), self.axis_power(y.into(), power.into()));
                let k = constant(self);
                let scaled = self.graph.times(k, y);
                let sum = self.graph.binary(BinaryOp::Add, x, scaled);
                self.graph.unary(UnaryOp::InverseSqrt, sum)
            }
        };
        let name = format!("{}{}", instance.kind.name(), if helper > 0 { "_b" } else { "" });
        self.graph.name(value, &name);
        self.repeated(value, n, &name)
    }

    /// The coefficients renumbered: terms in the order met, then constants.
    fn finish(self, result: Node) -> Written {
        let arguments =
            self.space.axes.iter().flat_map(|a| &a.arguments).map(|(name, _)| name.clone()).collect();
        let mut graph = self.graph;
        graph.renumber(CONSTANTS, self.met.len());
        let names =
            self.names.into_iter().chain((0..self.constants.len()).map(|k| format!("k{k}"))).collect();
        Written { graph, result, arguments, order: self.met, constants: self.constants, names }
    }
}
