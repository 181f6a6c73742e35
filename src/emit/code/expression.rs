//! Expressions and statements as text, with what a language does differently left to it.

use crate::fit::{Binary, Builtin, Expr, ExprKind, Function, Kind, Statement, Unary};

/// Longest line before a sum is broken up.
const WIDTH: usize = 100;

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
pub(super) trait Language {
    /// A literal; `typed` where nothing else says that it is an f32.
    fn number(&self, x: f32, typed: bool) -> String;
    /// A built-in function.
    fn builtin(&self, writer: &Writer<Self>, builtin: Builtin, operands: &[Expr], typed: bool) -> Text
    where
        Self: Sized;
    /// Name of the helper that raises to a whole power.
    fn power(&self, n: u32) -> String;
    /// `let name = ` or `let mut name: f32 = `.
    fn declare(&self, name: &str, kind: Kind, mutable: bool, typed: bool) -> String;
    /// The condition of an `if`.
    fn condition(&self, condition: String) -> String;
    /// Whether a function's last value is written without `return`.
    fn tail(&self) -> bool;
}

/// Writes one function's body.
pub(super) struct Writer<'a, L> {
    pub language: &'a L,
    pub function: &'a Function,
    /// Printed names of the functions.
    pub function_names: &'a [String],
    /// Printed names of the function's variables.
    pub names: &'a [String],
}

impl<L: Language> Writer<'_, L> {
    /// An expression.
    pub fn expression(&self, expr: &Expr, typed: bool) -> Text {
        match &expr.kind {
            ExprKind::Number(x) => {
                let level = if x.is_sign_negative() { Level::Sign } else { Level::Atom };
                Text { text: self.language.number(*x, typed), level }
            }
            ExprKind::Truth(x) => Text::atom(x.to_string()),
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
                Text::atom(format!("{}({})", self.language.power(*n), self.expression(a, false).text))
            }
            ExprKind::Builtin(builtin, operands) => self.language.builtin(self, *builtin, operands, typed),
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
        let left = self.expression(a, typed).within(left_least);
        let right = self.expression(b, typed).within(right_least);
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
            Statement::Return(e) if tail && self.language.tail() => self.line("", e, "", depth, out),
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
        let condition = self.language.condition(self.expression(condition, false).text);
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
        let start = self.language.declare(&self.names[variable], kind, mutable, typed);
        self.line(&start, value, ";", depth, out);
    }

    /// One statement; a sum too long for a line is broken before its signs.
    fn line(&self, start: &str, value: &Expr, end: &str, depth: usize, out: &mut String) {
        let indent = "    ".repeat(depth);
        let whole = format!("{indent}{start}{}{end}", self.expression(value, false).text);
        let sum = matches!(value.kind, ExprKind::Binary(Binary::Add | Binary::Subtract, ..));
        if whole.len() <= WIDTH || !sum {
            out.push_str(&whole);
            out.push('\n');
            return;
        }
        let mut line = format!("{indent}{start}");
        let mut fresh = true;
        for term in self.terms(value) {
            if !fresh && line.len() + 1 + term.len() + end.len() > WIDTH {
                out.push_str(&line);
                out.push('\n');
                line = format!("{indent}    {term}");
            } else if fresh {
                line.push_str(&term);
            } else {
                line = format!("{line} {term}");
            }
            fresh = false;
        }
        out.push_str(&line);
        out.push_str(end);
        out.push('\n');
    }

    /// The terms of a sum, each with its sign but the first.
    fn terms(&self, expr: &Expr) -> Vec<String> {
        match &expr.kind {
            ExprKind::Binary(op @ (Binary::Add | Binary::Subtract), a, b) => {
                let mut terms = self.terms(a);
                let typed = !(self.anchored(a) || self.anchored(b));
                let right = self.expression(b, typed).within(Level::Product);
                terms.push(format!("{} {right}", operator(*op).0));
                terms
            }
            _ => vec![self.expression(expr, false).within(Level::Sum)],
        }
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
