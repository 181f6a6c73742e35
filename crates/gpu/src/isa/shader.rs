//! Shaders that call an emitted function once, and the same shaders without the call.

use std::fmt::Write;

use crate::GpuError;
use crate::shader::members;
use crate::variable::CORNERS;
use lobefit::timing::isa::Precision;
use naga::back::spv;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{ArraySize, ImageDimension, Scalar, TypeInner, VectorSize};

/// Invocations of a workgroup.
const WORKGROUP: usize = 64;

/// A call as text.
pub(super) struct Shader {
    /// With the call.
    pub with: String,
    /// Without it.
    pub without: String,
}

/// What a call takes, and how it is written.
struct Arguments {
    /// The type that stands for a number.
    number: &'static str,
    /// Numbers that each invocation loads.
    given: usize,
    /// Vectors that are the same for all invocations.
    held: usize,
    /// Declarations of what else it takes.
    resources: String,
    /// The arguments, in order.
    words: Vec<String>,
}

impl Shader {
    /// Of a function in a module, whose code and that of all that it calls is given; none in a
    /// precision that is not for functions of its type: packed ones are of numbers alone, and
    /// what a texture or a block of uniforms holds is f32.
    ///
    /// Every invocation loads the numbers that the function takes and stores them, and stores a
    /// result; without the call the result is those numbers again. Equal numbers of all invocations
    /// lie together, so that no two need neighbouring registers.
    pub fn of(
        code: &str,
        module: &naga::Module,
        function: &str,
        precision: Precision,
    ) -> Result<Option<Shader>, GpuError> {
        let wrong = |reason: String| GpuError::Bake { place: function.into(), reason };
        let found = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(function));
        let (_, found) = found.ok_or_else(|| wrong("not in the include file".into()))?;
        if precision != Precision::F32 && code.contains("u32") {
            return Ok(None);
        }
        let number = match precision {
            Precision::F32 => "f32",
            Precision::F16 => "f16",
            Precision::F16Packed => "vec2<f16>",
        };
        let mut arguments =
            Arguments { number, given: 0, held: 0, resources: String::new(), words: Vec::new() };
        let mut values =
            found.result.as_ref().map_or(Vec::new(), |result| members(module, result.ty, "isa_value"));
        let mut variables = String::new();
        for argument in &found.arguments {
            let name = argument.name.as_deref().unwrap_or_default();
            let unknown = || wrong(format!("the argument `{name}` is of a type that is not known"));
            match module.types[argument.ty].inner {
                // What it is to write there is a result.
                TypeInner::Pointer { base, .. } => {
                    let ty = written(&module.types[base].inner).ok_or_else(unknown)?;
                    let variable = format!("isa_out_{}", arguments.words.len());
                    let _ = writeln!(variables, "    var {variable}: {ty};");
                    values.extend(members(module, base, &variable));
                    arguments.words.push(format!("&{variable}"));
                }
                ref inner => arguments.add(name, inner).ok_or_else(unknown)?,
            }
        }
        if values.is_empty() {
            return Err(wrong("it returns nothing".into()));
        }
        let numbers = arguments.given == arguments.words.len() && !code.contains("vec");
        match precision {
            Precision::F16 if arguments.held > 0 || !arguments.resources.is_empty() => return Ok(None),
            Precision::F16Packed if !numbers => return Ok(None),
            _ => {}
        }
        arguments.given = arguments.given.max(1);
        let value = if found.result.is_some() { "let isa_value = " } else { "" };
        let call = format!("{variables}    {value}{function}({});\n", arguments.words.join(", "));
        let again: Vec<String> = (0..values.len()).map(|k| format!("isa_{}", k % arguments.given)).collect();
        let with = arguments.text(&in_precision(code, number), &call, &values);
        arguments.resources.clear();
        Ok(Some(Shader { with, without: arguments.text("", "", &again) }))
    }
}

/// A type that a function may write to, as text: numbers and vectors of them.
fn written(ty: &TypeInner) -> Option<String> {
    match *ty {
        TypeInner::Scalar(Scalar::F32) => Some("f32".into()),
        TypeInner::Vector { size, scalar: Scalar::F32 } => Some(format!("vec{}<f32>", size as usize)),
        _ => None,
    }
}

impl Arguments {
    /// Adds an argument by its name and type; none of a type that is not emitted.
    fn add(&mut self, name: &str, ty: &TypeInner) -> Option<()> {
        let number = self.number;
        let mut next = || {
            self.given += 1;
            format!("isa_{}", self.given - 1)
        };
        let word = match *ty {
            TypeInner::Scalar(Scalar::F32) => next(),
            // The bits of a number: no instruction.
            TypeInner::Scalar(Scalar::U32) => format!("bitcast<u32>({})", next()),
            TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::F32 } if CORNERS.contains(&name) => {
                self.held += 1;
                format!("isa_held[{}].xyz", self.held - 1)
            }
            TypeInner::Vector { size, scalar: Scalar::F32 } => {
                let all: Vec<String> = (0..size as usize).map(|_| next()).collect();
                format!("vec{}<{number}>({})", size as usize, all.join(", "))
            }
            TypeInner::Image { dim, .. } => {
                let dimensions = match dim {
                    ImageDimension::D2 => "2d",
                    ImageDimension::D3 => "3d",
                    ImageDimension::Cube => "cube",
                    ImageDimension::D1 => return None,
                };
                self.bind(3, &format!("var isa_texture: texture_{dimensions}<f32>"));
                "isa_texture".into()
            }
            TypeInner::Sampler { .. } => {
                self.bind(4, "var isa_sampler: sampler");
                "isa_sampler".into()
            }
            TypeInner::Array { size: ArraySize::Constant(n), .. } => {
                self.bind(6, &format!("var<uniform> isa_planes: array<vec4<{number}>, {n}>"));
                "isa_planes".into()
            }
            _ => return None,
        };
        self.words.push(word);
        Some(())
    }

    fn bind(&mut self, binding: usize, declared: &str) {
        let _ = writeln!(self.resources, "@group(0) @binding({binding}) {declared};");
    }

    /// The whole shader, with the code of the function, the line that calls it, and what it stores.
    fn text(&self, code: &str, call: &str, values: &[String]) -> String {
        let Arguments { number, given, resources, .. } = self;
        let enable = if *number == "f32" { "" } else { "enable f16;\n" };
        let mut held = String::new();
        if self.held > 0 && !call.is_empty() {
            let declared = format!("array<vec4<{number}>, {}>", self.held);
            let _ = writeln!(held, "@group(0) @binding(5) var<uniform> isa_held: {declared};");
        }
        let at = |k: usize| format!("isa_at + {}u", k * WORKGROUP);
        let loads = (0..*given).map(|k| format!("    let isa_{k} = isa_given[{}];\n", at(k)));
        let stores = (0..*given).map(|k| format!("    isa_kept[{}] = isa_{k};\n", at(k)));
        let results =
            values.iter().enumerate().map(|(k, value)| format!("    isa_result[{}] = {value};\n", at(k)));
        format!(
            "{enable}{code}
@group(0) @binding(0) var<storage, read> isa_given: array<{number}>;
@group(0) @binding(1) var<storage, read_write> isa_kept: array<{number}>;
@group(0) @binding(2) var<storage, read_write> isa_result: array<{number}>;
{resources}{held}
@compute @workgroup_size({WORKGROUP})
fn isa_main(@builtin(workgroup_id) isa_group: vec3<u32>, @builtin(local_invocation_index) isa_index: u32) {{
    let isa_at = isa_group.x * {}u + isa_index;
{}{}{call}{}}}
",
            // Where this is no power of two, Mesa's driver for Adreno fuses no products into additions.
            WORKGROUP * (*given).max(values.len()).next_power_of_two(),
            loads.collect::<String>(),
            stores.collect::<String>(),
            results.collect::<String>(),
        )
    }
}

/// A shader as SPIR-V.
///
/// # Errors
/// What the compiler of WGSL says.
pub(super) fn spirv(text: &str) -> Result<Vec<u32>, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::SHADER_FLOAT16);
    let info = validator.validate(&module).map_err(|e| e.emit_to_string(text))?;
    // The code as it stands: nothing is added that bounds loops or guards divisions.
    let options =
        spv::Options { force_loop_bounding: false, emit_int_div_checks: false, ..spv::Options::default() };
    spv::write_vec(&module, &info, &options, None).map_err(|e| e.to_string())
}

/// Code of the dialect with another type for its numbers, literals among them.
fn in_precision(code: &str, number: &str) -> String {
    let mut text = String::new();
    let mut rest = code;
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    while let Some(first) = rest.chars().next() {
        let mut end = rest.find(|c| !word(c)).unwrap_or(rest.len()).max(first.len_utf8());
        if first.is_ascii_digit() {
            end = rest.find(|c| !word(c) && c != '.').unwrap_or(rest.len());
            // The sign of an exponent.
            if rest[..end].ends_with('e') && rest[end..].starts_with(['-', '+']) {
                end += 1 + rest[end + 1..].find(|c| !word(c)).unwrap_or(rest.len() - end - 1);
            }
        }
        let (token, after) = rest.split_at(end);
        match token {
            "f32" => text.push_str(number),
            _ if first.is_ascii_digit() && token.contains(['.', 'e']) && number.starts_with("vec") => {
                let _ = write!(text, "{number}({token})");
            }
            _ => text.push_str(token),
        }
        rest = after;
    }
    text
}
