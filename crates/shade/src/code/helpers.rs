//! What a language lacks, as functions in the order of operations of the tape.

use std::collections::BTreeSet;

use super::expression::power_body;
use super::printer::Printer;
use super::visit;
use crate::{ExprKind, Function};

/// What the functions compute that these call and the language lacks: `mix`, `pow5`, ...
pub(super) fn needed(printer: &dyn Printer, functions: &[Function]) -> BTreeSet<String> {
    let mut needed = BTreeSet::new();
    for function in functions {
        visit(&function.body, &mut |expr| match &expr.kind {
            // WGSL's `pow` is undefined for negative bases
            ExprKind::Power(_, n) => {
                needed.insert(format!("pow{n}"));
            }
            ExprKind::Builtin(builtin, operands) => {
                needed.extend(printer.lacking(*builtin, operands).map(String::from));
            }
            _ => {}
        });
    }
    needed
}

/// The squarings of `pow` and its exponent, each declared as `declare x2 = ...;`, and the value.
pub(super) fn power(base: &str, declare: &str) -> (Vec<String>, String) {
    let exponent = base.strip_prefix("pow").and_then(|n| n.parse().ok());
    power_body(exponent.unwrap_or(1), declare)
}
