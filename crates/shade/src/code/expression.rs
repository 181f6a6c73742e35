//! Expressions and statements as text, with what a language does differently left to it.

use std::collections::BTreeMap;

use super::lines::lines;
use super::printer::Printer;
use super::spelling::free;
use crate::{Binary, Builtin, Expr, ExprKind, Function, Kind, Statement, Unary, power_steps};

/// How tightly an expression binds: it needs parentheses where more is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    Choice,
    Logic,
    Comparison,
    Sum,
    Product,
    Sign,
    Atom,
}

/// Text with its level.
pub(super) struct Text {
    pub text: String,
    pub level: Level,
}

impl Text {
    pub fn atom(text: String) -> Text {
        Text { text, level: Level::Atom }
    }

    /// The text, in parentheses unless it binds at least as tightly as asked for.
    pub fn within(self, level: Level) -> String {
        if self.level >= level { self.text } else { format!("({})", self.text) }
    }
}

/// Writes one function's body.
pub(super) struct Writer<'a> {
    /// The language's printer.
    pub printer: &'a dyn Printer,
    /// Every function of the formula, for what calls return.
    pub functions: &'a [Function],
    /// The function that is written.
    pub function: &'a Function,
    /// Printed names of the functions.
    pub function_names: &'a [String],
    /// Printed names of the function's variables.
    pub names: &'a [String],
    /// Printed names of what stands in for built-ins that the language lacks, by what they compute
    /// (`mix`, `pow5`).
    pub helpers: &'a BTreeMap<String, String>,
}

impl Writer<'_> {
    /// The kind of an expression's value.
    pub fn kind(&self, expr: &Expr) -> Kind {
        expr.value(&self.function.variables, self.functions)
    }

    /// An expression; where the language has no arithmetic of vectors, those are written component
    /// by component.
    pub fn expression(&self, expr: &Expr, typed: bool) -> Text {
        let whole = matches!(expr.kind, ExprKind::Variable(_) | ExprKind::Call(..));
        if let Kind::Vector(n) = self.kind(expr)
            && !whole
            && !self.printer.has_vectors()
        {
            let components: Vec<String> =
                (0..n).map(|i| self.expression(&self.component(expr, i), false).text).collect();
            return Text::atom(self.printer.vector(&components));
        }
        self.plain(expr, typed)
    }

    /// Component `i` of an expression; a number is each of its components.
    fn component(&self, expr: &Expr, i: u8) -> Expr {
        if !matches!(self.kind(expr), Kind::Vector(_)) {
            return expr.clone();
        }
        let boxed = |e: &Expr| Box::new(self.component(e, i));
        let kind = match &expr.kind {
            ExprKind::Compose(components) => return components[usize::from(i)].clone(),
            ExprKind::Unary(op, a) => ExprKind::Unary(*op, boxed(a)),
            ExprKind::Binary(op, a, b) => ExprKind::Binary(*op, boxed(a), boxed(b)),
            ExprKind::Builtin(builtin, operands) => {
                ExprKind::Builtin(*builtin, operands.iter().map(|e| self.component(e, i)).collect())
            }
            _ => ExprKind::Component(Box::new(expr.clone()), i),
        };
        Expr { kind, span: expr.span }
    }

    /// The scalar product in the order of the tape: the sum of the products, first component first.
    pub fn dot(&self, a: &Expr, b: &Expr, typed: bool) -> Text {
        let n = match self.kind(a) {
            Kind::Vector(n) => n,
            _ => 1,
        };
        let product = |i: u8| {
            let operands = [a, b].map(|e| Box::new(self.component(e, i)));
            let [x, y] = operands;
            Expr { kind: ExprKind::Binary(Binary::Multiply, x, y), span: a.span }
        };
        let sum = (1..n).fold(product(0), |sum, i| Expr {
            kind: ExprKind::Binary(Binary::Add, Box::new(sum), Box::new(product(i))),
            span: a.span,
        });
        self.expression(&sum, typed)
    }

    /// `plane.xyz`: the first components of a variable.
    fn swizzle(&self, components: &[Expr]) -> Option<String> {
        let variable = |e: &Expr, place: usize| match &e.kind {
            ExprKind::Component(vector, i) if usize::from(*i) == place => match vector.kind {
                ExprKind::Variable(index) => Some(index),
                _ => None,
            },
            _ => None,
        };
        let first = variable(components.first()?, 0)?;
        let same = components.iter().enumerate().all(|(i, e)| variable(e, i) == Some(first));
        same.then(|| format!("{}.{}", self.names[first], &"xyzw"[..components.len()]))
    }

    fn plain(&self, expr: &Expr, typed: bool) -> Text {
        match &expr.kind {
            ExprKind::Number(x) => {
                let level = if x.is_sign_negative() { Level::Sign } else { Level::Atom };
                Text { text: self.printer.number(*x, typed), level }
            }
            ExprKind::Truth(x) => Text::atom(self.printer.truth(*x).to_string()),
            // A specialised formula has no parameters left.
            ExprKind::Parameter(index) => Text::atom(format!("parameter_{index}")),
            ExprKind::Variable(index) => Text::atom(self.names[*index].clone()),
            ExprKind::Unary(op, a) => {
                let sign = if *op == Unary::Negate { "-" } else { "!" };
                let operand = self.expression(a, typed);
                // -(-x): two signs in a row are another operator
                let least = if operand.text.starts_with('-') { Level::Atom } else { Level::Sign };
                Text { text: format!("{sign}{}", operand.within(least)), level: Level::Sign }
            }
            ExprKind::Binary(op, a, b) => self.binary(*op, a, b, typed),
            ExprKind::Power(a, n) => {
                let name = self.helper(&format!("pow{n}"));
                Text::atom(format!("{name}({})", self.expression(a, false).text))
            }
            ExprKind::Builtin(builtin, operands) => self.printer.builtin(self, *builtin, operands, typed),
            ExprKind::Compose(components) => Text::atom(self.swizzle(components).unwrap_or_else(|| {
                let list: Vec<String> = components.iter().map(|e| self.expression(e, false).text).collect();
                self.printer.vector(&list)
            })),
            ExprKind::Component(vector, i)
                if !self.printer.has_vectors()
                    && !matches!(vector.kind, ExprKind::Variable(_) | ExprKind::Call(..)) =>
            {
                self.plain(&self.component(vector, *i), typed)
            }
            ExprKind::Component(vector, i) => {
                let vector = self.expression(vector, false).within(Level::Atom);
                Text::atom(self.printer.component(&vector, usize::from(*i)))
            }
            ExprKind::Call(function, operands) => {
                Text::atom(format!("{}({})", self.function_names[*function], self.list(operands)))
            }
        }
    }

    /// The printed name of a function that the language lacks.
    pub fn helper(&self, base: &str) -> String {
        self.helpers.get(base).map_or(base, String::as_str).to_string()
    }

    /// Operands separated by commas.
    pub fn list(&self, operands: &[Expr]) -> String {
        operands.iter().map(|e| self.value(e, false)).collect::<Vec<_>>().join(", ")
    }

    /// An expression that stands alone: of two evaluations at once a vector, be it of literals.
    pub fn value(&self, expr: &Expr, typed: bool) -> String {
        let text = self.expression(expr, typed).text;
        let both = || self.printer.both(&text);
        (!self.anchored(expr)).then(both).flatten().unwrap_or(text)
    }

    fn binary(&self, op: Binary, a: &Expr, b: &Expr, typed: bool) -> Text {
        let (sign, level) = operator(op);
        let typed = typed || !(self.anchored(a) || self.anchored(b));
        let (left_least, right_least) = match level {
            // a - (b + c) is another number than a - b + c
            Level::Sum => (Level::Sum, Level::Product),
            Level::Product => (Level::Product, Level::Sign),
            Level::Logic if same_logic(op, a) => (Level::Logic, Level::Comparison),
            _ => (next(level), next(level)),
        };
        // Whether `!a == b` means (!a) == b, compilers of C's family ask.
        let least = |e: &Expr, least| match (&e.kind, level) {
            (ExprKind::Unary(Unary::Not, _), Level::Comparison) => Level::Atom,
            _ => least,
        };
        let left = self.expression(a, typed).within(least(a, left_least));
        let right = self.expression(b, typed).within(least(b, right_least));
        Text { text: format!("{left} {sign} {right}"), level }
    }

    /// Whether something in an expression says that it is an f32 (or its kind needs no saying).
    pub fn anchored(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Number(_) | ExprKind::Parameter(_) => false,
            ExprKind::Unary(_, a) => self.anchored(a),
            ExprKind::Binary(_, a, b) => self.anchored(a) || self.anchored(b),
            ExprKind::Builtin(Builtin::Select, operands) => operands[..2].iter().any(|e| self.anchored(e)),
            ExprKind::Builtin(..)
            | ExprKind::Truth(_)
            | ExprKind::Variable(_)
            | ExprKind::Power(..)
            | ExprKind::Compose(_)
            | ExprKind::Component(..)
            | ExprKind::Call(..) => true,
        }
    }

    /// A block's statements, each line indented by `depth` steps; `tail` if its last value is the
    /// function's.
    pub fn block(&self, body: &[Statement], depth: usize, tail: bool, out: &mut String) {
        for (index, statement) in body.iter().enumerate() {
            let tail = tail && index + 1 == body.len();
            self.statement(statement, depth, tail, out);
        }
    }

    fn statement(&self, statement: &Statement, depth: usize, tail: bool, out: &mut String) {
        match statement {
            Statement::Let(variable, e) => self.declaration(*variable, e, false, depth, out),
            Statement::Var(variable, e) => self.declaration(*variable, e, true, depth, out),
            Statement::Assign(variable, e) => {
                self.line(&format!("{} = ", self.names[*variable]), e, ";", depth, out);
            }
            Statement::Return(Expr { kind: ExprKind::Compose(parts), .. })
                if matches!(self.function.result, Kind::Fetches(_)) =>
            {
                self.give_fetches(parts, depth, out);
            }
            Statement::Each(element, list, body) => self.each(*element, *list, body, depth, out),
            Statement::Return(e) if tail && self.printer.tail() => self.line("", e, "", depth, out),
            Statement::Return(e) if self.names_result(e) => {
                let name = self.free("result");
                let start = self.printer.declare(&name, self.kind(e), false, false);
                self.line(&start, e, ";", depth, out);
                out.push_str(&lines(&format!("return {name};"), depth));
            }
            Statement::Return(e) => self.line("return ", e, ";", depth, out),
            Statement::If(condition, accept, reject) => {
                self.branch(condition, accept, reject, depth, tail, out);
            }
        }
    }

    fn give_fetches(&self, parts: &[Expr], depth: usize, out: &mut String) {
        let parts: Vec<String> = parts.iter().map(|e| self.expression(e, false).text).collect();
        let (fetches, weights) = parts.split_at(parts.len() / 2);
        let kind = self.printer.kind(self.function.result.clone());
        for line in self.printer.give_fetches(&kind, &self.free("taps"), [fetches, weights]) {
            out.push_str(&lines(&line, depth));
        }
    }

    /// A loop over the vectors of an array.
    fn each(&self, element: usize, list: usize, body: &[Statement], depth: usize, out: &mut String) {
        let Kind::List(n) = &self.function.variables[list].kind else { return };
        let (element, list) = (&self.names[element], &self.names[list]);
        let copy = self.printer.copied(list).map(|[name, _]| name);
        let opened = self.printer.each(element, copy.as_ref().unwrap_or(list), *n);
        for (i, line) in opened.iter().enumerate() {
            out.push_str(&lines(line, depth + usize::from(i > 0)));
        }
        self.block(body, depth + 1, false, out);
        out.push_str(&lines("}", depth));
    }

    /// Whether a result needs a name before it can be returned.
    fn names_result(&self, e: &Expr) -> bool {
        let whole = matches!(e.kind, ExprKind::Variable(_) | ExprKind::Call(..));
        matches!(self.kind(e), Kind::Vector(_)) && !whole && !self.printer.returns_vectors()
    }

    /// A name that no variable has.
    fn free(&self, name: &str) -> String {
        free(name, |n| self.names.iter().chain(self.function_names).any(|taken| taken == n))
    }

    fn branch(
        &self,
        condition: &Expr,
        accept: &[Statement],
        reject: &[Statement],
        depth: usize,
        tail: bool,
        out: &mut String,
    ) {
        let indent = "    ".repeat(depth);
        let tail = tail && returns(accept) && returns(reject);
        let condition = self.printer.condition(self.expression(condition, false).text);
        out.push_str(&format!("{indent}if {condition} {{\n"));
        self.block(accept, depth + 1, tail, out);
        if !reject.is_empty() {
            out.push_str(&format!("{indent}}} else {{\n"));
            self.block(reject, depth + 1, tail, out);
        }
        out.push_str(&format!("{indent}}}\n"));
    }

    fn declaration(&self, variable: usize, value: &Expr, mutable: bool, depth: usize, out: &mut String) {
        let kind = self.function.variables[variable].kind.clone();
        let typed = kind == Kind::Number && (mutable || !self.anchored(value));
        let start = self.printer.declare(&self.names[variable], kind, mutable, typed);
        self.line(&start, value, ";", depth, out);
    }

    /// One statement.
    fn line(&self, start: &str, value: &Expr, end: &str, depth: usize, out: &mut String) {
        let text = format!("{start}{}{end}", self.value(value, false));
        out.push_str(&lines(&text, depth));
    }
}

/// Whether a block ends by returning.
fn returns(body: &[Statement]) -> bool {
    match body.last() {
        Some(Statement::Return(_)) => true,
        Some(Statement::If(_, accept, reject)) => returns(accept) && returns(reject),
        _ => false,
    }
}

/// a && b && c needs no parentheses; a && b || c is not WGSL without them.
fn same_logic(op: Binary, expr: &Expr) -> bool {
    matches!(expr.kind, ExprKind::Binary(inner, ..) if inner == op)
}

fn next(level: Level) -> Level {
    match level {
        Level::Choice => Level::Logic,
        Level::Logic => Level::Comparison,
        Level::Comparison => Level::Sum,
        Level::Sum => Level::Product,
        Level::Product => Level::Sign,
        Level::Sign | Level::Atom => Level::Atom,
    }
}

fn operator(op: Binary) -> (&'static str, Level) {
    match op {
        Binary::Add => ("+", Level::Sum),
        Binary::Subtract => ("-", Level::Sum),
        Binary::Multiply => ("*", Level::Product),
        Binary::Divide => ("/", Level::Product),
        Binary::Equal => ("==", Level::Comparison),
        Binary::NotEqual => ("!=", Level::Comparison),
        Binary::Less => ("<", Level::Comparison),
        Binary::LessEqual => ("<=", Level::Comparison),
        Binary::Greater => (">", Level::Comparison),
        Binary::GreaterEqual => (">=", Level::Comparison),
        Binary::And => ("&&", Level::Logic),
        Binary::Or => ("||", Level::Logic),
    }
}

/// The lines that raise x to a power by repeated squaring, each squaring declared as
/// `declare x2 = ...;`, and the value.
pub(super) fn power_body(n: u32, declare: &str) -> (Vec<String>, String) {
    let name = |step: u32| if step == 1 { "x".to_string() } else { format!("x{step}") };
    let steps = power_steps(n);
    let last = steps.last().copied().unwrap_or(1);
    // A last factor that stands alone needs no name.
    let named = if steps.len() == 1 { last / 2 } else { last };
    let square = |step: u32| format!("{0} * {0}", name(step / 2));
    let squarings = (1..32).map(|k| 1 << k).take_while(|step| *step <= named);
    let lines = squarings.map(|step| format!("{declare} {} = {};", name(step), square(step))).collect();
    let value = match steps.len() {
        1 => square(last),
        _ => steps.iter().map(|s| name(*s)).collect::<Vec<_>>().join(" * "),
    };
    (lines, value)
}

/// The shortest decimal; where reading it as f64 and rounding that to f32 would give another number
/// (WGSL and glslang do so with literals that have no suffix), the decimal of the f64.
pub fn decimal(x: f32) -> String {
    let short = format!("{x:?}");
    match short.parse::<f64>() {
        Ok(wide) if wide as f32 == x => short,
        _ => format!("{:?}", f64::from(x)),
    }
}
