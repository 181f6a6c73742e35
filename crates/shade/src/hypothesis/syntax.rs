//! The syntax of a hypothesis: what is left of WGSL once the dialect's limits are applied. The
//! evaluator and the printers both read this, so that what is fitted is what is printed.

use crate::code::Float;

/// The kind of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// f32.
    Number,
    /// bool.
    Truth,
    /// A vector of 2 to 4 f32.
    Vector(u8),
    /// An array of so many vectors of 4 f32, as an argument.
    List(u8),
    /// A structure of weighted fetches, as a result.
    Fetches(Fetches),
}

/// A structure of weighted fetches: vectors of 4 f32, then as many weights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fetches {
    /// Its name in the source.
    pub name: String,
    /// Its documentation, without the marks of comments.
    pub doc: Vec<String>,
    /// How many fetches it has.
    pub count: u8,
}

/// A free parameter: an `override` declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its initial value, where the search starts; 1 if the declaration has none.
    pub start: f32,
}

/// An argument, a `let` or a `var` of a function; names are unique within it.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: Kind,
}

impl Variable {
    /// Names of its components; its own name if it is no vector.
    pub fn components(&self) -> Vec<String> {
        match self.kind {
            Kind::Number | Kind::Truth | Kind::Fetches(_) => vec![self.name.clone()],
            Kind::Vector(n) => {
                (0..usize::from(n)).map(|i| format!("{}.{}", self.name, &"xyzw"[i..=i])).collect()
            }
            Kind::List(n) => (0..4 * usize::from(n))
                .map(|i| format!("{}[{}].{}", self.name, i / 4, &"xyzw"[i % 4..=i % 4]))
                .collect(),
        }
    }
}

/// One operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    /// -x
    Negate,
    /// !x
    Not,
}

/// Two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Binary {
    /// x + y
    Add,
    /// x - y
    Subtract,
    /// x * y
    Multiply,
    /// x / y
    Divide,
    /// x == y
    Equal,
    /// x != y
    NotEqual,
    /// x < y
    Less,
    /// x <= y
    LessEqual,
    /// x > y
    Greater,
    /// x >= y
    GreaterEqual,
    /// x && y
    And,
    /// x || y
    Or,
}

/// The mathematical built-ins of the dialect, with their arguments in WGSL's order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Builtin {
    /// |x|
    Abs,
    /// The smaller.
    Min,
    /// The larger.
    Max,
    /// clamp(x, lo, hi) = min(max(x, lo), hi)
    Clamp,
    /// clamp(x, 0, 1)
    Saturate,
    /// mix(x, y, t) = x (1 - t) + y t
    Mix,
    /// fma(x, y, z) = x y + z, rounded once
    Fma,
    /// Square root.
    Sqrt,
    /// 1 / sqrt(x)
    InverseSqrt,
    /// e^x
    Exp,
    /// 2^x
    Exp2,
    /// Natural logarithm.
    Log,
    /// Binary logarithm.
    Log2,
    /// x^y for x > 0, or x >= 0 and y > 0
    Pow,
    /// Largest integer not above x.
    Floor,
    /// -1, 0 or 1
    Sign,
    /// step(edge, x) = 1 where edge <= x, else 0
    Step,
    /// t t (3 - 2 t), t = saturate((x - lo) / (hi - lo))
    SmoothStep,
    /// Sine, radians.
    Sin,
    /// Cosine, radians.
    Cos,
    /// The sum of the products of the components, first component first.
    Dot,
    /// select(reject, accept, condition)
    Select,
}

/// An expression with its place in the source.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Byte range in the source.
    pub span: (u32, u32),
}

/// What an expression is.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A finite f32.
    Number(f32),
    /// true or false.
    Truth(bool),
    /// A free parameter, by index into [`Formula::parameters`].
    Parameter(usize),
    /// A variable, by index into [`Function::variables`].
    Variable(usize),
    /// One operand.
    Unary(Unary, Box<Expr>),
    /// Two operands.
    Binary(Binary, Box<Expr>, Box<Expr>),
    /// x^n for a literal n = 2 ... 16: repeated squaring, see [`power_steps`].
    Power(Box<Expr>, u32),
    /// A built-in.
    Builtin(Builtin, Vec<Expr>),
    /// A vector of numbers.
    Compose(Vec<Expr>),
    /// A component of a vector.
    Component(Box<Expr>, u8),
    /// A function of the formula, by index into [`Formula::functions`].
    Call(usize, Vec<Expr>),
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Names a value.
    Let(usize, Expr),
    /// Declares a variable that is assigned to later.
    Var(usize, Expr),
    /// Assigns to a variable.
    Assign(usize, Expr),
    /// Branches.
    If(Expr, Vec<Statement>, Vec<Statement>),
    /// Names each vector of an array in turn and runs a block with it.
    Each(usize, usize, Vec<Statement>),
    /// Returns.
    Return(Expr),
}

/// A function of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Number of arguments: the first variables.
    pub arguments: usize,
    /// Arguments, then what the body declares.
    pub variables: Vec<Variable>,
    /// What it returns.
    pub result: Kind,
    /// Its statements; every path ends in a return.
    pub body: Vec<Statement>,
}

/// A formula: functions, each after those it calls, the last being the formula itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// Functions in order of declaration.
    pub functions: Vec<Function>,
    /// Free parameters; none once coefficients are filled in.
    pub parameters: Vec<Parameter>,
    /// The type of its numbers in printed code.
    pub float: Float,
}

impl Function {
    /// Gives some of its arguments other names: each pair is a name and the one that stands for it.
    pub fn rename_arguments(&mut self, names: &[(&str, &str)]) {
        for argument in &mut self.variables[..self.arguments] {
            if let Some((_, to)) = names.iter().find(|(from, _)| *from == argument.name) {
                argument.name = (*to).to_string();
            }
        }
    }

    /// Whether its body reads a variable.
    pub fn reads(&self, variable: usize) -> bool {
        fn block(body: &[Statement], variable: usize) -> bool {
            body.iter().any(|statement| match statement {
                Statement::Let(_, e)
                | Statement::Var(_, e)
                | Statement::Assign(_, e)
                | Statement::Return(e) => e.reads(variable),
                Statement::If(condition, accept, reject) => {
                    condition.reads(variable) || block(accept, variable) || block(reject, variable)
                }
                Statement::Each(_, list, body) => *list == variable || block(body, variable),
            })
        }
        block(&self.body, variable)
    }
}

impl Formula {
    /// The formula's own function.
    pub fn main(&self) -> &Function {
        // `Hypothesis::parse` refuses a module without a function.
        &self.functions[self.functions.len() - 1]
    }
}

impl Expr {
    /// Its operands, in order.
    pub fn operands(&self) -> Vec<&Expr> {
        match &self.kind {
            ExprKind::Number(_) | ExprKind::Truth(_) | ExprKind::Parameter(_) | ExprKind::Variable(_) => {
                Vec::new()
            }
            ExprKind::Unary(_, a) | ExprKind::Power(a, _) | ExprKind::Component(a, _) => vec![a],
            ExprKind::Binary(_, a, b) => vec![a, b],
            ExprKind::Builtin(_, operands) | ExprKind::Call(_, operands) | ExprKind::Compose(operands) => {
                operands.iter().collect()
            }
        }
    }

    /// The kind of its value, in a function of these variables that calls these functions. A number
    /// beside a vector is each of its components.
    pub fn value(&self, variables: &[Variable], functions: &[Function]) -> Kind {
        let of = |e: &Expr| e.value(variables, functions);
        match &self.kind {
            ExprKind::Number(_) | ExprKind::Parameter(_) | ExprKind::Power(..) | ExprKind::Component(..) => {
                Kind::Number
            }
            ExprKind::Truth(_) | ExprKind::Unary(Unary::Not, _) => Kind::Truth,
            ExprKind::Unary(Unary::Negate, a) => of(a),
            ExprKind::Binary(Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide, a, b) => {
                match of(a) {
                    Kind::Number => of(b),
                    vector => vector,
                }
            }
            ExprKind::Binary(..) => Kind::Truth,
            ExprKind::Variable(index) => variables[*index].kind.clone(),
            ExprKind::Builtin(Builtin::Dot, _) => Kind::Number,
            ExprKind::Builtin(_, operands) => operands.first().map_or(Kind::Number, of),
            ExprKind::Compose(components) => Kind::Vector(components.len() as u8),
            ExprKind::Call(index, _) => functions[*index].result.clone(),
        }
    }

    /// The same with other operands.
    pub fn map(&self, f: &mut impl FnMut(&Expr) -> Expr) -> Expr {
        let kind = match &self.kind {
            ExprKind::Number(_) | ExprKind::Truth(_) | ExprKind::Parameter(_) | ExprKind::Variable(_) => {
                self.kind.clone()
            }
            ExprKind::Unary(op, a) => ExprKind::Unary(*op, Box::new(f(a))),
            ExprKind::Binary(op, a, b) => ExprKind::Binary(*op, Box::new(f(a)), Box::new(f(b))),
            ExprKind::Power(a, n) => ExprKind::Power(Box::new(f(a)), *n),
            ExprKind::Component(a, i) => ExprKind::Component(Box::new(f(a)), *i),
            ExprKind::Builtin(builtin, operands) => {
                ExprKind::Builtin(*builtin, operands.iter().map(f).collect())
            }
            ExprKind::Call(function, operands) => ExprKind::Call(*function, operands.iter().map(f).collect()),
            ExprKind::Compose(operands) => ExprKind::Compose(operands.iter().map(f).collect()),
        };
        Expr { kind, span: self.span }
    }

    /// Whether it is the same expression, wherever it stands.
    pub fn same(&self, other: &Expr) -> bool {
        fn bare(expr: &Expr) -> Expr {
            Expr { span: (0, 0), ..expr.map(&mut bare) }
        }
        bare(self) == bare(other)
    }

    /// Whether it reads the variable.
    pub fn reads(&self, variable: usize) -> bool {
        self.kind == ExprKind::Variable(variable) || self.operands().iter().any(|e| e.reads(variable))
    }
}

/// The exponents 1, 2, 4, ... whose powers multiply, in this order, to x^n.
pub fn power_steps(n: u32) -> Vec<u32> {
    (0..32).map(|bit| 1 << bit).filter(|step| n & step != 0).collect()
}
