//! The arguments and results of a shader function as scalars with names.

use naga::{Function, Handle, ScalarKind, Span, Type, TypeInner, VectorSize};

use super::value::Value;
use super::walk::Walk;
use crate::foreign::ForeignError;
use lobefit_shade::{Node, Op};

/// The arguments of a function.
pub(super) struct Signature {
    /// Names of the scalars that go in.
    pub inputs: Vec<String>,
    /// Values of the arguments: inputs, and pointers to variables.
    pub values: Vec<Value>,
    /// Slots of the variables that come out, with the arguments' names and types.
    outs: Vec<(usize, String, Handle<Type>)>,
}

/// Most inputs of a function.
const INPUTS: usize = 64;

impl<'a> Walk<'a> {
    /// Inputs for every scalar argument; variables, nothing written to them, for those that the
    /// function writes.
    pub fn arguments(&mut self, function: &'a Function, span: Span) -> Result<Signature, ForeignError> {
        let mut signature = Signature { inputs: Vec::new(), values: Vec::new(), outs: Vec::new() };
        for argument in &function.arguments {
            let name = argument.name.clone().unwrap_or_default();
            if let TypeInner::Pointer { base, .. } = self.module.types[argument.ty].inner {
                let slot = self.memory.len();
                let value = self.unset(base, span)?;
                self.memory.push(value);
                signature.values.push(Self::pointer(slot));
                signature.outs.push((slot, name, base));
            } else {
                let value = self.input(argument.ty, &name, &mut signature.inputs, span)?;
                signature.values.push(value);
            }
        }
        if signature.inputs.len() > INPUTS {
            return Err(self.source.too_large("scalar arguments", signature.inputs.len(), INPUTS));
        }
        Ok(signature)
    }

    /// Inputs for the scalars of a type.
    fn input(
        &mut self,
        ty: Handle<Type>,
        name: &str,
        inputs: &mut Vec<String>,
        span: Span,
    ) -> Result<Value, ForeignError> {
        match self.parts(ty, span)? {
            Parts::Number => {
                inputs.push(name.to_string());
                Ok(Value::Number(self.maker.push(Op::Input((inputs.len() - 1) as u16))))
            }
            Parts::Several(parts) => {
                let entries =
                    parts.into_iter().map(|(part, ty)| self.input(ty, &join(name, &part), inputs, span));
                Ok(Value::List(entries.collect::<Result<Vec<Value>, ForeignError>>()?))
            }
            Parts::Vector(size) => {
                let names = ["x", "y", "z", "w"].iter().take(size as usize);
                let mut entry = |part: &&str| {
                    inputs.push(join(name, part));
                    Value::Number(self.maker.push(Op::Input((inputs.len() - 1) as u16)))
                };
                Ok(Value::List(names.map(&mut entry).collect()))
            }
        }
    }

    /// The scalars of a result with their names: of the value returned, then of what was written to
    /// arguments.
    pub fn results(
        &mut self,
        function: &'a Function,
        signature: &Signature,
        value: Value,
        span: Span,
    ) -> Result<Vec<(String, Node)>, ForeignError> {
        let mut results = Vec::new();
        if let Some(result) = &function.result {
            self.result(result.ty, "", &value, &mut results, span)?;
        }
        for (slot, name, ty) in &signature.outs {
            let value = self.memory[*slot].clone();
            self.result(*ty, name, &value, &mut results, span)?;
        }
        if results.is_empty() {
            let name = function.name.clone().unwrap_or_default();
            let advice = "a formula returns a number, a vector or a structure of them";
            return Err(self.source.unsupported(
                span,
                format!("the function {name}, which returns nothing,"),
                advice,
            ));
        }
        Ok(results)
    }

    fn result(
        &self,
        ty: Handle<Type>,
        name: &str,
        value: &Value,
        results: &mut Vec<(String, Node)>,
        span: Span,
    ) -> Result<(), ForeignError> {
        match (self.parts(ty, span)?, value) {
            (Parts::Number, Value::Number(node)) => results.push((name.to_string(), *node)),
            (Parts::Several(parts), Value::List(entries)) => {
                for ((part, ty), entry) in parts.into_iter().zip(entries) {
                    self.result(ty, &join(name, &part), entry, results, span)?;
                }
            }
            (Parts::Vector(_), Value::List(entries)) => {
                for (part, entry) in ["x", "y", "z", "w"].iter().zip(entries) {
                    let Value::Number(node) = entry else { return Err(self.mismatch(span, entry)) };
                    results.push((join(name, part), *node));
                }
            }
            (_, other) => return Err(self.mismatch(span, other)),
        }
        Ok(())
    }

    fn parts(&self, ty: Handle<Type>, span: Span) -> Result<Parts, ForeignError> {
        let number = |scalar: naga::Scalar| scalar.kind == ScalarKind::Float && scalar.width == 4;
        match &self.module.types[ty].inner {
            TypeInner::Scalar(scalar) if number(*scalar) => Ok(Parts::Number),
            TypeInner::Vector { size, scalar } if number(*scalar) => Ok(Parts::Vector(*size)),
            TypeInner::Struct { members, .. } => {
                let part = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.ty);
                Ok(Parts::Several(members.iter().map(part).collect()))
            }
            _ => {
                let what = "an argument or result of this type";
                Err(self.source.unsupported(span, what, "use f32, vectors of f32 and structures of them"))
            }
        }
    }
}

/// What a type consists of.
enum Parts {
    Number,
    Vector(VectorSize),
    Several(Vec<(String, Handle<Type>)>),
}

fn join(name: &str, part: &str) -> String {
    if name.is_empty() { part.to_string() } else { format!("{name}.{part}") }
}
