//! A formula as a flat list of operations in single-assignment form, common sub-expressions once:
//! what is evaluated, differentiated, bounded and counted.

mod build;
mod contract;
mod cost;
mod evaluate;
mod features;
mod gradient;
mod half;
mod interval;
mod interval_evaluate;
mod real;

pub use build::fold;
pub use evaluate::{BLOCK, Workspace};
pub use features::Features;
pub use half::Half;
pub use interval::Interval;
pub use real::Real;

use super::Place;

/// Index of an operation; operands come before their users.
pub type Node = u32;

/// An operation. Truth values are 1 and 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// An input, by index.
    Input(u16),
    /// A free parameter, by index.
    Parameter(u16),
    /// A number.
    Literal(f32),
    /// One operand.
    Unary(UnaryOp, Node),
    /// Two operands.
    Binary(BinaryOp, Node, Node),
    /// x y + z, rounded once.
    Fma(Node, Node, Node),
    /// condition, accept, reject.
    Select(Node, Node, Node),
}

/// Operations on one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum UnaryOp {
    /// -x
    Negate,
    /// |x|
    Abs,
    /// clamp(x, 0, 1)
    Saturate,
    /// Largest integer not above x.
    Floor,
    /// -1, 0, 1
    Sign,
    /// Square root.
    Sqrt,
    /// 1 / sqrt(x), two roundings
    InverseSqrt,
    /// e^x
    Exp,
    /// 2^x
    Exp2,
    /// Natural logarithm.
    Log,
    /// Binary logarithm.
    Log2,
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// 1 - x of a truth value.
    Not,
}

/// Operations on two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BinaryOp {
    /// x + y
    Add,
    /// x - y
    Subtract,
    /// x y
    Multiply,
    /// x / y
    Divide,
    /// The smaller; x if equal.
    Min,
    /// The larger; x if equal.
    Max,
    /// x^y
    Pow,
    /// x < y
    Less,
    /// x <= y
    LessEqual,
    /// x == y
    Equal,
    /// Both of two truth values.
    And,
    /// Either of two truth values.
    Or,
}

/// A formula as a list of operations.
///
/// Not-a-number is never hidden: `min`, `max`, `clamp`, comparisons and `select` pass it on, unlike
/// a shader's.
#[derive(Clone, Debug, PartialEq)]
pub struct Tape {
    ops: Vec<Op>,
    places: Vec<Place>,
    function: String,
    inputs: Vec<String>,
    parameters: usize,
}

impl Tape {
    /// Operations in order; the last is the result.
    pub fn ops(&self) -> &[Op] {
        &self.ops
    }

    /// Where in the source an operation comes from.
    pub fn place(&self, node: Node) -> &Place {
        &self.places[node as usize]
    }

    /// A tape of operations, operands before their users and the result last, for its cost: it has
    /// no source.
    pub fn of_ops(ops: Vec<Op>, parameters: usize) -> Tape {
        let places = ops.iter().map(|_| Place::of("", "", 0, 0)).collect();
        Tape { ops, places, function: String::new(), inputs: Vec::new(), parameters }
    }

    /// The same operations under another function name.
    pub fn renamed(&self, name: &str) -> Tape {
        Tape { function: name.to_string(), ..self.clone() }
    }

    /// Whether an operation at a place depends on a parameter.
    pub fn is_free_at(&self, place: &Place) -> bool {
        let mut free: Vec<bool> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            free.push(matches!(op, Op::Parameter(_)) || op.operands().any(|n| free[n as usize]));
        }
        free.iter().zip(&self.places).any(|(free, at)| *free && at == place)
    }

    /// Name of the formula's function.
    pub fn function(&self) -> &str {
        &self.function
    }

    /// Names of the inputs, in order.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// Number of free parameters.
    pub fn parameters(&self) -> usize {
        self.parameters
    }
}

impl Op {
    /// Operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = Node> {
        let operands = match *self {
            Op::Input(_) | Op::Parameter(_) | Op::Literal(_) => [None; 3],
            Op::Unary(_, a) => [Some(a), None, None],
            Op::Binary(_, a, b) => [Some(a), Some(b), None],
            Op::Fma(a, b, c) | Op::Select(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }
}
