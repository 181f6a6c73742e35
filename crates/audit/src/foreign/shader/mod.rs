//! Shader functions that are run: their scalars of the result, over the scalars of the arguments.
//!
//! naga's front ends parse and check WGSL and GLSL; its intermediate form is run point by point in
//! f32, operations in the order written, none fused; a variable of GLSL that is read before it is
//! set is an error.
//!
//! This is not the lowering of `lobefit_shade`, which keeps a text's statements so that they can be
//! printed in six languages, and refuses what cannot be: integers and their loops, matrices,
//! structures, vectors that change, pointers and `out` arguments. Functions of other people use all
//! of these, and are only evaluated.

mod alone;
mod cut;
mod items;
mod operator;
mod run;
mod source;
mod value;

use std::sync::Arc;

use naga::{Function, Handle, Module, ScalarKind, Span, Type, TypeInner};
use rayon::prelude::*;

use super::ForeignError;
use run::Run;
use source::Source;
use value::Value;

/// Points that are run before errors are looked at.
const TASK: usize = 1024;

/// The language of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ShaderLanguage {
    /// WebGPU's.
    Wgsl,
    /// OpenGL's and Vulkan's.
    Glsl,
}

/// A function of a shader file.
#[derive(Clone, Debug)]
pub struct ShaderFunction {
    /// Its name.
    pub name: String,
    /// Scalars of its arguments, in order: `roughness`, and `f0.x f0.y f0.z` for a vector f0.
    pub inputs: Vec<String>,
    /// Scalars of its result, in order: an empty name for a single number, else `x y`, members of a
    /// structure, `out` arguments.
    pub results: Vec<String>,
    /// Functions of its file that were left out before it was read, by name: in GLSL those that
    /// read textures or that the front end cannot read, and what depends on them.
    pub left_out: Vec<String>,
    program: Arc<Program>,
    handle: Handle<Function>,
}

/// A file that was read.
#[derive(Debug)]
struct Program {
    source: Source,
    module: Module,
}

/// Stack of threads that parse and run: both recurse over nested blocks.
const STACK: usize = 64 << 20;

/// The functions of a shader file: the one that is asked for (each overload of it), or all that can
/// be read. The language follows from the extension, else from the text. GLSL may be a bare include:
/// it needs neither `#version` nor `main`; directives that name other files are left out, and so are
/// functions that read textures or that the front end cannot read, unless the
/// one asked for needs them; `saturate` is known.
///
/// # Errors
/// Each names the file, line and column, and what to do: what is no WGSL or GLSL; a function that
/// is not there, or uses textures, uniforms or whatever else is not run, on the way that all
/// arguments of 1/2 take; where no function is asked for, only if none can be read, the first one's
/// reason.
pub fn read_functions(
    bytes: &[u8],
    file: &str,
    entry: Option<&str>,
) -> Result<Vec<ShaderFunction>, ForeignError> {
    let source = Source::new(bytes, file)?;
    let lost = |message: String| ForeignError::new(file, message);
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let handle = thread.spawn_scoped(scope, || read(source, entry));
        let handle = handle.map_err(|e| lost(format!("no thread to parse it on: {e}")))?;
        handle.join().map_err(|_| lost("the front end gave up on this source".into()))?
    })
}

fn read(source: Source, entry: Option<&str>) -> Result<Vec<ShaderFunction>, ForeignError> {
    let (module, left_out) = source.parse(entry)?;
    let program = Arc::new(Program { source, module });
    let Program { source, module } = &*program;
    let name = |function: &Function| function.name.clone().unwrap_or_default();
    let plain = || module.functions.iter().filter(|(_, f)| f.name.as_deref() != Some("main"));
    if let Some(entry) = entry {
        let asked: Vec<Handle<Function>> =
            module.functions.iter().filter(|(_, f)| name(f) == entry).map(|(handle, _)| handle).collect();
        if asked.is_empty() {
            let known: Vec<String> = plain().map(|(_, f)| name(f)).collect();
            return Err(ForeignError::no_such(&source.file, "function", entry, &known));
        }
        return asked.into_iter().map(|handle| one(&program, handle, &left_out)).collect();
    }
    let (mut found, mut first) = (Vec::new(), None);
    for (handle, _) in plain() {
        match one(&program, handle, &left_out) {
            Ok(function) => found.push(function),
            Err(error) => first = first.or(Some(error)),
        }
    }
    match first {
        _ if !found.is_empty() => Ok(found),
        Some(error) => Err(error),
        None => {
            let message = "no function in it but entry points: write the formula as a function of its own";
            Err(ForeignError::new(&source.file, message))
        }
    }
}

/// Most inputs of a function.
const INPUTS: usize = 64;

fn one(
    program: &Arc<Program>,
    handle: Handle<Function>,
    left_out: &[String],
) -> Result<ShaderFunction, ForeignError> {
    let Program { source, module } = &**program;
    let (function, span) = (&module.functions[handle], module.functions.get_span(handle));
    let name = function.name.clone().unwrap_or_default();
    let (mut inputs, mut results, mut outs) = (Vec::new(), Vec::new(), Vec::new());
    if let Some(result) = &function.result {
        program.scalars(result.ty, "", &mut results, span)?;
    }
    for argument in &function.arguments {
        let name = argument.name.as_deref().unwrap_or_default();
        match written(module, argument.ty) {
            Some(base) => program.scalars(base, name, &mut outs, span)?,
            None => program.scalars(argument.ty, name, &mut inputs, span)?,
        }
    }
    results.append(&mut outs);
    if inputs.len() > INPUTS {
        return Err(source.too_large("scalar arguments", inputs.len(), INPUTS));
    }
    if results.is_empty() {
        let advice = "a formula returns a number, a vector or a structure of them";
        return Err(source.unsupported(span, format!("the function {name}, which returns nothing,"), advice));
    }
    let (left_out, program) = (left_out.to_vec(), Arc::clone(program));
    let function = ShaderFunction { name, inputs, results, left_out, program, handle };
    // What is not run is known now, where it is on the way.
    function.at(&vec![0.5; function.inputs.len()])?;
    Ok(function)
}

/// What an argument points to that the function writes.
fn written(module: &Module, ty: Handle<Type>) -> Option<Handle<Type>> {
    if let TypeInner::Pointer { base, .. } = module.types[ty].inner { Some(base) } else { None }
}

impl Program {
    /// Names of the scalars of a type, depth first.
    fn scalars(
        &self,
        ty: Handle<Type>,
        name: &str,
        names: &mut Vec<String>,
        span: Span,
    ) -> Result<(), ForeignError> {
        let number = |scalar: &naga::Scalar| scalar.kind == ScalarKind::Float && scalar.width == 4;
        let join = |part: &str| if name.is_empty() { part.to_string() } else { format!("{name}.{part}") };
        match &self.module.types[ty].inner {
            TypeInner::Scalar(scalar) if number(scalar) => names.push(name.to_string()),
            TypeInner::Vector { size, scalar } if number(scalar) => {
                names.extend(["x", "y", "z", "w"].into_iter().take(*size as usize).map(join));
            }
            TypeInner::Struct { members, .. } => {
                for member in members {
                    let part = member.name.as_deref().unwrap_or_default();
                    self.scalars(member.ty, &join(part), names, span)?;
                }
            }
            _ => {
                let what = "an argument or result of this type";
                let advice = "use f32, vectors of f32 and structures of them";
                return Err(self.source.unsupported(span, what, advice));
            }
        }
        Ok(())
    }
}

impl ShaderFunction {
    /// Its results at one point, as many as [`Self::results`]; NaN where a branch depends on what is
    /// not a number, as an input that is not given.
    ///
    /// # Errors
    /// What cannot be run, with its place.
    pub fn at(&self, inputs: &[f32]) -> Result<Vec<f32>, ForeignError> {
        let Program { source, module } = &*self.program;
        let (function, span) = (&module.functions[self.handle], module.functions.get_span(self.handle));
        let mut run = Run::new(module, source)?;
        let first = run.memory.len();
        let mut given = inputs.iter();
        let mut arguments = Vec::new();
        for argument in &function.arguments {
            arguments.push(match written(module, argument.ty) {
                Some(base) => {
                    let value = run.filled(base, span, &mut |_| Value::Unset)?;
                    run.memory.push(value);
                    Run::pointer(run.memory.len() - 1)
                }
                None => {
                    let mut next = |_| Value::Number(given.next().copied().unwrap_or(f32::NAN));
                    run.filled(argument.ty, span, &mut next)?
                }
            });
        }
        let value = run.call(self.handle, arguments)?;
        let mut results = Vec::new();
        for value in std::iter::once(&value).chain(&run.memory[first..]) {
            results.extend(value.numbers().ok_or_else(|| run.mismatch(span, std::slice::from_ref(value)))?);
        }
        if run.undefined {
            results.fill(f32::NAN);
        }
        Ok(results)
    }

    /// Its results at columns of points, one column for each input, equally long; a column for each
    /// result.
    ///
    /// # Errors
    /// As of [`Self::at`].
    pub fn evaluate(&self, columns: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, ForeignError> {
        let points = columns.first().map_or(1, Vec::len);
        let one = |i: usize| self.at(&columns.iter().map(|column| column[i]).collect::<Vec<f32>>());
        let threads =
            rayon::ThreadPoolBuilder::new().stack_size(STACK).num_threads(rayon::current_num_threads());
        let pool = threads.build().ok();
        let mut rows = Vec::with_capacity(points);
        for start in (0..points).step_by(TASK) {
            let task = || (start..points.min(start + TASK)).into_par_iter().map(one).collect::<Vec<_>>();
            // The first error of all, whatever the number of threads.
            for row in pool.as_ref().map_or_else(task, |pool| pool.install(task)) {
                rows.push(row?);
            }
        }
        Ok((0..self.results.len()).map(|k| rows.iter().map(|row| row[k]).collect()).collect())
    }
}
