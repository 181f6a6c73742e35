//! Loops over the vectors of an array:
//! `for (var i = 0; i < N; i++) { let element = list[i]; ... }`, N being the array's length.

use naga::{BinaryOperator, Block, Expression, Handle, Literal, LocalVariable, Span, Statement as Naga};

use super::branch::Lowering;
use super::syntax::{Kind, Statement};
use crate::ShadeError;

impl Lowering<'_> {
    /// Whether a local variable counts a loop.
    pub(super) fn counts(&self, local: Handle<LocalVariable>) -> bool {
        let ty = self.function.local_variables[local].ty;
        self.context.has_vectors()
            && matches!(self.context.module.types[ty].inner, naga::TypeInner::Scalar(naga::Scalar::I32))
    }

    /// A loop.
    pub(super) fn each(&mut self, body: &Block, span: Span) -> Result<Statement, ShadeError> {
        let count = body.iter().find_map(|statement| self.count(statement));
        let Some(Naga::Block(inner)) = body.last() else { return Err(self.no_loop(span)) };
        let outer = self.element.take();
        let statements = self.block(inner)?;
        let (element, list) =
            std::mem::replace(&mut self.element, outer).ok_or_else(|| self.no_loop(span))?;
        match (&self.variables[list].kind, count) {
            (Kind::List(n), Some(count)) if i32::from(*n) == count => {
                Ok(Statement::Each(element, list, statements))
            }
            _ => Err(self.no_loop(span)),
        }
    }

    /// N of `i < N`, where the statement leaves the loop otherwise.
    fn count(&self, statement: &Naga) -> Option<i32> {
        let Naga::If { condition, .. } = statement else { return None };
        let Expression::Binary { op: BinaryOperator::Less, right, .. } =
            self.function.expressions[*condition]
        else {
            return None;
        };
        match self.function.expressions[right] {
            Expression::Literal(Literal::I32(n)) => Some(n),
            _ => None,
        }
    }

    /// Names the vector of a loop.
    pub(super) fn name_element(
        &mut self,
        name: &str,
        list: Handle<Expression>,
        handle: Handle<Expression>,
    ) -> Result<(), ShadeError> {
        let Expression::FunctionArgument(list) = self.function.expressions[list] else {
            return Err(self.no_loop(self.function.expressions.get_span(handle)));
        };
        let variable = self.variable(name, Kind::Vector(4));
        self.named.insert(handle.index(), variable);
        self.element = Some((variable, list as usize));
        Ok(())
    }

    fn no_loop(&self, span: Span) -> ShadeError {
        let message =
            "a loop goes over an array of vectors: for (var i = 0; i < N; i++) { let x = list[i]; ... }";
        self.context.refuse(span, message)
    }
}
