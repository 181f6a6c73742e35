//! Derivatives of a tape with respect to its parameters, by the reverse sweep, in f64.

use multiversion::multiversion;

use super::evaluate::{BLOCK, Lanes, Workspace};
use super::{BinaryOp, Op, Tape, UnaryOp};
use lobefit_math::ops;

impl Tape {
    /// The derivatives of the results of the last block evaluated: `gradient[p][lane]`.
    ///
    /// At a kink (|x| at 0, equal operands of min) the derivative is that of the branch taken;
    /// floor and sign have derivative 0.
    pub fn reverse(&self, workspace: &mut Workspace<f64>, gradient: &mut [[f64; BLOCK]]) {
        let Workspace { values, adjoints } = workspace;
        adjoints.clear();
        adjoints.resize(self.ops.len(), [0.0; BLOCK]);
        if let Some(last) = adjoints.last_mut() {
            last.fill(1.0);
        }
        sweep(&self.ops, values, adjoints, gradient);
    }

    /// Derivatives at one point.
    pub fn gradient_at(&self, inputs: &[f64], coefficients: &[f64]) -> Vec<f64> {
        let columns: Vec<Vec<f64>> = inputs.iter().map(|&x| vec![x]).collect();
        let mut workspace = Workspace::new(self);
        self.forward(&columns, 0, 1, coefficients, &mut workspace);
        let mut gradient = vec![[0.0; BLOCK]; self.parameters];
        self.reverse(&mut workspace, &mut gradient);
        gradient.iter().map(|lanes| lanes[0]).collect()
    }
}

/// The reverse sweep by the instructions that the processor has; as those of the values, the bits are
/// the same.
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"))]
fn sweep(ops: &[Op], values: &[Lanes<f64>], adjoints: &mut [Lanes<f64>], gradient: &mut [[f64; BLOCK]]) {
    for (node, op) in ops.iter().enumerate().rev() {
        let (before, rest) = adjoints.split_at_mut(node);
        let seed = &rest[0];
        let v = |n: u32| &values[n as usize];
        match *op {
            Op::Input(_) | Op::Literal(_) => {}
            Op::Parameter(p) => gradient[usize::from(p)] = *seed,
            Op::Unary(code, a) => one(code, v(a), &values[node], seed, &mut before[a as usize]),
            Op::Binary(BinaryOp::Add, a, b) => spread(before, seed, [a, b], |_| [1.0, 1.0]),
            Op::Binary(BinaryOp::Subtract, a, b) => spread(before, seed, [a, b], |_| [1.0, -1.0]),
            Op::Binary(BinaryOp::Multiply, a, b) => spread(before, seed, [a, b], |i| [v(b)[i], v(a)[i]]),
            Op::Binary(code, a, b) => {
                let partials = |i: usize| binary_partials(code, v(a)[i], v(b)[i], values[node][i]);
                spread_dear(before, seed, [a, b], partials);
            }
            Op::Fma(a, b, c) => spread(before, seed, [a, b, c], |i| [v(b)[i], v(a)[i], 1.0]),
            Op::Select(c, a, b) => spread(before, seed, [a, b], |i| {
                let taken = v(c)[i];
                [taken, 1.0 - taken]
            }),
        }
    }
}

/// Adds seed times partial derivative to each operand; where either is 0 nothing is added, whatever
/// the other is.
#[inline(always)]
fn spread<const N: usize>(
    adjoints: &mut [Lanes<f64>],
    seed: &Lanes<f64>,
    operands: [u32; N],
    partials: impl Fn(usize) -> [f64; N],
) {
    for (which, operand) in operands.into_iter().enumerate() {
        let adjoint = &mut adjoints[operand as usize];
        for i in 0..BLOCK {
            let partial = partials(i)[which];
            let product = seed[i] * partial;
            adjoint[i] += if (seed[i] != 0.0) & (partial != 0.0) { product } else { 0.0 };
        }
    }
}

/// [`spread`] where the partial derivatives cost more than a branch.
#[inline(always)]
fn spread_dear<const N: usize>(
    adjoints: &mut [Lanes<f64>],
    seed: &Lanes<f64>,
    operands: [u32; N],
    partials: impl Fn(usize) -> [f64; N],
) {
    for i in 0..BLOCK {
        if seed[i] != 0.0 {
            let partials = partials(i);
            for (operand, partial) in operands.iter().zip(partials) {
                if partial != 0.0 {
                    adjoints[*operand as usize][i] += seed[i] * partial;
                }
            }
        }
    }
}

fn one(code: UnaryOp, x: &Lanes<f64>, y: &Lanes<f64>, seed: &Lanes<f64>, out: &mut Lanes<f64>) {
    for i in 0..BLOCK {
        if seed[i] != 0.0 {
            out[i] += seed[i] * unary_partial(code, x[i], y[i]);
        }
    }
}

/// dy/dx of y = f(x).
fn unary_partial(code: UnaryOp, x: f64, y: f64) -> f64 {
    const LN_2: f64 = std::f64::consts::LN_2;
    match code {
        UnaryOp::Negate | UnaryOp::Not => -1.0,
        UnaryOp::Abs => 1.0_f64.copysign(x),
        UnaryOp::Saturate => f64::from(u8::from((0.0..=1.0).contains(&x))),
        UnaryOp::Floor | UnaryOp::Sign => 0.0,
        UnaryOp::Sqrt => 0.5 / y,
        UnaryOp::InverseSqrt => -0.5 * y / x,
        UnaryOp::Exp => y,
        UnaryOp::Exp2 => y * LN_2,
        UnaryOp::Log => 1.0 / x,
        UnaryOp::Log2 => 1.0 / (x * LN_2),
        UnaryOp::Sin => ops::cos(x),
        UnaryOp::Cos => -ops::sin(x),
    }
}

/// dz/dx and dz/dy of z = f(x, y).
#[inline(always)]
fn binary_partials(code: BinaryOp, x: f64, y: f64, z: f64) -> [f64; 2] {
    match code {
        BinaryOp::Add | BinaryOp::Subtract | BinaryOp::Multiply => unreachable!("spread without branches"),
        BinaryOp::Divide => [1.0 / y, -z / y],
        BinaryOp::Min => choice(y < x),
        BinaryOp::Max => choice(y > x),
        // At x = 0 the formula of both is 0 for y > 1, which is also their limit.
        BinaryOp::Pow if x == 0.0 => [0.0, 0.0],
        BinaryOp::Pow => [y * z / x, z * ops::log(x)],
        BinaryOp::Less | BinaryOp::LessEqual | BinaryOp::Equal | BinaryOp::And | BinaryOp::Or => [0.0, 0.0],
    }
}

fn choice(second: bool) -> [f64; 2] {
    if second { [0.0, 1.0] } else { [1.0, 0.0] }
}
