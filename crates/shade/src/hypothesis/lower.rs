//! From WGSL text through naga's typed intermediate form to the dialect's own syntax.

use naga::{Handle, Literal, Module, Scalar, Span, TypeInner};

use super::branch::lower_function;
use super::size::{Limits, refuse};
use super::syntax::{Expr, ExprKind, Fetches, Formula, Function, Kind, Parameter, Statement};
use crate::code::Float;
use crate::{Place, ShadeError};

/// What a source lowers to.
pub(super) struct Lowered {
    pub formula: Formula,
    pub doc: Vec<String>,
}

/// The module being lowered, with what messages need.
pub(super) struct Context<'a> {
    pub module: &'a Module,
    file: &'a str,
    source: &'a str,
    /// Whether functions may be of vectors.
    vectors: bool,
    /// Functions lowered so far; naga orders callees before callers.
    pub functions: Vec<Function>,
}

impl Context<'_> {
    /// Lowers the functions of the module; its parameters.
    fn functions(&mut self) -> Result<Vec<Parameter>, ShadeError> {
        refuse_globals(self)?;
        let (parameters, module) = (parameters(self)?, self.module);
        for (handle, function) in module.functions.iter() {
            let lowered = lower_function(self, function, module.functions.get_span(handle))?;
            self.functions.push(lowered);
        }
        Ok(parameters)
    }

    /// Whether functions may be of vectors.
    pub fn has_vectors(&self) -> bool {
        self.vectors
    }

    /// The error "this may not be used" at a place.
    pub fn refuse(&self, span: Span, message: impl Into<String>) -> ShadeError {
        let (start, end) = bytes(span);
        let place = Place::of(self.file, self.source, start as usize, end as usize);
        ShadeError::Dialect { place: Box::new(place), message: message.into() }
    }

    /// The kind of a type, if it is of the dialect.
    pub fn kind(&self, ty: Handle<naga::Type>, span: Span) -> Result<Kind, ShadeError> {
        match self.module.types[ty].inner {
            TypeInner::Scalar(Scalar::F32) => Ok(Kind::Number),
            TypeInner::Scalar(Scalar::BOOL) => Ok(Kind::Truth),
            TypeInner::Vector { size, scalar: Scalar::F32 } if self.vectors => Ok(Kind::Vector(size as u8)),
            TypeInner::Array { base, size: naga::ArraySize::Constant(n), .. }
                if self.vectors && self.kind(base, span)? == Kind::Vector(4) && n.get() < 256 =>
            {
                Ok(Kind::List(n.get() as u8))
            }
            TypeInner::Struct { ref members, .. } if self.vectors => self.fetches(ty, members, span),
            _ if self.vectors => Err(self.refuse(span, "only f32, its vectors and bool are allowed")),
            _ => Err(self.refuse(span, "only f32 and bool are allowed in a hypothesis")),
        }
    }

    /// The kind of a structure: vectors of 4, then as many numbers.
    fn fetches(
        &self,
        ty: Handle<naga::Type>,
        members: &[naga::StructMember],
        span: Span,
    ) -> Result<Kind, ShadeError> {
        let n = members.len() / 2;
        let kinds: Result<Vec<Kind>, ShadeError> = members.iter().map(|m| self.kind(m.ty, span)).collect();
        let name = self.module.types[ty].name.clone();
        if let Some(name) = name
            && kinds? == [vec![Kind::Vector(4); n], vec![Kind::Number; n]].concat()
            && n < 256
        {
            let doc = self.module.doc_comments.as_ref().and_then(|comments| comments.types.get(&ty));
            let doc = doc.into_iter().flatten().flat_map(|text| text.lines()).map(plain).collect();
            return Ok(Kind::Fetches(Fetches { name, doc, count: n as u8 }));
        }
        Err(self.refuse(span, "a structure must have vectors of 4, then as many numbers"))
    }

    /// A literal of the dialect.
    pub fn literal(&self, literal: Literal, span: Span) -> Result<ExprKind, ShadeError> {
        match literal {
            Literal::F32(x) => Ok(ExprKind::Number(x)),
            Literal::Bool(x) => Ok(ExprKind::Truth(x)),
            _ => Err(self.refuse(span, "only f32 and bool literals are allowed in a hypothesis")),
        }
    }

    /// The value of a module-scope constant expression.
    pub fn constant(&self, init: Handle<naga::Expression>, span: Span) -> Result<ExprKind, ShadeError> {
        match self.module.global_expressions[init] {
            naga::Expression::Literal(literal) => self.literal(literal, span),
            naga::Expression::ZeroValue(ty) => self.zero(ty, span),
            naga::Expression::Constant(other) => self.constant(self.module.constants[other].init, span),
            _ => Err(self.refuse(span, "this must be a constant number or bool")),
        }
    }

    /// The zero of a type.
    pub fn zero(&self, ty: Handle<naga::Type>, span: Span) -> Result<ExprKind, ShadeError> {
        Ok(match self.kind(ty, span)? {
            Kind::Number => ExprKind::Number(0.0),
            Kind::Truth => ExprKind::Truth(false),
            Kind::Vector(n) => {
                let zero = Expr { kind: ExprKind::Number(0.0), span: bytes(span) };
                ExprKind::Compose(vec![zero; usize::from(n)])
            }
            Kind::List(_) | Kind::Fetches(_) => {
                return Err(self.refuse(span, "an array or a structure has to be written out"));
            }
        })
    }
}

/// A span as byte range.
pub(super) fn bytes(span: Span) -> (u32, u32) {
    span.to_range().map_or((0, 0), |r| (r.start as u32, r.end as u32))
}

/// Parses, validates and lowers a hypothesis.
pub(super) fn lower(file: &str, source: &str) -> Result<Lowered, ShadeError> {
    let module = parse(file, source)?;
    let mut context = Context { module: &module, file, source, vectors: false, functions: Vec::new() };
    let parameters = context.functions()?;
    refuse_unused(&context, &parameters)?;
    let doc = documentation(&module);
    Ok(Lowered { formula: Formula { functions: context.functions, parameters, float: Float::F32 }, doc })
}

/// Parses, validates and lowers functions of numbers and vectors, each with its documentation.
pub(crate) fn lower_functions(file: &str, source: &str) -> Result<(Formula, Vec<Vec<String>>), ShadeError> {
    let module = parse(file, source)?;
    let mut context = Context { module: &module, file, source, vectors: true, functions: Vec::new() };
    let parameters = context.functions()?;
    let of = |handle| module.doc_comments.as_ref().and_then(|comments| comments.functions.get(&handle));
    let doc = |handle| of(handle).into_iter().flatten().flat_map(|text| text.lines()).map(plain).collect();
    let docs = module.functions.iter().map(|(handle, _)| doc(handle)).collect();
    Ok((Formula { functions: context.functions, parameters, float: Float::F32 }, docs))
}

/// Parses and validates WGSL.
pub(crate) fn parse(file: &str, source: &str) -> Result<Module, ShadeError> {
    let place = |span: Option<Span>| {
        let (start, end) = span.map_or((0, 0), bytes);
        Box::new(Place::of(file, source, start as usize, end as usize))
    };
    let mut options = naga::front::wgsl::Options::new();
    options.parse_doc_comments = true;
    let module = naga::front::wgsl::Frontend::new_with_options(options).parse(source).map_err(|e| {
        let label = e.labels().next();
        let message = worded(e.message(), label.as_ref().map_or("", |(_, text)| text));
        ShadeError::Syntax { place: place(label.map(|(span, _)| span)), message }
    })?;
    let flags = naga::valid::ValidationFlags::all();
    naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module).map_err(
        |e| {
            let span = e.spans().map(|(span, _)| *span).find(Span::is_defined);
            ShadeError::Syntax { place: place(span), message: chain(e.as_inner()) }
        },
    )?;
    Ok(module)
}

/// The front end's message with the label of its place, unless that says nothing new: labels refer
/// to the message (`see msg`), or repeat it.
fn worded(message: &str, label: &str) -> String {
    let told = label.is_empty() || label == "see msg" || message.contains(label);
    if told { message.to_string() } else { format!("{message} ({label})") }
}

/// An error with its causes in one line.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}

fn refuse_globals(context: &Context) -> Result<(), ShadeError> {
    let module = context.module;
    if let Some((handle, _)) = module.global_variables.iter().next() {
        let span = module.global_variables.get_span(handle);
        return Err(context.refuse(span, "global variables are not allowed in a hypothesis"));
    }
    if !module.entry_points.is_empty() {
        let message = "entry points are not allowed in a hypothesis: write a plain function";
        return Err(context.refuse(Span::default(), message));
    }
    if module.functions.is_empty() {
        return Err(context.refuse(Span::default(), "a hypothesis needs a function"));
    }
    Ok(())
}

fn parameters(context: &Context) -> Result<Vec<Parameter>, ShadeError> {
    let overrides = &context.module.overrides;
    refuse(context.file, "free parameters (override)", overrides.len(), Limits::PARAMETERS)?;
    let one = |(handle, parameter): (Handle<naga::Override>, &naga::Override)| {
        let span = overrides.get_span(handle);
        if context.kind(parameter.ty, span)? != Kind::Number {
            return Err(context.refuse(span, "a free parameter must be an f32"));
        }
        let start = match parameter.init {
            None => 1.0,
            Some(init) => match context.constant(init, span)? {
                ExprKind::Number(x) => x,
                _ => return Err(context.refuse(span, "a free parameter must start at a number")),
            },
        };
        Ok(Parameter { name: parameter.name.clone().unwrap_or_default(), start })
    };
    overrides.iter().map(one).collect()
}

/// Refuses functions that are never called and parameters that are never read: the author meant
/// something else.
fn refuse_unused(context: &Context, parameters: &[Parameter]) -> Result<(), ShadeError> {
    let mut called = vec![false; context.functions.len()];
    let mut read = vec![false; parameters.len()];
    if let Some(last) = called.last_mut() {
        *last = true;
    }
    for function in &context.functions {
        visit(&function.body, &mut |expr| match expr.kind {
            ExprKind::Call(index, _) => called[index] = true,
            ExprKind::Parameter(index) => read[index] = true,
            _ => {}
        });
    }
    if let Some(index) = called.iter().position(|c| !c) {
        let name = &context.functions[index].name;
        let span = context.module.functions.iter().nth(index).map(|(h, _)| h);
        let span = span.map_or(Span::default(), |h| context.module.functions.get_span(h));
        let message = format!("function {name} is never called; the last function is the hypothesis");
        return Err(context.refuse(span, message));
    }
    if let Some(index) = read.iter().position(|r| !r) {
        let span = context.module.overrides.iter().nth(index).map(|(h, _)| h);
        let span = span.map_or(Span::default(), |h| context.module.overrides.get_span(h));
        let message = format!(
            "parameter {} is not used: use it in the formula or remove its override",
            parameters[index].name
        );
        return Err(context.refuse(span, message));
    }
    Ok(())
}

/// Calls `f` on every expression of a block.
pub(crate) fn visit(body: &[Statement], f: &mut impl FnMut(&Expr)) {
    fn expression(expr: &Expr, f: &mut impl FnMut(&Expr)) {
        f(expr);
        for operand in expr.operands() {
            expression(operand, f);
        }
    }
    for statement in body {
        match statement {
            Statement::Let(_, e) | Statement::Var(_, e) | Statement::Assign(_, e) | Statement::Return(e) => {
                expression(e, f);
            }
            Statement::If(condition, accept, reject) => {
                expression(condition, f);
                visit(accept, f);
                visit(reject, f);
            }
            Statement::Each(_, _, body) => visit(body, f),
        }
    }
}

/// Documentation comments of the module, then of its last function.
fn documentation(module: &Module) -> Vec<String> {
    let Some(comments) = &module.doc_comments else { return Vec::new() };
    let main = module.functions.iter().last().and_then(|(handle, _)| comments.functions.get(&handle));
    let lines = comments.module.iter().chain(main.into_iter().flatten());
    lines.flat_map(|text| text.lines()).map(plain).collect()
}

/// A documentation line without its marker.
fn plain(line: &str) -> String {
    let line = line.trim();
    let text = ["///", "//!", "/**", "/*!"].iter().find_map(|marker| line.strip_prefix(marker));
    text.unwrap_or(line).trim_end_matches("*/").trim().to_string()
}
