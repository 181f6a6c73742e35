//! Which parameters the samples do not determine, in words.

use nalgebra::DMatrix;

use super::reduce::{RANK_TOLERANCE, Triangle};
use lobefit_shade::Tape;
use lobefit_shade::tape::{BinaryOp, Op, UnaryOp};

/// A parameter takes part in an undetermined combination if more than this of its axis lies in the
/// null space. Rounding leaves some 1e-8 (the square of it is compared) where a singular value is
/// at its tolerance.
const PART: f64 = 1e-6;

/// One sentence for each parameter that does not matter and each set of parameters that coincide;
/// none if all are determined.
///
/// Decided at the coefficients found: at a = 0, the b of a exp(b x) does not matter.
/// `steps`: of [`in_steps`].
pub(super) fn undetermined(triangle: &Triangle, names: &[String], steps: &[bool]) -> Vec<String> {
    let n = triangle.r.ncols();
    if n == 0 {
        return Vec::new();
    }
    let null = null_space(triangle);
    let mut seen = vec![false; n];
    let mut sentences = Vec::new();
    for first in 0..n {
        if seen[first] || null[(first, first)] <= PART {
            continue;
        }
        let mut group = vec![first];
        seen[first] = true;
        let mut next = 0;
        while let Some(&i) = group.get(next) {
            next += 1;
            let linked = (0..n).filter(|&j| !seen[j] && null[(i, j)].abs() > PART).collect::<Vec<_>>();
            linked.iter().for_each(|&j| seen[j] = true);
            group.extend(linked);
        }
        group.sort_unstable();
        sentences.push(sentence(&group, names, steps));
    }
    sentences
}

/// Which parameters move the formula through operations whose derivative is 0 wherever it has one.
pub(super) fn in_steps(tape: &Tape) -> Vec<bool> {
    use BinaryOp::{Equal, Less, LessEqual};
    let step = |op: &Op, _| {
        matches!(op, Op::Unary(UnaryOp::Floor | UnaryOp::Sign, _) | Op::Binary(Less | LessEqual | Equal, ..))
    };
    inside(tape, step)
}

/// The sentence of a parameter without an effect, or without a derivative.
pub(super) fn idle(name: &str, in_steps: bool) -> String {
    if in_steps {
        return format!(
            "`{name}` moves the formula in steps, if at all: its derivative is 0 at every sample"
        );
    }
    format!("`{name}` does not matter")
}

fn sentence(group: &[usize], names: &[String], steps: &[bool]) -> String {
    if let [only] = group {
        return idle(&names[*only], steps[*only]);
    }
    let quoted: Vec<String> = group.iter().map(|&i| format!("`{}`", names[i])).collect();
    match quoted.split_last() {
        Some((last, [first])) => {
            format!("{first} and {last} coincide: only a combination of them is determined")
        }
        Some((last, rest)) => {
            format!("{} and {last} coincide: only fewer combinations of them are determined", rest.join(", "))
        }
        None => String::new(),
    }
}

/// The orthogonal projector onto the directions that the Jacobian, its columns scaled to length 1,
/// does not see.
fn null_space(triangle: &Triangle) -> DMatrix<f64> {
    let n = triangle.r.ncols();
    let svd = triangle.scaled().svd(false, true);
    let top = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let mut null = DMatrix::identity(n, n);
    let Some(v) = svd.v_t else { return null };
    for k in (0..n).filter(|&k| svd.singular_values[k] > RANK_TOLERANCE * top) {
        let row = v.row(k);
        null -= row.transpose() * row;
    }
    null
}

/// For each parameter, whether an operand depends on it that `chosen` picks by its operation and
/// its place among the operands.
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

pub(super) fn join(all: &mut [bool], more: &[bool]) {
    all.iter_mut().zip(more).for_each(|(all, more)| *all |= more);
}
