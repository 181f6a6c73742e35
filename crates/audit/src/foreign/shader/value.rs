//! Values while a shader function is walked: nodes of a tape, numbers known now, and lists of them.

use lobefit_shade::{Assembler, BinaryOp, Node, Op, UnaryOp};

/// A value of a shader.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// An f32.
    Number(Node),
    /// A bool: 1 or 0.
    Truth(Node),
    /// An integer, which is known: inputs do not reach integers.
    Integer(i64),
    /// A vector, an array, a structure, or a matrix as the list of its columns.
    List(Vec<Value>),
    /// Where a variable, or a part of it, is.
    Pointer(Pointer),
    /// Part of a variable that nothing has been written to.
    Unset,
}

/// A variable by its slot, and indices into it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pointer {
    pub slot: usize,
    pub path: Vec<usize>,
}

impl Pointer {
    /// The pointer to an entry.
    pub fn entry(&self, index: usize) -> Pointer {
        let mut path = self.path.clone();
        path.push(index);
        Pointer { slot: self.slot, path }
    }

    /// What it points to.
    pub fn of<'a>(&self, memory: &'a mut [Value]) -> Option<&'a mut Value> {
        let mut value = memory.get_mut(self.slot)?;
        for &index in &self.path {
            value = match value {
                Value::List(list) => list.get_mut(index)?,
                _ => return None,
            };
        }
        Some(value)
    }
}

impl Value {
    /// Its scalars, depth first, if all are numbers.
    pub fn numbers(&self) -> Option<Vec<Node>> {
        match self {
            Value::Number(node) => Some(vec![*node]),
            Value::List(list) => {
                let parts: Option<Vec<Vec<Node>>> = list.iter().map(Value::numbers).collect();
                Some(parts?.concat())
            }
            _ => None,
        }
    }

    /// Whether it is a matrix: a list of lists.
    pub fn is_matrix(&self) -> bool {
        matches!(self, Value::List(list) if matches!(list.first(), Some(Value::List(_))))
    }
}

/// The tape under construction, with the place of the expression at hand.
#[derive(Debug, Default)]
pub(super) struct Maker {
    pub tape: Assembler,
    pub span: (u32, u32),
}

impl Maker {
    pub fn push(&mut self, op: Op) -> Node {
        self.tape.push(op, self.span)
    }

    pub fn literal(&mut self, x: f32) -> Node {
        self.push(Op::Literal(x))
    }

    pub fn truth(&mut self, x: bool) -> Node {
        self.literal(if x { 1.0 } else { 0.0 })
    }

    pub fn unary(&mut self, op: UnaryOp, a: Node) -> Node {
        self.push(Op::Unary(op, a))
    }

    pub fn binary(&mut self, op: BinaryOp, a: Node, b: Node) -> Node {
        self.push(Op::Binary(op, a, b))
    }

    pub fn add(&mut self, a: Node, b: Node) -> Node {
        self.binary(BinaryOp::Add, a, b)
    }

    pub fn subtract(&mut self, a: Node, b: Node) -> Node {
        self.binary(BinaryOp::Subtract, a, b)
    }

    pub fn multiply(&mut self, a: Node, b: Node) -> Node {
        self.binary(BinaryOp::Multiply, a, b)
    }

    pub fn not(&mut self, a: Node) -> Node {
        match self.tape.constant(a) {
            Some(x) => self.truth(x == 0.0),
            None => self.unary(UnaryOp::Not, a),
        }
    }

    /// accept where the condition is 1, else reject.
    pub fn select(&mut self, condition: Node, accept: Node, reject: Node) -> Node {
        match self.tape.constant(condition) {
            _ if accept == reject => accept,
            Some(1.0) => accept,
            Some(0.0) => reject,
            _ => self.push(Op::Select(condition, accept, reject)),
        }
    }

    /// Both of two truth values.
    pub fn and(&mut self, a: Node, b: Node) -> Node {
        match (self.tape.constant(a), self.tape.constant(b)) {
            (Some(x), _) => {
                if x == 1.0 {
                    b
                } else {
                    a
                }
            }
            (_, Some(y)) => {
                if y == 1.0 {
                    a
                } else {
                    b
                }
            }
            _ => self.binary(BinaryOp::And, a, b),
        }
    }

    /// Either of two truth values.
    pub fn or(&mut self, a: Node, b: Node) -> Node {
        match (self.tape.constant(a), self.tape.constant(b)) {
            (Some(x), _) => {
                if x == 1.0 {
                    a
                } else {
                    b
                }
            }
            (_, Some(y)) => {
                if y == 1.0 {
                    b
                } else {
                    a
                }
            }
            _ => self.binary(BinaryOp::Or, a, b),
        }
    }

    /// One value or the other, entry by entry; what is unset in one, or differs where no number
    /// does, is unset.
    pub fn merge(&mut self, condition: Node, accept: &Value, reject: &Value) -> Value {
        match (accept, reject) {
            (a, b) if a == b => a.clone(),
            (Value::Number(a), Value::Number(b)) => Value::Number(self.select(condition, *a, *b)),
            (Value::Truth(a), Value::Truth(b)) => {
                let constant = |node| self.tape.constant(node);
                // What a front end makes of `a && b` and `a || b`.
                match (constant(*a), constant(*b)) {
                    (_, Some(0.0)) => Value::Truth(self.and(condition, *a)),
                    (Some(1.0), _) => Value::Truth(self.or(condition, *b)),
                    _ => Value::Truth(self.select(condition, *a, *b)),
                }
            }
            (Value::List(a), Value::List(b)) if a.len() == b.len() => {
                Value::List(a.iter().zip(b).map(|(a, b)| self.merge(condition, a, b)).collect())
            }
            _ => Value::Unset,
        }
    }
}
