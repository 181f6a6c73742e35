//! Expressions and statements as text, with what a language does differently left to it.

use super::lines::lines;
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

/// What a language does its own way.
pub(super) trait Dialect {
    /// A literal; `typed` where nothing else says that it is an f32.
    fn number(&self, x: f32, typed: bool) -> String;
    /// true or false.
    fn truth(&self, x: bool) -> String {
        x.to_string()
    }
    /// A built-in function.
    fn builtin(&self, writer: &Writer<Self>, builtin: Builtin, operands: &[Expr], typed: bool) -> Text
    where
        Self: Sized;
    /// Printed name of a function that the language lacks, by what it computes (`pow5`).
    fn helper(&self, base: &str) -> String;
    /// `let name = ` or `let mut name: f32 = `.
    fn declare(&self, name: &str, kind: Kind, mutable: bool, typed: bool) -> String;
    /// The condition of an `if`.
    fn condition(&self, condition: String) -> String;
    /// Whether a function's last value is written without `return`.
    fn tail(&self) -> bool;
}

/// Writes one function's body.
pub(super) struct Writer<'a, D> {
    pub dialect: &'a D,
    pub function: &'a Function,
    /// Printed names of the functions.
    pub function_names: &'a [String],
    /// Printed names of the function's variables.
    pub names: &'a [String],
}

impl<D: Dialect> Writer<'_, D> {
    /// An expression.
    pub fn expression(&self, expr: &Expr, typed: bool) -> Text {
        match &expr.kind {
            ExprKind::Number(x) => {
                let level = if x.is_sign_negative() { Level::Sign } else { Level::Atom };
                Text { text: self.dialect.number(*x, typed), level }
            }
            ExprKind::Truth(x) => Text::atom(self.dialect.truth(*x)),
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
                let name = self.dialect.helper(&format!("pow{n}"));
                Text::atom(format!("{name}({})", self.expression(a, false).text))
            }
            ExprKind::Builtin(builtin, operands) => self.dialect.builtin(self, *builtin, operands, typed),
            ExprKind::Call(function, operands) => {
                Text::atom(format!("{}({})", self.function_names[*function], self.list(operands)))
            }
        }
    }

    /// Operands separated by commas.
    pub fn list(&self, operands: &[Expr]) -> String {
        operands.iter().map(|e| self.expression(e, false).text).collect::<Vec<_>>().join(", ")
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
            | ExprKind::Call(..) => true,
        }
    }

    /// A block's statements, each line indented by `depth` steps; `tail` if its last value is the function's.
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
            Statement::Return(e) if tail && self.dialect.tail() => self.line("", e, "", depth, out),
            Statement::Return(e) => self.line("return ", e, ";", depth, out),
            Statement::If(condition, accept, reject) => {
                self.branch(condition, accept, reject, depth, tail, out);
            }
        }
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
        let condition = self.dialect.condition(self.expression(condition, false).text);
        out.push_str(&format!("{indent}if {condition} {{\n"));
        self.block(accept, depth + 1, tail, out);
        if !reject.is_empty() {
            out.push_str(&format!("{indent}}} else {{\n"));
            self.block(reject, depth + 1, tail, out);
        }
        out.push_str(&format!("{indent}}}\n"));
    }

    fn declaration(&self, variable: usize, value: &Expr, mutable: bool, depth: usize, out: &mut String) {
        let kind = self.function.variables[variable].kind;
        let typed = kind == Kind::Number && (mutable || !self.anchored(value));
        let start = self.dialect.declare(&self.names[variable], kind, mutable, typed);
        self.line(&start, value, ";", depth, out);
    }

    /// One statement.
    fn line(&self, start: &str, value: &Expr, end: &str, depth: usize, out: &mut String) {
        let text = format!("{start}{}{end}", self.expression(value, false).text);
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

/// The lines that raise x to a power by repeated squaring, each squaring declared as `declare x2 = ...;`, and the value.
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

/// The shortest decimal; where reading it as f64 and rounding that to f32 would give another number (WGSL and glslang do so
/// with literals that have no suffix), the decimal of the f64.
pub fn decimal(x: f32) -> String {
    let short = format!("{x:?}");
    match short.parse::<f64>() {
        Ok(wide) if wide as f32 == x => short,
        _ => format!("{:?}", f64::from(x)),
    }
}
