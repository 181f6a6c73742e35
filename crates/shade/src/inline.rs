//! Calls written out: the values that a called function names become values of its caller.

use crate::hypothesis::{Binary, Expr, ExprKind, Function, Statement, Variable};

/// A function with the calls of some straight functions (names, then a result) written out. What it
/// names already by the same name and value is not named again.
pub(crate) fn inlined(functions: &[Function], index: usize, which: &dyn Fn(&str) -> bool) -> Function {
    let function = &functions[index];
    let mut inliner = Inliner { functions, which, variables: function.variables.clone() };
    let body = inliner.block(&function.body);
    Function { variables: inliner.variables, body, ..function.clone() }
}

struct Inliner<'a> {
    functions: &'a [Function],
    which: &'a dyn Fn(&str) -> bool,
    variables: Vec<Variable>,
}

impl Inliner<'_> {
    fn block(&mut self, body: &[Statement]) -> Vec<Statement> {
        let mut out = Vec::new();
        for statement in body {
            let statement = match statement {
                Statement::Let(variable, e) => Statement::Let(*variable, self.expression(e, &mut out)),
                Statement::Var(variable, e) => Statement::Var(*variable, self.expression(e, &mut out)),
                Statement::Assign(variable, e) => Statement::Assign(*variable, self.expression(e, &mut out)),
                Statement::Return(e) => Statement::Return(self.expression(e, &mut out)),
                Statement::If(condition, accept, reject) => {
                    let condition = self.expression(condition, &mut out);
                    Statement::If(condition, self.block(accept), self.block(reject))
                }
                Statement::Each(element, list, body) => Statement::Each(*element, *list, self.block(body)),
            };
            out.push(statement);
        }
        out
    }

    fn expression(&mut self, expr: &Expr, out: &mut Vec<Statement>) -> Expr {
        let expr = expr.map(&mut |operand| self.expression(operand, out));
        match &expr.kind {
            ExprKind::Call(callee, arguments) => self.call(*callee, arguments, out).unwrap_or(expr),
            _ => expr,
        }
    }

    /// The value of a call, what it names being named before; none of a function that branches.
    fn call(&mut self, callee: usize, arguments: &[Expr], out: &mut Vec<Statement>) -> Option<Expr> {
        let callee = &self.functions[callee];
        if !(self.which)(&callee.name) {
            return None;
        }
        let (Statement::Return(result), lets) = callee.body.split_last()? else { return None };
        let lets: Option<Vec<(usize, &Expr)>> = lets.iter().map(named).collect();
        let lets = lets?;
        let mut values: Vec<Option<Expr>> = vec![None; callee.variables.len()];
        for (i, argument) in arguments.iter().enumerate() {
            values[i] = Some(self.plain(&callee.variables[i], argument, out));
        }
        for (variable, value) in lets {
            let value = substituted(value, &values);
            values[variable] = Some(self.name(&callee.variables[variable], value, out));
        }
        Some(substituted(result, &values))
    }

    /// An argument that may stand wherever the callee reads it.
    fn plain(&mut self, variable: &Variable, argument: &Expr, out: &mut Vec<Statement>) -> Expr {
        match &argument.kind {
            ExprKind::Variable(_) | ExprKind::Number(_) | ExprKind::Truth(_) | ExprKind::Parameter(_) => {
                argument.clone()
            }
            ExprKind::Component(vector, _) if matches!(vector.kind, ExprKind::Variable(_)) => {
                argument.clone()
            }
            _ => self.name(variable, argument.clone(), out),
        }
    }

    /// The variable that names a value in the caller.
    fn name(&mut self, variable: &Variable, value: Expr, out: &mut Vec<Statement>) -> Expr {
        let span = value.span;
        let of = |index| Expr { kind: ExprKind::Variable(index), span };
        let stem = |name: &str| name == variable.name || name.starts_with(&format!("{}_", variable.name));
        let known = out
            .iter()
            .enumerate()
            .filter_map(|(i, statement)| Some((named(statement)?, &out[i + 1..])))
            .find(|((index, known), later)| {
                let stands = |v| !value.reads(v) || !later.iter().any(|statement| assigns(statement, v));
                stem(&self.variables[*index].name)
                    && known.same(&value)
                    && (0..self.variables.len()).all(stands)
            });
        if let Some(((index, _), _)) = known {
            return of(index);
        }
        let taken = |name: &str| self.variables.iter().any(|v| v.name == name);
        let mut name = variable.name.clone();
        let mut number = 2;
        while taken(&name) {
            name = format!("{}_{number}", variable.name);
            number += 1;
        }
        self.variables.push(Variable { name, kind: variable.kind.clone() });
        let index = self.variables.len() - 1;
        out.push(Statement::Let(index, value));
        of(index)
    }
}

/// Whether a statement gives a variable another value.
fn assigns(statement: &Statement, variable: usize) -> bool {
    match statement {
        Statement::Assign(assigned, _) => *assigned == variable,
        Statement::If(_, accept, reject) => accept.iter().chain(reject).any(|s| assigns(s, variable)),
        Statement::Each(_, _, body) => body.iter().any(|s| assigns(s, variable)),
        Statement::Let(..) | Statement::Var(..) | Statement::Return(_) => false,
    }
}

fn named(statement: &Statement) -> Option<(usize, &Expr)> {
    match statement {
        Statement::Let(variable, value) => Some((*variable, value)),
        _ => None,
    }
}

/// An expression of a callee with the caller's values for its variables. A factor of 1 is left out:
/// the product has the same bits.
fn substituted(expr: &Expr, values: &[Option<Expr>]) -> Expr {
    if let ExprKind::Variable(index) = &expr.kind {
        return values[*index].clone().unwrap_or_else(|| expr.clone());
    }
    let expr = expr.map(&mut |operand| substituted(operand, values));
    match expr.kind {
        ExprKind::Binary(Binary::Multiply, one, other) if one.kind == ExprKind::Number(1.0) => *other,
        _ => expr,
    }
}
