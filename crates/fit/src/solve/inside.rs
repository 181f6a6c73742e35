//! Which parameters some operands of a formula's operations depend on.

use lobefit_shade::Tape;
use lobefit_shade::tape::Op;

/// For each parameter, whether an operand depends on it that `chosen` picks by its operation and its place among the operands.
pub(super) fn inside(tape: &Tape, chosen: impl Fn(&Op, usize) -> bool) -> Vec<bool> {
    let mut found = vec![false; tape.parameters()];
    let mut reach: Vec<Vec<bool>> = Vec::with_capacity(tape.ops().len());
    for op in tape.ops() {
        let mut own = vec![false; tape.parameters()];
        if let Op::Parameter(i) = *op {
            own[usize::from(i)] = true;
        }
        for (place, operand) in op.operands().enumerate() {
            join(&mut own, &reach[operand as usize]);
            if chosen(op, place) {
                join(&mut found, &reach[operand as usize]);
            }
        }
        reach.push(own);
    }
    found
}

fn join(all: &mut [bool], more: &[bool]) {
    all.iter_mut().zip(more).for_each(|(all, more)| *all |= more);
}
