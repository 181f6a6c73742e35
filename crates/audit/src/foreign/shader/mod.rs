//! Shader functions as tapes: one per scalar of the result, over the scalars of the arguments.
//!
//! naga's front ends parse and check WGSL and GLSL; its intermediate form is walked symbolically.
//! Literals are f32, as in shaders; operations are made in the order written, none fused; a
//! variable of GLSL that is read before it is set is an error.
//!
//! This is not the lowering of `lobefit_shade`, which keeps a text's statements so that they can be
//! printed in six languages, and refuses what cannot be: integers and their loops, matrices,
//! structures, vectors that change, pointers and `out` arguments. Functions of other people use all
//! of these, and are only evaluated.

mod arithmetic;
mod cut;
mod expression;
mod items;
mod math;
mod signature;
mod source;
mod value;
mod walk;

use naga::{Function, Handle, Module};

use super::{ForeignError, Spot};
use lobefit_shade::Tape;
use source::Source;
use walk::Walk;

/// The language of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderLanguage {
    /// WebGPU's.
    Wgsl,
    /// OpenGL's and Vulkan's.
    Glsl,
}

/// A function of a shader file.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderFunction {
    /// File as the caller named it.
    pub file: String,
    /// Its name.
    pub name: String,
    /// Scalars of its arguments, in order: `roughness`, and `f0.x f0.y f0.z` for a vector f0.
    pub inputs: Vec<String>,
    /// Scalars of its result, in order: nothing for a single number, else `x y`, members of a
    /// structure, `out` arguments.
    pub results: Vec<String>,
    /// One tape per scalar of the result, in order; each takes all inputs and no parameters.
    pub components: Vec<Tape>,
    /// Where it begins.
    pub at: Spot,
    /// Functions of its file that were left out before it was read, by name: in GLSL those that
    /// read textures or that the front end cannot read, and what depends on them.
    pub left_out: Vec<String>,
}

/// Stack of the thread that parses and walks: both recurse over nested expressions.
const STACK: usize = 64 << 20;

/// The functions of a shader file: the one that is asked for (each overload of it), or all that can
/// be read. Unless stated, the language follows from the extension, else from the text. GLSL may
/// be a bare include: it needs neither `#version` nor `main`; directives that name other files are
/// left out, and so are functions that read textures or that the front end cannot read, unless the
/// one asked for needs them; `saturate` is known.
///
/// # Errors
/// Each names the file, line and column, and what to do: what is no WGSL or GLSL; a function that
/// is not there, or uses textures, uniforms, loops or indices that depend on inputs, or whatever
/// else [`Tape`] cannot hold; where no function is asked for, only if none can be read, the first
/// one's reason.
pub fn read_functions(
    bytes: &[u8],
    file: &str,
    language: Option<ShaderLanguage>,
    entry: Option<&str>,
) -> Result<Vec<ShaderFunction>, ForeignError> {
    let source = Source::new(bytes, file, language)?;
    let lost = |message: String| ForeignError::Malformed {
        file: file.into(),
        at: Spot::Line { line: 1, column: 1 },
        message,
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let handle = thread.spawn_scoped(scope, || read(&source, entry));
        let handle = handle.map_err(|e| lost(format!("no thread to parse it on: {e}")))?;
        handle.join().map_err(|_| lost("the front end gave up on this source".into()))?
    })
}

fn read(source: &Source, entry: Option<&str>) -> Result<Vec<ShaderFunction>, ForeignError> {
    let (module, left_out) = source.parse(entry)?;
    let name = |function: &Function| function.name.clone().unwrap_or_default();
    let plain = || module.functions.iter().filter(|(_, f)| f.name.as_deref() != Some("main"));
    if let Some(entry) = entry {
        let asked: Vec<Handle<Function>> =
            module.functions.iter().filter(|(_, f)| name(f) == entry).map(|(handle, _)| handle).collect();
        if asked.is_empty() {
            let known = plain().map(|(_, f)| name(f)).collect();
            let (file, name) = (source.file.clone(), entry.to_string());
            return Err(ForeignError::NoSuch { file, what: "function", name, known });
        }
        return asked.into_iter().map(|handle| one(source, &module, handle, &left_out)).collect();
    }
    let (mut found, mut first) = (Vec::new(), None);
    for (handle, _) in plain() {
        match one(source, &module, handle, &left_out) {
            Ok(function) => found.push(function),
            Err(error) => first = first.or(Some(error)),
        }
    }
    match first {
        _ if !found.is_empty() => Ok(found),
        Some(error) => Err(error),
        None => {
            let message =
                "no function in it but entry points: write the formula as a function of its own".into();
            Err(ForeignError::Nothing { file: source.file.clone(), message })
        }
    }
}

fn one(
    source: &Source,
    module: &Module,
    handle: Handle<Function>,
    left_out: &[String],
) -> Result<ShaderFunction, ForeignError> {
    let function = &module.functions[handle];
    let span = module.functions.get_span(handle);
    let name = function.name.clone().unwrap_or_default();
    let mut walk = Walk::new(module, source);
    walk.globals()?;
    let signature = walk.arguments(function, span)?;
    let value = walk.call(handle, signature.values.clone())?;
    let results = walk.results(function, &signature, value, span)?;
    let place = |span| source.place(span);
    let tapes = results.iter().map(|(_, node)| walk.maker.tape.tape(*node, &name, &signature.inputs, place));
    Ok(ShaderFunction {
        file: source.file.clone(),
        components: tapes.collect(),
        results: match &results[..] {
            [(single, _)] if single.is_empty() => Vec::new(),
            several => several.iter().map(|(name, _)| name.clone()).collect(),
        },
        inputs: signature.inputs,
        name,
        at: source.spot(span),
        left_out: left_out.to_vec(),
    })
}
