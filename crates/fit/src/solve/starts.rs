//! Starting points: the declared one, low-discrepancy points around it, and the declared one with
//! signs turned.

use super::rank::inside;
use lobefit_shade::Tape;
use lobefit_shade::tape::{BinaryOp, Op, UnaryOp};

/// `count` starting points. The first is `declared`; the others fill the box of half widths
/// `spread max(|declared|, 1)` around it, by the additive recurrence of the generalised golden
/// ratio g, the root of g^(n+1) = g + 1 (Roberts 2018), which needs no table and no seed.
pub(super) fn starts(declared: &[f64], count: usize, spread: f64) -> Vec<Vec<f64>> {
    let n = declared.len();
    let mut golden = 1.5_f64;
    for _ in 0..64 {
        // g = (1 + g)^(1/(n+1)), a contraction
        golden = lobefit_math::ops::pow(1.0 + golden, 1.0 / (n as f64 + 1.0));
    }
    let mut strides = Vec::with_capacity(n);
    let mut stride = 1.0;
    for _ in 0..n {
        stride /= golden;
        strides.push(stride);
    }
    let point = |index: usize| -> Vec<f64> {
        let around = declared.iter().zip(&strides).map(|(x, stride)| {
            let u = 0.5 + index as f64 * stride;
            x + (2.0 * (u - u.floor()) - 1.0) * spread * x.abs().max(1.0)
        });
        around.collect()
    };
    std::iter::once(declared.to_vec()).chain((1..count.max(1)).map(point)).collect()
}

/// Exponents whose signs are turned in all combinations; of more, each alone and all together.
const COMBINED: usize = 3;

/// Declared points with the signs of some parameters turned, beside those of [`starts`], whose box
/// around a value of 1 or more has no point below 0. Turned are exponents, in all combinations, and
/// the other parameters inside roots, logarithms, powers and the like, one by one: the sign of a
/// factor or of an addend is found by least squares from wherever it starts.
pub(super) fn turned(tape: &Tape, declared: &[f64]) -> Vec<Vec<f64>> {
    let moving = |inside: Vec<bool>| -> Vec<usize> {
        (0..declared.len()).filter(|&i| inside[i] && declared[i] != 0.0).collect()
    };
    let exponents = moving(inside(tape, is_exponent));
    let others = moving(inside(tape, is_curved));
    let mut sets: Vec<Vec<usize>> = if exponents.len() <= COMBINED {
        let some = |mask: usize| (0..exponents.len()).filter(move |i| mask >> i & 1 == 1);
        (1..1_usize << exponents.len()).map(|mask| some(mask).map(|i| exponents[i]).collect()).collect()
    } else {
        exponents.iter().map(|i| vec![*i]).chain(std::iter::once(exponents.clone())).collect()
    };
    sets.extend(others.into_iter().filter(|i| !exponents.contains(i)).map(|i| vec![i]));
    let turn = |set: Vec<usize>| {
        let mut point = declared.to_vec();
        set.into_iter().for_each(|i| point[i] = -point[i]);
        point
    };
    sets.into_iter().map(turn).collect()
}

fn is_exponent(op: &Op, place: usize) -> bool {
    match op {
        Op::Unary(UnaryOp::Exp | UnaryOp::Exp2, _) => true,
        Op::Binary(BinaryOp::Pow, ..) => place == 1,
        _ => false,
    }
}

/// Whether an operation on one operand, a power of its base, or a choice of the smaller or larger,
/// is not linear.
fn is_curved(op: &Op, place: usize) -> bool {
    match op {
        Op::Unary(code, _) => *code != UnaryOp::Negate,
        Op::Binary(BinaryOp::Pow, ..) => place == 0,
        Op::Binary(BinaryOp::Min | BinaryOp::Max, ..) => true,
        _ => false,
    }
}
