//! What nothing needs, taken out: arguments that no body reads, functions that no other calls.

use crate::hypothesis::{Expr, ExprKind, Function, Statement};

/// The functions, each without the arguments that its body does not read once those that it calls
/// have lost theirs.
pub(crate) fn trimmed(functions: &[Function]) -> Vec<Function> {
    let mut done: Vec<Function> = Vec::new();
    // by function, whether each argument stays
    let mut stays: Vec<Vec<bool>> = Vec::new();
    for function in functions {
        let body = block(&function.body, &mut |expr| called(expr, &stays));
        let function = Function { body, ..function.clone() };
        let read: Vec<bool> = (0..function.arguments).map(|i| function.reads(i)).collect();
        done.push(without(&function, &read));
        stays.push(read);
    }
    done
}

/// Takes out the functions that the last one does not call, through others or itself.
pub(crate) fn drop_uncalled(functions: &mut Vec<Function>) {
    let mut needed = vec![false; functions.len()];
    if let Some(last) = needed.last_mut() {
        *last = true;
    }
    // A function stands after those that it calls, so one walk from the last back meets every call.
    for index in (0..functions.len()).rev() {
        if needed[index] {
            calls_of(&functions[index].body, &mut needed);
        }
    }
    let place = |index: usize| needed[..index].iter().filter(|&&needed| needed).count();
    let renumbered = |expr: Expr| match expr.kind {
        ExprKind::Call(callee, arguments) => {
            Expr { kind: ExprKind::Call(place(callee), arguments), span: expr.span }
        }
        _ => expr,
    };
    let stay = functions.iter().enumerate().filter(|(index, _)| needed[*index]).map(|(_, function)| {
        let body = block(&function.body, &mut |expr| renumbered(expr));
        Function { body, ..function.clone() }
    });
    *functions = stay.collect();
}

/// Marks the functions that a body calls.
fn calls_of(body: &[Statement], needed: &mut [bool]) {
    block(body, &mut |expr| {
        if let ExprKind::Call(callee, _) = &expr.kind {
            needed[*callee] = true;
        }
        expr
    });
}

/// A function without some of its arguments.
fn without(function: &Function, stays: &[bool]) -> Function {
    let stay = |i: usize| stays.get(i).copied().unwrap_or(true);
    let place = |i: usize| (0..i).filter(|&j| stay(j)).count();
    let variables = function.variables.iter().enumerate().filter(|(i, _)| stay(*i));
    let variables = variables.map(|(_, variable)| variable.clone()).collect();
    let mut body = block(&function.body, &mut |expr| match &expr.kind {
        ExprKind::Variable(i) => Expr { kind: ExprKind::Variable(place(*i)), span: expr.span },
        _ => expr,
    });
    renumber(&mut body, &place);
    Function { variables, arguments: place(function.arguments), body, ..function.clone() }
}

/// A call without the arguments that the callee has lost.
fn called(expr: Expr, stays: &[Vec<bool>]) -> Expr {
    let ExprKind::Call(callee, arguments) = &expr.kind else { return expr };
    let kept = arguments.iter().zip(&stays[*callee]).filter(|(_, stays)| **stays);
    let kind = ExprKind::Call(*callee, kept.map(|(argument, _)| argument.clone()).collect());
    Expr { kind, span: expr.span }
}

fn deep(expr: &Expr, f: &mut impl FnMut(Expr) -> Expr) -> Expr {
    let inner = expr.map(&mut |operand| deep(operand, f));
    f(inner)
}

fn block(body: &[Statement], f: &mut impl FnMut(Expr) -> Expr) -> Vec<Statement> {
    let one = |statement: &Statement| match statement {
        Statement::Let(variable, e) => Statement::Let(*variable, deep(e, f)),
        Statement::Var(variable, e) => Statement::Var(*variable, deep(e, f)),
        Statement::Assign(variable, e) => Statement::Assign(*variable, deep(e, f)),
        Statement::Return(e) => Statement::Return(deep(e, f)),
        Statement::If(condition, accept, reject) => {
            Statement::If(deep(condition, f), block(accept, f), block(reject, f))
        }
        Statement::Each(element, list, body) => Statement::Each(*element, *list, block(body, f)),
    };
    body.iter().map(one).collect()
}

/// The variables that statements name, each by its new place.
fn renumber(body: &mut [Statement], place: &impl Fn(usize) -> usize) {
    for statement in body {
        match statement {
            Statement::Let(variable, _) | Statement::Var(variable, _) | Statement::Assign(variable, _) => {
                *variable = place(*variable);
            }
            Statement::If(_, accept, reject) => {
                renumber(accept, place);
                renumber(reject, place);
            }
            Statement::Each(element, list, body) => {
                (*element, *list) = (place(*element), place(*list));
                renumber(body, place);
            }
            Statement::Return(_) => {}
        }
    }
}
