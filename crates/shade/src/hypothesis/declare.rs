//! Puts each `var` declaration where its first use is, and drops names that nothing reads: the
//! front end hoists declarations out of their place, and readers want them back.

use super::lower::visit;
use super::syntax::{Expr, ExprKind, Statement};

/// A `var` declaration that has lost its place.
pub(super) struct Declared {
    pub variable: usize,
    /// Initial value, if the front end hoisted it too.
    pub value: Option<Expr>,
    /// What it holds otherwise.
    pub zero: Expr,
}

/// Declares variables in `body`.
pub(super) fn declare(body: &mut Vec<Statement>, declared: &[Declared]) {
    drop_unread(body);
    for one in declared {
        place(body, one);
    }
}

/// Removes `let`s and assignments to variables that are never read, until every one left is read.
fn drop_unread(body: &mut Vec<Statement>) {
    loop {
        let mut read = std::collections::BTreeSet::new();
        visit(body, &mut |expr| {
            if let ExprKind::Variable(variable) = expr.kind {
                read.insert(variable);
            }
        });
        if !remove(body, &|variable| !read.contains(&variable)) {
            return;
        }
    }
}

fn remove(body: &mut Vec<Statement>, unread: &impl Fn(usize) -> bool) -> bool {
    let before = body.len();
    body.retain(|statement| match statement {
        Statement::Let(variable, _) | Statement::Assign(variable, _) | Statement::Var(variable, _) => {
            !unread(*variable)
        }
        Statement::If(..) | Statement::Each(..) | Statement::Return(_) => true,
    });
    let mut changed = body.len() != before;
    for statement in body {
        match statement {
            Statement::If(_, accept, reject) => changed |= remove(accept, unread) | remove(reject, unread),
            Statement::Each(_, _, body) => changed |= remove(body, unread),
            _ => {}
        }
    }
    changed
}

/// Declares one variable in the innermost block that holds all its uses, at the first of them.
fn place(body: &mut Vec<Statement>, one: &Declared) {
    let variable = one.variable;
    let uses: Vec<usize> = (0..body.len()).filter(|&i| mentions(&body[i..=i], variable)).collect();
    let Some(&first) = uses.first() else { return };
    if uses.len() == 1
        && let Statement::If(condition, accept, reject) = &mut body[first]
        && !condition.reads(variable)
    {
        match (mentions(accept, variable), mentions(reject, variable)) {
            (true, false) => return place(accept, one),
            (false, true) => return place(reject, one),
            _ => {}
        }
    }
    if one.value.is_none()
        && let Statement::Assign(assigned, value) = &body[first]
        && *assigned == variable
        && !value.reads(variable)
    {
        let value = value.clone();
        let constant = !body[first + 1..].iter().any(|s| assigns(s, variable));
        body[first] =
            if constant { Statement::Let(variable, value) } else { Statement::Var(variable, value) };
        return;
    }
    let value = one.value.clone().unwrap_or_else(|| one.zero.clone());
    let constant = !body.iter().any(|s| assigns(s, variable));
    let declared = if constant { Statement::Let(variable, value) } else { Statement::Var(variable, value) };
    body.insert(first, declared);
}

fn mentions(body: &[Statement], variable: usize) -> bool {
    body.iter().any(|statement| match statement {
        Statement::Let(v, e) | Statement::Var(v, e) | Statement::Assign(v, e) => {
            *v == variable || e.reads(variable)
        }
        Statement::Return(e) => e.reads(variable),
        Statement::If(condition, accept, reject) => {
            condition.reads(variable) || mentions(accept, variable) || mentions(reject, variable)
        }
        Statement::Each(_, list, body) => *list == variable || mentions(body, variable),
    })
}

fn assigns(statement: &Statement, variable: usize) -> bool {
    match statement {
        Statement::Assign(v, _) => *v == variable,
        Statement::If(_, accept, reject) => accept.iter().chain(reject).any(|s| assigns(s, variable)),
        Statement::Each(_, _, body) => body.iter().any(|s| assigns(s, variable)),
        _ => false,
    }
}
