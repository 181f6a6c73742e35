//! Expressions of a shader function as values.

use naga::{
    ArraySize, Expression, Handle, Literal, Scalar, ScalarKind, Span, SwizzleComponent, Type, TypeInner,
};

use super::ShaderLanguage;
use super::value::Value;
use super::walk::{Frame, ONLY, Walk};
use super::{arithmetic, math};
use crate::foreign::{ForeignError, limits};
use lobefit_shade::Node;

impl<'a> Walk<'a> {
    /// The value of an expression that has been walked, or needs no walk.
    pub fn value(
        &mut self,
        frame: &mut Frame<'a>,
        handle: Handle<Expression>,
    ) -> Result<Value, ForeignError> {
        match &frame.values[handle.index()] {
            Some(value) => Ok(value.clone()),
            None => self.expression(frame, handle),
        }
    }

    /// The value of a bool.
    pub fn truth(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Node, ForeignError> {
        match self.value(frame, handle)? {
            Value::Truth(node) => Ok(node),
            other => Err(self.mismatch(frame.function.expressions.get_span(handle), &other)),
        }
    }

    /// The value of an expression.
    pub fn expression(
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
            Expression::GlobalVariable(global) => return self.global(global, span),
            Expression::Load { pointer } => return self.load(frame, pointer, span),
            Expression::Access { base, index } => {
                let index = match self.value(frame, index)? {
                    Value::Integer(index) => index,
                    _ => {
                        let advice = "an index must be known: audit the array itself as a table";
                        return Err(self.source.unsupported(
                            span,
                            "an index that depends on the inputs",
                            advice,
                        ));
                    }
                };
                let base = self.value(frame, base)?;
                return self.entry(&base, index, span);
            }
            Expression::AccessIndex { base, index } => {
                let base = self.value(frame, base)?;
                return self.entry(&base, i64::from(index), span);
            }
            _ => {}
        }
        let mut operands = Vec::new();
        for operand in arithmetic::operands(expression) {
            operands.push(self.value(frame, operand)?);
        }
        self.maker.span = span.to_range().map_or((0, 0), |r| (r.start as u32, r.end as u32));
        self.combine(expression, operands, span)
    }

    /// The value of an expression of the module's own scope.
    fn global_expression(&mut self, handle: Handle<Expression>) -> Result<Value, ForeignError> {
        self.step()?;
        let expression = &self.module.global_expressions[handle];
        let span = self.module.global_expressions.get_span(handle);
        let mut operands = Vec::new();
        for operand in arithmetic::operands(expression) {
            operands.push(self.global_expression(operand)?);
        }
        self.combine(expression, operands, span)
    }

    /// The value of an expression of these operands, in the order of [`arithmetic::operands`].
    fn combine(&mut self, expression: &Expression, x: Vec<Value>, span: Span) -> Result<Value, ForeignError> {
        match *expression {
            Expression::Literal(literal) => self.literal(literal, span),
            Expression::Constant(constant) => self.global_expression(self.module.constants[constant].init),
            Expression::Override(handle) => match self.module.overrides[handle].init {
                Some(init) => self.global_expression(init),
                None => Err(self.source.unsupported(span, "an override without a value", "give it one")),
            },
            Expression::ZeroValue(ty) => self.zero(ty, span),
            Expression::Compose { ty, .. } => self.compose(ty, x, span),
            Expression::Splat { size, .. } => Ok(Value::List(vec![x[0].clone(); size as usize])),
            Expression::Swizzle { size, pattern, .. } => self.swizzle(&x[0], &pattern[..size as usize], span),
            Expression::Unary { op, .. } => arithmetic::unary(self, op, &x[0], span),
            Expression::Binary { op, .. } => arithmetic::binary(self, op, &x[0], &x[1], span),
            Expression::Select { .. } => self.choose(&x[0], &x[1], &x[2], span),
            Expression::Relational { fun, .. } => arithmetic::relational(self, fun, &x[0], span),
            Expression::Math { fun, .. } => math::function(self, fun, &x, span),
            Expression::As { kind, convert: Some(_), .. } => self.convert(&x[0], kind, span),
            Expression::ImageSample { .. } | Expression::ImageLoad { .. } | Expression::ImageQuery { .. } => {
                let advice = "audit the texture's own file as a table";
                Err(self.source.unsupported(span, "a texture", advice))
            }
            Expression::Derivative { .. } => {
                let advice = "a formula depends on its arguments alone";
                Err(self.source.unsupported(span, "a derivative between pixels", advice))
            }
            _ => Err(self.source.unsupported(span, "this expression", ONLY)),
        }
    }

    /// The error that a value is of another type than is needed, or was never set.
    pub fn mismatch(&self, span: Span, value: &Value) -> ForeignError {
        match value {
            Value::Unset => self.source.unsupported(
                span,
                "a variable that is not set on every path, or set to integers that depend on the inputs",
                "set it before it is read",
            ),
            _ => self.source.unsupported(span, "an expression of these types", ONLY),
        }
    }

    fn literal(&mut self, literal: Literal, span: Span) -> Result<Value, ForeignError> {
        Ok(match literal {
            Literal::F32(x) => Value::Number(self.maker.literal(x)),
            Literal::AbstractFloat(x) => Value::Number(self.maker.literal(x as f32)),
            Literal::Bool(x) => Value::Truth(self.maker.truth(x)),
            Literal::I32(x) => Value::Integer(x.into()),
            Literal::U32(x) => Value::Integer(x.into()),
            Literal::AbstractInt(x) => Value::Integer(x),
            _ => return Err(self.source.unsupported(span, "a number that is not f32", "write it as f32")),
        })
    }

    fn global(&mut self, handle: Handle<naga::GlobalVariable>, span: Span) -> Result<Value, ForeignError> {
        let variable = &self.module.global_variables[handle];
        if let Some(slot) = self.globals[handle.index()] {
            return Ok(Self::pointer(slot));
        }
        let name = variable.name.clone().unwrap_or_default();
        let what = format!("the global variable {name}");
        Err(self.source.unsupported(span, what, "make it an argument of the function, or a constant"))
    }

    /// Gives the private variables with initial values their slots.
    pub fn globals(&mut self) -> Result<(), ForeignError> {
        for (handle, variable) in self.module.global_variables.iter() {
            if let (naga::AddressSpace::Private, Some(init)) = (variable.space, variable.init) {
                let value = self.global_expression(init)?;
                self.globals[handle.index()] = Some(self.memory.len());
                self.memory.push(value);
            }
        }
        Ok(())
    }

    fn load(
        &mut self,
        frame: &mut Frame<'a>,
        pointer: Handle<Expression>,
        span: Span,
    ) -> Result<Value, ForeignError> {
        let value = match self.value(frame, pointer)? {
            Value::Pointer(pointer) => pointer.of(&mut self.memory).cloned(),
            other => return Err(self.mismatch(span, &other)),
        };
        value.ok_or_else(|| self.mismatch(span, &Value::Unset))
    }

    fn entry(&self, base: &Value, index: i64, span: Span) -> Result<Value, ForeignError> {
        let outside =
            || self.source.unsupported(span, format!("index {index}, beyond the end,"), "check the index");
        let index = usize::try_from(index).map_err(|_| outside())?;
        match base {
            Value::List(list) => list.get(index).cloned().ok_or_else(outside),
            Value::Pointer(pointer) => Ok(Value::Pointer(pointer.entry(index))),
            other => Err(self.mismatch(span, other)),
        }
    }

    /// The zero of a type.
    pub fn zero(&mut self, ty: Handle<Type>, span: Span) -> Result<Value, ForeignError> {
        let number = Value::Number(self.maker.literal(0.0));
        let truth = Value::Truth(self.maker.truth(false));
        self.filled(ty, span, &move |scalar| match scalar.kind {
            ScalarKind::Float => number.clone(),
            ScalarKind::Bool => truth.clone(),
            _ => Value::Integer(0),
        })
    }

    /// What a variable without an initial value holds: zeros in WGSL, nothing in GLSL.
    pub fn unwritten(&mut self, ty: Handle<Type>, span: Span) -> Result<Value, ForeignError> {
        match self.source.language {
            ShaderLanguage::Wgsl => self.zero(ty, span),
            ShaderLanguage::Glsl => self.unset(ty, span),
        }
    }

    /// A value of a type that nothing has been written to.
    pub fn unset(&self, ty: Handle<Type>, span: Span) -> Result<Value, ForeignError> {
        self.filled(ty, span, &|_| Value::Unset)
    }

    /// A value of a type, its scalars made by `fill`.
    fn filled(
        &self,
        ty: Handle<Type>,
        span: Span,
        fill: &dyn Fn(Scalar) -> Value,
    ) -> Result<Value, ForeignError> {
        let vector = |size: naga::VectorSize, scalar| Value::List(vec![fill(scalar); size as usize]);
        Ok(match &self.module.types[ty].inner {
            TypeInner::Scalar(scalar) => fill(*scalar),
            TypeInner::Vector { size, scalar } => vector(*size, *scalar),
            TypeInner::Matrix { columns, rows, scalar } => {
                Value::List(vec![vector(*rows, *scalar); *columns as usize])
            }
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                let count = count.get() as usize;
                let all = count.saturating_mul(self.entries(*base));
                if all > limits::OPERATIONS {
                    return Err(self.source.too_large("entries of an array", all, limits::OPERATIONS));
                }
                Value::List(vec![self.filled(*base, span, fill)?; count])
            }
            TypeInner::Struct { members, .. } => {
                let all = self.entries(ty);
                if all > limits::OPERATIONS {
                    return Err(self.source.too_large("entries of a structure", all, limits::OPERATIONS));
                }
                let fields: Result<Vec<Value>, ForeignError> =
                    members.iter().map(|m| self.filled(m.ty, span, fill)).collect();
                Value::List(fields?)
            }
            _ => return Err(self.source.unsupported(span, "a variable of this type", ONLY)),
        })
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

    /// A vector from scalars and vectors; anything else from its entries.
    fn compose(&mut self, ty: Handle<Type>, parts: Vec<Value>, span: Span) -> Result<Value, ForeignError> {
        let TypeInner::Vector { size, .. } = self.module.types[ty].inner else {
            return Ok(Value::List(parts));
        };
        let mut flat = Vec::new();
        for part in parts {
            match part {
                Value::List(list) => flat.extend(list),
                other => flat.push(other),
            }
        }
        if flat.len() == size as usize {
            Ok(Value::List(flat))
        } else {
            Err(self.mismatch(span, &Value::List(flat)))
        }
    }

    fn swizzle(
        &self,
        vector: &Value,
        pattern: &[SwizzleComponent],
        span: Span,
    ) -> Result<Value, ForeignError> {
        let entries = pattern.iter().map(|component| self.entry(vector, *component as i64, span));
        Ok(Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?))
    }

    /// accept or reject, entry by entry where the condition is a vector.
    fn choose(
        &mut self,
        condition: &Value,
        accept: &Value,
        reject: &Value,
        span: Span,
    ) -> Result<Value, ForeignError> {
        match (condition, accept, reject) {
            (Value::Truth(c), a, b) => Ok(self.maker.merge(*c, a, b)),
            (Value::List(c), Value::List(a), Value::List(b)) if c.len() == a.len() && a.len() == b.len() => {
                let entries = c.iter().zip(a).zip(b).map(|((c, a), b)| self.choose(c, a, b, span));
                Ok(Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?))
            }
            (other, ..) => Err(self.mismatch(span, other)),
        }
    }

    fn convert(&mut self, value: &Value, kind: ScalarKind, span: Span) -> Result<Value, ForeignError> {
        use ScalarKind::{Bool, Float, Sint, Uint};
        Ok(match (value, kind) {
            (Value::List(list), _) => {
                let entries = list.iter().map(|entry| self.convert(entry, kind, span));
                Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?)
            }
            (Value::Number(_), Float) | (Value::Truth(_), Bool) | (Value::Integer(_), Sint | Uint) => {
                value.clone()
            }
            (Value::Integer(x), Float) => Value::Number(self.maker.literal(*x as f32)),
            (Value::Integer(x), Bool) => Value::Truth(self.maker.truth(*x != 0)),
            (Value::Truth(node), Float) => Value::Number(*node),
            (Value::Number(node), Sint | Uint) => match self.maker.tape.constant(*node) {
                // Towards zero, as both languages say; in range, or the languages do not say.
                Some(x) if x.abs() < 2147483648.0 && (kind == Sint || x >= 0.0) => Value::Integer(x as i64),
                _ => {
                    let what = "an integer that depends on the inputs";
                    return Err(self.source.unsupported(span, what, "use floor, and no indices"));
                }
            },
            (other, _) => return Err(self.mismatch(span, other)),
        })
    }
}
