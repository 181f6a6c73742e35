//! Names in the printed code: the hypothesis's own, unless the language has taken them.

use super::CodeError;
use crate::fit::{Formula, Function};

/// A language's reserved words, as far as a WGSL identifier can be one.
pub(super) struct Reserved {
    pub language: &'static str,
    pub words: &'static [&'static str],
}

/// Words of Rust (all editions) that WGSL allows as names.
pub(super) const RUST: Reserved = Reserved {
    language: "Rust",
    words: &[
        "abstract", "as", "async", "await", "become", "box", "do", "dyn", "extern", "f32", "final", "gen",
        "impl", "in", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
        "static", "super", "trait", "try", "type", "typeof", "union", "unsafe", "unsized", "use", "virtual",
        "where", "yield", "crate", "self", "Self", "main",
    ],
};

/// Built-ins of WGSL that the printed code may call, and so must not be shadowed.
pub(super) const WGSL: Reserved = Reserved {
    language: "WGSL",
    words: &[
        "abs",
        "min",
        "max",
        "clamp",
        "saturate",
        "mix",
        "fma",
        "sqrt",
        "inverseSqrt",
        "exp",
        "exp2",
        "log",
        "log2",
        "pow",
        "floor",
        "sign",
        "step",
        "smoothstep",
        "sin",
        "cos",
        "select",
    ],
};

/// The printed names of one formula.
pub(super) struct Names {
    pub functions: Vec<String>,
}

impl Names {
    /// The formula keeps its name; its helpers get it as a prefix, so that files can hold many formulas.
    ///
    /// # Errors
    /// The formula's name is reserved.
    pub fn of(formula: &Formula, reserved: &Reserved) -> Result<Names, CodeError> {
        let main = &formula.main().name;
        if reserved.words.contains(&main.as_str()) {
            return Err(CodeError::Name { function: main.clone(), language: reserved.language });
        }
        let last = formula.functions.len() - 1;
        let name = |(index, function): (usize, &Function)| {
            let prefixed = function.name.starts_with(&format!("{main}_"));
            if index == last || prefixed {
                function.name.clone()
            } else {
                format!("{main}_{}", function.name)
            }
        };
        let mut functions: Vec<String> = Vec::new();
        for named in formula.functions.iter().enumerate().map(name) {
            let unique = free(&named, |n| functions.iter().any(|f| f == n));
            functions.push(unique);
        }
        Ok(Names { functions })
    }

    /// Names of a function's variables.
    pub fn variables(&self, function: &Function, reserved: &Reserved) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for variable in &function.variables {
            let taken = |n: &str| {
                reserved.words.contains(&n)
                    || names.iter().any(|m| m == n)
                    || self.functions.iter().any(|f| f == n)
            };
            names.push(free(&variable.name, taken));
        }
        names
    }
}

/// `name`, with underscores appended until it is not taken.
pub(super) fn free(name: &str, taken: impl Fn(&str) -> bool) -> String {
    let mut name = name.to_string();
    while taken(&name) {
        name.push('_');
    }
    name
}
