//! Values of a tape, 64 points at a time.

use multiversion::multiversion;
use rayon::prelude::*;

use super::real::{binary, select, unary};
use super::{BinaryOp, Op, Real, Tape};
use crate::ShadeError;

/// Points evaluated together.
pub const BLOCK: usize = 64;

/// Points per parallel task; a whole number of blocks, so that no result depends on the number of
/// threads.
const TASK: usize = 64 * BLOCK;

/// One value per point of a block.
pub(super) type Lanes<R> = [R; BLOCK];

/// Room for the values (and derivatives) of one block.
pub struct Workspace<R> {
    pub(super) values: Vec<Lanes<R>>,
    pub(super) adjoints: Vec<Lanes<R>>,
}

impl<R: Real> Workspace<R> {
    /// Room for `tape`.
    pub fn new(tape: &Tape) -> Workspace<R> {
        Workspace { values: vec![[R::ZERO; BLOCK]; tape.ops.len()], adjoints: Vec::new() }
    }

    /// The results of the last block evaluated.
    pub fn result(&self) -> &[R; BLOCK] {
        // A tape has at least its result.
        &self.values[self.values.len() - 1]
    }

    /// All values of an operation in the last block evaluated.
    pub fn values_of(&self, node: u32) -> &[R; BLOCK] {
        &self.values[node as usize]
    }
}

impl Op {
    /// Value from those of the operations before it.
    #[inline(always)]
    pub fn evaluate<R: Real>(&self, inputs: &[R], coefficients: &[R], values: &[R]) -> R {
        let v = |n: u32| values[n as usize];
        match *self {
            Op::Input(i) => inputs[usize::from(i)],
            Op::Parameter(i) => coefficients[usize::from(i)],
            Op::Literal(x) => R::literal(x),
            Op::Unary(code, a) => unary(code, v(a)),
            Op::Binary(code, a, b) => binary(code, v(a), v(b)),
            Op::Fma(a, b, c) => v(a).fma(v(b), v(c)),
            Op::Select(a, b, c) => select(v(a), v(b), v(c)),
        }
    }
}

impl Tape {
    /// Value at one point: inputs and coefficients in order.
    ///
    /// # Panics
    /// Fewer inputs or coefficients than the tape has; [`Tape::evaluate`] checks instead.
    pub fn at<R: Real>(&self, inputs: &[R], coefficients: &[R]) -> R {
        // a small tape needs no room of its own
        if self.ops.len() <= BLOCK {
            return self.run(inputs, coefficients, &mut [R::ZERO; BLOCK][..self.ops.len()]);
        }
        self.run(inputs, coefficients, &mut vec![R::ZERO; self.ops.len()])
    }

    fn run<R: Real>(&self, inputs: &[R], coefficients: &[R], values: &mut [R]) -> R {
        for (node, op) in self.ops.iter().enumerate() {
            values[node] = op.evaluate(inputs, coefficients, values);
        }
        values[values.len() - 1]
    }

    /// Values at columns of points (one column per input, equally long), in parallel and in order.
    ///
    /// # Errors
    /// Columns or coefficients of the wrong number or length.
    pub fn evaluate<R: Real>(&self, inputs: &[Vec<R>], coefficients: &[R]) -> Result<Vec<R>, ShadeError> {
        let points = self.check_shape(inputs, coefficients)?;
        let tasks: Vec<Vec<R>> = (0..points.div_ceil(TASK))
            .into_par_iter()
            .map(|task| {
                let start = task * TASK;
                let end = points.min(start + TASK);
                let mut workspace = Workspace::new(self);
                let mut out = Vec::with_capacity(end - start);
                for block in (start..end).step_by(BLOCK) {
                    let count = BLOCK.min(end - block);
                    self.forward(inputs, block, count, coefficients, &mut workspace);
                    out.extend_from_slice(&workspace.result()[..count]);
                }
                out
            })
            .collect();
        Ok(tasks.concat())
    }

    /// Number of points of the columns, if these and the coefficients fit the tape.
    pub fn check_shape<R>(&self, inputs: &[Vec<R>], coefficients: &[R]) -> Result<usize, ShadeError> {
        let shape = |what: &str, found, expected| {
            if found == expected {
                return Ok(());
            }
            Err(ShadeError::Shape { what: format!("{}: {what}", self.function), found, expected })
        };
        shape("columns of inputs", inputs.len(), self.inputs.len())?;
        shape("coefficients", coefficients.len(), self.parameters)?;
        let points = inputs.first().map_or(1, Vec::len);
        for (name, column) in self.inputs.iter().zip(inputs) {
            shape(&format!("points of input {name}"), column.len(), points)?;
        }
        Ok(points)
    }

    /// Evaluates points `start .. start + count` of the columns into `workspace`; lanes beyond
    /// repeat the last one.
    pub fn forward<R: Real>(
        &self,
        inputs: &[Vec<R>],
        start: usize,
        count: usize,
        coefficients: &[R],
        workspace: &mut Workspace<R>,
    ) {
        sweep(&self.ops, inputs, [start, count], coefficients, &mut workspace.values);
    }
}

/// The values of operations in order, by the instructions that the processor has: the same operations,
/// and nothing is contracted, so that the bits are the same.
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"))]
fn sweep<R: Real>(
    ops: &[Op],
    inputs: &[Vec<R>],
    [start, count]: [usize; 2],
    coefficients: &[R],
    values: &mut [Lanes<R>],
) {
    for (node, op) in ops.iter().enumerate() {
        let (done, rest) = values.split_at_mut(node);
        let out = &mut rest[0];
        let v = |n: u32| &done[n as usize];
        match *op {
            Op::Input(i) => {
                let column = &inputs[usize::from(i)][start..start + count];
                out[..count].copy_from_slice(column);
                out[count..].fill(column[count - 1]);
            }
            Op::Parameter(i) => out.fill(coefficients[usize::from(i)]),
            Op::Literal(x) => out.fill(R::literal(x)),
            Op::Unary(code, a) => map(out, v(a), |x| unary(code, x)),
            Op::Binary(code, a, b) => two(code, out, v(a), v(b)),
            Op::Fma(a, b, c) => {
                let (a, b, c) = (v(a), v(b), v(c));
                (0..BLOCK).for_each(|i| out[i] = a[i].fma(b[i], c[i]));
            }
            Op::Select(a, b, c) => {
                let (a, b, c) = (v(a), v(b), v(c));
                (0..BLOCK).for_each(|i| out[i] = select(a[i], b[i], c[i]));
            }
        }
    }
}

#[inline(always)]
fn map<R: Real>(out: &mut Lanes<R>, a: &Lanes<R>, f: impl Fn(R) -> R) {
    for i in 0..BLOCK {
        out[i] = f(a[i]);
    }
}

/// A binary operation on all lanes; the common ones as loops of their own, which the compiler
/// vectorises.
#[inline(always)]
fn two<R: Real>(code: BinaryOp, out: &mut Lanes<R>, a: &Lanes<R>, b: &Lanes<R>) {
    #[inline(always)]
    fn lanes<R: Real>(out: &mut Lanes<R>, a: &Lanes<R>, b: &Lanes<R>, f: impl Fn(R, R) -> R) {
        for i in 0..BLOCK {
            out[i] = f(a[i], b[i]);
        }
    }
    match code {
        BinaryOp::Add => lanes(out, a, b, |x, y| x + y),
        BinaryOp::Subtract => lanes(out, a, b, |x, y| x - y),
        BinaryOp::Multiply => lanes(out, a, b, |x, y| x * y),
        BinaryOp::Divide => lanes(out, a, b, |x, y| x / y),
        other => lanes(out, a, b, |x, y| binary(other, x, y)),
    }
}
