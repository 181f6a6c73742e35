//! Functions as text, in any language.

use std::collections::BTreeMap;

use super::expression::Writer;
use super::names::Names;
use super::printer::Printer;
use super::spelling::free;
use super::{CodeError, comment, helpers};
use crate::{Formula, Function, Kind};

/// Longest line before arguments get lines of their own.
const WIDTH: usize = 120;

/// Prints a specialised formula, `header` before its main function.
pub(super) fn print(
    printer: &dyn Printer,
    formula: &Formula,
    header: &[String],
) -> Result<String, CodeError> {
    let mut names = Names::of(formula, printer.facts())?;
    let mut out = String::new();
    if !printer.nests_helpers() {
        for base in helpers::needed(printer, &formula.functions) {
            names.help(&formula.main().name, &base);
            out.push_str(&format!("{}\n", printer.helper(&base, &names.helpers[&base])));
        }
    }
    let printing = Printing { printer, formula, names: &names };
    for index in 0..formula.functions.len() {
        let main = index + 1 == formula.functions.len();
        if main {
            out.push_str(&comment("///", header));
        }
        printing.function(index, main, &mut out);
        if !main {
            out.push('\n');
        }
    }
    Ok(out)
}

/// Prints one of the functions of a specialised formula; the others keep their names.
pub(super) fn print_one(
    printer: &dyn Printer,
    formula: &Formula,
    index: usize,
    header: &[String],
) -> Result<String, CodeError> {
    let names = Names::whole(formula, index, printer.facts())?;
    let mut out = comment("///", header);
    Printing { printer, formula, names: &names }.function(index, true, &mut out);
    Ok(out)
}

/// A formula being printed.
struct Printing<'a> {
    printer: &'a dyn Printer,
    formula: &'a Formula,
    names: &'a Names,
}

impl Printing<'_> {
    fn function(&self, index: usize, public: bool, out: &mut String) {
        let (printer, function) = (self.printer, &self.formula.functions[index]);
        let names = self.names.variables(function);
        let inner = self.inner(function, &names);
        let writer = Writer {
            printer,
            functions: &self.formula.functions,
            function,
            function_names: &self.names.functions,
            names: &names,
            helpers: if printer.nests_helpers() { &inner } else { &self.names.helpers },
        };
        let name = &self.names.functions[index];
        out.push_str(&printer.attributes(function, &names, name));
        let argument =
            |i: usize| printer.argument(&names[i], &printer.kind(function.variables[i].kind.clone()));
        let arguments: Vec<String> = (0..function.arguments).map(argument).collect();
        let [start, end] = printer.signature(name, &printer.kind(function.result.clone()), public);
        out.push_str(&within(&start, &arguments, &end));
        for (base, name) in &inner {
            let text = printer.helper(base, name);
            text.lines().for_each(|line| out.push_str(&format!("    {line}\n")));
        }
        let unused = (0..function.arguments).filter(|&i| !function.reads(i));
        for line in unused.filter_map(|i| printer.unused(&names[i])) {
            out.push_str(&format!("    {line}\n"));
        }
        let lists = (0..function.arguments).filter(|&i| matches!(function.variables[i].kind, Kind::List(_)));
        for [_, copy] in lists.filter_map(|i| printer.copied(&names[i])) {
            out.push_str(&format!("    {copy}\n"));
        }
        writer.block(&function.body, 1, true, out);
        out.push_str("}\n");
    }

    /// The helpers that stand inside a function, with names that nothing else in it has.
    fn inner(&self, function: &Function, names: &[String]) -> BTreeMap<String, String> {
        if !self.printer.nests_helpers() {
            return BTreeMap::new();
        }
        let needed = helpers::needed(self.printer, std::slice::from_ref(function));
        let taken = |n: &str| names.iter().chain(&self.names.functions).any(|v| v == n);
        needed.into_iter().map(|base| (base.clone(), free(&base, taken))).collect()
    }
}

/// A list in one line, or one item in each.
pub(super) fn within(start: &str, list: &[String], end: &str) -> String {
    let line = format!("{start}{}{end}", list.join(", "));
    if line.trim_end().len() <= WIDTH {
        return line;
    }
    format!("{start}\n    {}\n{end}", list.join(",\n    "))
}
