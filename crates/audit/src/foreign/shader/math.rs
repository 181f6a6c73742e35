//! Built-in functions of shaders, by the formulas of the WGSL and GLSL specifications.

use naga::{MathFunction, Span};

use super::arithmetic::{dot, truncated};
use super::value::Value;
use super::walk::{ONLY, Walk};
use crate::foreign::ForeignError;
use lobefit_shade::{BinaryOp, Node, Op, UnaryOp, power_steps};

/// Largest exponent that is multiplied out, as in hypotheses.
const POWER: u32 = 16;

pub(super) fn function(
    walk: &mut Walk,
    f: MathFunction,
    x: &[Value],
    span: Span,
) -> Result<Value, ForeignError> {
    match f {
        MathFunction::Dot => return dot(walk, &x[0], &x[1], span).map(Value::Number),
        MathFunction::Length | MathFunction::Distance | MathFunction::Normalize => {
            return size(walk, f, x, span);
        }
        MathFunction::Transpose => return transpose(walk, &x[0], span),
        _ => {}
    }
    let length = x.iter().find_map(|v| if let Value::List(list) = v { Some(list.len()) } else { None });
    let Some(length) = length else { return scalar(walk, f, x, span) };
    let mut entries = Vec::new();
    for i in 0..length {
        let mut operands = Vec::new();
        for value in x {
            operands.push(match value {
                Value::List(list) => list.get(i).cloned().ok_or_else(|| walk.mismatch(span, value))?,
                scalar => scalar.clone(),
            });
        }
        entries.push(function(walk, f, &operands, span)?);
    }
    Ok(Value::List(entries))
}

fn scalar(walk: &mut Walk, f: MathFunction, x: &[Value], span: Span) -> Result<Value, ForeignError> {
    if let [Value::Integer(a), rest @ ..] = x {
        return integer(walk, f, *a, rest, span);
    }
    let mut numbers = Vec::new();
    for value in x {
        match value {
            Value::Number(node) => numbers.push(*node),
            // mix(x, y, condition)
            Value::Truth(node) if f == MathFunction::Mix => numbers.push(*node),
            other => return Err(walk.mismatch(span, other)),
        }
    }
    if let (MathFunction::Mix, [a, b, _], Value::Truth(c)) = (f, &numbers[..], &x[x.len() - 1]) {
        return Ok(Value::Number(walk.maker.select(*c, *b, *a)));
    }
    let node = match numbers[..] {
        [a] => one(walk, f, a),
        [a, b] => two(walk, f, a, b),
        [a, b, c] => three(walk, f, a, b, c),
        _ => None,
    };
    node.map(Value::Number).ok_or_else(|| walk.source.unsupported(span, format!("the function {f:?}"), ONLY))
}

fn integer(walk: &Walk, f: MathFunction, a: i64, rest: &[Value], span: Span) -> Result<Value, ForeignError> {
    let value = match (f, rest) {
        (MathFunction::Abs, []) => a.abs(),
        (MathFunction::Sign, []) => a.signum(),
        (MathFunction::Min, [Value::Integer(b)]) => a.min(*b),
        (MathFunction::Max, [Value::Integer(b)]) => a.max(*b),
        (MathFunction::Clamp, [Value::Integer(low), Value::Integer(high)]) => a.max(*low).min(*high),
        _ => return Err(walk.source.unsupported(span, format!("the function {f:?} of integers"), ONLY)),
    };
    Ok(Value::Integer(value))
}

fn one(walk: &mut Walk, f: MathFunction, x: Node) -> Option<Node> {
    let maker = &mut walk.maker;
    let unary = match f {
        MathFunction::Abs => UnaryOp::Abs,
        MathFunction::Saturate => UnaryOp::Saturate,
        MathFunction::Floor => UnaryOp::Floor,
        MathFunction::Sign => UnaryOp::Sign,
        MathFunction::Sqrt => UnaryOp::Sqrt,
        MathFunction::InverseSqrt => UnaryOp::InverseSqrt,
        MathFunction::Exp => UnaryOp::Exp,
        MathFunction::Exp2 => UnaryOp::Exp2,
        MathFunction::Log => UnaryOp::Log,
        MathFunction::Log2 => UnaryOp::Log2,
        MathFunction::Sin => UnaryOp::Sin,
        MathFunction::Cos => UnaryOp::Cos,
        MathFunction::Tan => {
            let (sine, cosine) = (maker.unary(UnaryOp::Sin, x), maker.unary(UnaryOp::Cos, x));
            return Some(maker.binary(BinaryOp::Divide, sine, cosine));
        }
        MathFunction::Ceil => {
            let negative = maker.unary(UnaryOp::Negate, x);
            let floor = maker.unary(UnaryOp::Floor, negative);
            return Some(maker.unary(UnaryOp::Negate, floor));
        }
        MathFunction::Fract => {
            let floor = maker.unary(UnaryOp::Floor, x);
            return Some(maker.subtract(x, floor));
        }
        MathFunction::Trunc => return Some(truncated(maker, x)),
        MathFunction::Radians | MathFunction::Degrees => {
            let factor = std::f32::consts::PI / 180.0;
            let factor = maker.literal(if f == MathFunction::Radians { factor } else { 1.0 / factor });
            return Some(maker.multiply(x, factor));
        }
        _ => return None,
    };
    Some(maker.unary(unary, x))
}

fn two(walk: &mut Walk, f: MathFunction, x: Node, y: Node) -> Option<Node> {
    let maker = &mut walk.maker;
    Some(match f {
        MathFunction::Min => maker.binary(BinaryOp::Min, x, y),
        MathFunction::Max => maker.binary(BinaryOp::Max, x, y),
        MathFunction::Pow => power(walk, x, y),
        MathFunction::Step => {
            let (one, zero) = (maker.literal(1.0), maker.literal(0.0));
            let condition = maker.binary(BinaryOp::LessEqual, x, y);
            maker.select(condition, one, zero)
        }
        _ => return None,
    })
}

/// x^y; whole constant exponents are multiplied out, as in hypotheses and by compilers.
fn power(walk: &mut Walk, x: Node, y: Node) -> Node {
    let maker = &mut walk.maker;
    let whole = maker.tape.constant(y).filter(|n| n.floor() == *n && (2.0..=POWER as f32).contains(n));
    let Some(n) = whole else { return maker.binary(BinaryOp::Pow, x, y) };
    let (mut square, mut step, mut result) = (x, 1, None);
    for wanted in power_steps(n as u32) {
        while step < wanted {
            square = maker.multiply(square, square);
            step *= 2;
        }
        result = Some(result.map_or(square, |product| maker.multiply(product, square)));
    }
    result.unwrap_or(x)
}

fn three(walk: &mut Walk, f: MathFunction, x: Node, y: Node, z: Node) -> Option<Node> {
    let maker = &mut walk.maker;
    let (zero, one) = (maker.literal(0.0), maker.literal(1.0));
    Some(match f {
        MathFunction::Clamp if (y, z) == (zero, one) => maker.unary(UnaryOp::Saturate, x),
        MathFunction::Clamp => {
            let above = maker.binary(BinaryOp::Max, x, y);
            maker.binary(BinaryOp::Min, above, z)
        }
        // x (1 - z) + y z
        MathFunction::Mix => {
            let rest = maker.subtract(one, z);
            let (first, second) = (maker.multiply(x, rest), maker.multiply(y, z));
            maker.add(first, second)
        }
        MathFunction::Fma => maker.push(Op::Fma(x, y, z)),
        // t t (3 - 2 t), t = saturate((z - x) / (y - x))
        MathFunction::SmoothStep => {
            let (above, range) = (maker.subtract(z, x), maker.subtract(y, x));
            let ratio = maker.binary(BinaryOp::Divide, above, range);
            let t = maker.unary(UnaryOp::Saturate, ratio);
            let (two, three) = (maker.literal(2.0), maker.literal(3.0));
            let (square, twice) = (maker.multiply(t, t), maker.multiply(two, t));
            let rest = maker.subtract(three, twice);
            maker.multiply(square, rest)
        }
        _ => return None,
    })
}

/// length(x), distance(x, y) and normalize(x).
fn size(walk: &mut Walk, f: MathFunction, x: &[Value], span: Span) -> Result<Value, ForeignError> {
    let vector = match x {
        [a, b] => super::arithmetic::binary(walk, naga::BinaryOperator::Subtract, a, b, span)?,
        [a, ..] => a.clone(),
        [] => Value::Unset,
    };
    if let Value::Number(a) = vector {
        let code = if f == MathFunction::Normalize { UnaryOp::Sign } else { UnaryOp::Abs };
        return Ok(Value::Number(walk.maker.unary(code, a)));
    }
    let square = dot(walk, &vector, &vector, span)?;
    let length = Value::Number(walk.maker.unary(UnaryOp::Sqrt, square));
    match f {
        MathFunction::Normalize => {
            super::arithmetic::binary(walk, naga::BinaryOperator::Divide, &vector, &length, span)
        }
        _ => Ok(length),
    }
}

fn transpose(walk: &mut Walk, matrix: &Value, span: Span) -> Result<Value, ForeignError> {
    let columns: Vec<&Vec<Value>> = match matrix {
        Value::List(columns) => {
            columns.iter().filter_map(|c| if let Value::List(c) = c { Some(c) } else { None }).collect()
        }
        _ => Vec::new(),
    };
    let Some(rows) = columns.first().map(|c| c.len()) else { return Err(walk.mismatch(span, matrix)) };
    let row = |i: usize| Value::List(columns.iter().filter_map(|c| c.get(i).cloned()).collect());
    Ok(Value::List((0..rows).map(row).collect()))
}
