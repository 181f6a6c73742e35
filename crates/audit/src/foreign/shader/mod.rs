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
mod eager;
mod hlsl;
mod items;
mod library;
mod needed;
mod operator;
mod preprocess;
mod rewrite;
mod run;
mod source;
mod text;
mod value;

use std::sync::Arc;

use naga::{Handle, Module, Scalar, ScalarKind, Span, Type, TypeInner};
use rayon::prelude::*;

use super::{ForeignError, limits};
pub use preprocess::Surroundings;
use run::Run;
use source::{Program, Source};
use value::Value;

/// Points at which a scalar is tried that may make no difference.
const IDLE: usize = 16;

/// Points that are run before errors are looked at.
const TASK: usize = 1024;

/// The language of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ShaderLanguage {
    /// WebGPU's.
    Wgsl,
    /// OpenGL's and Vulkan's.
    Glsl,
    /// Direct3D's, and what Slang shares with it.
    Hlsl,
}

/// A function of a shader file.
#[derive(Clone, Debug)]
pub struct ShaderFunction {
    /// Its name.
    pub name: String,
    /// Its name with the types of its arguments, which tells overloads apart.
    pub signature: String,
    /// Scalars of its arguments, in order: `roughness`, and `f0.x f0.y f0.z` for a vector f0.
    pub inputs: Vec<String>,
    /// Which of them are whole numbers or truth values.
    pub whole: Vec<bool>,
    /// Scalars of its result, in order: an empty name for a single number, else `x y`, members of a
    /// structure, `out` arguments; but for whole numbers and truth values.
    pub results: Vec<String>,
    /// Functions of its file, or overloads, that were asked for with it and cannot be read: of the first.
    pub left_out: Vec<LeftOut>,
    program: Arc<Program>,
    /// Of all scalars of its result whether they are numbers of a formula.
    counted: Vec<bool>,
}

/// A function that is left aside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its name, of an overload with the types of its arguments.
    pub name: String,
    /// Why, in a clause, with its line.
    pub reason: String,
}

impl LeftOut {
    /// By the message of its error, of which advice stands behind the first clause.
    pub fn new(name: impl Into<String>, why: &str) -> LeftOut {
        let clause = why.split(": ").next().unwrap_or_default().split("; ").next().unwrap_or_default();
        LeftOut { name: name.into(), reason: clause.into() }
    }

    fn unread(name: String, why: &ForeignError) -> LeftOut {
        let LeftOut { name, reason } = LeftOut::new(name, &why.message);
        match why.place.trim_start_matches([':', ' ']) {
            "" => LeftOut { name, reason },
            place => LeftOut { name, reason: format!("{place}: {reason}") },
        }
    }
}

/// Stack of threads that parse and run: both recurse over nested blocks.
const STACK: usize = 64 << 20;

/// The functions of a shader file: the one that is asked for (each overload of it; `name(float,
/// vec3)` names one), or all of the file itself that can be read. A function is read with what it
/// calls and names, and nothing else of the file. The language follows from the extension, else
/// from the text; templates of a script are the shader in it. GLSL may be a bare include: it needs
/// neither `#version` nor `main`, and `saturate` is known.
///
/// # Errors
/// Each names the file, line and column, and what to do: what is no WGSL, GLSL or HLSL; a function that
/// is not there, or uses textures, uniforms or whatever else is not run, on the way that all
/// arguments of 1/2 take; where no function is asked for, only if none can be read, the first one's
/// reason.
pub fn read_functions(
    bytes: &[u8],
    file: &str,
    entry: Option<&str>,
    around: &Surroundings,
) -> Result<Vec<ShaderFunction>, ForeignError> {
    let lost = |message: String| ForeignError::new(file, message);
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let read = || read(&Source::new(bytes, file, around)?, entry);
        let handle = thread.spawn_scoped(scope, read);
        let handle = handle.map_err(|e| lost(format!("no thread to parse it on: {e}")))?;
        handle.join().map_err(|_| lost("the front end gave up on this source".into()))?
    })
}

/// Whether a shader file has functions of its own but entry points; so has one that cannot be read, unless it
/// is larger than a shader may be.
pub fn holds_functions(bytes: &[u8], file: &str, around: &Surroundings) -> bool {
    if bytes.len() > limits::SHADER {
        return false;
    }
    std::thread::scope(|scope| {
        let found =
            || Source::new(bytes, file, around).map_or(true, |source| !source.functions(None).is_empty());
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, found);
        thread.ok().and_then(|thread| thread.join().ok()).unwrap_or(true)
    })
}

fn read(source: &Source, entry: Option<&str>) -> Result<Vec<ShaderFunction>, ForeignError> {
    if let Some(entry) = entry {
        let (name, types) = entry.split_once('(').map_or((entry, None), |(name, types)| (name, Some(types)));
        let all = source.functions(Some(name.trim()));
        let wanted = |types: &str| -> Vec<String> {
            let list = types.trim_end().trim_end_matches(')').split(',');
            list.map(|t| t.trim().to_string()).filter(|t| !t.is_empty()).collect()
        };
        let meant = |i: &usize| types.is_none_or(|types| source.item(*i).types() == wanted(types));
        let found: Vec<usize> = all.iter().copied().filter(meant).collect();
        if found.is_empty() {
            return Err(source.no_such(entry.trim(), name.trim(), &all));
        }
        // Of several overloads those that can be read are meant.
        let (found, refused) = parted(source, found, |i| source.item(i).signature());
        return if found.is_empty() { refused.map_or(Ok(found), Err) } else { Ok(found) };
    }
    let all = source.functions(None);
    if all.len() > limits::FUNCTIONS {
        let message = format!("{} functions, and the limit is {}: name one", all.len(), limits::FUNCTIONS);
        return Err(ForeignError::new(&source.file, message));
    }
    let (found, refused) = parted(source, all, |i| source.item(i).name().to_string());
    match refused {
        _ if !found.is_empty() => Ok(found),
        Some(error) => Err(error),
        None => Err(source.no_function()),
    }
}

/// Those of a source's functions that can be read, the first with the others, and why the first of these
/// cannot.
fn parted(
    source: &Source,
    all: Vec<usize>,
    named: impl Fn(usize) -> String,
) -> (Vec<ShaderFunction>, Option<ForeignError>) {
    let (mut found, mut first, mut left_out) = (Vec::new(), None, Vec::new());
    for i in all {
        match one(source, i) {
            Ok(function) => found.push(function),
            Err(error) => {
                left_out.push(LeftOut::unread(named(i), &error));
                first = first.or(Some(error));
            }
        }
    }
    left_out.dedup_by(|later, before| later.name == before.name);
    if let Some(one) = found.first_mut() {
        one.left_out = left_out;
    }
    (found, first)
}

/// Most inputs of a function.
const INPUTS: usize = 64;

fn one(source: &Source, item: usize) -> Result<ShaderFunction, ForeignError> {
    let program = source.program(item)?;
    let (function, span) = program.function();
    let (mut inputs, mut results, mut outs) = (Vec::new(), Vec::new(), Vec::new());
    if let Some(result) = &function.result {
        program.scalars(result.ty, "", &mut results, span)?;
    }
    for argument in &function.arguments {
        let name = argument.name.as_deref().unwrap_or_default();
        match written(&program.module, argument.ty) {
            Some(base) => program.scalars(base, name, &mut outs, span)?,
            None => program.scalars(argument.ty, name, &mut inputs, span)?,
        }
    }
    results.append(&mut outs);
    if inputs.len() > INPUTS {
        return Err(program.too_large("scalar arguments", inputs.len(), INPUTS));
    }
    let (name, signature) = (source.item(item).name().to_string(), source.item(item).signature());
    let advice = "a formula returns a number, a vector or a structure of them";
    if results.is_empty() {
        return Err(program.unsupported(
            span,
            format!("the function {name}, which returns nothing,"),
            advice,
        ));
    }
    if results.iter().all(|r| r.1) {
        return Err(program.unsupported(span, format!("a result of {name} that is no f32,"), advice));
    }
    let (inputs, whole) = inputs.into_iter().unzip();
    // A flag or an index beside numbers is none of them.
    let counted = results.iter().map(|r| !r.1).collect();
    let results = results.into_iter().filter(|r| !r.1).map(|r| r.0).collect();
    let (program, left_out) = (Arc::new(program), Vec::new());
    let function = ShaderFunction { name, signature, inputs, whole, results, left_out, program, counted };
    // What is not run is known now, where it is on the way.
    function.at(&vec![0.5; function.inputs.len()])?;
    Ok(function)
}

/// What an argument points to that the function writes.
fn written(module: &Module, ty: Handle<Type>) -> Option<Handle<Type>> {
    if let TypeInner::Pointer { base, .. } = module.types[ty].inner { Some(base) } else { None }
}

impl Program {
    /// Names of the scalars of a type, depth first, and whether each is a whole number or truth
    /// value.
    fn scalars(
        &self,
        ty: Handle<Type>,
        name: &str,
        names: &mut Vec<(String, bool)>,
        span: Span,
    ) -> Result<(), ForeignError> {
        let whole = |scalar: &Scalar| match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => Some(false),
            (ScalarKind::Sint | ScalarKind::Uint, 4) | (ScalarKind::Bool, _) => Some(true),
            _ => None,
        };
        let join = |part: &str| if name.is_empty() { part.to_string() } else { format!("{name}.{part}") };
        let known = match &self.module.types[ty].inner {
            TypeInner::Scalar(scalar) => whole(scalar).map(|whole| names.push((name.to_string(), whole))),
            TypeInner::Vector { size, scalar } => whole(scalar).map(|whole| {
                names.extend(
                    ["x", "y", "z", "w"].into_iter().take(*size as usize).map(|part| (join(part), whole)),
                );
            }),
            TypeInner::Struct { members, .. } => {
                for member in members {
                    let part = member.name.as_deref().unwrap_or_default();
                    self.scalars(member.ty, &join(part), names, span)?;
                }
                Some(())
            }
            _ => None,
        };
        let what = "an argument or result of this type";
        known.ok_or_else(|| self.unsupported(span, what, "use f32, vectors of f32 and structures of them"))
    }
}

impl ShaderFunction {
    /// Its results at one point, as many as [`Self::results`]; NaN where a branch depends on what is
    /// not a number, as an input that is not given.
    ///
    /// # Errors
    /// What cannot be run, with its place.
    pub fn at(&self, inputs: &[f32]) -> Result<Vec<f32>, ForeignError> {
        self.run(inputs).map(|(results, _)| results)
    }

    /// Statements and expressions that are run for a point, loops unrolled.
    ///
    /// # Errors
    /// As of [`Self::at`].
    pub fn steps(&self, inputs: &[f32]) -> Result<usize, ForeignError> {
        self.run(inputs).map(|(_, steps)| steps)
    }

    fn run(&self, inputs: &[f32]) -> Result<(Vec<f32>, usize), ForeignError> {
        let (function, span) = self.program.function();
        let mut run = Run::new(&self.program)?;
        let first = run.memory.len();
        let mut given = inputs.iter();
        let mut arguments = Vec::new();
        for argument in &function.arguments {
            arguments.push(match written(&self.program.module, argument.ty) {
                Some(base) => {
                    let value = run.filled(base, span, &mut |_| Value::Unset)?;
                    run.memory.push(value);
                    Run::pointer(run.memory.len() - 1)
                }
                None => {
                    let mut next = |scalar: Scalar| {
                        let x = given.next().copied().unwrap_or(f32::NAN);
                        match scalar.kind {
                            ScalarKind::Float => Value::Number(x),
                            ScalarKind::Bool => Value::Truth(if x == 0.0 { 0.0 } else { 1.0 }),
                            _ => Value::Integer(x as i64),
                        }
                    };
                    run.filled(argument.ty, span, &mut next)?
                }
            });
        }
        let value = run.call(self.program.entry, arguments)?;
        let mut results = Vec::new();
        for value in std::iter::once(&value).chain(&run.memory[first..]) {
            results
                .extend(value.all_numbers().ok_or_else(|| run.mismatch(span, std::slice::from_ref(value)))?);
        }
        let mut counted = self.counted.iter();
        results.retain(|_| counted.next() == Some(&true));
        if run.undefined {
            results.fill(f32::NAN);
        }
        Ok((results, run.steps))
    }

    /// Whether its results do not depend on one of its scalars, by points of a lattice at which others
    /// have the values given, and it two of its own and those that are `tried`: what cannot be run there
    /// depends.
    pub fn is_idle(&self, input: usize, given: &[Option<f32>], tried: &[f32]) -> bool {
        // Multiples of the golden ratio, another for each scalar; whole numbers are 0, 1 and 2.
        let fraction = |k: usize, i: usize| (k as f64 * (i + 2) as f64 * 0.618_033_988_749).fract() as f32;
        let scaled = |i: usize, x: f32| if self.whole[i] { (3.0 * x).floor() } else { x };
        let point = |k: usize, half: f32| -> Vec<f32> {
            let free = |i: usize| if i == input { 0.5 * (half + fraction(k, i)) } else { fraction(k, i) };
            let of = |i: usize| given.get(i).copied().flatten().unwrap_or_else(|| scaled(i, free(i)));
            (0..self.inputs.len()).map(of).collect()
        };
        let bits = |at: &[f32]| Some(self.at(at).ok()?.into_iter().map(f32::to_bits).collect::<Vec<_>>());
        (1..=IDLE).all(|k| {
            let first = point(k, 0.0);
            let at = |x: &f32| {
                let mut other = first.clone();
                other[input] = *x;
                other
            };
            let found = bits(&first);
            found.is_some()
                && [point(k, 1.0)].into_iter().chain(tried.iter().map(at)).all(|at| bits(&at) == found)
        })
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
