//! Whether a formula is a quotient P/Q of expressions affine in its parameters, and the rows of P
//! and Q at given points.
//!
//! Every operation's value at a point is carried as a pair of rows over (1, p_0, p_1 ...). Sums
//! over the same denominator, products and quotients with one parameter-free side, and 1 + S/Q keep
//! the form; whatever does not ends the attempt. A branch on the inputs alone is taken point by
//! point.

use lobefit_shade::Tape;
use lobefit_shade::tape::{BinaryOp, Op, UnaryOp};

/// P and Q at some points, row by row, `1 + parameters` entries each: the constant first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rows {
    pub numerator: Vec<f64>,
    pub denominator: Vec<f64>,
    /// Whether no denominator depends on a parameter: the formula is affine.
    pub linear: bool,
}

/// A value as a quotient of affine rows. `free` values depend on no parameter and are kept as they
/// are.
#[derive(Clone, Debug, PartialEq)]
enum Form {
    Free(f64),
    Quotient { p: Vec<f64>, q: Vec<f64> },
}

/// The rows at columns of points; none if the formula is no such quotient, or is not finite at one
/// of the points.
pub(super) fn recognise(tape: &Tape, inputs: &[Vec<f64>], points: usize) -> Option<Rows> {
    let mut rows = Rows { numerator: Vec::new(), denominator: Vec::new(), linear: true };
    for point in 0..points {
        let at: Vec<f64> = inputs.iter().map(|column| column[point]).collect();
        let (p, mut q) = form_at(tape, &at)?.rows(tape.parameters());
        if is_free(&q) {
            let c = q[0];
            rows.numerator.extend(p.iter().map(|x| x / c));
            q.fill(0.0);
            q[0] = 1.0;
        } else {
            rows.linear = false;
            rows.numerator.extend(p);
        }
        rows.denominator.extend(q);
    }
    let finite = rows.numerator.iter().chain(&rows.denominator).all(|x| x.is_finite());
    finite.then_some(rows)
}

fn form_at(tape: &Tape, inputs: &[f64]) -> Option<Form> {
    let width = 1 + tape.parameters();
    let mut forms: Vec<Form> = Vec::with_capacity(tape.ops().len());
    for op in tape.ops() {
        let at = |n: u32| &forms[n as usize];
        let all: Vec<&Form> = op.operands().map(at).collect();
        let free: Option<Vec<f64>> = all.iter().map(|form| form.free()).collect();
        let form = match (*op, free) {
            (Op::Parameter(i), _) => {
                let mut p = vec![0.0; width];
                p[1 + usize::from(i)] = 1.0;
                Form::Quotient { p, q: one(width) }
            }
            (_, Some(values)) => Form::Free(value(op, inputs, &values)),
            (Op::Unary(UnaryOp::Negate, a), _) => at(a).times(&Form::Free(-1.0))?,
            (Op::Binary(BinaryOp::Add, a, b), _) => at(a).plus(at(b), 1.0, width)?,
            (Op::Binary(BinaryOp::Subtract, a, b), _) => at(a).plus(at(b), -1.0, width)?,
            (Op::Binary(BinaryOp::Multiply, a, b), _) => at(a).times(at(b))?,
            (Op::Binary(BinaryOp::Divide, a, b), _) => at(a).over(at(b), width)?,
            (Op::Fma(a, b, c), _) => at(a).times(at(b))?.plus(at(c), 1.0, width)?,
            (Op::Select(c, accept, reject), _) => match at(c).free()? {
                1.0 => at(accept).clone(),
                0.0 => at(reject).clone(),
                _ => return None,
            },
            _ => return None,
        };
        forms.push(form);
    }
    forms.pop()
}

impl Form {
    fn free(&self) -> Option<f64> {
        match self {
            Form::Free(x) => Some(*x),
            Form::Quotient { .. } => None,
        }
    }

    fn rows(self, parameters: usize) -> (Vec<f64>, Vec<f64>) {
        match self {
            Form::Quotient { p, q } => (p, q),
            Form::Free(x) => {
                let mut p = vec![0.0; 1 + parameters];
                p[0] = x;
                (p, one(1 + parameters))
            }
        }
    }

    /// self + sign other
    fn plus(&self, other: &Form, sign: f64, width: usize) -> Option<Form> {
        let ((p, q), (r, s)) = (self.clone().rows(width - 1), other.clone().rows(width - 1));
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + sign * b).collect::<Vec<f64>>();
        if q == s {
            return Some(Form::Quotient { p: sum(&p, &r), q });
        }
        // p/q + r/s = (p s + r q) / (q s)
        Some(Form::Quotient { p: sum(&product(&p, &s)?, &product(&r, &q)?), q: product(&q, &s)? })
    }

    fn times(&self, other: &Form) -> Option<Form> {
        match (self, other) {
            (Form::Free(x), Form::Free(y)) => Some(Form::Free(x * y)),
            (Form::Quotient { p, q }, Form::Free(x)) | (Form::Free(x), Form::Quotient { p, q }) => {
                Some(Form::Quotient { p: scaled(p, *x), q: q.clone() })
            }
            (Form::Quotient { p, q }, Form::Quotient { p: r, q: s }) => {
                Some(Form::Quotient { p: product(p, r)?, q: product(q, s)? })
            }
        }
    }

    fn over(&self, other: &Form, width: usize) -> Option<Form> {
        let ((p, q), (r, s)) = (self.clone().rows(width - 1), other.clone().rows(width - 1));
        if q == s {
            return Some(Form::Quotient { p, q: r });
        }
        Some(Form::Quotient { p: product(&p, &s)?, q: product(&q, &r)? })
    }
}

/// The value of an operation whose operands have these values.
fn value(op: &Op, inputs: &[f64], operands: &[f64]) -> f64 {
    let alone = match *op {
        Op::Input(_) | Op::Literal(_) | Op::Parameter(_) => *op,
        Op::Unary(code, _) => Op::Unary(code, 0),
        Op::Binary(code, ..) => Op::Binary(code, 0, 1),
        Op::Fma(..) => Op::Fma(0, 1, 2),
        Op::Select(..) => Op::Select(0, 1, 2),
    };
    alone.evaluate(inputs, &[], operands)
}

fn one(width: usize) -> Vec<f64> {
    let mut row = vec![0.0; width];
    row[0] = 1.0;
    row
}

fn is_free(row: &[f64]) -> bool {
    row[1..].iter().all(|x| *x == 0.0)
}

fn scaled(row: &[f64], x: f64) -> Vec<f64> {
    row.iter().map(|r| r * x).collect()
}

/// The product of two affine rows, if one of them is a number.
fn product(a: &[f64], b: &[f64]) -> Option<Vec<f64>> {
    if is_free(a) {
        return Some(scaled(b, a[0]));
    }
    is_free(b).then(|| scaled(a, b[0]))
}
