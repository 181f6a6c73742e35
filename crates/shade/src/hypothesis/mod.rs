//! A hypothesis: a WGSL module whose last function is a formula and whose `override` declarations
//! are its free parameters.
//!
//! The dialect: f32 and bool; `const`, `override`, `let`, `var`; `if`, `return`; calls of the
//! module's own functions; arithmetic, comparisons, logic; `abs min max clamp saturate mix fma sqrt
//! inverseSqrt exp exp2 log log2 pow floor sign step smoothstep sin cos select`. Everything else is
//! refused with its place. WGSL rounds literals to f32 when it parses them; the f64 evaluation uses
//! the rounded values too.

mod branch;
mod declare;
mod each;
mod expression;
mod lower;
mod places;
mod size;
mod specialise;
mod syntax;
mod vector;

pub(crate) use lower::{lower_functions, parse, visit};
pub use size::Limits;
pub(crate) use specialise::specialise;
pub use syntax::{
    Binary, Builtin, Expr, ExprKind, Fetches, Formula, Function, Kind, Parameter, Statement, Unary, Variable,
    power_steps,
};

use super::code::Float;
use super::inline::inlined;
use super::tape::Tape;
use super::trim::drop_uncalled;
use super::{Place, ShadeError};

/// Stack of the thread that parses: the WGSL front end recurses over nested expressions.
const PARSER_STACK: usize = 64 << 20;

/// Runs a parser of a source of moderate size on a stack of its own.
pub(crate) fn on_parser_stack<T: Send>(
    file: &str,
    source: &str,
    parse: impl FnOnce() -> Result<T, ShadeError> + Send,
) -> Result<T, ShadeError> {
    size::check(file, source)?;
    let lost = || ShadeError::Syntax {
        place: Box::new(Place::of(file, source, 0, 0)),
        message: "the WGSL front end failed on this source".to_string(),
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(PARSER_STACK);
        let handle = thread.spawn_scoped(scope, parse);
        handle.map_err(|e| ShadeError::Thread { message: e.to_string() })?.join().map_err(|_| lost())?
    })
}

/// A formula with free parameters, ready to be evaluated, fitted and printed.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    file: String,
    source: String,
    doc: Vec<String>,
    inputs: Vec<String>,
    formula: Formula,
    tape: Tape,
}

impl Hypothesis {
    /// Parses and checks a WGSL module; `file` is used in messages only.
    ///
    /// The last function of the module is the formula: f32 arguments (its inputs, by name), f32
    /// result. A parameter without initial value starts at 1.
    ///
    /// # Errors
    /// Sources beyond [`Limits`]; what is not WGSL ([`ShadeError::Syntax`]); what is WGSL outside
    /// the dialect, an unused parameter, a function that is never called ([`ShadeError::Dialect`]);
    /// each with file, line, column.
    pub fn parse(file: &str, source: &str) -> Result<Hypothesis, ShadeError> {
        on_parser_stack(file, source, || Self::parse_here(file, source))
    }

    fn parse_here(file: &str, source: &str) -> Result<Hypothesis, ShadeError> {
        let lowered = lower::lower(file, source)?;
        let tape = Tape::of(&lowered.formula, file, source)?;
        let main = lowered.formula.main();
        let inputs = main.variables[..main.arguments].iter().map(|v| v.name.clone()).collect();
        Ok(Hypothesis {
            file: file.to_string(),
            source: source.to_string(),
            doc: lowered.doc,
            inputs,
            formula: lowered.formula,
            tape,
        })
    }

    /// The same formula under another function name; its source keeps the old one.
    pub fn renamed(&self, name: &str) -> Hypothesis {
        let mut renamed = self.clone();
        if let Some(main) = renamed.formula.functions.last_mut() {
            main.name = name.to_string();
        }
        renamed.tape = self.tape.renamed(name);
        renamed
    }

    /// The module with one more function after its own, which becomes the formula, in one piece.
    ///
    /// # Errors
    /// As [`Hypothesis::parse`].
    pub fn wrapped(&self, function: &str) -> Result<Hypothesis, ShadeError> {
        let wrapped = Hypothesis::parse(&self.file, &format!("{}\n{function}", self.source))?;
        Ok(Hypothesis { doc: self.doc.clone(), ..wrapped.in_one_piece()? })
    }

    /// The formula with its calls of straight functions written out; a function that is not called
    /// any more is left out.
    ///
    /// # Errors
    /// More operations than [`Limits`] has.
    pub fn in_one_piece(mut self) -> Result<Hypothesis, ShadeError> {
        let functions = &mut self.formula.functions;
        for index in 0..functions.len() {
            functions[index] = inlined(functions, index, &|_| true);
        }
        drop_uncalled(functions);
        self.tape = Tape::of(&self.formula, &self.file, &self.source)?;
        Ok(self)
    }

    /// The same formula with numbers of another type in printed code; its tape is the same.
    pub fn in_float(mut self, float: Float) -> Hypothesis {
        self.formula.float = float;
        self
    }

    /// The type of its numbers in printed code.
    pub fn float(&self) -> Float {
        self.formula.float
    }

    /// Names of its arguments in the printed code: those of its inputs, unless they were renamed.
    pub fn arguments(&self) -> Vec<String> {
        let main = self.formula.main();
        main.variables[..main.arguments].iter().map(|variable| variable.name.clone()).collect()
    }

    /// The formula with other names for some of its arguments in the printed code, where each pair
    /// is a name and the one that stands for it. Its inputs keep theirs.
    pub fn with_arguments(mut self, names: &[(&str, &str)]) -> Hypothesis {
        if let Some(main) = self.formula.functions.last_mut() {
            main.rename_arguments(names);
        }
        self
    }

    /// Name of the formula's function.
    pub fn name(&self) -> &str {
        &self.formula.main().name
    }

    /// File as named to [`Hypothesis::parse`].
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The WGSL source.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Lines of the module's and the formula's documentation comments, without their markers.
    pub fn doc(&self) -> &[String] {
        &self.doc
    }

    /// Names of the arguments, in order.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// Free parameters in order of declaration.
    pub fn parameters(&self) -> &[Parameter] {
        &self.formula.parameters
    }

    /// Starting values of the parameters.
    pub fn starts(&self) -> Vec<f64> {
        self.parameters().iter().map(|p| f64::from(p.start)).collect()
    }

    /// The formula, parameters free.
    pub fn formula(&self) -> &Formula {
        &self.formula
    }

    /// The formula as a list of operations.
    pub fn tape(&self) -> &Tape {
        &self.tape
    }

    /// The formula with coefficients in place of its parameters and constant sub-expressions
    /// folded, in f32, for printing. It has the bits of the tape at these coefficients.
    ///
    /// # Errors
    /// Another number of coefficients than parameters; a coefficient that is not finite; a constant
    /// sub-expression that is not.
    pub fn specialise(&self, coefficients: &[f32]) -> Result<Formula, ShadeError> {
        specialise(&self.formula, coefficients)
    }
}
