//! Operations with common ones once, and their text: what is printed has the operations that were
//! counted.

use std::collections::BTreeMap;

use lobefit_shade::Tape;
use lobefit_shade::tape::{BinaryOp, Op, UnaryOp};

/// Index of an operation.
pub(super) type Node = u32;

/// A formula's operations.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    ops: Vec<Op>,
    /// Values that are named in the text, in the order of computation, with their names.
    names: BTreeMap<Node, String>,
}

impl Graph {
    /// The node of an operation, new or known.
    fn push(&mut self, op: Op) -> Node {
        let op = match op {
            Op::Binary(code @ (BinaryOp::Add | BinaryOp::Multiply), a, b) if b < a => Op::Binary(code, b, a),
            other => other,
        };
        if let Some(known) = self.ops.iter().position(|o| *o == op) {
            return known as Node;
        }
        self.ops.push(op);
        (self.ops.len() - 1) as Node
    }

    pub fn argument(&mut self, index: usize) -> Node {
        self.push(Op::Input(index as u16))
    }

    pub fn coefficient(&mut self, index: usize) -> Node {
        self.push(Op::Parameter(index as u16))
    }

    pub fn number(&mut self, value: f32) -> Node {
        self.push(Op::Literal(value))
    }

    pub fn unary(&mut self, op: UnaryOp, a: Node) -> Node {
        self.push(Op::Unary(op, a))
    }

    pub fn binary(&mut self, op: BinaryOp, a: Node, b: Node) -> Node {
        self.push(Op::Binary(op, a, b))
    }

    /// A product; factors of 1 disappear.
    pub fn times(&mut self, a: Node, b: Node) -> Node {
        match (self.is_one(a), self.is_one(b)) {
            (true, _) => b,
            (_, true) => a,
            _ => self.binary(BinaryOp::Multiply, a, b),
        }
    }

    pub fn is_one(&self, node: Node) -> bool {
        self.ops[node as usize] == Op::Literal(1.0)
    }

    /// Names a value, unless it is an argument, a number, a coefficient or named already.
    pub fn name(&mut self, node: Node, name: &str) {
        let leaf = matches!(self.ops[node as usize], Op::Input(_) | Op::Parameter(_) | Op::Literal(_));
        if !leaf && !self.names.values().any(|n| n == name) {
            self.names.entry(node).or_insert_with(|| name.to_string());
        }
    }

    /// Coefficients from `first` on become those from `place` on.
    pub fn renumber(&mut self, first: usize, place: usize) {
        for op in &mut self.ops {
            if let Op::Parameter(k) = op
                && usize::from(*k) >= first
            {
                *k = (usize::from(*k) - first + place) as u16;
            }
        }
    }

    /// Which operations `result` needs.
    fn needed(&self, result: Node) -> Vec<bool> {
        let mut needed = vec![false; self.ops.len()];
        needed[result as usize] = true;
        for node in (0..=result as usize).rev().filter(|n| *n < self.ops.len()) {
            if needed[node] {
                self.ops[node].operands().for_each(|n| needed[n as usize] = true);
            }
        }
        needed
    }

    /// Operations of the cost model.
    pub fn cost(&self, result: Node) -> u32 {
        let needed = self.needed(result);
        let mut renumbered = vec![0; self.ops.len()];
        let mut kept: Vec<Op> = Vec::with_capacity(self.ops.len());
        for node in (0..self.ops.len()).filter(|&n| needed[n]) {
            renumbered[node] = kept.len() as Node;
            let at = |n: Node| renumbered[n as usize];
            kept.push(match self.ops[node] {
                Op::Unary(code, a) => Op::Unary(code, at(a)),
                Op::Binary(code, a, b) => Op::Binary(code, at(a), at(b)),
                leaf => leaf,
            });
        }
        Tape::of_ops(kept, 0).cost_ops()
    }

    /// The body of a function that returns `result`: a line for every named value and every value
    /// that is used twice.
    pub fn text(&self, result: Node, arguments: &[String], coefficients: &[String]) -> String {
        let needed = self.needed(result);
        let mut users = vec![0; self.ops.len()];
        for node in (0..self.ops.len()).filter(|&n| needed[n]) {
            self.ops[node].operands().for_each(|n| users[n as usize] += 1);
        }
        let mut writer = Text { graph: self, arguments, coefficients, names: BTreeMap::new() };
        let mut body = String::new();
        for node in (0..self.ops.len()).filter(|&n| needed[n] && n != result as usize) {
            let leaf = self.ops[node].operands().next().is_none();
            let own = self.names.get(&(node as Node));
            if leaf || (own.is_none() && users[node] < 2) {
                continue;
            }
            let name = own.cloned().unwrap_or_else(|| format!("t{}", writer.names.len()));
            let (value, _) = writer.expression(node as Node);
            body += &format!("    let {name} = {value};\n");
            writer.names.insert(node as Node, name);
        }
        body + &format!("    return {};\n", writer.expression(result).0)
    }
}

/// How tightly an expression binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Bond {
    Sum,
    Product,
    Whole,
}

struct Text<'a> {
    graph: &'a Graph,
    arguments: &'a [String],
    coefficients: &'a [String],
    names: BTreeMap<Node, String>,
}

impl Text<'_> {
    fn expression(&self, node: Node) -> (String, Bond) {
        if let Some(name) = self.names.get(&node) {
            return (name.clone(), Bond::Whole);
        }
        match self.graph.ops[node as usize] {
            Op::Input(k) => (self.arguments[k as usize].clone(), Bond::Whole),
            Op::Parameter(k) => (self.coefficients[k as usize].clone(), Bond::Whole),
            Op::Literal(x) => (format!("{x:?}"), Bond::Whole),
            Op::Unary(UnaryOp::Negate, a) => (format!("-{}", self.within(a, Bond::Product)), Bond::Product),
            Op::Unary(op, a) => {
                let name = match op {
                    UnaryOp::Sqrt => "sqrt",
                    UnaryOp::InverseSqrt => "inverseSqrt",
                    UnaryOp::Exp2 => "exp2",
                    UnaryOp::Abs => "abs",
                    _ => "saturate",
                };
                (format!("{name}({})", self.expression(a).0), Bond::Whole)
            }
            Op::Binary(BinaryOp::Add, a, b) => {
                // Constants first, then products: c0 + x * y.
                let (a, b) = if self.plain(b) && !self.plain(a) { (b, a) } else { (a, b) };
                (format!("{} + {}", self.within(a, Bond::Sum), self.within(b, Bond::Product)), Bond::Sum)
            }
            Op::Binary(BinaryOp::Subtract, a, b) => {
                (format!("{} - {}", self.within(a, Bond::Sum), self.within(b, Bond::Product)), Bond::Sum)
            }
            Op::Binary(BinaryOp::Divide, a, b) => (
                format!("{} / {}", self.within(a, Bond::Product), self.within(b, Bond::Whole)),
                Bond::Product,
            ),
            Op::Binary(_, a, b) => {
                // A product in brackets stays one: the order of the multiplications is part of the
                // formula.
                let (a, b) = if self.weight(b) < self.weight(a) { (b, a) } else { (a, b) };
                let left =
                    if self.product(a) { self.within(a, Bond::Product) } else { self.within(a, Bond::Whole) };
                (format!("{left} * {}", self.within(b, Bond::Whole)), Bond::Product)
            }
            Op::Fma(..) | Op::Select(..) => (String::new(), Bond::Whole),
        }
    }

    fn within(&self, node: Node, least: Bond) -> String {
        let (text, bond) = self.expression(node);
        if bond < least { format!("({text})") } else { text }
    }

    /// A number or a coefficient.
    fn plain(&self, node: Node) -> bool {
        matches!(self.graph.ops[node as usize], Op::Parameter(_) | Op::Literal(_))
    }

    fn product(&self, node: Node) -> bool {
        !self.names.contains_key(&node)
            && matches!(self.graph.ops[node as usize], Op::Binary(BinaryOp::Multiply, ..))
    }

    /// Names before products before sums.
    fn weight(&self, node: Node) -> u8 {
        if self.names.contains_key(&node) {
            return 1;
        }
        match self.graph.ops[node as usize] {
            Op::Parameter(_) | Op::Literal(_) => 0,
            Op::Input(_) => 1,
            Op::Binary(BinaryOp::Multiply, ..) => 2,
            _ => 3,
        }
    }
}
