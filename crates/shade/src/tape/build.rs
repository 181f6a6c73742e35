//! Syntax to tape: calls inlined, branches turned into selects, equal operations made one.

use std::collections::HashMap;

use super::{BinaryOp, Node, Op, Tape, UnaryOp};
use crate::hypothesis::{Binary, Builtin, Expr, ExprKind, Formula, Limits, Statement, Unary, power_steps};
use crate::{Place, ShadeError};

/// What an operation is recognised by: its code, and its operands or bits.
pub(super) type Key = (u8, u8, u32, u32, u32);

/// The nodes of a number, or of the components of a vector.
type Value = Vec<Node>;

/// A tape under construction. `None` while folding a lone expression without a formula around it.
struct Builder<'a> {
    formula: Option<&'a Formula>,
    ops: Vec<Op>,
    spans: Vec<(u32, u32)>,
    known: HashMap<Key, Node>,
    calls: HashMap<(usize, Vec<Value>), Value>,
    span: (u32, u32),
    /// Most operations.
    limit: usize,
    /// What syntax was not as the reader of hypotheses leaves it, if anything: the tape is then
    /// refused.
    defect: Option<&'static str>,
}

/// What has happened when a block has run: the variables, and whether and what it has returned.
#[derive(Clone)]
struct State {
    variables: Vec<Option<Value>>,
    returned: Returned,
}

#[derive(Clone)]
enum Returned {
    Never,
    Always(Value),
    /// Where the first is true, the second.
    Where(Node, Value),
}

impl Tape {
    /// The tape of a formula.
    pub fn of(formula: &Formula, file: &str, source: &str) -> Result<Tape, ShadeError> {
        Tape::of_function(formula, formula.functions.len() - 1, None, [file, source])
    }

    /// The tape of a function among functions; inputs are its arguments, component by component.
    /// Its result is one component of the function's; without a component it is the last of all
    /// that the function computes, a tape for its cost.
    pub(crate) fn of_function(
        formula: &Formula,
        index: usize,
        component: Option<usize>,
        place: [&str; 2],
    ) -> Result<Tape, ShadeError> {
        let limit = component.map_or(Limits::OPERATIONS, |_| Limits::SOURCE_OPERATIONS);
        let mut made = Inputs::of(formula, limit);
        let values = made.call(index);
        let results = component.map_or(&values[..], |i| &values[i..=i]);
        made.tape(results, index, place)
    }

    /// A tape for the cost of some functions together: arguments of one name are the same inputs.
    pub(crate) fn of_functions(
        formula: &Formula,
        indices: &[usize],
        place: [&str; 2],
    ) -> Result<Tape, ShadeError> {
        let mut made = Inputs::of(formula, Limits::SOURCE_OPERATIONS);
        let results: Vec<Node> = indices.iter().flat_map(|&index| made.call(index)).collect();
        made.tape(&results, formula.functions.len() - 1, place)
    }
}

/// Functions called on inputs.
struct Inputs<'a> {
    formula: &'a Formula,
    builder: Builder<'a>,
    names: Vec<String>,
    nodes: Vec<Node>,
}

impl<'a> Inputs<'a> {
    fn of(formula: &'a Formula, limit: usize) -> Inputs<'a> {
        let builder = Builder::new(Some(formula), limit);
        Inputs { formula, builder, names: Vec::new(), nodes: Vec::new() }
    }

    /// Value of a function of the inputs that its arguments name.
    fn call(&mut self, index: usize) -> Value {
        let function = &self.formula.functions[index];
        let arguments = function.variables[..function.arguments].iter();
        let arguments =
            arguments.map(|v| v.components().iter().map(|name| self.input(name)).collect()).collect();
        self.builder.call(index, arguments)
    }

    fn input(&mut self, name: &str) -> Node {
        if let Some(known) = self.names.iter().position(|known| known == name) {
            return self.nodes[known];
        }
        let node = self.builder.push(Op::Input(self.names.len() as u16));
        self.names.push(name.to_string());
        self.nodes.push(node);
        node
    }

    fn tape(self, results: &[Node], index: usize, [file, source]: [&str; 2]) -> Result<Tape, ShadeError> {
        let Inputs { formula, builder, names, .. } = self;
        let function = &formula.functions[index].name;
        builder.whole(function)?;
        let found = builder.ops.len();
        if found > builder.limit {
            let (what, limit) = ("operations", builder.limit);
            return Err(ShadeError::TooLarge { file: file.into(), what, found, limit });
        }
        let place = |span: (u32, u32)| Place::of(file, source, span.0 as usize, span.1 as usize);
        let (ops, spans) = reachable(&builder.ops, &builder.spans, results);
        Ok(Tape {
            ops,
            places: spans.into_iter().map(place).collect(),
            function: function.clone(),
            inputs: names,
            parameters: formula.parameters.len(),
        })
    }
}

/// The f32 value of an expression of a function whose operands are literals.
///
/// # Errors
/// An expression with other operands, a defect.
pub fn fold(expr: &Expr, function: &str) -> Result<ExprKind, ShadeError> {
    let mut builder = Builder::new(None, Limits::OPERATIONS);
    let result = builder.expression(expr, &[]);
    builder.whole(function)?;
    let (ops, spans) = reachable(&builder.ops, &builder.spans, &result);
    let places = spans.iter().map(|_| Place::of("", "", 0, 0)).collect();
    let tape = Tape { ops, places, function: String::new(), inputs: Vec::new(), parameters: 0 };
    let value: f32 = tape.at(&[], &[]);
    let truth = match &expr.kind {
        ExprKind::Unary(op, _) => *op == Unary::Not,
        ExprKind::Binary(op, ..) => {
            !matches!(op, Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide)
        }
        ExprKind::Builtin(Builtin::Select, operands) => matches!(operands[0].kind, ExprKind::Truth(_)),
        _ => false,
    };
    Ok(if truth { ExprKind::Truth(value == 1.0) } else { ExprKind::Number(value) })
}

impl<'a> Builder<'a> {
    fn new(formula: Option<&'a Formula>, limit: usize) -> Builder<'a> {
        Builder {
            formula,
            ops: Vec::new(),
            spans: Vec::new(),
            known: HashMap::new(),
            calls: HashMap::new(),
            span: (0, 0),
            limit,
            defect: None,
        }
    }

    /// Refuses what is built of syntax that is not as it should be.
    fn whole(&self, function: &str) -> Result<(), ShadeError> {
        self.defect.map_or(Ok(()), |what| Err(ShadeError::Defect { function: function.into(), what }))
    }

    /// A node in place of what is not there: nothing is made of it, since the tape is refused.
    fn missing(&mut self, what: &'static str) -> Node {
        self.defect.get_or_insert(what);
        0
    }

    /// The node of an operation, new or known. Beyond the limit on operations nothing new is made:
    /// the tape is refused when it is done.
    fn push(&mut self, op: Op) -> Node {
        let op = canonical(op);
        let key = key(op);
        if let Some(&node) = self.known.get(&key) {
            return node;
        }
        if self.ops.len() > self.limit {
            return 0;
        }
        let node = self.ops.len() as Node;
        self.ops.push(op);
        self.spans.push(self.span);
        self.known.insert(key, node);
        node
    }

    fn number(&mut self, x: f32) -> Node {
        self.push(Op::Literal(x))
    }

    fn unary(&mut self, op: UnaryOp, a: Node) -> Node {
        self.push(Op::Unary(op, a))
    }

    fn binary(&mut self, op: BinaryOp, a: Node, b: Node) -> Node {
        self.push(Op::Binary(op, a, b))
    }

    fn select(&mut self, condition: Node, accept: Node, reject: Node) -> Node {
        if accept == reject { accept } else { self.push(Op::Select(condition, accept, reject)) }
    }

    fn choose(&mut self, condition: Node, accept: &[Node], reject: &[Node]) -> Value {
        accept.iter().zip(reject).map(|(&a, &b)| self.select(condition, a, b)).collect()
    }

    fn not(&mut self, a: Node) -> Node {
        self.unary(UnaryOp::Not, a)
    }

    /// Value of a call; a function of equal arguments is evaluated once.
    fn call(&mut self, function: usize, arguments: Vec<Value>) -> Value {
        let key = (function, arguments);
        if let Some(value) = self.calls.get(&key) {
            return value.clone();
        }
        let Some(formula) = self.formula else { return vec![self.missing("a call outside of a formula")] };
        let callee = &formula.functions[function];
        let mut variables = vec![None; callee.variables.len()];
        for (variable, argument) in variables.iter_mut().zip(&key.1) {
            *variable = Some(argument.clone());
        }
        let end = self.block(&callee.body, State { variables, returned: Returned::Never });
        let (Returned::Always(value) | Returned::Where(_, value)) = end.returned else {
            return vec![self.missing("a path without a return")];
        };
        self.calls.insert(key, value.clone());
        value
    }

    fn block(&mut self, body: &[Statement], mut state: State) -> State {
        for statement in body {
            match statement {
                Statement::Let(variable, e)
                | Statement::Var(variable, e)
                | Statement::Assign(variable, e) => {
                    let value = self.expression(e, &state.variables);
                    state.variables[*variable] = Some(value);
                }
                Statement::Return(e) => {
                    let value = self.expression(e, &state.variables);
                    state.returned = self.then(state.returned, Returned::Always(value));
                }
                Statement::If(condition, accept, reject) => {
                    let condition = self.expression(condition, &state.variables)[0];
                    let inner = State { variables: state.variables, returned: Returned::Never };
                    let accept = self.block(accept, inner.clone());
                    let reject = self.block(reject, inner);
                    let merged = self.merge(condition, accept, reject);
                    state.variables = merged.variables;
                    state.returned = self.then(state.returned, merged.returned);
                }
                Statement::Each(element, list, body) => {
                    let Some(rows) = state.variables[*list].clone() else {
                        self.missing("a loop over an array without a value");
                        continue;
                    };
                    for row in rows.chunks(4) {
                        state.variables[*element] = Some(row.to_vec());
                        state = self.block(body, state);
                    }
                }
            }
            if matches!(state.returned, Returned::Always(_)) {
                break;
            }
        }
        state
    }

    /// What has been returned after `first`, and then, where that has not returned, `second`.
    fn then(&mut self, first: Returned, second: Returned) -> Returned {
        match (first, second) {
            (Returned::Never, other) | (other, Returned::Never) => other,
            (Returned::Always(value), _) => Returned::Always(value),
            (Returned::Where(c, value), Returned::Always(other)) => {
                Returned::Always(self.choose(c, &value, &other))
            }
            (Returned::Where(c, value), Returned::Where(d, other)) => {
                let either = self.binary(BinaryOp::Or, c, d);
                Returned::Where(either, self.choose(c, &value, &other))
            }
        }
    }

    /// The state after a branch.
    fn merge(&mut self, condition: Node, accept: State, reject: State) -> State {
        let returned = self.merge_returned(condition, accept.returned.clone(), reject.returned.clone());
        let variables = match (accept.returned, reject.returned) {
            (Returned::Always(_), _) => reject.variables,
            (_, Returned::Always(_)) => accept.variables,
            _ => {
                let pairs = accept.variables.into_iter().zip(reject.variables);
                pairs.map(|(a, b)| Some(self.choose(condition, &a?, &b?))).collect()
            }
        };
        State { variables, returned }
    }

    fn merge_returned(&mut self, condition: Node, accept: Returned, reject: Returned) -> Returned {
        use Returned::{Always, Never, Where};
        match (accept, reject) {
            (Never, Never) => Never,
            (Always(a), Always(b)) => Always(self.choose(condition, &a, &b)),
            (Always(a), Never) => Where(condition, a),
            (Never, Always(b)) => Where(self.not(condition), b),
            (Where(c, a), Never) => Where(self.binary(BinaryOp::And, condition, c), a),
            (Never, Where(d, b)) => {
                let rejected = self.not(condition);
                Where(self.binary(BinaryOp::And, rejected, d), b)
            }
            (Always(a), Where(d, b)) => {
                let either = self.binary(BinaryOp::Or, condition, d);
                Where(either, self.choose(condition, &a, &b))
            }
            (Where(c, a), Always(b)) => {
                let rejected = self.not(condition);
                let either = self.binary(BinaryOp::Or, rejected, c);
                Where(either, self.choose(condition, &a, &b))
            }
            (Where(c, a), Where(d, b)) => {
                let either = self.select(condition, c, d);
                Where(either, self.choose(condition, &a, &b))
            }
        }
    }

    fn expression(&mut self, expr: &Expr, variables: &[Option<Value>]) -> Value {
        let operands: Vec<Value> =
            expr.operands().into_iter().map(|e| self.expression(e, variables)).collect();
        self.span = expr.span;
        let node = match &expr.kind {
            ExprKind::Number(x) => self.number(*x),
            ExprKind::Truth(x) => self.number(f32::from(u8::from(*x))),
            ExprKind::Parameter(index) => self.push(Op::Parameter(*index as u16)),
            ExprKind::Variable(index) => {
                let value = variables.get(*index).cloned().flatten();
                return value
                    .unwrap_or_else(|| vec![self.missing("a variable that is read before it is set")]);
            }
            ExprKind::Compose(_) => return operands.concat(),
            ExprKind::Component(_, i) => operands[0][usize::from(*i)],
            ExprKind::Call(function, _) => return self.call(*function, operands),
            ExprKind::Builtin(Builtin::Dot, _) => self.dot(&operands[0], &operands[1]),
            _ => {
                let n = operands.iter().map(Vec::len).max().unwrap_or(1);
                let component = |i: usize| -> Vec<Node> {
                    operands.iter().map(|value| if value.len() == 1 { value[0] } else { value[i] }).collect()
                };
                return (0..n).map(|i| self.arithmetic(expr, &component(i))).collect();
            }
        };
        vec![node]
    }

    /// Arithmetic of numbers.
    fn arithmetic(&mut self, expr: &Expr, operands: &[Node]) -> Node {
        match &expr.kind {
            ExprKind::Unary(Unary::Negate, _) => self.unary(UnaryOp::Negate, operands[0]),
            ExprKind::Unary(Unary::Not, _) => self.not(operands[0]),
            ExprKind::Binary(op, ..) => self.operator(*op, operands[0], operands[1]),
            ExprKind::Power(_, n) => self.power(operands[0], *n),
            ExprKind::Builtin(builtin, _) => self.builtin(*builtin, operands),
            _ => self.missing("an operation that is no arithmetic"),
        }
    }

    fn dot(&mut self, a: &[Node], b: &[Node]) -> Node {
        let mut sum = None;
        for (&x, &y) in a.iter().zip(b) {
            let product = self.binary(BinaryOp::Multiply, x, y);
            sum = Some(sum.map_or(product, |sum| self.binary(BinaryOp::Add, sum, product)));
        }
        sum.unwrap_or_else(|| self.missing("a product of vectors without components"))
    }

    fn operator(&mut self, op: Binary, a: Node, b: Node) -> Node {
        match op {
            Binary::Add => self.binary(BinaryOp::Add, a, b),
            Binary::Subtract => self.binary(BinaryOp::Subtract, a, b),
            Binary::Multiply => self.binary(BinaryOp::Multiply, a, b),
            Binary::Divide => self.binary(BinaryOp::Divide, a, b),
            Binary::Equal => self.binary(BinaryOp::Equal, a, b),
            Binary::NotEqual => {
                let equal = self.binary(BinaryOp::Equal, a, b);
                self.not(equal)
            }
            Binary::Less => self.binary(BinaryOp::Less, a, b),
            Binary::LessEqual => self.binary(BinaryOp::LessEqual, a, b),
            Binary::Greater => self.binary(BinaryOp::Less, b, a),
            Binary::GreaterEqual => self.binary(BinaryOp::LessEqual, b, a),
            Binary::And => self.binary(BinaryOp::And, a, b),
            Binary::Or => self.binary(BinaryOp::Or, a, b),
        }
    }

    fn power(&mut self, x: Node, n: u32) -> Node {
        let mut squares = vec![x];
        let mut result = None;
        for step in power_steps(n) {
            let index = step.trailing_zeros() as usize;
            while squares.len() <= index {
                let last = squares[squares.len() - 1];
                squares.push(self.binary(BinaryOp::Multiply, last, last));
            }
            result = Some(match result {
                None => squares[index],
                Some(product) => self.binary(BinaryOp::Multiply, product, squares[index]),
            });
        }
        result.unwrap_or(x)
    }

    fn builtin(&mut self, builtin: Builtin, x: &[Node]) -> Node {
        let unary = match builtin {
            Builtin::Abs => UnaryOp::Abs,
            Builtin::Saturate => UnaryOp::Saturate,
            Builtin::Sqrt => UnaryOp::Sqrt,
            Builtin::InverseSqrt => UnaryOp::InverseSqrt,
            Builtin::Exp => UnaryOp::Exp,
            Builtin::Exp2 => UnaryOp::Exp2,
            Builtin::Log => UnaryOp::Log,
            Builtin::Log2 => UnaryOp::Log2,
            Builtin::Floor => UnaryOp::Floor,
            Builtin::Sign => UnaryOp::Sign,
            Builtin::Sin => UnaryOp::Sin,
            Builtin::Cos => UnaryOp::Cos,
            _ => return self.composite(builtin, x),
        };
        self.unary(unary, x[0])
    }

    /// Built-ins of several operands, by the formulas that [`Builtin`] states.
    fn composite(&mut self, builtin: Builtin, x: &[Node]) -> Node {
        match builtin {
            Builtin::Min => self.binary(BinaryOp::Min, x[0], x[1]),
            Builtin::Max => self.binary(BinaryOp::Max, x[0], x[1]),
            Builtin::Pow => self.binary(BinaryOp::Pow, x[0], x[1]),
            Builtin::Fma => self.push(Op::Fma(x[0], x[1], x[2])),
            Builtin::Select => self.select(x[2], x[1], x[0]),
            Builtin::Clamp => self.clamp(x[0], x[1], x[2]),
            Builtin::Mix => {
                let one = self.number(1.0);
                let rest = self.binary(BinaryOp::Subtract, one, x[2]);
                let first = self.binary(BinaryOp::Multiply, x[0], rest);
                let second = self.binary(BinaryOp::Multiply, x[1], x[2]);
                self.binary(BinaryOp::Add, first, second)
            }
            Builtin::Step => {
                let (one, zero) = (self.number(1.0), self.number(0.0));
                let condition = self.binary(BinaryOp::LessEqual, x[0], x[1]);
                self.select(condition, one, zero)
            }
            _ => {
                let above = self.binary(BinaryOp::Subtract, x[2], x[0]);
                let range = self.binary(BinaryOp::Subtract, x[1], x[0]);
                let ratio = self.binary(BinaryOp::Divide, above, range);
                let t = self.unary(UnaryOp::Saturate, ratio);
                let (two, three) = (self.number(2.0), self.number(3.0));
                let square = self.binary(BinaryOp::Multiply, t, t);
                let twice = self.binary(BinaryOp::Multiply, two, t);
                let rest = self.binary(BinaryOp::Subtract, three, twice);
                self.binary(BinaryOp::Multiply, square, rest)
            }
        }
    }

    fn clamp(&mut self, x: Node, lo: Node, hi: Node) -> Node {
        let (zero, one) = (Op::Literal(0.0), Op::Literal(1.0));
        if self.ops[lo as usize] == zero && self.ops[hi as usize] == one {
            return self.unary(UnaryOp::Saturate, x);
        }
        let above = self.binary(BinaryOp::Max, x, lo);
        self.binary(BinaryOp::Min, above, hi)
    }
}

/// Sums and products with their operands in one order: a + b and b + a have the same bits.
pub(super) fn canonical(op: Op) -> Op {
    match op {
        Op::Binary(code @ (BinaryOp::Add | BinaryOp::Multiply), a, b) if b < a => Op::Binary(code, b, a),
        other => other,
    }
}

pub(super) fn key(op: Op) -> Key {
    match op {
        Op::Input(i) => (0, 0, u32::from(i), 0, 0),
        Op::Parameter(i) => (1, 0, u32::from(i), 0, 0),
        Op::Literal(x) => (2, 0, x.to_bits(), 0, 0),
        Op::Unary(code, a) => (3, code as u8, a, 0, 0),
        Op::Binary(code, a, b) => (4, code as u8, a, b, 0),
        Op::Fma(a, b, c) => (5, 0, a, b, c),
        Op::Select(a, b, c) => (6, 0, a, b, c),
    }
}

/// The operations that results need, renumbered, the last result last.
pub(super) fn reachable(ops: &[Op], spans: &[(u32, u32)], results: &[Node]) -> (Vec<Op>, Vec<(u32, u32)>) {
    let mut needed = vec![false; ops.len()];
    results.iter().for_each(|&result| needed[result as usize] = true);
    for node in (0..ops.len()).rev() {
        if needed[node] {
            ops[node].operands().for_each(|operand| needed[operand as usize] = true);
        }
    }
    let mut renumbered = vec![0; ops.len()];
    let (mut kept, mut places) = (Vec::new(), Vec::new());
    for node in (0..ops.len()).filter(|&n| needed[n]) {
        renumbered[node] = kept.len() as Node;
        let at = |n: Node| renumbered[n as usize];
        kept.push(match ops[node] {
            Op::Unary(code, a) => Op::Unary(code, at(a)),
            Op::Binary(code, a, b) => Op::Binary(code, at(a), at(b)),
            Op::Fma(a, b, c) => Op::Fma(at(a), at(b), at(c)),
            Op::Select(a, b, c) => Op::Select(at(a), at(b), at(c)),
            leaf => leaf,
        });
        places.push(spans[node]);
    }
    (kept, places)
}
