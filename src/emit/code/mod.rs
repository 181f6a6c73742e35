//! A fitted formula as source code: Rust and WGSL, with the hypothesis's own names and structure.
//!
//! Both printers write the specialised formula: coefficients and constant sub-expressions as the shortest decimals
//! that read back to the same f32, in the order of operations of the hypothesis, with no more parentheses than that
//! order needs. `a + -c b` is written `a - c b`, which has the same bits.

mod expression;
mod names;
mod rust;
mod wgsl;

use crate::fit::{Builtin, Expr, ExprKind, FitError, Formula, Hypothesis, Statement};

/// Magnitude below which a coefficient is refused: shaders flush subnormal numbers, and products of tiny ones are.
const TINY: f32 = 1e-30;

/// A function as source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Printed {
    /// The function, with its helpers and its header; ends in a line feed.
    pub text: String,
    /// Rust: whether it needs `std` (sqrt, floor, mul_add, exp, ...); `core` is enough otherwise.
    pub needs_std: bool,
    /// Whether its bits are promised: it uses no transcendental function, whose last bits are the platform's.
    /// `min`, `max` and `clamp` are excepted where an operand is not a number or two zeros differ in sign.
    pub exact: bool,
}

/// A fit that cannot be printed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodeError {
    /// The coefficients do not fit the hypothesis.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A number too small for shaders.
    #[error(
        "{function}: number {value:e} is below {TINY:e}: round it to 0 or change the units of the hypothesis"
    )]
    Tiny {
        /// Function's name.
        function: String,
        /// The number.
        value: f32,
    },
    /// A function's name is a word of the language.
    #[error("function {function}: its name means something else in {language}: rename it in the hypothesis")]
    Name {
        /// Function's name.
        function: String,
        /// The language.
        language: &'static str,
    },
}

/// The fit as a Rust function `pub fn name(inputs: f32, ...) -> f32`, with `header` as its documentation.
///
/// The text compiles alone, without dependencies, editions 2021 and 2024, free of warnings. Where [`Printed::exact`]
/// holds, it returns the bits of the hypothesis's tape in f32; `exp`, `exp2`, `ln`, `log2`, `powf`, `sin`, `cos` are
/// std's and may differ by some ulp.
///
/// # Errors
/// Coefficients of the wrong number, not finite, or below 1e-30; a function named as a word of Rust.
pub fn rust(hypothesis: &Hypothesis, coefficients: &[f32], header: &[String]) -> Result<Printed, CodeError> {
    let formula = specialise(hypothesis, coefficients)?;
    Ok(printed(rust::print(&formula, header)?, &formula))
}

/// The fit as a WGSL function, with `header` as its documentation. It is itself a hypothesis without parameters
/// whose tape has the same values.
///
/// # Errors
/// Coefficients of the wrong number, not finite, or below 1e-30; a function named as a built-in.
pub fn wgsl(hypothesis: &Hypothesis, coefficients: &[f32], header: &[String]) -> Result<Printed, CodeError> {
    let formula = specialise(hypothesis, coefficients)?;
    Ok(printed(wgsl::print(&formula, header)?, &formula))
}

fn specialise(hypothesis: &Hypothesis, coefficients: &[f32]) -> Result<Formula, CodeError> {
    let formula = hypothesis.specialise(coefficients)?;
    let mut tiny = None;
    for function in &formula.functions {
        visit(&function.body, &mut |expr| match expr.kind {
            ExprKind::Number(value) if value != 0.0 && value.abs() < TINY => tiny = Some(value),
            _ => {}
        });
    }
    let function = hypothesis.name().to_string();
    tiny.map_or(Ok(formula), |value| Err(CodeError::Tiny { function, value }))
}

fn printed(text: String, formula: &Formula) -> Printed {
    let (mut needs_std, mut exact) = (false, true);
    for function in &formula.functions {
        visit(&function.body, &mut |expr| {
            if let ExprKind::Builtin(builtin, _) = &expr.kind {
                let transcendental = transcendental(*builtin);
                exact &= !transcendental;
                needs_std |= transcendental
                    || matches!(
                        builtin,
                        Builtin::Sqrt | Builtin::InverseSqrt | Builtin::Floor | Builtin::Fma
                    );
            }
        });
    }
    Printed { text, needs_std, exact }
}

fn transcendental(builtin: Builtin) -> bool {
    matches!(
        builtin,
        Builtin::Exp
            | Builtin::Exp2
            | Builtin::Log
            | Builtin::Log2
            | Builtin::Pow
            | Builtin::Sin
            | Builtin::Cos
    )
}

/// Calls `f` on every expression of a block.
fn visit(body: &[Statement], f: &mut impl FnMut(&Expr)) {
    for statement in body {
        match statement {
            Statement::Let(_, e) | Statement::Var(_, e) | Statement::Assign(_, e) | Statement::Return(e) => {
                visit_expression(e, f);
            }
            Statement::If(condition, accept, reject) => {
                visit_expression(condition, f);
                visit(accept, f);
                visit(reject, f);
            }
        }
    }
}

fn visit_expression(expr: &Expr, f: &mut impl FnMut(&Expr)) {
    f(expr);
    for operand in expr.operands() {
        visit_expression(operand, f);
    }
}
