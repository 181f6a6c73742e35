//! A shader function as WGSL, with what it needs and nothing else.

use naga::back::wgsl::{WriterFlags, write_string};
use naga::compact::{KeepUnused, compact};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{
    EntryPoint, Expression, Function, Handle, LocalVariable, Module, ShaderStage, Span, Statement, TypeInner,
};

use super::ShaderFunction;
use crate::foreign::ForeignError;

impl ShaderFunction {
    /// The function in WGSL, under another name: a module of it and of what it needs.
    ///
    /// # Errors
    /// What WGSL cannot say.
    pub fn wgsl(&self, name: &str) -> Result<String, ForeignError> {
        let mut module = self.program.module.clone();
        let function = &mut module.functions[self.program.entry];
        function.name = Some(name.into());
        // What no entry point calls is left out.
        module.entry_points = vec![entry(calling(&module, self.program.entry))];
        compact(&mut module, KeepUnused::No);
        module.entry_points.clear();
        let refused = |reason: String| {
            let span = self.program.module.functions.get_span(self.program.entry);
            self.program.unsupported(span, format!("a function that WGSL cannot say ({reason})"), ONLY)
        };
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator.validate(&module).map_err(|e| refused(e.as_inner().to_string()))?;
        write_string(&module, &info, WriterFlags::empty()).map_err(|e| refused(e.to_string()))
    }
}

const ONLY: &str = "write it in WGSL";

/// A function that calls another with zeros.
fn calling(module: &Module, handle: Handle<Function>) -> Function {
    let (mut caller, span) = (Function::default(), Span::UNDEFINED);
    let mut arguments = Vec::new();
    for argument in &module.functions[handle].arguments {
        let value = match module.types[argument.ty].inner {
            TypeInner::Pointer { base: ty, .. } => {
                let variable = LocalVariable { name: None, ty, init: None };
                Expression::LocalVariable(caller.local_variables.append(variable, span))
            }
            _ => Expression::ZeroValue(argument.ty),
        };
        arguments.push(caller.expressions.append(value, span));
    }
    let result = module.functions[handle].result.as_ref();
    let result = result.map(|_| caller.expressions.append(Expression::CallResult(handle), span));
    caller.body.push(Statement::Call { function: handle, arguments, result }, span);
    caller
}

fn entry(function: Function) -> EntryPoint {
    EntryPoint {
        name: "main".into(),
        stage: ShaderStage::Compute,
        early_depth_test: None,
        workgroup_size: [1; 3],
        workgroup_size_overrides: None,
        function,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    }
}
