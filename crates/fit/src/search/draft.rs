//! A solved form as text: scaled so that one coefficient is 1, with its documentation.

use super::beam::usable;
use super::form::Form;
use super::helper::Helper;
use super::link::Link;
use super::score::Score;
use super::space::Space;
use super::write::{Layout, Written, layout};
use crate::FitError;
use lobefit_shade::Hypothesis;

/// A form with its coefficients as its layout scales them.
pub(super) struct Part<'a> {
    pub form: &'a Form,
    pub layout: Layout,
    /// By term, those of Q first.
    scaled: Vec<f64>,
    /// Whether the quotient is subtracted.
    pub negative: bool,
}

impl<'a> Part<'a> {
    /// None if no coefficient can be divided by.
    pub fn new(space: &Space, form: &'a Form, score: &Score) -> Option<Part<'a>> {
        let layout = layout(space, form, |k| usable(form, score, k))?;
        let below = form.under.len();
        let all = if below == 0 { &score.coefficients[1..] } else { &score.coefficients };
        let factor = match layout.unit {
            Some(unit) => all[unit],
            None => score.coefficients[0],
        };
        // A unit in P may turn the sign of P; Q stays positive, and the quotient is subtracted.
        let negative = layout.unit.is_some() && factor < 0.0;
        let scaled = (0..all.len())
            .map(|k| if negative && k < below { -all[k] / factor } else { all[k] / factor })
            .collect();
        Some(Part { form, layout, scaled, negative })
    }

    fn words(&self) -> String {
        let kind = if self.form.under.is_empty() { "a polynomial" } else { "a quotient" };
        let helpers: Vec<&str> = self.form.helpers.iter().map(|h| h.kind.words()).collect();
        let with = if helpers.is_empty() { "" } else { " with " };
        format!("{kind}{with}{}", helpers.join(" and "))
    }
}

/// A formula as text, but for the values of its parameters.
pub(super) struct Draft {
    name: String,
    parameters: Vec<String>,
    /// The parameters at the optimum.
    pub values: Vec<f64>,
    /// How many of them, the last ones, are constants of helpers.
    pub constants: usize,
    function: String,
}

impl Draft {
    /// The formula that is written of these parts; the operations follow `name`.
    pub fn new(name: &str, title: &str, link: Option<Link>, parts: &[Part], written: Written) -> Draft {
        let ops = written.graph.cost(written.result);
        let constants = written.constants.iter().map(|helper| helper.constant());
        let values = written.order.iter().map(|(part, k)| parts[*part].scaled[*k]).chain(constants).collect();
        let body = written.graph.text(written.result, &written.arguments, &written.names);
        let kinds: Vec<String> =
            parts.iter().map(|part| link.map_or("", Link::words).to_string() + &part.words()).collect();
        let kinds = match kinds.as_slice() {
            [one] => capital(one) + " of " + &counted(ops),
            several => format!("{} in {}", capital(&several.join(" and ")), counted(ops)),
        };
        let function =
            Function { name: format!("{name}{ops}"), title, kinds, arguments: &written.arguments, body };
        Draft { values, constants: written.constants.len(), ..function.draft(written.names) }
    }

    /// A nested sum with a reciprocal: the lines of its body; values of `c0, c1, ...` and `k0`.
    pub fn nested(space: &Space, ops: u32, (helper, body): (Helper, &str), values: Vec<f64>) -> Draft {
        let arguments: Vec<String> =
            space.axes.iter().flat_map(|a| &a.arguments).map(|(name, _)| name.clone()).collect();
        let kinds = format!("A nested sum with {} of {}", helper.words(), counted(ops));
        let name = format!("{}{ops}", space.name);
        let function =
            Function { name, title: &space.title, kinds, arguments: &arguments, body: body.to_string() };
        let names = (0..values.len() - 1).map(|k| format!("c{k}")).chain(["k0".to_string()]).collect();
        Draft { values, constants: 1, ..function.draft(names) }
    }

    /// The hypothesis that starts at these values.
    pub fn hypothesis(&self, values: &[f64]) -> Result<Hypothesis, FitError> {
        let declare =
            |(name, value): (&String, &f64)| format!("override {name}: f32 = {:?};\n", *value as f32);
        let declared: String = self.parameters.iter().zip(values).map(declare).collect();
        Ok(Hypothesis::parse(&format!("{}.wgsl", self.name), &format!("{declared}\n{}", self.function))?)
    }
}

/// A function before its text is put together.
struct Function<'a> {
    name: String,
    title: &'a str,
    kinds: String,
    arguments: &'a [String],
    body: String,
}

impl Function<'_> {
    /// The text, with the arguments that it reads; no values yet.
    fn draft(self, parameters: Vec<String>) -> Draft {
        let reads = |argument: &&String| {
            self.body.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == *argument)
        };
        let arguments: Vec<String> =
            self.arguments.iter().filter(reads).map(|a| format!("{a}: f32")).collect();
        let title: String = self.title.lines().map(|line| format!("/// {line}\n")).collect();
        let Function { name, kinds, body, .. } = &self;
        let function =
            format!("{title}/// {kinds}.\nfn {name}({}) -> f32 {{\n{body}}}\n", arguments.join(", "));
        Draft { name: self.name, parameters, values: Vec::new(), constants: 0, function }
    }
}

fn counted(ops: u32) -> String {
    match ops {
        0 => "no operations".into(),
        1 => "one operation".into(),
        _ => format!("{ops} operations"),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
