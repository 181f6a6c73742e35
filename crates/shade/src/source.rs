//! Functions of numbers and vectors from one WGSL text: evaluated, counted and printed from the
//! same syntax.

use crate::code::{CodeError, Float, Language};
use crate::hypothesis::{Formula, Function, Kind};
use crate::inline::inlined;
use crate::tape::{Features, Tape};
use crate::trim::trimmed;
use crate::{Place, ShadeError, hypothesis};

/// Functions of one WGSL text, each after those that it calls.
///
/// The dialect is that of [`Hypothesis`](crate::Hypothesis) with `vec2f`, `vec3f` and `vec4f`:
/// their components, constructors, arithmetic, `dot` and `select`. A vector that a function returns
/// gets a name before it is used, and so does one that is an argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    file: String,
    text: String,
    formula: Formula,
    docs: Vec<Vec<String>>,
}

impl Source {
    /// Parses and checks WGSL functions; `file` is used in messages only.
    ///
    /// # Errors
    /// Sources beyond [`Limits`](crate::Limits), what is not WGSL, what is WGSL outside the
    /// dialect; each with file, line, column.
    pub fn parse(file: &str, text: &str) -> Result<Source, ShadeError> {
        hypothesis::on_parser_stack(file, text, || {
            let (formula, docs) = hypothesis::lower_functions(file, text)?;
            Ok(Source { file: file.to_string(), text: text.to_string(), formula, docs })
        })
    }

    /// The same functions with the calls of some written out in those that call them.
    pub fn inlined(mut self, which: impl Fn(&str) -> bool) -> Source {
        for index in 0..self.formula.functions.len() {
            self.formula.functions[index] = inlined(&self.formula.functions, index, &which);
        }
        self
    }

    /// The same functions with numbers of another type in printed code.
    pub fn in_float(mut self, float: Float) -> Source {
        self.formula.float = float;
        self
    }

    /// The same functions without the arguments that they do not read.
    pub fn trimmed(mut self) -> Source {
        self.formula.functions = trimmed(&self.formula.functions);
        self
    }

    /// The same functions, one of them under another name.
    ///
    /// # Errors
    /// There is no function of this name.
    pub fn renamed(mut self, name: &str, to: &str) -> Result<Source, ShadeError> {
        let index = self.index(name)?;
        self.formula.functions[index].name = to.to_string();
        Ok(self)
    }

    /// The same functions with other names for some of their arguments: each pair is a name and the
    /// one that stands for it.
    pub fn with_arguments(mut self, names: &[(&str, &str)]) -> Source {
        self.formula.functions.iter_mut().for_each(|function| function.rename_arguments(names));
        self
    }

    fn index(&self, name: &str) -> Result<usize, ShadeError> {
        let found = self.formula.functions.iter().position(|function| function.name == name);
        found.ok_or_else(|| ShadeError::Dialect {
            place: Box::new(Place::of(&self.file, &self.text, 0, 0)),
            message: format!("there is no function {name}"),
        })
    }

    /// A function.
    ///
    /// # Errors
    /// There is none of this name.
    pub fn function(&self, name: &str) -> Result<&Function, ShadeError> {
        Ok(&self.formula.functions[self.index(name)?])
    }

    /// Names of the arguments that a function reads, in order.
    ///
    /// # Errors
    /// There is no function of this name.
    pub fn read(&self, name: &str) -> Result<Vec<&str>, ShadeError> {
        let function = self.function(name)?;
        let arguments = function.variables[..function.arguments].iter().enumerate();
        Ok(arguments
            .filter(|(i, _)| function.reads(*i))
            .map(|(_, variable)| variable.name.as_str())
            .collect())
    }

    /// Documentation of a function, without the marks of comments.
    ///
    /// # Errors
    /// There is no function of this name.
    pub fn doc(&self, name: &str) -> Result<&[String], ShadeError> {
        Ok(&self.docs[self.index(name)?])
    }

    /// A component of a function's value as a list of operations; its inputs are the arguments,
    /// component by component (`ray.x`).
    ///
    /// # Errors
    /// There is no function of this name; more operations than [`Limits`](crate::Limits) has.
    pub fn tape(&self, name: &str, component: usize) -> Result<Tape, ShadeError> {
        Tape::of_function(&self.formula, self.index(name)?, Some(component), [&self.file, &self.text])
    }

    /// Operations of some functions together, arguments of one name being the same value and what
    /// they share counted once.
    ///
    /// # Errors
    /// There is no function of one of the names; more operations than [`Limits`](crate::Limits)
    /// has.
    pub fn cost_ops(&self, names: &[&str]) -> Result<u32, ShadeError> {
        Ok(self.tape_of(names)?.cost_ops())
    }

    /// The kinds of work in some functions together, as [`Source::cost_ops`] counts them.
    ///
    /// # Errors
    /// As [`Source::cost_ops`].
    pub fn features(&self, names: &[&str]) -> Result<Features, ShadeError> {
        Ok(self.tape_of(names)?.features_of_all())
    }

    fn tape_of(&self, names: &[&str]) -> Result<Tape, ShadeError> {
        let indices: Result<Vec<usize>, ShadeError> = names.iter().map(|name| self.index(name)).collect();
        Tape::of_functions(&self.formula, &indices?, [&self.file, &self.text])
    }

    /// A function as source text, `header` as its documentation. It calls the others by their
    /// names.
    ///
    /// # Errors
    /// There is no function of this name; a number that no shader has, a name that the language has
    /// taken.
    pub fn print(&self, language: Language, name: &str, header: &[String]) -> Result<String, CodeError> {
        crate::code::print_function(language, &self.formula, self.index(name)?, header)
    }

    /// The structure that a function returns, with its documentation; nothing of another function.
    ///
    /// # Errors
    /// There is no function of this name.
    pub fn print_structure(&self, language: Language, name: &str) -> Result<Option<String>, ShadeError> {
        Ok(match &self.function(name)?.result {
            Kind::Fetches(fetches) => Some(language.fetches(fetches)),
            _ => None,
        })
    }

    /// A function with its own documentation.
    ///
    /// # Errors
    /// As [`Source::print`].
    pub fn print_documented(&self, language: Language, name: &str) -> Result<String, CodeError> {
        self.print(language, name, self.doc(name)?)
    }
}
