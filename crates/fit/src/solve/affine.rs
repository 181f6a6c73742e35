//! The parameters in which a formula is affine while the others stay.

use super::rank::{inside, join};
use lobefit_shade::Tape;
use lobefit_shade::tape::{BinaryOp, Op, UnaryOp};

/// Those parameters, in order: of the two sides of a product that with more of them keeps them. None
/// where the formula has a kink in a parameter, as on the kink derivatives are those of one side.
pub(super) fn affine(tape: &Tape) -> Vec<usize> {
    use BinaryOp::{Add, Divide, Multiply, Subtract};
    if kinked(tape) {
        return Vec::new();
    }
    let mut bent = vec![false; tape.parameters()];
    loop {
        let before = bent.clone();
        let mut reach: Vec<Vec<bool>> = Vec::with_capacity(tape.ops().len());
        for op in tape.ops() {
            let of = |node: u32| &reach[node as usize];
            let size = |node: u32| of(node).iter().filter(|free| **free).count();
            let curved: Vec<u32> = match *op {
                Op::Unary(UnaryOp::Negate, _) | Op::Binary(Add | Subtract, ..) => Vec::new(),
                Op::Binary(Multiply, a, b) | Op::Fma(a, b, _) => vec![if size(a) < size(b) { a } else { b }],
                Op::Binary(Divide, _, b) => vec![b],
                Op::Select(condition, ..) => vec![condition],
                _ => op.operands().collect(),
            };
            curved.iter().for_each(|&node| join(&mut bent, of(node)));
            let mut own = vec![false; tape.parameters()];
            if let Op::Parameter(i) = *op {
                own[usize::from(i)] = true;
            }
            op.operands().for_each(|node| join(&mut own, of(node)));
            own.iter_mut().zip(&bent).for_each(|(own, bent)| *own &= !bent);
            reach.push(own);
        }
        if bent == before {
            return (0..bent.len()).filter(|&i| !bent[i]).collect();
        }
    }
}

/// Whether a derivative by a parameter jumps where it is taken: in an operation with a kink, or a choice
/// by a value of the parameters.
fn kinked(tape: &Tape) -> bool {
    use BinaryOp::{Equal, Less, LessEqual, Max, Min};
    use UnaryOp::{Abs, Floor, Saturate, Sign};
    let kink = |op: &Op, _| {
        matches!(op, Op::Unary(Abs | Saturate | Floor | Sign, _))
            || matches!(op, Op::Binary(Less | LessEqual | Equal | Min | Max, ..))
    };
    inside(tape, kink).contains(&true)
}
