//! Sums of terms as operations: nested, with powers by squaring and helpers.

use super::form::{Form, Term, least, less};
use super::graph::{Graph, Node};
use super::helper::{Helper, Instance};
use super::space::{SLOTS, Space};
use super::write::{Layout, Names, Sums, Written};
use lobefit_shade::tape::{BinaryOp, UnaryOp};

/// Writes the parts of a formula into one graph, which knows what they have in common.
pub(super) struct Writer<'a> {
    space: &'a Space,
    /// Helpers of the part that is written.
    helpers: &'a [Instance],
    /// Parts begun before it.
    part: usize,
    pub graph: Graph,
    /// Parts and terms in the order in which their coefficients are met.
    met: Vec<(usize, usize)>,
    names: Vec<String>,
    /// Helpers in the order in which their constants are met.
    constants: Vec<Instance>,
}

/// Where the numbers of the helpers' constants begin: after those of all terms.
const CONSTANTS: usize = 100;

impl<'a> Writer<'a> {
    pub fn new(space: &'a Space) -> Writer<'a> {
        Writer {
            space,
            helpers: &[],
            part: 0,
            graph: Graph::default(),
            met: Vec::new(),
            names: Vec::new(),
            constants: Vec::new(),
        }
    }

    /// The sums of the next part of a formula.
    pub fn sums(&mut self, form: &'a Form, layout: &Layout, names: &Names) -> Sums {
        self.helpers = &form.helpers;
        let numbered = |terms: &[Term], first: usize| -> Vec<(Term, Option<usize>)> {
            let one = |(k, t): (usize, &Term)| (*t, (layout.unit != Some(first + k)).then_some(first + k));
            terms.iter().enumerate().map(one).collect()
        };
        let over = numbered(&form.over, form.under.len());
        let over = self.sum(&over, &layout.over, names.letters[0]);
        let under = (!form.under.is_empty()).then(|| {
            let under = numbered(&form.under, 0);
            let divisor = self.sum(&under, &layout.under, names.letters[1]);
            self.graph.name(over, names.sums[0]);
            self.graph.name(divisor, names.sums[1]);
            divisor
        });
        self.part += 1;
        Sums { over, under }
    }

    /// An argument that is no power of an axis: it follows those that are.
    pub fn further(&mut self) -> Node {
        let before = self.space.axes.iter().map(|a| a.arguments.len()).sum();
        self.graph.argument(before)
    }

    /// Operations of one sum of a form by itself, nested by the slots in order.
    pub fn cost(space: &'a Space, form: &'a Form, terms: &[Term], order: &[usize]) -> u32 {
        let mut writer = Writer::new(space);
        writer.helpers = &form.helpers;
        let numbered: Vec<(Term, Option<usize>)> =
            terms.iter().enumerate().map(|(k, t)| (*t, Some(k))).collect();
        let node = writer.sum(&numbered, order, "c");
        writer.graph.cost(node)
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
        let key = (self.part, term);
        let index = self.met.iter().position(|k| *k == key).unwrap_or_else(|| {
            let count = self.names.iter().filter(|n| n.starts_with(letter)).count();
            self.met.push(key);
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
        let instance = self.helpers[helper];
        let constant = |writer: &mut Self| {
            let known = writer.constants.iter().position(|k| *k == instance).unwrap_or_else(|| {
                writer.constants.push(instance);
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
    pub fn finish(self, result: Node) -> Written {
        let arguments =
            self.space.axes.iter().flat_map(|a| &a.arguments).map(|(name, _)| name.clone()).collect();
        let mut graph = self.graph;
        graph.renumber(CONSTANTS, self.met.len());
        let names =
            self.names.into_iter().chain((0..self.constants.len()).map(|k| format!("k{k}"))).collect();
        Written { graph, result, arguments, order: self.met, constants: self.constants, names }
    }
}
