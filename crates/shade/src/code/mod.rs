//! A fitted formula as source code, with the hypothesis's own names and structure, in every
//! [`Language`].
//!
//! The printers write the specialised formula: coefficients and constant sub-expressions as the
//! shortest decimals that read back to the same f32, in the order of operations of the hypothesis,
//! with no more parentheses than that order needs. `a + -c b` is written `a - c b`, which has the
//! same bits.
//!
//! What is promised of the values, beside those of the hypothesis's tape in f32:
//!
//! - Rust: the same bits where [`Printed::exact`], else 8 ulp. Tested with rustc, run.
//! - C: the same bits where [`Printed::exact`], else 4 ulp, without contraction, on machines that
//!   evaluate a float as a float. Contracted, each operation's error is no larger than its
//!   rounding's. Tested with a C99 compiler, run, and a C++ compiler.
//! - WGSL: read back, the same bits; on a device, what WGSL leaves to it: sums and products within
//!   1 ulp, quotients 2.5. Tested with naga, and a Vulkan device.
//! - HLSL, GLSL: the same as C, with the specifications' built-ins, in C++; on a device, what
//!   Vulkan leaves to it, which is the same as in WGSL. Tested with glslang, SPIR-V Tools, and a
//!   Vulkan device.
//! - MSL: the same as C, with the specification's built-ins, in C++. No Metal compiler runs outside
//!   Apple's systems, and none has read it; fast math, its default, may reorder sums.
//!
//! The ulp are of sums of positive terms, or of 1 where terms cancel. In C's family, `mix` is x
//! (1 - t) + y t by a function of ours where the language's own is x + t (y - x); `select` is `?:`,
//! both of whose operands are free of side effects; `fma` is `fmaf`, `fma` in MSL, `mad` in HLSL
//! and, for versions that have none, `x * y + z` in GLSL, the last two of which may round once or
//! twice.

mod c;
mod c_table;
mod counted;
mod expression;
mod family;
mod float;
mod function;
mod glsl;
mod helpers;
mod hlsl;
mod language;
mod lines;
mod msl;
mod names;
mod pair;
mod printer;
mod rust;
mod rust_table;
mod spelling;
mod subvoxels;
mod table;
mod wgsl;
mod words;

use crate::comment::comment;
use crate::hypothesis::visit;
use crate::{Builtin, ExprKind, Formula, Hypothesis, ShadeError};
pub use c_table::C_PREFIX;
pub use counted::MaskCost;
pub use expression::decimal;
pub use float::Float;
pub use language::Language;
pub use lines::lines as wrapped;
pub use rust_table::RUST_HELPERS;
pub use subvoxels::{MASK_FUNCTIONS, MaskFunction, subvoxels};
pub use table::{LETTERS, TEXTURE_AXES, TableLookup, Texels, helpers};

/// Magnitude below which a coefficient is refused: shaders flush subnormal numbers, and products of
/// tiny ones are.
const TINY: f32 = 1e-30;

/// A function as source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Printed {
    /// The function, with its helpers and its header; ends in a line feed.
    pub text: String,
    /// Rust: whether it needs `std` (sqrt, floor, mul_add, exp, ...); `core` is enough otherwise.
    pub needs_std: bool,
    /// Whether its bits are promised, as far as the language promises bits: it uses no
    /// transcendental function, whose last bits are the platform's, no f16, and no `fma` where the language
    /// may round twice. `min`, `max` and `clamp` are excepted where an operand is not a number or
    /// two zeros differ in sign.
    pub exact: bool,
}

/// A fit that cannot be printed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodeError {
    /// The coefficients do not fit the hypothesis.
    #[error(transparent)]
    Fit(#[from] ShadeError),
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
    /// A function's name has letters that the language's names do not.
    #[error(
        "function {function}: in {language} names are of ASCII letters, digits and single underscores, a letter first: \
         rename it in the hypothesis"
    )]
    Letters {
        /// Function's name.
        function: String,
        /// The language.
        language: &'static str,
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

/// The fit as a function of numbers of the hypothesis's [`Float`], `header` as its documentation.
///
/// The text stands after [`Language::opening`] in a file and needs nothing else. Its functions keep
/// the hypothesis's names, but for words that the language has taken; helpers have the formula's
/// name before theirs, so that one file can hold many formulas. Every function stands before its
/// first use.
///
/// # Errors
/// Coefficients of the wrong number, not finite, or below 1e-30; a function named as a word of the
/// language, or in letters that it does not have.
pub fn print(
    language: Language,
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    header: &[String],
) -> Result<Printed, CodeError> {
    let formula = specialise(hypothesis, coefficients)?;
    let text = function::print(language.printer(formula.float), &formula, header)?;
    Ok(printed(text, language, &formula))
}

/// Two evaluations of the fit at once in half precision, of vectors of two numbers, under the name of
/// [`pair_of`]; none in a language without half precision, and of a formula that has no pair.
///
/// # Errors
/// As [`print()`].
pub fn print_pair(
    language: Language,
    hypothesis: &Hypothesis,
    coefficients: &[f32],
    header: &[String],
) -> Result<Option<String>, CodeError> {
    let (Some(printer), Some(name)) = (language.pair_printer(), pair_of(hypothesis)) else { return Ok(None) };
    let formula = specialise(&hypothesis.renamed(&name), coefficients)?;
    function::print(printer, &formula, header).map(Some)
}

/// The name of the function that evaluates a formula of f16 twice at once; none of f32, and of a
/// formula that branches or compares, which vectors do not.
pub fn pair_of(hypothesis: &Hypothesis) -> Option<String> {
    let has = hypothesis.float() == Float::F16 && pair::has(hypothesis.formula());
    has.then(|| format!("{}_pair", hypothesis.name()))
}

/// One function of a formula without parameters, `header` as its documentation; what it calls
/// stands before it under its own name.
pub(crate) fn print_function(
    language: Language,
    formula: &Formula,
    index: usize,
    header: &[String],
) -> Result<String, CodeError> {
    let formula = crate::hypothesis::specialise(formula, &[])?;
    function::print_one(language.printer(formula.float), &formula, index, header)
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

fn printed(text: String, language: Language, formula: &Formula) -> Printed {
    let (mut needs_std, mut exact) = (false, formula.float == Float::F32);
    for function in &formula.functions {
        visit(&function.body, &mut |expr| {
            if let ExprKind::Builtin(builtin, _) = &expr.kind {
                let transcendental = transcendental(*builtin);
                exact &= !transcendental && language.printer(formula.float).rounds(*builtin);
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
