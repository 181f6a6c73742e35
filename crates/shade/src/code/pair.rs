//! Which formulas may be evaluated twice at once, on vectors of two numbers.

use crate::hypothesis::visit;
use crate::{Binary, Builtin, Expr, ExprKind, Formula, Kind, Statement, Unary};

/// Whether every value of a formula is a number that depends on no condition: then the same text
/// with vectors for numbers computes each component as the formula computes a number.
pub(super) fn has(formula: &Formula) -> bool {
    formula.functions.iter().all(|function| {
        let numbers = function.variables.iter().all(|variable| variable.kind == Kind::Number);
        let straight = |statement: &Statement| !matches!(statement, Statement::If(..) | Statement::Each(..));
        let mut is_plain = true;
        visit(&function.body, &mut |expr| is_plain &= plain(expr));
        numbers && function.result == Kind::Number && function.body.iter().all(straight) && is_plain
    })
}

fn plain(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Truth(_) | ExprKind::Compose(_) | ExprKind::Component(..) => false,
        ExprKind::Unary(op, _) => *op == Unary::Negate,
        ExprKind::Binary(op, ..) => {
            matches!(op, Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide)
        }
        ExprKind::Builtin(builtin, _) => {
            use Builtin::{Dot, Select, Sign, SmoothStep, Step};
            !matches!(builtin, Dot | Select | Sign | SmoothStep | Step)
        }
        ExprKind::Number(_)
        | ExprKind::Parameter(_)
        | ExprKind::Variable(_)
        | ExprKind::Power(..)
        | ExprKind::Call(..) => true,
    }
}
