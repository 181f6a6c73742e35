//! A formula with its coefficients filled in, for printing.

use super::syntax::{Binary, Expr, ExprKind, Formula, Function, Statement, Unary};
use crate::ShadeError;
use crate::tape::fold;

/// Replaces parameters by coefficients and folds constant sub-expressions in f32.
pub(crate) fn specialise(formula: &Formula, coefficients: &[f32]) -> Result<Formula, ShadeError> {
    if coefficients.len() != formula.parameters.len() {
        let what = format!("{}: coefficients", formula.main().name);
        return Err(ShadeError::Shape {
            what,
            found: coefficients.len(),
            expected: formula.parameters.len(),
        });
    }
    for (index, value) in coefficients.iter().enumerate() {
        finite(*value, &format!("{}: coefficient", formula.main().name), index)?;
    }
    let functions: Result<Vec<Function>, ShadeError> = formula
        .functions
        .iter()
        .map(|f| Ok(Function { body: block(&f.body, coefficients, &f.name)?, ..f.clone() }))
        .collect();
    Ok(Formula { functions: functions?, parameters: Vec::new(), float: formula.float })
}

fn finite(value: f32, column: &str, index: usize) -> Result<(), ShadeError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(ShadeError::NotFinite { column: column.to_string(), index, value: f64::from(value) })
}

fn block(body: &[Statement], coefficients: &[f32], name: &str) -> Result<Vec<Statement>, ShadeError> {
    let value = |e: &Expr| expression(e, coefficients, name);
    body.iter()
        .map(|statement| {
            Ok(match statement {
                Statement::Let(variable, e) => Statement::Let(*variable, value(e)?),
                Statement::Var(variable, e) => Statement::Var(*variable, value(e)?),
                Statement::Assign(variable, e) => Statement::Assign(*variable, value(e)?),
                Statement::Return(e) => Statement::Return(value(e)?),
                Statement::If(condition, accept, reject) => Statement::If(
                    value(condition)?,
                    block(accept, coefficients, name)?,
                    block(reject, coefficients, name)?,
                ),
                Statement::Each(element, list, body) => {
                    Statement::Each(*element, *list, block(body, coefficients, name)?)
                }
            })
        })
        .collect()
}

fn expression(expr: &Expr, coefficients: &[f32], name: &str) -> Result<Expr, ShadeError> {
    let value = |e: &Expr| expression(e, coefficients, name);
    let values = |list: &[Expr]| list.iter().map(value).collect::<Result<Vec<Expr>, ShadeError>>();
    let kind = match &expr.kind {
        ExprKind::Parameter(index) => ExprKind::Number(coefficients[*index]),
        ExprKind::Unary(op, a) => ExprKind::Unary(*op, Box::new(value(a)?)),
        ExprKind::Binary(op, a, b) => binary(*op, value(a)?, value(b)?),
        ExprKind::Power(a, n) => ExprKind::Power(Box::new(value(a)?), *n),
        ExprKind::Builtin(builtin, operands) => ExprKind::Builtin(*builtin, values(operands)?),
        ExprKind::Call(function, operands) => ExprKind::Call(*function, values(operands)?),
        ExprKind::Compose(components) => ExprKind::Compose(values(components)?),
        ExprKind::Component(vector, i) => ExprKind::Component(Box::new(value(vector)?), *i),
        other => other.clone(),
    };
    folded(Expr { kind, span: expr.span }, name)
}

/// The literal that an expression of literals is worth; any other expression as it is.
fn folded(expr: Expr, name: &str) -> Result<Expr, ShadeError> {
    let literal = |e: &&Expr| matches!(e.kind, ExprKind::Number(_) | ExprKind::Truth(_));
    let operands = expr.operands();
    let vector = matches!(expr.kind, ExprKind::Call(..) | ExprKind::Compose(_));
    if operands.is_empty() || vector || !operands.iter().all(literal) {
        return Ok(expr);
    }
    let kind = fold(&expr, name)?;
    if let ExprKind::Number(value) = kind {
        finite(value, &format!("{name}: constant sub-expression"), 0)?;
    }
    Ok(Expr { kind, span: expr.span })
}

/// x + -c is printed x - c, and x + -c y as x - c y: IEEE arithmetic gives the same bits.
fn binary(op: Binary, left: Expr, right: Expr) -> ExprKind {
    let opposite = match op {
        Binary::Add => Some(Binary::Subtract),
        Binary::Subtract => Some(Binary::Add),
        _ => None,
    };
    match (opposite, negated(&right)) {
        (Some(opposite), Some(right)) => ExprKind::Binary(opposite, Box::new(left), Box::new(right)),
        _ => ExprKind::Binary(op, Box::new(left), Box::new(right)),
    }
}

/// -e where e is a negative literal, a product or quotient led by one, or a negation.
fn negated(expr: &Expr) -> Option<Expr> {
    let kind = match &expr.kind {
        ExprKind::Number(x) if x.is_sign_negative() => ExprKind::Number(-x),
        ExprKind::Unary(Unary::Negate, a) => return Some((**a).clone()),
        ExprKind::Binary(op @ (Binary::Multiply | Binary::Divide), a, b) => {
            ExprKind::Binary(*op, Box::new(negated(a)?), b.clone())
        }
        _ => return None,
    };
    Some(Expr { kind, span: expr.span })
}
