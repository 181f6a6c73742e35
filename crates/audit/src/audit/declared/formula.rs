//! Formulas of a file's own statement: `sqrt(mu * (1 + l) / (mu + l))`, with `+ - * /`, brackets,
//! `sqrt`, `log2` and literal powers `x^2`. They are spelled as WGSL and evaluated in f64 like
//! every other formula.

use lobefit_shade::{Hypothesis, Tape};

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Formula(Tape);

impl Formula {
    /// Reads a whole text.
    ///
    /// Errors: what stands where something else is called for.
    pub fn parse(text: &str) -> Result<Formula, String> {
        let (formula, names) = spelled(text)?;
        let arguments: Vec<String> = names.iter().map(|name| format!("{name}: f32")).collect();
        let source = format!("fn formula({}) -> f32 {{ return {formula}; }}", arguments.join(", "));
        let parsed = Hypothesis::parse("declared.wgsl", &source);
        parsed.map(|formula| Formula(formula.tape().clone())).map_err(|_| format!("`{text}` is no formula"))
    }

    /// Its value, names given by `of`; none where a name has no value.
    pub fn value(&self, of: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
        let given = self.0.inputs().iter().map(|name| of(name.strip_prefix(PREFIX).unwrap_or(name)));
        Some(self.0.at(&given.collect::<Option<Vec<f64>>>()?, &[]))
    }
}

/// Before every name, so that no name is a word of WGSL.
const PREFIX: &str = "v_";

/// A formula in WGSL, and the names in it, each once.
fn spelled(text: &str) -> Result<(String, Vec<String>), String> {
    let (mut tokens, mut names): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let within = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let end =
            if within(first) { rest.find(|c| !within(c)).unwrap_or(rest.len()) } else { first.len_utf8() };
        let (word, after) = rest.split_at(end);
        rest = after.trim_start();
        if first.is_ascii_digit() {
            let number = word.parse::<f64>().map_err(|_| format!("`{word}` is no number"))?;
            // a literal exponent, else a number that is an f32 even where it is whole
            let power = tokens.pop_if(|token| token == "^").map(|_| operand(&mut tokens));
            tokens.push(power.map_or(format!("{number:?}"), |base| format!("pow({base}, {number:?})")));
        } else if within(first) && rest.starts_with('(') {
            let known = ["sqrt", "log2"].contains(&word);
            tokens.push(known.then(|| word.to_string()).ok_or(format!("no function `{word}` is known"))?);
        } else if within(first) {
            let name = format!("{PREFIX}{word}");
            if !names.contains(&name) {
                names.push(name.clone());
            }
            tokens.push(name);
        } else if "+-*/^()".contains(first) {
            tokens.push(word.to_string());
        } else {
            return Err(format!("`{first}` in `{text}`"));
        }
    }
    Ok((tokens.join(" "), names))
}

/// Takes the last operand from tokens: a name or a number, or a bracket with what stands in it and
/// the function before it.
fn operand(tokens: &mut Vec<String>) -> String {
    let (mut start, mut open) = (tokens.len(), 0);
    while start > 0 {
        start -= 1;
        open += i32::from(tokens[start] == ")") - i32::from(tokens[start] == "(");
        if open <= 0 {
            break;
        }
    }
    let called = start > 0 && ["sqrt", "log2"].contains(&tokens[start - 1].as_str());
    tokens.split_off(start - usize::from(called)).join(" ")
}
