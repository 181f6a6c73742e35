//! Vectors: naga's arena to trees of the dialect. A vector that a call returns has to be named
//! before it is an operand, and so has one that is an argument: not every language can write it in
//! place.

use naga::{Expression, Handle, Span, TypeInner};

use super::branch::Lowering;
use super::lower::bytes;
use super::syntax::{Expr, ExprKind, Kind};
use crate::ShadeError;

impl Lowering<'_> {
    /// Whether an expression is a vector.
    pub(super) fn is_vector(&self, expr: &Expr) -> bool {
        matches!(expr.value(&self.variables, &self.context.functions), Kind::Vector(_))
    }

    /// An operand; a number that is spread over the components of a vector stays the number.
    pub(super) fn operand(&self, handle: Handle<Expression>) -> Result<Expr, ShadeError> {
        let handle = match self.function.expressions[handle] {
            Expression::Splat { value, .. } if self.context.has_vectors() => value,
            _ => handle,
        };
        let operand = self.expression(handle)?;
        if matches!(operand.kind, ExprKind::Call(..)) && self.is_vector(&operand) {
            return Err(self.unnamed(handle, "a vector that a function returns has to be named first"));
        }
        Ok(operand)
    }

    /// An argument of a call.
    pub(super) fn argument(&self, handle: Handle<Expression>, _: Span) -> Result<Expr, ShadeError> {
        let argument = self.expression(handle)?;
        if self.is_vector(&argument) && !matches!(argument.kind, ExprKind::Variable(_)) {
            return Err(self.unnamed(handle, "a vector has to be named before it is an argument"));
        }
        Ok(argument)
    }

    fn unnamed(&self, handle: Handle<Expression>, message: &str) -> ShadeError {
        self.context.refuse(self.function.expressions.get_span(handle), message)
    }

    /// Vectors and their components.
    pub(super) fn vector(&self, expression: &Expression, span: Span) -> Result<ExprKind, ShadeError> {
        match expression {
            Expression::Compose { ty, components } => {
                if let Ok(Kind::Fetches(_)) = self.context.kind(*ty, span) {
                    let parts = components.iter().map(|&handle| self.operand(handle));
                    return Ok(ExprKind::Compose(parts.collect::<Result<_, _>>()?));
                }
                let TypeInner::Vector { .. } = self.context.module.types[*ty].inner else {
                    return Err(self
                        .context
                        .refuse(span, "matrices, arrays and structures are not allowed here"));
                };
                let mut all = Vec::new();
                for &handle in components {
                    let part = self.operand(handle)?;
                    match part.value(&self.variables, &self.context.functions) {
                        Kind::Vector(n) => all.extend((0..n).map(|i| component(&part, i, span))),
                        _ => all.push(part),
                    }
                }
                Ok(ExprKind::Compose(all))
            }
            Expression::Splat { size, value } => {
                Ok(ExprKind::Compose(vec![self.operand(*value)?; *size as usize]))
            }
            Expression::Swizzle { size, vector, pattern } => {
                let vector = self.operand(*vector)?;
                let components = pattern.iter().take(*size as usize);
                Ok(ExprKind::Compose(components.map(|i| component(&vector, *i as u8, span)).collect()))
            }
            Expression::AccessIndex { base, index } => {
                let vector = self.operand(*base)?;
                if !self.is_vector(&vector) {
                    return Err(self.context.refuse(span, "only vectors have components"));
                }
                Ok(component(&vector, *index as u8, span).kind)
            }
            _ => Err(self.context.refuse(span, "this expression is not allowed here")),
        }
    }
}

/// A component of a vector; that of a composed one is the number that it is composed of.
fn component(vector: &Expr, i: u8, span: Span) -> Expr {
    match &vector.kind {
        ExprKind::Compose(components) => components[usize::from(i)].clone(),
        _ => Expr { kind: ExprKind::Component(Box::new(vector.clone()), i), span: bytes(span) },
    }
}
