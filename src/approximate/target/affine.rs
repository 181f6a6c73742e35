//! Whether a formula is affine in one of its inputs.

use lobefit_shade::{BinaryOp, Op, Tape, UnaryOp};

/// How an operation depends on an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Degree {
    /// Not at all.
    Constant,
    /// As a + b x.
    Affine,
    /// In any other way.
    Other,
}

/// Whether the formula is a + b x in the input of this name, with a and b free of it; also where it
/// does not have the input. Judged by its operations: false may be said of a formula that is affine
/// in disguise.
pub(super) fn affine_in(tape: &Tape, input: &str) -> bool {
    let mut degrees: Vec<Degree> = Vec::with_capacity(tape.ops().len());
    for op in tape.ops() {
        let of = |n: &u32| degrees[*n as usize];
        let product = |a: Degree, b: Degree| {
            if a == Degree::Constant || b == Degree::Constant { a.max(b) } else { Degree::Other }
        };
        let opaque = |largest: Degree| if largest == Degree::Constant { largest } else { Degree::Other };
        degrees.push(match op {
            Op::Input(i) if tape.inputs()[usize::from(*i)] == input => Degree::Affine,
            Op::Input(_) | Op::Parameter(_) | Op::Literal(_) => Degree::Constant,
            Op::Unary(UnaryOp::Negate, a) => of(a),
            Op::Unary(_, a) => opaque(of(a)),
            Op::Binary(BinaryOp::Add | BinaryOp::Subtract, a, b) => of(a).max(of(b)),
            Op::Binary(BinaryOp::Multiply, a, b) => product(of(a), of(b)),
            Op::Binary(BinaryOp::Divide, a, b) if of(b) == Degree::Constant => of(a),
            Op::Binary(_, a, b) => opaque(of(a).max(of(b))),
            Op::Fma(a, b, c) => product(of(a), of(b)).max(of(c)),
            Op::Select(a, b, c) if of(a) == Degree::Constant => of(b).max(of(c)),
            Op::Select(..) => Degree::Other,
        });
    }
    degrees.last().is_none_or(|last| *last != Degree::Other)
}
