//! Names in the printed code: the hypothesis's own, unless the language has taken them.

use std::collections::BTreeMap;

use super::CodeError;
use super::printer::Facts;
use super::spelling::free;
use super::words::Words;
use crate::{Formula, Function};

/// The printed names of one formula.
pub(super) struct Names {
    words: &'static Words,
    /// Of the functions, in order.
    pub functions: Vec<String>,
    /// Of the functions that the language lacks, by what they compute (`pow5`, `mix`).
    pub helpers: BTreeMap<String, String>,
}

impl Names {
    /// The formula keeps its name; its helpers get it as a prefix, so that files can hold many
    /// formulas.
    ///
    /// # Errors
    /// The formula's name is a word of the language, or no name in it.
    pub fn of(formula: &Formula, facts: &'static Facts) -> Result<Names, CodeError> {
        let words = &facts.words;
        let main = &formula.main().name;
        check(main, facts)?;
        let last = formula.functions.len() - 1;
        let name = |(index, function): (usize, &Function)| {
            let prefixed = function.name.starts_with(&format!("{main}_"));
            let name = (words.spelled)(&function.name);
            if index == last || prefixed { name } else { format!("{main}_{}", name.trim_start_matches('_')) }
        };
        let mut functions: Vec<String> = Vec::new();
        for named in formula.functions.iter().enumerate().map(name) {
            let unique = free(&named, |n| words.takes_function(n) || functions.iter().any(|f| f == n));
            functions.push(unique);
        }
        Ok(Names { words, functions, helpers: BTreeMap::new() })
    }

    /// Every function keeps its name, `index` being the one that is printed.
    ///
    /// # Errors
    /// Its name is a word of the language, or no name in it.
    pub fn whole(formula: &Formula, index: usize, facts: &'static Facts) -> Result<Names, CodeError> {
        check(&formula.functions[index].name, facts)?;
        let functions = formula.functions.iter().map(|function| function.name.clone()).collect();
        Ok(Names { words: &facts.words, functions, helpers: BTreeMap::new() })
    }

    /// Names a function that the language lacks, with the formula's name as prefix.
    pub fn help(&mut self, main: &str, base: &str) {
        let name = free(&format!("{main}_{base}"), |n| self.functions.iter().any(|f| f == n));
        self.helpers.insert(base.to_string(), name);
    }

    /// Names of a function's variables.
    pub fn variables(&self, function: &Function) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for variable in &function.variables {
            let taken = |n: &str| {
                self.words.takes(n)
                    || names.iter().chain(&self.functions).chain(self.helpers.values()).any(|m| m == n)
            };
            names.push(free(&(self.words.spelled)(&variable.name), taken));
        }
        names
    }
}

/// Whether a function may have a name.
fn check(name: &str, facts: &Facts) -> Result<(), CodeError> {
    let (function, language) = (name.to_string(), facts.title);
    if facts.words.takes_function(name) {
        return Err(CodeError::Name { function, language });
    }
    if (facts.words.spelled)(name) != name {
        return Err(CodeError::Letters { function, language });
    }
    Ok(())
}
