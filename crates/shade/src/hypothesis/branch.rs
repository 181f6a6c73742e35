//! Functions and statements: naga's blocks to statements of the dialect.

use std::collections::BTreeMap;

use naga::{Block, Expression, Handle, LocalVariable, Span, Statement as Naga};

use super::declare::{Declared, declare};
use super::lower::{Context, bytes};
use super::size::Limits;
use super::syntax::{Binary, Expr, ExprKind, Function, Kind, Statement, Unary, Variable};
use crate::ShadeError;

/// A function being lowered. Keys are naga's arena indices.
pub(super) struct Lowering<'a> {
    pub(super) context: &'a Context<'a>,
    pub(super) function: &'a naga::Function,
    /// Expressions with a name of their own, by variable.
    pub(super) named: BTreeMap<usize, usize>,
    /// `var` declarations, by variable.
    pub(super) locals: BTreeMap<usize, usize>,
    /// Anonymous locals into which naga lowers `&&` and `||`, raised to expressions again.
    pub(super) logic: BTreeMap<usize, Expr>,
    /// Results of calls that have no name.
    pub(super) calls: BTreeMap<usize, Expr>,
    pub(super) variables: Vec<Variable>,
    /// The vector and the array of the loop that is being lowered, once its vector has a name.
    pub(super) element: Option<(usize, usize)>,
    depth: usize,
}

/// Lowers one function.
pub(super) fn lower_function(
    context: &Context,
    function: &naga::Function,
    span: Span,
) -> Result<Function, ShadeError> {
    let main = !context.has_vectors() && context.functions.len() + 1 == context.module.functions.len();
    let mut lowering = Lowering {
        context,
        function,
        named: BTreeMap::new(),
        locals: BTreeMap::new(),
        logic: BTreeMap::new(),
        calls: BTreeMap::new(),
        variables: Vec::new(),
        element: None,
        depth: 0,
    };
    lowering.arguments(main, span)?;
    let Some(result) = &function.result else {
        return Err(context.refuse(span, "a function of a hypothesis must return a value"));
    };
    let result = context.kind(result.ty, span)?;
    if main && result != Kind::Number {
        return Err(context.refuse(span, "a hypothesis must return an f32"));
    }
    let initial = lowering.local_variables()?;
    let mut body = lowering.block(&function.body)?;
    declare(&mut body, &initial);
    Ok(Function {
        name: function.name.clone().unwrap_or_default(),
        arguments: function.arguments.len(),
        variables: lowering.variables,
        result,
        body,
    })
}

impl Lowering<'_> {
    fn arguments(&mut self, main: bool, span: Span) -> Result<(), ShadeError> {
        for argument in &self.function.arguments {
            let kind = self.context.kind(argument.ty, span)?;
            if main && kind != Kind::Number {
                return Err(self.context.refuse(span, "the inputs of a hypothesis must be f32"));
            }
            let name = argument.name.clone().unwrap_or_default();
            self.variables.push(Variable { name, kind });
        }
        Ok(())
    }

    /// Registers the named `var` declarations.
    fn local_variables(&mut self) -> Result<Vec<Declared>, ShadeError> {
        let mut initial = Vec::new();
        for (handle, local) in self.function.local_variables.iter() {
            let span = self.function.local_variables.get_span(handle);
            if self.counts(handle) {
                continue;
            }
            let kind = self.context.kind(local.ty, span)?;
            let Some(name) = &local.name else { continue };
            if matches!(kind, Kind::Vector(_)) {
                let message = "a vector may not change: write `let`, or a `var` for each component";
                return Err(self.context.refuse(span, message));
            }
            let variable = self.variable(name, kind);
            self.locals.insert(handle.index(), variable);
            let value = local.init.map(|init| self.expression(init)).transpose()?;
            let zero = Expr { kind: self.context.zero(local.ty, span)?, span: bytes(span) };
            initial.push(Declared { variable, value, zero });
        }
        Ok(initial)
    }

    /// A new variable; a name already taken gets a number.
    pub(super) fn variable(&mut self, name: &str, kind: Kind) -> usize {
        let taken = |candidate: &str| self.variables.iter().any(|v| v.name == candidate);
        let mut unique = name.to_string();
        let mut number = 2;
        while taken(&unique) {
            unique = format!("{name}_{number}");
            number += 1;
        }
        self.variables.push(Variable { name: unique, kind });
        self.variables.len() - 1
    }

    pub(super) fn block(&mut self, block: &Block) -> Result<Vec<Statement>, ShadeError> {
        self.depth += 1;
        if self.depth > Limits::DEPTH {
            let span = block.span_iter().next().map_or(Span::default(), |(_, span)| *span);
            return Err(self.context.refuse(span, format!("branches nest deeper than {}", Limits::DEPTH)));
        }
        let mut statements = Vec::new();
        for (statement, span) in block.span_iter() {
            self.statement(statement, *span, &mut statements)?;
        }
        self.depth -= 1;
        Ok(statements)
    }

    fn statement(&mut self, naga: &Naga, span: Span, out: &mut Vec<Statement>) -> Result<(), ShadeError> {
        match naga {
            Naga::Emit(range) => {
                for handle in range.clone() {
                    self.emit(handle, out)?;
                }
            }
            Naga::Block(block) => out.extend(self.block(block)?),
            Naga::If { condition, accept, reject } => self.branch(*condition, accept, reject, out)?,
            Naga::Loop { body, .. } if self.context.has_vectors() => out.push(self.each(body, span)?),
            Naga::Return { value: Some(value) } => out.push(Statement::Return(self.expression(*value)?)),
            Naga::Store { pointer, value } => {
                let local = self.local(*pointer, span)?;
                if self.counts(local) {
                    return Ok(());
                }
                let lost = || self.context.refuse(span, "this assignment is not allowed here");
                let variable = self.locals.get(&local.index()).copied().ok_or_else(lost)?;
                out.push(Statement::Assign(variable, self.expression(*value)?));
            }
            Naga::Call { function, arguments, result } => {
                let arguments: Result<Vec<Expr>, ShadeError> =
                    arguments.iter().map(|&e| self.argument(e, span)).collect();
                let Some(result) = result else { return Ok(()) };
                let kind = ExprKind::Call(function.index(), arguments?);
                let call = Expr { kind, span: bytes(self.function.expressions.get_span(*result)) };
                self.calls.insert(result.index(), call);
                self.emit(*result, out)?;
            }
            other => return Err(self.context.refuse(span, unsupported(other))),
        }
        Ok(())
    }

    /// Makes an expression a `let` if it has a name; the others are lowered where they are used.
    fn emit(&mut self, handle: Handle<Expression>, out: &mut Vec<Statement>) -> Result<(), ShadeError> {
        let Some(name) = self.function.named_expressions.get(&handle) else { return Ok(()) };
        if let Expression::Access { base, .. } = self.function.expressions[handle] {
            return self.name_element(name, base, handle);
        }
        let value = self.tree(handle)?;
        let kind = value.value(&self.variables, &self.context.functions);
        let variable = self.variable(name, kind);
        self.named.insert(handle.index(), variable);
        out.push(Statement::Let(variable, value));
        Ok(())
    }

    /// The local variable that a pointer points to.
    pub(super) fn local(
        &self,
        pointer: Handle<Expression>,
        span: Span,
    ) -> Result<Handle<LocalVariable>, ShadeError> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(local) => Ok(local),
            _ => Err(self.context.refuse(span, "only whole local variables may be read and written")),
        }
    }

    fn branch(
        &mut self,
        condition: Handle<Expression>,
        accept: &Block,
        reject: &Block,
        out: &mut Vec<Statement>,
    ) -> Result<(), ShadeError> {
        if let Some((local, value)) = self.short_circuit(accept, reject) {
            return self.logic(local, condition, accept, value, reject);
        }
        let condition = self.expression(condition)?;
        let accept = self.block(accept)?;
        let reject = self.block(reject)?;
        out.push(Statement::If(condition, accept, reject));
        Ok(())
    }

    /// naga lowers `a && b` to `if a { _t = b; } else { _t = false; }` with an anonymous `_t` (and
    /// `a || b` to `if !a { _t = b; } else { _t = true; }`): the anonymous local and the handle of
    /// b, if this is one of those.
    fn short_circuit(
        &self,
        accept: &Block,
        reject: &Block,
    ) -> Option<(Handle<LocalVariable>, Handle<Expression>)> {
        let (Some(Naga::Store { pointer, value }), Some(Naga::Store { pointer: other, .. })) =
            (accept.last(), reject.last())
        else {
            return None;
        };
        let Expression::LocalVariable(local) = self.function.expressions[*pointer] else { return None };
        let Expression::LocalVariable(same) = self.function.expressions[*other] else { return None };
        let anonymous = self.function.local_variables[local].name.is_none();
        (anonymous && local == same).then_some((local, *value))
    }

    fn logic(
        &mut self,
        local: Handle<LocalVariable>,
        condition: Handle<Expression>,
        accept: &Block,
        value: Handle<Expression>,
        reject: &Block,
    ) -> Result<(), ShadeError> {
        let mut inner = Vec::new();
        for (statement, span) in accept.span_iter().take(accept.len() - 1) {
            self.statement(statement, *span, &mut inner)?;
        }
        let left = self.expression(condition)?;
        let right = self.expression(value)?;
        let ends_true = match reject.last() {
            Some(Naga::Store { value, .. }) => self.expression(*value)?.kind == ExprKind::Truth(true),
            _ => false,
        };
        let span = (left.span.0.min(right.span.0), left.span.1.max(right.span.1));
        let (op, left) = if ends_true { (Binary::Or, opposite(left)) } else { (Binary::And, left) };
        let kind = ExprKind::Binary(op, Box::new(left), Box::new(right));
        self.logic.insert(local.index(), Expr { kind, span });
        Ok(())
    }
}

/// !x, without a double negation. naga folds the negation of a literal.
fn opposite(expr: Expr) -> Expr {
    let kind = match expr.kind {
        ExprKind::Unary(Unary::Not, inner) => return *inner,
        ExprKind::Truth(x) => ExprKind::Truth(!x),
        other => ExprKind::Unary(Unary::Not, Box::new(Expr { kind: other, span: expr.span })),
    };
    Expr { kind, span: expr.span }
}

/// Why a statement is refused.
fn unsupported(statement: &Naga) -> &'static str {
    match statement {
        Naga::Loop { .. } | Naga::Break | Naga::Continue => "loops are not allowed in a hypothesis",
        Naga::Switch { .. } => "switch is not allowed in a hypothesis: use if",
        Naga::Kill => "discard is not allowed in a hypothesis",
        Naga::Return { value: None } => "every path of a hypothesis must return a value",
        _ => "this statement is not allowed in a hypothesis",
    }
}
