//! Expressions: naga's arena to trees of the dialect.

use naga::{BinaryOperator, Expression, Handle, MathFunction, Span, UnaryOperator};

use super::branch::Lowering;
use super::lower::bytes;
use super::syntax::{Binary, Builtin, Expr, ExprKind, Unary};
use crate::ShadeError;

/// Largest literal exponent that is multiplied out.
const LARGEST_POWER: f32 = 16.0;

impl Lowering<'_> {
    /// The expression behind a handle: a variable where it has been named, else a tree.
    pub(super) fn expression(&self, handle: Handle<Expression>) -> Result<Expr, ShadeError> {
        let span = self.function.expressions.get_span(handle);
        match self.named.get(&handle.index()) {
            Some(&variable) => Ok(Expr { kind: ExprKind::Variable(variable), span: bytes(span) }),
            None => self.tree(handle),
        }
    }

    /// The expression behind a handle, even if it has a name.
    pub(super) fn tree(&self, handle: Handle<Expression>) -> Result<Expr, ShadeError> {
        let span = self.function.expressions.get_span(handle);
        let kind = match &self.function.expressions[handle] {
            Expression::Literal(literal) => self.context.literal(*literal, span)?,
            Expression::ZeroValue(ty) => self.context.zero(*ty, span)?,
            Expression::Constant(constant) => {
                self.context.constant(self.context.module.constants[*constant].init, span)?
            }
            Expression::Override(parameter) => ExprKind::Parameter(parameter.index()),
            Expression::FunctionArgument(index) => ExprKind::Variable(*index as usize),
            Expression::Load { pointer } => return self.load(*pointer, span),
            Expression::Unary { op, expr } => self.unary(*op, *expr, span)?,
            Expression::Binary { op, left, right } => self.binary(*op, *left, *right, span)?,
            Expression::Select { condition, accept, reject } => {
                let operands = [reject, accept, condition].map(|&e| self.operand(e));
                ExprKind::Builtin(Builtin::Select, operands.into_iter().collect::<Result<_, _>>()?)
            }
            Expression::Math { fun, arg, arg1, arg2, .. } => {
                let operands = [Some(*arg), *arg1, *arg2];
                let operands: Result<Vec<Expr>, ShadeError> =
                    operands.into_iter().flatten().map(|e| self.operand(e)).collect();
                self.math(*fun, operands?, span)?
            }
            Expression::CallResult(_) => {
                let lost = || self.context.refuse(span, "this call is not allowed here");
                return self.calls.get(&handle.index()).cloned().ok_or_else(lost);
            }
            other if self.context.has_vectors() => self.vector(other, span)?,
            other => return Err(self.context.refuse(span, unsupported(other))),
        };
        Ok(Expr { kind, span: bytes(span) })
    }

    fn load(&self, pointer: Handle<Expression>, span: Span) -> Result<Expr, ShadeError> {
        let local = self.local(pointer, span)?;
        if let Some(expr) = self.logic.get(&local.index()) {
            return Ok(expr.clone());
        }
        let lost = || self.context.refuse(span, "this variable is not allowed here");
        let variable = self.locals.get(&local.index()).copied().ok_or_else(lost)?;
        Ok(Expr { kind: ExprKind::Variable(variable), span: bytes(span) })
    }

    fn unary(&self, op: UnaryOperator, expr: Handle<Expression>, span: Span) -> Result<ExprKind, ShadeError> {
        let op = match op {
            UnaryOperator::Negate => Unary::Negate,
            UnaryOperator::LogicalNot => Unary::Not,
            UnaryOperator::BitwiseNot => {
                return Err(self.context.refuse(span, "bit operators are not allowed"));
            }
        };
        Ok(ExprKind::Unary(op, Box::new(self.expression(expr)?)))
    }

    fn binary(
        &self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
        span: Span,
    ) -> Result<ExprKind, ShadeError> {
        let op = match op {
            BinaryOperator::Add => Binary::Add,
            BinaryOperator::Subtract => Binary::Subtract,
            BinaryOperator::Multiply => Binary::Multiply,
            BinaryOperator::Divide => Binary::Divide,
            BinaryOperator::Equal => Binary::Equal,
            BinaryOperator::NotEqual => Binary::NotEqual,
            BinaryOperator::Less => Binary::Less,
            BinaryOperator::LessEqual => Binary::LessEqual,
            BinaryOperator::Greater => Binary::Greater,
            BinaryOperator::GreaterEqual => Binary::GreaterEqual,
            BinaryOperator::LogicalAnd => Binary::And,
            BinaryOperator::LogicalOr => Binary::Or,
            _ => {
                let message =
                    "this operator is not allowed in a hypothesis: use + - * /, comparisons, && and ||";
                return Err(self.context.refuse(span, message));
            }
        };
        Ok(ExprKind::Binary(op, Box::new(self.operand(left)?), Box::new(self.operand(right)?)))
    }

    fn math(&self, fun: MathFunction, operands: Vec<Expr>, span: Span) -> Result<ExprKind, ShadeError> {
        if fun != MathFunction::Dot && operands.iter().any(|e| self.is_vector(e)) {
            return Err(self.context.refuse(span, "of the built-ins, only dot and select take vectors"));
        }
        let builtin = match fun {
            MathFunction::Dot if self.context.has_vectors() => Builtin::Dot,
            MathFunction::Abs => Builtin::Abs,
            MathFunction::Min => Builtin::Min,
            MathFunction::Max => Builtin::Max,
            MathFunction::Clamp => Builtin::Clamp,
            MathFunction::Saturate => Builtin::Saturate,
            MathFunction::Mix => Builtin::Mix,
            MathFunction::Fma => Builtin::Fma,
            MathFunction::Sqrt => Builtin::Sqrt,
            MathFunction::InverseSqrt => Builtin::InverseSqrt,
            MathFunction::Exp => Builtin::Exp,
            MathFunction::Exp2 => Builtin::Exp2,
            MathFunction::Log => Builtin::Log,
            MathFunction::Log2 => Builtin::Log2,
            MathFunction::Pow => return Ok(power(operands)),
            MathFunction::Floor => Builtin::Floor,
            MathFunction::Sign => Builtin::Sign,
            MathFunction::Step => Builtin::Step,
            MathFunction::SmoothStep => Builtin::SmoothStep,
            MathFunction::Sin => Builtin::Sin,
            MathFunction::Cos => Builtin::Cos,
            _ => {
                let message = format!("the built-in {fun:?} is not allowed in a hypothesis");
                return Err(self.context.refuse(span, message));
            }
        };
        Ok(ExprKind::Builtin(builtin, operands))
    }
}

/// pow(x, n) for a literal whole n is multiplied out: it is exact for negative x too, and cheap.
fn power(mut operands: Vec<Expr>) -> ExprKind {
    if let [base, Expr { kind: ExprKind::Number(n), .. }] = operands.as_slice()
        && *n >= 2.0
        && *n <= LARGEST_POWER
        && n.fract() == 0.0
    {
        return ExprKind::Power(Box::new(base.clone()), *n as u32);
    }
    operands.truncate(2);
    ExprKind::Builtin(Builtin::Pow, operands)
}

/// Why an expression is refused.
fn unsupported(expression: &Expression) -> &'static str {
    match expression {
        Expression::Compose { .. } | Expression::Splat { .. } | Expression::Swizzle { .. } => {
            "vectors, matrices, arrays and structures are not allowed in a hypothesis"
        }
        Expression::Access { .. } | Expression::AccessIndex { .. } => {
            "components and elements are not allowed in a hypothesis"
        }
        Expression::As { .. } => "conversions are not allowed in a hypothesis: every number is an f32",
        Expression::Derivative { .. } => "screen-space derivatives are not allowed in a hypothesis",
        Expression::Relational { .. } => "this test is not allowed in a hypothesis",
        Expression::LocalVariable(_) => "pointers are not allowed in a hypothesis",
        _ => "this expression is not allowed in a hypothesis",
    }
}
