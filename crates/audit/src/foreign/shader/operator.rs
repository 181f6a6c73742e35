//! Operators and built-in functions of shaders on values, by the formulas of the WGSL and GLSL
//! specifications: in f32, nothing contracted; entry by entry, a scalar with every entry of a vector.
//! `None` of operands that they do not take.

use naga::{BinaryOperator, MathFunction, RelationalFunction, ScalarKind, UnaryOperator};

use super::value::Value;
use lobefit_math::ops;
use lobefit_shade::{BinaryOp, Op, UnaryOp, power_steps};

/// Largest exponent that is multiplied out, as in hypotheses.
const POWER: u32 = 16;

fn apply(op: UnaryOp, x: f32) -> f32 {
    Op::Unary(op, 0).evaluate(&[], &[], &[x])
}

fn combine(op: BinaryOp, x: f32, y: f32) -> f32 {
    Op::Binary(op, 0, 1).evaluate(&[], &[], &[x, y])
}

pub(super) fn unary(op: UnaryOperator, x: &Value) -> Option<Value> {
    match (op, x) {
        (_, Value::List(list)) => Value::list(list.iter().map(|entry| unary(op, entry))),
        (UnaryOperator::Negate, Value::Number(a)) => Some(Value::Number(-a)),
        (UnaryOperator::Negate, Value::Integer(a)) => Some(Value::Integer(-a)),
        (UnaryOperator::LogicalNot, Value::Truth(a)) => Some(Value::Truth(1.0 - a)),
        _ => None,
    }
}

pub(super) fn binary(op: BinaryOperator, x: &Value, y: &Value) -> Option<Value> {
    match (x, y) {
        _ if op == BinaryOperator::Multiply && (x.is_matrix() || y.is_matrix()) => product(x, y),
        (Value::List(a), Value::List(b)) if a.len() == b.len() => {
            Value::list(a.iter().zip(b).map(|(a, b)| binary(op, a, b)))
        }
        (Value::List(_), Value::List(_)) => None,
        (Value::List(a), b) => Value::list(a.iter().map(|a| binary(op, a, b))),
        (a, Value::List(b)) => Value::list(b.iter().map(|b| binary(op, a, b))),
        (Value::Number(a), Value::Number(b)) => numbers(op, *a, *b),
        (Value::Integer(a), Value::Integer(b)) => integers(op, *a, *b),
        (Value::Truth(a), Value::Truth(b)) => truths(op, *a, *b).map(Value::Truth),
        _ => None,
    }
}

fn numbers(op: BinaryOperator, a: f32, b: f32) -> Option<Value> {
    use BinaryOperator as By;
    Some(Value::Truth(match op {
        By::Less => combine(BinaryOp::Less, a, b),
        By::LessEqual => combine(BinaryOp::LessEqual, a, b),
        By::Greater => combine(BinaryOp::Less, b, a),
        By::GreaterEqual => combine(BinaryOp::LessEqual, b, a),
        By::Equal => combine(BinaryOp::Equal, a, b),
        By::NotEqual => 1.0 - combine(BinaryOp::Equal, a, b),
        By::Add => return Some(Value::Number(a + b)),
        By::Subtract => return Some(Value::Number(a - b)),
        By::Multiply => return Some(Value::Number(a * b)),
        By::Divide => return Some(Value::Number(a / b)),
        By::Modulo => return Some(Value::Number(a - b * (a / b).trunc())),
        _ => return None,
    }))
}

fn truths(op: BinaryOperator, a: f32, b: f32) -> Option<f32> {
    Some(match op {
        BinaryOperator::LogicalAnd | BinaryOperator::And => combine(BinaryOp::And, a, b),
        BinaryOperator::LogicalOr | BinaryOperator::InclusiveOr => combine(BinaryOp::Or, a, b),
        BinaryOperator::Equal => combine(BinaryOp::Equal, a, b),
        BinaryOperator::NotEqual | BinaryOperator::ExclusiveOr => 1.0 - combine(BinaryOp::Equal, a, b),
        _ => return None,
    })
}

fn integers(op: BinaryOperator, a: i64, b: i64) -> Option<Value> {
    use BinaryOperator as By;
    let value = match op {
        By::Less => return Some(Value::truth(a < b)),
        By::LessEqual => return Some(Value::truth(a <= b)),
        By::Greater => return Some(Value::truth(a > b)),
        By::GreaterEqual => return Some(Value::truth(a >= b)),
        By::Equal => return Some(Value::truth(a == b)),
        By::NotEqual => return Some(Value::truth(a != b)),
        By::Add => a.checked_add(b)?,
        By::Subtract => a.checked_sub(b)?,
        By::Multiply => a.checked_mul(b)?,
        By::Divide => a.checked_div(b)?,
        By::Modulo => a.checked_rem(b)?,
        By::And => a & b,
        By::InclusiveOr => a | b,
        By::ExclusiveOr => a ^ b,
        By::ShiftLeft if (0..32).contains(&b) => a.checked_mul(1 << b)?,
        By::ShiftRight if (0..32).contains(&b) => a >> b,
        _ => return None,
    };
    // i32 and u32 alike; what wraps around is no counter.
    (-(1i64 << 31)..1 << 32).contains(&value).then_some(Value::Integer(value))
}

pub(super) fn relational(function: RelationalFunction, x: &Value) -> Option<Value> {
    let op = match function {
        RelationalFunction::All => BinaryOperator::LogicalAnd,
        RelationalFunction::Any => BinaryOperator::LogicalOr,
        _ => return None,
    };
    let entries = x.entries().unwrap_or(std::slice::from_ref(x));
    let (first, rest) = entries.split_first()?;
    rest.iter().try_fold(first.clone(), |sum, entry| binary(op, &sum, entry))
}

/// accept or reject, entry by entry where the condition is a vector.
pub(super) fn choose(condition: &Value, accept: &Value, reject: &Value) -> Option<Value> {
    match (condition, accept, reject) {
        (Value::Truth(c), Value::Number(a), Value::Number(b)) => {
            Some(Value::Number(Op::Select(0, 1, 2).evaluate(&[], &[], &[*c, *a, *b])))
        }
        (Value::Truth(_), Value::List(a), Value::List(b)) if a.len() == b.len() => {
            Value::list(a.iter().zip(b).map(|(a, b)| choose(condition, a, b)))
        }
        (Value::List(c), Value::List(a), Value::List(b)) if c.len() == a.len() && a.len() == b.len() => {
            Value::list(c.iter().zip(a).zip(b).map(|((c, a), b)| choose(c, a, b)))
        }
        (Value::Truth(c), a, b) if !c.is_nan() => Some(if *c == 1.0 { a } else { b }.clone()),
        _ => None,
    }
}

pub(super) fn convert(value: &Value, kind: ScalarKind) -> Option<Value> {
    use ScalarKind::{Bool, Float, Sint, Uint};
    match (value, kind) {
        (Value::List(list), _) => Value::list(list.iter().map(|entry| convert(entry, kind))),
        (Value::Number(_), Float) | (Value::Truth(_), Bool) | (Value::Integer(_), Sint | Uint) => {
            Some(value.clone())
        }
        (Value::Integer(x), Float) => Some(Value::Number(*x as f32)),
        (Value::Integer(x), Bool) => Some(Value::truth(*x != 0)),
        (Value::Truth(x), Float) => Some(Value::Number(*x)),
        // Towards zero, as both languages say; in range, or the languages do not say.
        (Value::Number(x), Sint | Uint) if x.abs() < 2147483648.0 && (kind == Sint || *x >= 0.0) => {
            Some(Value::Integer(*x as i64))
        }
        _ => None,
    }
}

/// The product with a matrix: columns times entries; a vector on the left counts as a row.
fn product(x: &Value, y: &Value) -> Option<Value> {
    let multiply = |a: &Value, b: &Value| binary(BinaryOperator::Multiply, a, b);
    match (x, y) {
        (Value::Number(_), Value::List(columns)) | (Value::List(columns), Value::Number(_)) => {
            let scalar = if let Value::Number(_) = x { x } else { y };
            Value::list(columns.iter().map(|column| multiply(column, scalar)))
        }
        (_, Value::List(columns)) if x.is_matrix() && y.is_matrix() => {
            Value::list(columns.iter().map(|column| product(x, column)))
        }
        (Value::List(columns), Value::List(entries)) if x.is_matrix() && columns.len() == entries.len() => {
            let mut terms = columns.iter().zip(entries).map(|(column, entry)| multiply(column, entry));
            let first = terms.next()??;
            terms.try_fold(first, |sum, term| binary(BinaryOperator::Add, &sum, &term?))
        }
        (Value::List(_), Value::List(columns)) if !x.is_matrix() => {
            Value::list(columns.iter().map(|column| dot(x, column).map(Value::Number)))
        }
        _ => None,
    }
}

/// x0 y0 + x1 y1 + ..., from the left.
fn dot(x: &Value, y: &Value) -> Option<f32> {
    let (a, b) = (x.numbers()?, y.numbers()?);
    let terms = a.iter().zip(&b).map(|(a, b)| a * b);
    terms.reduce(|sum, term| sum + term).filter(|_| a.len() == b.len())
}

/// A built-in function; `known` says whether the last operand is a constant of the text.
pub(super) fn function(f: MathFunction, x: &[Value], known: bool) -> Option<Value> {
    match (f, x) {
        (MathFunction::Dot, [a, b]) => return dot(a, b).map(Value::Number),
        (MathFunction::Length | MathFunction::Normalize, [a]) => return size(f, a),
        (MathFunction::Distance, [a, b]) => return size(f, &binary(BinaryOperator::Subtract, a, b)?),
        (MathFunction::Transpose, [matrix]) => return transpose(matrix),
        (MathFunction::Cross, [a, b]) => return cross(a, b),
        (MathFunction::Reflect, [i, n]) => return along(i, n, -2.0 * dot(n, i)?),
        (MathFunction::Refract, [i, n, Value::Number(eta)]) => return refract(i, n, *eta),
        (MathFunction::FaceForward, [n, i, g]) => {
            return if dot(g, i)? < 0.0 { Some(n.clone()) } else { unary(UnaryOperator::Negate, n) };
        }
        _ => {}
    }
    let Some(length) = x.iter().find_map(|v| v.entries().map(<[Value]>::len)) else {
        return scalar(f, x, known);
    };
    Value::list((0..length).map(|i| {
        let entry = |value: &Value| value.entries().map_or(Some(value.clone()), |list| list.get(i).cloned());
        function(f, &x.iter().map(entry).collect::<Option<Vec<Value>>>()?, known)
    }))
}

fn scalar(f: MathFunction, x: &[Value], known: bool) -> Option<Value> {
    Some(Value::Number(match x {
        [Value::Integer(a), rest @ ..] => return integer(f, *a, rest).map(Value::Integer),
        [a, b, c @ Value::Truth(_)] if f == MathFunction::Mix => return choose(c, b, a),
        [Value::Number(x)] => one(f, *x)?,
        [Value::Number(x), Value::Number(y)] => two(f, *x, *y, known)?,
        [Value::Number(x), Value::Number(y), Value::Number(z)] => three(f, *x, *y, *z)?,
        _ => return None,
    }))
}

fn integer(f: MathFunction, a: i64, rest: &[Value]) -> Option<i64> {
    match (f, rest) {
        (MathFunction::Abs, []) => Some(a.abs()),
        (MathFunction::Sign, []) => Some(a.signum()),
        (MathFunction::Min, [Value::Integer(b)]) => Some(a.min(*b)),
        (MathFunction::Max, [Value::Integer(b)]) => Some(a.max(*b)),
        (MathFunction::Clamp, [Value::Integer(low), Value::Integer(high)]) => Some(a.max(*low).min(*high)),
        _ => None,
    }
}

fn one(f: MathFunction, x: f32) -> Option<f32> {
    let degree = std::f32::consts::PI / 180.0;
    Some(match f {
        MathFunction::Abs => x.abs(),
        MathFunction::Saturate => apply(UnaryOp::Saturate, x),
        MathFunction::Floor => x.floor(),
        MathFunction::Sign => apply(UnaryOp::Sign, x),
        MathFunction::Sqrt => x.sqrt(),
        MathFunction::InverseSqrt => apply(UnaryOp::InverseSqrt, x),
        MathFunction::Exp => apply(UnaryOp::Exp, x),
        MathFunction::Exp2 => apply(UnaryOp::Exp2, x),
        MathFunction::Log => apply(UnaryOp::Log, x),
        MathFunction::Log2 => apply(UnaryOp::Log2, x),
        MathFunction::Sin => apply(UnaryOp::Sin, x),
        MathFunction::Cos => apply(UnaryOp::Cos, x),
        MathFunction::Tan => apply(UnaryOp::Sin, x) / apply(UnaryOp::Cos, x),
        MathFunction::Asin => ops::asinf(x),
        MathFunction::Acos => ops::acosf(x),
        MathFunction::Atan => ops::atanf(x),
        MathFunction::Ceil => x.ceil(),
        MathFunction::Fract => x - x.floor(),
        MathFunction::Trunc => x.trunc(),
        MathFunction::Radians => x * degree,
        MathFunction::Degrees => x * (1.0 / degree),
        _ => return None,
    })
}

fn two(f: MathFunction, x: f32, y: f32, known: bool) -> Option<f32> {
    Some(match f {
        MathFunction::Min => combine(BinaryOp::Min, x, y),
        MathFunction::Max => combine(BinaryOp::Max, x, y),
        // Whole constant exponents are multiplied out, as in hypotheses and by compilers.
        MathFunction::Pow if known && y.fract() == 0.0 && (2.0..=POWER as f32).contains(&y) => {
            let power = |n: u32| (1..=n.ilog2()).fold(x, |square, _| square * square);
            power_steps(y as u32).into_iter().map(power).reduce(|product, square| product * square)?
        }
        MathFunction::Pow => combine(BinaryOp::Pow, x, y),
        MathFunction::Atan2 => ops::atan2f(x, y),
        MathFunction::Step => combine(BinaryOp::LessEqual, x, y),
        _ => return None,
    })
}

fn three(f: MathFunction, x: f32, y: f32, z: f32) -> Option<f32> {
    Some(match f {
        MathFunction::Clamp => combine(BinaryOp::Min, combine(BinaryOp::Max, x, y), z),
        MathFunction::Mix => x * (1.0 - z) + y * z,
        MathFunction::Fma => x.mul_add(y, z),
        MathFunction::SmoothStep => {
            let t = apply(UnaryOp::Saturate, (z - x) / (y - x));
            (t * t) * (3.0 - 2.0 * t)
        }
        _ => return None,
    })
}

/// length(x) and normalize(x).
fn size(f: MathFunction, x: &Value) -> Option<Value> {
    let unit = f == MathFunction::Normalize;
    if let Value::Number(a) = x {
        return Some(Value::Number(if unit { apply(UnaryOp::Sign, *a) } else { a.abs() }));
    }
    let length = Value::Number(dot(x, x)?.sqrt());
    if unit { binary(BinaryOperator::Divide, x, &length) } else { Some(length) }
}

fn cross(a: &Value, b: &Value) -> Option<Value> {
    let (a, b) = (a.numbers()?, b.numbers()?);
    let ([ax, ay, az], [bx, by, bz]) = (<[f32; 3]>::try_from(a).ok()?, <[f32; 3]>::try_from(b).ok()?);
    let entries = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    Some(Value::List(entries.map(Value::Number).to_vec()))
}

/// i + n x.
fn along(i: &Value, n: &Value, x: f32) -> Option<Value> {
    let step = binary(BinaryOperator::Multiply, n, &Value::Number(x))?;
    binary(BinaryOperator::Add, i, &step)
}

/// The refracted direction, by the formula of the GLSL specification, section 8.5; zero where all
/// is reflected.
fn refract(i: &Value, n: &Value, eta: f32) -> Option<Value> {
    let cosine = dot(n, i)?;
    let k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    let scaled = |x: f32| binary(BinaryOperator::Multiply, i, &Value::Number(x));
    if k < 0.0 { scaled(0.0) } else { along(&scaled(eta)?, n, -(eta * cosine + k.sqrt())) }
}

fn transpose(matrix: &Value) -> Option<Value> {
    let columns: Vec<&[Value]> = matrix.entries()?.iter().map(Value::entries).collect::<Option<_>>()?;
    let row = |i: usize| Value::list(columns.iter().map(|column| column.get(i).cloned()));
    Value::list((0..columns.first()?.len()).map(row))
}
