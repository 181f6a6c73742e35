//! Operators of shaders on values: entry by entry, a scalar with every entry of a vector, and the
//! products of matrices.

use naga::{BinaryOperator, Expression, Handle, RelationalFunction, Span, UnaryOperator};

use super::value::{Maker, Value};
use super::walk::{ONLY, Walk};
use crate::foreign::ForeignError;
use lobefit_shade::{BinaryOp, Node, UnaryOp};

/// The operands of an expression whose value follows from theirs, in order.
pub(super) fn operands(expression: &Expression) -> Vec<Handle<Expression>> {
    match expression {
        Expression::Compose { components, .. } => components.clone(),
        Expression::Splat { value, .. } => vec![*value],
        Expression::Swizzle { vector, .. } => vec![*vector],
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => vec![*expr],
        Expression::Binary { left, right, .. } => vec![*left, *right],
        Expression::Select { condition, accept, reject } => vec![*condition, *accept, *reject],
        Expression::Relational { argument, .. } => vec![*argument],
        Expression::Math { arg, arg1, arg2, arg3, .. } => {
            [Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten().collect()
        }
        _ => Vec::new(),
    }
}

pub(super) fn unary(
    walk: &mut Walk,
    op: UnaryOperator,
    x: &Value,
    span: Span,
) -> Result<Value, ForeignError> {
    Ok(match (op, x) {
        (_, Value::List(list)) => {
            let entries = list.iter().map(|entry| unary(walk, op, entry, span));
            Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?)
        }
        (UnaryOperator::Negate, Value::Number(a)) => Value::Number(walk.maker.unary(UnaryOp::Negate, *a)),
        (UnaryOperator::Negate, Value::Integer(a)) => Value::Integer(-a),
        (UnaryOperator::LogicalNot, Value::Truth(a)) => Value::Truth(walk.maker.not(*a)),
        (_, other) => return Err(walk.mismatch(span, other)),
    })
}

pub(super) fn binary(
    walk: &mut Walk,
    op: BinaryOperator,
    x: &Value,
    y: &Value,
    span: Span,
) -> Result<Value, ForeignError> {
    if op == BinaryOperator::Multiply && (x.is_matrix() || y.is_matrix()) {
        return product(walk, x, y, span);
    }
    Ok(match (x, y) {
        (Value::List(a), Value::List(b)) if a.len() == b.len() => {
            let entries = a.iter().zip(b).map(|(a, b)| binary(walk, op, a, b, span));
            Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?)
        }
        (Value::List(a), b @ (Value::Number(_) | Value::Integer(_))) => {
            let entries = a.iter().map(|a| binary(walk, op, a, b, span));
            Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?)
        }
        (a @ (Value::Number(_) | Value::Integer(_)), Value::List(b)) => {
            let entries = b.iter().map(|b| binary(walk, op, a, b, span));
            Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?)
        }
        (Value::Number(a), Value::Number(b)) => return numbers(walk, op, *a, *b, span),
        (Value::Integer(a), Value::Integer(b)) => return integers(walk, op, *a, *b, span),
        (Value::Truth(a), Value::Truth(b)) => Value::Truth(truths(walk, op, *a, *b, span)?),
        (Value::Unset, _) | (_, Value::Unset) => return Err(walk.mismatch(span, &Value::Unset)),
        (other, _) => return Err(walk.mismatch(span, other)),
    })
}

fn numbers(walk: &mut Walk, op: BinaryOperator, a: Node, b: Node, span: Span) -> Result<Value, ForeignError> {
    let maker = &mut walk.maker;
    let compared = match op {
        BinaryOperator::Less => maker.binary(BinaryOp::Less, a, b),
        BinaryOperator::LessEqual => maker.binary(BinaryOp::LessEqual, a, b),
        BinaryOperator::Greater => maker.binary(BinaryOp::Less, b, a),
        BinaryOperator::GreaterEqual => maker.binary(BinaryOp::LessEqual, b, a),
        BinaryOperator::Equal => maker.binary(BinaryOp::Equal, a, b),
        BinaryOperator::NotEqual => {
            let equal = maker.binary(BinaryOp::Equal, a, b);
            maker.not(equal)
        }
        BinaryOperator::Add => return Ok(Value::Number(maker.add(a, b))),
        BinaryOperator::Subtract => return Ok(Value::Number(maker.subtract(a, b))),
        BinaryOperator::Multiply => return Ok(Value::Number(maker.multiply(a, b))),
        BinaryOperator::Divide => return Ok(Value::Number(maker.binary(BinaryOp::Divide, a, b))),
        // x - y trunc(x / y)
        BinaryOperator::Modulo => {
            let ratio = maker.binary(BinaryOp::Divide, a, b);
            let whole = truncated(maker, ratio);
            let part = maker.multiply(b, whole);
            return Ok(Value::Number(maker.subtract(a, part)));
        }
        _ => return Err(walk.source.unsupported(span, "this operator", ONLY)),
    };
    Ok(Value::Truth(compared))
}

/// Towards zero: sign(x) floor(|x|).
pub(super) fn truncated(maker: &mut Maker, x: Node) -> Node {
    let magnitude = maker.unary(UnaryOp::Abs, x);
    let whole = maker.unary(UnaryOp::Floor, magnitude);
    let sign = maker.unary(UnaryOp::Sign, x);
    maker.multiply(sign, whole)
}

fn truths(walk: &mut Walk, op: BinaryOperator, a: Node, b: Node, span: Span) -> Result<Node, ForeignError> {
    let maker = &mut walk.maker;
    Ok(match op {
        BinaryOperator::LogicalAnd | BinaryOperator::And => maker.and(a, b),
        BinaryOperator::LogicalOr | BinaryOperator::InclusiveOr => maker.or(a, b),
        BinaryOperator::Equal => maker.binary(BinaryOp::Equal, a, b),
        BinaryOperator::NotEqual | BinaryOperator::ExclusiveOr => {
            let equal = maker.binary(BinaryOp::Equal, a, b);
            maker.not(equal)
        }
        _ => return Err(walk.source.unsupported(span, "this operator", ONLY)),
    })
}

fn integers(walk: &mut Walk, op: BinaryOperator, a: i64, b: i64, span: Span) -> Result<Value, ForeignError> {
    use BinaryOperator as Op;
    let compared = match op {
        Op::Less => a < b,
        Op::LessEqual => a <= b,
        Op::Greater => a > b,
        Op::GreaterEqual => a >= b,
        Op::Equal => a == b,
        Op::NotEqual => a != b,
        _ => {
            let value = match op {
                Op::Add => a.checked_add(b),
                Op::Subtract => a.checked_sub(b),
                Op::Multiply => a.checked_mul(b),
                Op::Divide => a.checked_div(b),
                Op::Modulo => a.checked_rem(b),
                Op::And => Some(a & b),
                Op::InclusiveOr => Some(a | b),
                Op::ExclusiveOr => Some(a ^ b),
                Op::ShiftLeft if (0..32).contains(&b) => a.checked_mul(1 << b),
                Op::ShiftRight if (0..32).contains(&b) => Some(a >> b),
                _ => None,
            };
            // i32 and u32 alike; what wraps around is no counter.
            let value = value.filter(|v| (-(1i64 << 31)..1 << 32).contains(v));
            return value.map(Value::Integer).ok_or_else(|| {
                walk.source.unsupported(span, "an integer beyond 32 bits, or this operator", ONLY)
            });
        }
    };
    Ok(Value::Truth(walk.maker.truth(compared)))
}

pub(super) fn relational(
    walk: &mut Walk,
    function: RelationalFunction,
    x: &Value,
    span: Span,
) -> Result<Value, ForeignError> {
    let entries = match x {
        Value::Truth(node) => vec![*node],
        Value::List(list) => {
            list.iter().filter_map(|v| if let Value::Truth(n) = v { Some(*n) } else { None }).collect()
        }
        _ => Vec::new(),
    };
    let Some((&first, rest)) = entries.split_first() else { return Err(walk.mismatch(span, x)) };
    let maker = &mut walk.maker;
    Ok(Value::Truth(match function {
        RelationalFunction::All => rest.iter().fold(first, |all, &entry| maker.and(all, entry)),
        RelationalFunction::Any => rest.iter().fold(first, |any, &entry| maker.or(any, entry)),
        _ => {
            return Err(walk.source.unsupported(
                span,
                "isnan or isinf",
                "nothing may be infinite or not a number",
            ));
        }
    }))
}

/// The product with a matrix: columns times entries; a vector on the left counts as a row.
fn product(walk: &mut Walk, x: &Value, y: &Value, span: Span) -> Result<Value, ForeignError> {
    let wrong = |walk: &Walk| Err(walk.mismatch(span, x));
    match (x, y) {
        (Value::Number(_), Value::List(columns)) | (Value::List(columns), Value::Number(_)) => {
            let scalar = if let Value::Number(_) = x { x } else { y };
            let entries =
                columns.iter().map(|column| binary(walk, BinaryOperator::Multiply, column, scalar, span));
            Ok(Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?))
        }
        (_, Value::List(columns)) if x.is_matrix() && y.is_matrix() => {
            let entries = columns.iter().map(|column| product(walk, x, column, span));
            Ok(Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?))
        }
        (Value::List(columns), Value::List(entries)) if x.is_matrix() => {
            if columns.len() != entries.len() {
                return wrong(walk);
            }
            let mut sum: Option<Value> = None;
            for (column, entry) in columns.iter().zip(entries) {
                let term = binary(walk, BinaryOperator::Multiply, column, entry, span)?;
                sum = Some(match sum {
                    None => term,
                    Some(sum) => binary(walk, BinaryOperator::Add, &sum, &term, span)?,
                });
            }
            sum.map_or_else(|| wrong(walk), Ok)
        }
        (Value::List(_), Value::List(columns)) => {
            let entries = columns.iter().map(|column| dot(walk, x, column, span).map(Value::Number));
            Ok(Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?))
        }
        _ => wrong(walk),
    }
}

/// x0 y0 + x1 y1 + ..., from the left.
pub(super) fn dot(walk: &mut Walk, x: &Value, y: &Value, span: Span) -> Result<Node, ForeignError> {
    let (Some(a), Some(b)) = (x.numbers(), y.numbers()) else { return Err(walk.mismatch(span, x)) };
    let maker = &mut walk.maker;
    let mut sum: Option<Node> = None;
    if a.len() == b.len() {
        for (&a, &b) in a.iter().zip(&b) {
            let term = maker.multiply(a, b);
            sum = Some(sum.map_or(term, |sum| maker.add(sum, term)));
        }
    }
    sum.ok_or_else(|| walk.mismatch(span, x))
}
