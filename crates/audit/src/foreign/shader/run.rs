//! A shader function run at one point of its arguments.

use naga::{
    AddressSpace, ArraySize, Block, Expression, Function, Handle, Literal, Module, Scalar, ScalarKind, Span,
    Statement, SwitchValue, SwizzleComponent, Type, TypeInner, VectorSize,
};

use super::source::{NO_GLOBAL, Program};
use super::value::{Pointer, Value};
use super::{ShaderLanguage, operator};
use crate::foreign::{ForeignError, limits};

/// What has happened when a block has run.
enum Flow {
    Next,
    Break,
    Continue,
    Return(Value),
}

/// A function at work.
struct Frame<'a> {
    function: &'a Function,
    arguments: Vec<Value>,
    /// Slots of its variables, by index.
    locals: Vec<usize>,
    /// Values of its expressions, by index.
    values: Vec<Option<Value>>,
}

/// A module whose functions are run.
pub(super) struct Run<'a> {
    pub module: &'a Module,
    pub program: &'a Program,
    /// Variables of the functions at work, callers first.
    pub memory: Vec<Value>,
    /// Whether a branch depended on what is not a number: no result means anything.
    pub undefined: bool,
    /// Slots of global variables, by index.
    globals: Vec<Option<usize>>,
    /// The last place that was known: front ends do not tell that of every expression.
    here: Span,
    /// Statements and expressions that were run.
    pub steps: usize,
    depth: usize,
}

/// What is read, for messages.
const ONLY: &str = "a function may use numbers, vectors, matrices, arrays, if, loops and calls";

/// Whether a node of an expression is a constant of the text.
fn is_known(function: &Function, handle: Handle<Expression>) -> bool {
    match &function.expressions[handle] {
        Expression::Literal(_) | Expression::Constant(_) | Expression::ZeroValue(_) => true,
        Expression::Splat { value, .. } => is_known(function, *value),
        Expression::Compose { components, .. } => components.iter().all(|part| is_known(function, *part)),
        _ => false,
    }
}

/// Most operands of an expression that is not composed of entries.
const OPERANDS: usize = 4;

/// The operands of an expression whose value follows from theirs, in order; of one that is composed, its
/// entries.
fn operands(expression: &Expression) -> impl Iterator<Item = Handle<Expression>> {
    let (entries, own): (&[_], [Option<_>; OPERANDS]) = match *expression {
        Expression::Compose { ref components, .. } => (components, [None; OPERANDS]),
        Expression::Splat { value: x, .. }
        | Expression::Swizzle { vector: x, .. }
        | Expression::Unary { expr: x, .. }
        | Expression::As { expr: x, .. }
        | Expression::Relational { argument: x, .. }
        | Expression::AccessIndex { base: x, .. }
        | Expression::Load { pointer: x } => (&[], [Some(x), None, None, None]),
        Expression::Binary { left, right, .. } => (&[], [Some(left), Some(right), None, None]),
        Expression::Access { base, index } => (&[], [Some(base), Some(index), None, None]),
        Expression::Select { condition, accept, reject } => {
            (&[], [Some(condition), Some(accept), Some(reject), None])
        }
        Expression::Math { arg, arg1, arg2, arg3, .. } => (&[], [Some(arg), arg1, arg2, arg3]),
        _ => (&[], [None; OPERANDS]),
    };
    own.into_iter().flatten().chain(entries.iter().copied())
}

impl<'a> Run<'a> {
    /// With the initial values of the module's private variables.
    pub fn new(program: &'a Program) -> Result<Run<'a>, ForeignError> {
        let module = &program.module;
        let mut run = Run {
            module,
            program,
            memory: Vec::new(),
            undefined: false,
            globals: vec![None; module.global_variables.len()],
            here: Span::default(),
            steps: 0,
            depth: 0,
        };
        for (handle, variable) in module.global_variables.iter() {
            if let (AddressSpace::Private, Some(init)) = (variable.space, variable.init) {
                let value = run.global_expression(init)?;
                run.globals[handle.index()] = Some(run.memory.len());
                run.memory.push(value);
            }
        }
        Ok(run)
    }

    /// The value of a call; an empty list where the function returns nothing.
    pub fn call(&mut self, handle: Handle<Function>, arguments: Vec<Value>) -> Result<Value, ForeignError> {
        let function = &self.module.functions[handle];
        let span = self.known(self.module.functions.get_span(handle));
        self.depth += 1;
        if self.depth > limits::DEPTH {
            return Err(self.program.too_large("calls inside one another", self.depth, limits::DEPTH));
        }
        let base = self.memory.len();
        let values = vec![None; function.expressions.len()];
        let mut frame = Frame { function, arguments, locals: Vec::new(), values };
        for (handle, local) in function.local_variables.iter() {
            let span = function.local_variables.get_span(handle);
            let value = match local.init {
                Some(init) => self.value(&mut frame, init)?,
                None => self.unwritten(local.ty, span)?,
            };
            frame.locals.push(self.memory.len());
            self.memory.push(value);
        }
        let flow = self.block(&mut frame, &function.body)?;
        self.memory.truncate(base);
        self.depth -= 1;
        match flow {
            Flow::Return(value) => Ok(value),
            _ if function.result.is_none() => Ok(Value::List(Vec::new())),
            _ => Err(self.program.unsupported(
                span,
                "a path that returns nothing",
                "let every path return a value",
            )),
        }
    }

    fn block(&mut self, frame: &mut Frame<'a>, block: &Block) -> Result<Flow, ForeignError> {
        for (statement, span) in block.span_iter() {
            match self.statement(frame, statement, *span)? {
                Flow::Next => {}
                flow => return Ok(flow),
            }
        }
        Ok(Flow::Next)
    }

    /// The span, or the last one before it that tells a place.
    fn known(&mut self, span: Span) -> Span {
        if span.is_defined() {
            self.here = span;
        }
        self.here
    }

    /// Counts a step and refuses too many.
    fn step(&mut self) -> Result<(), ForeignError> {
        self.steps += 1;
        if self.steps > limits::STEPS {
            return Err(self.program.too_large(
                "steps of one call, loops unrolled",
                self.steps,
                limits::STEPS,
            ));
        }
        Ok(())
    }

    fn statement(
        &mut self,
        frame: &mut Frame<'a>,
        statement: &Statement,
        span: Span,
    ) -> Result<Flow, ForeignError> {
        self.step()?;
        let span = self.known(span);
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.expression(frame, handle)?;
                    frame.values[handle.index()] = Some(value);
                }
            }
            Statement::Block(block) => return self.block(frame, block),
            Statement::If { condition, accept, reject } => {
                let holds = self.holds(frame, *condition)?;
                return self.block(frame, if holds { accept } else { reject });
            }
            Statement::Switch { selector, cases } => {
                let selected = self.value(frame, *selector)?;
                let Value::Integer(found) = selected else { return Err(self.mismatch(span, &[selected])) };
                let is = |value: SwitchValue| match value {
                    SwitchValue::I32(x) => i64::from(x) == found,
                    SwitchValue::U32(x) => i64::from(x) == found,
                    SwitchValue::Default => false,
                };
                let case = cases.iter().position(|c| is(c.value));
                let case = case.or_else(|| cases.iter().position(|c| c.value == SwitchValue::Default));
                for case in cases.iter().skip(case.unwrap_or(cases.len())) {
                    match self.block(frame, &case.body)? {
                        Flow::Next if case.fall_through => {}
                        Flow::Next | Flow::Break => break,
                        other => return Ok(other),
                    }
                }
            }
            Statement::Loop { body, continuing, break_if } => loop {
                self.step()?;
                match self.block(frame, body)? {
                    Flow::Break => break,
                    Flow::Next | Flow::Continue => {}
                    other => return Ok(other),
                }
                self.block(frame, continuing)?;
                if let Some(condition) = break_if
                    && self.holds(frame, *condition)?
                {
                    break;
                }
            },
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                let value = value.map(|value| self.value(frame, value)).transpose()?;
                return Ok(Flow::Return(value.unwrap_or(Value::List(Vec::new()))));
            }
            Statement::Store { pointer, value } => {
                let value = self.value(frame, *value)?;
                let pointer = self.value(frame, *pointer)?;
                let Value::Pointer(pointer) = pointer else { return Err(self.mismatch(span, &[pointer])) };
                let outside =
                    || self.program.unsupported(span, "an assignment beyond the end", "check the index");
                *pointer.of(&mut self.memory).ok_or_else(outside)? = value;
            }
            Statement::Call { function, arguments, result } => {
                let values = arguments.iter().map(|&a| self.value(frame, a)).collect::<Result<_, _>>()?;
                let value = self.call(*function, values)?;
                if let Some(result) = result {
                    frame.values[result.index()] = Some(value);
                }
            }
            _ => return Err(self.program.unsupported(span, "this statement", ONLY)),
        }
        Ok(Flow::Next)
    }

    /// Whether a condition holds; of what is not a number nothing does, and all is undefined.
    fn holds(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<bool, ForeignError> {
        match self.value(frame, handle)? {
            Value::Truth(truth) => {
                self.undefined |= truth.is_nan();
                Ok(truth == 1.0)
            }
            other => Err(self.mismatch(frame.function.expressions.get_span(handle), &[other])),
        }
    }

    /// The value of an expression that has been made, or is made now.
    fn value(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Value, ForeignError> {
        match &frame.values[handle.index()] {
            Some(value) => Ok(value.clone()),
            None => self.expression(frame, handle),
        }
    }

    fn expression(
        &mut self,
        frame: &mut Frame<'a>,
        handle: Handle<Expression>,
    ) -> Result<Value, ForeignError> {
        self.step()?;
        let expression = &frame.function.expressions[handle];
        let span = self.known(frame.function.expressions.get_span(handle));
        match *expression {
            Expression::FunctionArgument(index) => return Ok(frame.arguments[index as usize].clone()),
            Expression::LocalVariable(local) => return Ok(Self::pointer(frame.locals[local.index()])),
            _ => {}
        }
        if let Expression::Compose { .. } = expression {
            let entries = operands(expression).map(|entry| self.value(frame, entry));
            let entries = entries.collect::<Result<Vec<Value>, _>>()?;
            return self.made(expression, &entries, false, span);
        }
        // The last is an exponent where one is called for.
        let (mut values, mut count, mut known) = ([const { Value::Unset }; OPERANDS], 0, false);
        for operand in operands(expression) {
            values[count] = self.value(frame, operand)?;
            count += 1;
            known = matches!(expression, Expression::Math { .. }) && is_known(frame.function, operand);
        }
        self.made(expression, &values[..count], known, span)
    }

    /// The value of an expression of the module's own scope.
    fn global_expression(&mut self, handle: Handle<Expression>) -> Result<Value, ForeignError> {
        self.step()?;
        let expression = &self.module.global_expressions[handle];
        let span = self.module.global_expressions.get_span(handle);
        let operands = operands(expression).map(|operand| self.global_expression(operand));
        let operands = operands.collect::<Result<Vec<Value>, _>>()?;
        self.made(expression, &operands, true, span)
    }

    /// The value of an expression of these operands, in the order of [`operands`].
    fn made(
        &mut self,
        expression: &Expression,
        x: &[Value],
        known: bool,
        span: Span,
    ) -> Result<Value, ForeignError> {
        let made = match *expression {
            Expression::Literal(literal) => return self.literal(literal, span),
            Expression::Constant(constant) => {
                return self.global_expression(self.module.constants[constant].init);
            }
            Expression::Override(handle) => match self.module.overrides[handle].init {
                Some(init) => return self.global_expression(init),
                None => {
                    return Err(self.program.unsupported(span, "an override without a value", "give it one"));
                }
            },
            Expression::GlobalVariable(global) => return self.global(global, span),
            Expression::ZeroValue(ty) => return self.zero(ty, span),
            Expression::Load { .. } => match &x[0] {
                Value::Pointer(pointer) => {
                    let value = pointer.of(&mut self.memory).cloned();
                    let outside =
                        || self.program.unsupported(span, "an index beyond the end", "check the index");
                    return value.ok_or_else(outside);
                }
                _ => None,
            },
            Expression::Access { .. } => match x[1] {
                Value::Integer(index) => return self.entry(&x[0], index, span),
                _ => None,
            },
            Expression::AccessIndex { index, .. } => return self.entry(&x[0], i64::from(index), span),
            Expression::Compose { ty, .. } => self.composed(ty, x),
            Expression::Splat { size, .. } => Some(Value::List(vec![x[0].clone(); size as usize])),
            Expression::Swizzle { size, pattern, .. } => {
                return self.swizzle(&x[0], &pattern[..size as usize], span);
            }
            Expression::Unary { op, .. } => operator::unary(op, &x[0]),
            Expression::Binary { op, .. } => operator::binary(op, &x[0], &x[1]),
            Expression::Select { .. } => operator::choose(&x[0], &x[1], &x[2]),
            Expression::Relational { fun, .. } => operator::relational(fun, &x[0]),
            Expression::Math { fun, .. } => match operator::function(fun, x, known) {
                None if !x.iter().any(Value::has_gaps) => {
                    return Err(self.program.unsupported(
                        span,
                        format!("the function {fun:?} of these types"),
                        ONLY,
                    ));
                }
                made => made,
            },
            Expression::As { kind, convert: Some(_), .. } => operator::convert(&x[0], kind),
            Expression::ImageSample { .. } | Expression::ImageLoad { .. } | Expression::ImageQuery { .. } => {
                let advice = "audit the texture's own file as a table";
                return Err(self.program.unsupported(span, "a texture", advice));
            }
            Expression::Derivative { .. } => {
                let advice = "a formula depends on its arguments alone";
                return Err(self.program.unsupported(span, "a derivative between pixels", advice));
            }
            _ => return Err(self.program.unsupported(span, "this expression", ONLY)),
        };
        made.ok_or_else(|| self.mismatch(span, x))
    }

    /// The error that values are of other types than are needed, or were never set.
    pub fn mismatch(&self, span: Span, values: &[Value]) -> ForeignError {
        if values.iter().any(Value::has_gaps) {
            let what = "a variable that is not set on every path";
            return self.program.unsupported(span, what, "set it before it is read");
        }
        self.program.unsupported(span, "an expression of these types, or beyond 32 bits", ONLY)
    }

    fn literal(&self, literal: Literal, span: Span) -> Result<Value, ForeignError> {
        Ok(match literal {
            Literal::F32(x) => Value::Number(x),
            Literal::AbstractFloat(x) => Value::Number(x as f32),
            Literal::Bool(x) => Value::truth(x),
            Literal::I32(x) => Value::Integer(x.into()),
            Literal::U32(x) => Value::Integer(x.into()),
            Literal::AbstractInt(x) => Value::Integer(x),
            _ => return Err(self.program.unsupported(span, "a number that is not f32", "write it as f32")),
        })
    }

    fn global(&self, handle: Handle<naga::GlobalVariable>, span: Span) -> Result<Value, ForeignError> {
        if let Some(slot) = self.globals[handle.index()] {
            return Ok(Self::pointer(slot));
        }
        let name = self.module.global_variables[handle].name.clone().unwrap_or_default();
        let what = format!("the global variable {name}");
        Err(self.program.unsupported(span, what, NO_GLOBAL))
    }

    /// A pointer to a variable that is kept in a slot.
    pub fn pointer(slot: usize) -> Value {
        Value::Pointer(Pointer { slot, path: Vec::new() })
    }

    fn entry(&self, base: &Value, index: i64, span: Span) -> Result<Value, ForeignError> {
        let outside =
            || self.program.unsupported(span, format!("index {index}, beyond the end,"), "check the index");
        let index = usize::try_from(index).map_err(|_| outside())?;
        match base {
            Value::List(list) => list.get(index).cloned().ok_or_else(outside),
            Value::Pointer(pointer) => Ok(Value::Pointer(pointer.entry(index))),
            other => Err(self.mismatch(span, std::slice::from_ref(other))),
        }
    }

    fn swizzle(
        &self,
        vector: &Value,
        pattern: &[SwizzleComponent],
        span: Span,
    ) -> Result<Value, ForeignError> {
        let entries = pattern.iter().map(|component| self.entry(vector, *component as i64, span));
        Ok(Value::List(entries.collect::<Result<_, _>>()?))
    }

    /// A vector from scalars and vectors; anything else from its entries.
    fn composed(&self, ty: Handle<Type>, parts: &[Value]) -> Option<Value> {
        let TypeInner::Vector { size, .. } = self.module.types[ty].inner else {
            return Some(Value::List(parts.to_vec()));
        };
        let flat = parts.iter().flat_map(|part| part.entries().unwrap_or(std::slice::from_ref(part)));
        let flat: Vec<Value> = flat.cloned().collect();
        (flat.len() == size as usize).then_some(Value::List(flat))
    }

    fn zero(&self, ty: Handle<Type>, span: Span) -> Result<Value, ForeignError> {
        self.filled(ty, span, &mut |scalar| match scalar.kind {
            ScalarKind::Float => Value::Number(0.0),
            ScalarKind::Bool => Value::Truth(0.0),
            _ => Value::Integer(0),
        })
    }

    /// What a variable without an initial value holds: zeros in WGSL, nothing in GLSL.
    pub fn unwritten(&self, ty: Handle<Type>, span: Span) -> Result<Value, ForeignError> {
        match self.program.language {
            ShaderLanguage::Wgsl => self.zero(ty, span),
            ShaderLanguage::Glsl | ShaderLanguage::Hlsl => self.filled(ty, span, &mut |_| Value::Unset),
        }
    }

    /// A value of a type, its scalars made by `fill`.
    pub fn filled(
        &self,
        ty: Handle<Type>,
        span: Span,
        fill: &mut dyn FnMut(Scalar) -> Value,
    ) -> Result<Value, ForeignError> {
        let all = self.entries(ty);
        if all > limits::ENTRIES {
            return Err(self.program.too_large("entries of a variable", all, limits::ENTRIES));
        }
        let vector = |size: VectorSize, scalar, fill: &mut dyn FnMut(Scalar) -> Value| {
            Value::List((0..size as usize).map(|_| fill(scalar)).collect())
        };
        let list: Vec<Value> = match &self.module.types[ty].inner {
            TypeInner::Scalar(scalar) => return Ok(fill(*scalar)),
            TypeInner::Vector { size, scalar } => return Ok(vector(*size, *scalar, fill)),
            TypeInner::Matrix { columns, rows, scalar } => {
                (0..*columns as usize).map(|_| vector(*rows, *scalar, fill)).collect()
            }
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                (0..count.get()).map(|_| self.filled(*base, span, fill)).collect::<Result<_, _>>()?
            }
            TypeInner::Struct { members, .. } => {
                members.iter().map(|m| self.filled(m.ty, span, fill)).collect::<Result<_, _>>()?
            }
            _ => return Err(self.program.unsupported(span, "a variable of this type", ONLY)),
        };
        Ok(Value::List(list))
    }

    /// Scalars of a type, those of an array counted in. A module's types name only those before
    /// them, so that one pass counts all.
    fn entries(&self, ty: Handle<Type>) -> usize {
        let mut counts: Vec<usize> = Vec::with_capacity(ty.index() + 1);
        for (_, each) in self.module.types.iter().take(ty.index() + 1) {
            let of = |inner: &Handle<Type>| counts.get(inner.index()).copied().unwrap_or(usize::MAX);
            counts.push(match &each.inner {
                TypeInner::Vector { size, .. } => *size as usize,
                TypeInner::Matrix { columns, rows, .. } => *columns as usize * *rows as usize,
                TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                    (count.get() as usize).saturating_mul(of(base))
                }
                TypeInner::Struct { members, .. } => {
                    members.iter().fold(0, |sum: usize, m| sum.saturating_add(of(&m.ty)))
                }
                _ => 1,
            });
        }
        counts.last().copied().unwrap_or(0)
    }
}
