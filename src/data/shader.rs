//! Warps and decodings as a shader computes them: the functions of `warps.wgsl` and
//! `decodings.wgsl`, evaluated in f32 and counted.

use std::sync::LazyLock;

use super::{Axis, Decode, Surface, Values};
use lobefit_shade::code::{LETTERS, decimal};
use lobefit_shade::{ShadeError, Source, Tape};

/// The text of both files.
const TEXT: &str = concat!(include_str!("warps.wgsl"), "\n", include_str!("decodings.wgsl"));

/// Their functions.
static LIBRARY: LazyLock<Result<Source, ShadeError>> = LazyLock::new(|| Source::parse("warps.wgsl", TEXT));

fn library() -> Result<&'static Source, ShadeError> {
    LIBRARY.as_ref().map_err(Clone::clone)
}

/// What the functions' arguments are called, in the order in which they are given.
const INPUTS: [&str; 12] = [
    "x",
    "alpha",
    "ior",
    "anisotropy",
    "cos2_phi",
    "least",
    "whole",
    "texel.x",
    "texel.y",
    "texel.z",
    "texel.w",
    "mu",
];

/// A function of the library, and where its inputs stand in [`INPUTS`].
#[derive(Clone, Debug)]
struct Evaluated {
    tape: Tape,
    inputs: Vec<usize>,
}

impl Evaluated {
    fn of(function: &str, component: usize) -> Result<Evaluated, ShadeError> {
        let tape = library()?.tape(function, component)?;
        let place = |name: &String| {
            let name = if name == "texel" { "texel.x" } else { name };
            INPUTS.iter().position(|input| *input == name)
        };
        let unknown = || ShadeError::UnknownInput {
            function: function.into(),
            input: tape.inputs().join(", "),
            given: INPUTS.join(", "),
        };
        let inputs = tape.inputs().iter().map(place).collect::<Option<Vec<usize>>>().ok_or_else(unknown)?;
        Ok(Evaluated { tape, inputs })
    }

    fn at(&self, given: &[f32; INPUTS.len()]) -> f32 {
        let mut inputs = [0.0; INPUTS.len()];
        for (input, place) in inputs.iter_mut().zip(&self.inputs) {
            *input = given[*place];
        }
        self.tape.at(&inputs[..self.inputs.len()], &[])
    }
}

/// Values of an input to texture coordinates, in a shader's arithmetic.
#[derive(Clone, Debug)]
pub struct Coordinate {
    warp: Evaluated,
    least: f32,
    whole: f32,
    affine: (f32, f32),
}

impl Coordinate {
    /// The texture coordinate of a value.
    pub fn at(&self, x: f32, surface: Surface<f32>) -> f32 {
        let Surface { alpha, ior, anisotropy, cos2_phi } = surface;
        let mut given = [0.0; INPUTS.len()];
        given[..7].copy_from_slice(&[x, alpha, ior, anisotropy, cos2_phi, self.least, self.whole]);
        let value = self.warp.at(&given);
        match self.affine {
            (1.0, 0.0) => value,
            (scale, offset) => value * scale + offset,
        }
    }
}

/// Texels to values, in a shader's arithmetic.
#[derive(Clone, Debug)]
pub struct Decoder {
    albedo: Evaluated,
    bias: Option<Evaluated>,
}

impl Decoder {
    /// The values of a texel; what lies beyond the table's channels is not read.
    pub fn at(&self, texel: [f32; 4], mu: f32, surface: Surface<f32>) -> Values {
        let Surface { alpha, ior, anisotropy, cos2_phi } = surface;
        let [r, g, b, a] = texel;
        let given = [0.0, alpha, ior, anisotropy, cos2_phi, 0.0, 0.0, r, g, b, a, mu];
        Values { e: self.albedo.at(&given), b: self.bias.as_ref().map(|bias| bias.at(&given)) }
    }
}

impl Decode {
    /// What it computes.
    ///
    /// # Errors
    /// A library that does not parse, a defect of this program.
    pub fn decoder(self) -> Result<Decoder, ShadeError> {
        let of = |component: usize| Evaluated::of(self.function(), component);
        Ok(Decoder { albedo: of(0)?, bias: (self.count() == 3).then(|| of(2)).transpose()? })
    }
}

impl Axis {
    /// What its warp computes.
    ///
    /// # Errors
    /// A library that does not parse, a defect of this program.
    pub fn coordinate(&self) -> Result<Coordinate, ShadeError> {
        let (least, whole) = (self.min as f32, self.whole());
        Ok(Coordinate { warp: Evaluated::of(self.warp.function(), 0)?, least, whole, affine: self.affine() })
    }

    /// The texture coordinate as an expression of WGSL that calls the library.
    fn call(&self) -> Result<String, ShadeError> {
        let function = library()?.function(self.warp.function())?;
        let argument = |name: &str| match name {
            "x" => self.name.clone(),
            "least" => decimal(self.min as f32),
            "whole" => decimal(self.whole()),
            shared => shared.to_string(),
        };
        let arguments = &function.variables[..function.arguments];
        let passed: Vec<String> = arguments.iter().map(|v| argument(&v.name)).collect();
        let call = format!("{}({})", self.warp.function(), passed.join(", "));
        Ok(match self.affine() {
            (1.0, 0.0) => call,
            (scale, offset) if scale < 0.0 => format!("{} - {call} * {}", decimal(offset), decimal(-scale)),
            (scale, offset) => format!("{call} * {} + {}", decimal(scale), decimal(offset)),
        })
    }
}

/// Arguments that the functions of tables may have, in their order.
pub const ARGUMENTS: [&str; 6] = ["roughness", "alpha", "mu", "anisotropy", "ior", "cos2_phi"];

/// The functions of a table: its coordinates and its decoding, with the library's functions written
/// out in them.
#[derive(Clone, Debug)]
pub struct TableCode {
    source: Source,
    /// Name of the function of the coordinates.
    pub coordinates: String,
    /// Name of the function of the decoding.
    pub decoding: String,
}

impl TableCode {
    /// Those of a table called `name`, the functions having the arguments that they read and those
    /// that `also` asks for: of the coordinates, and of the decoding.
    ///
    /// # Errors
    /// A library that does not parse, a defect of this program.
    pub fn new(
        name: &str,
        axes: &[Axis],
        decode: Decode,
        also: [&[&str]; 2],
    ) -> Result<TableCode, ShadeError> {
        let letters = &LETTERS[..axes.len()];
        let (coordinates, decoding) = (format!("{name}_{}", letters.concat()), format!("{name}_decode"));
        let code = |arguments: [&[&str]; 2]| -> Result<TableCode, ShadeError> {
            let text = format!(
                "{TEXT}\n{}\n{}",
                coordinate_function(&coordinates, axes, arguments[0])?,
                decode_function(&decoding, decode, arguments[1])?
            );
            let source = Source::parse("warps.wgsl", &text)?.inlined(|_| true);
            Ok(TableCode { source, coordinates: coordinates.clone(), decoding: decoding.clone() })
        };
        let every = code([&ARGUMENTS; 2])?;
        let needed = |function: &str, also: &[&str]| -> Result<Vec<&str>, ShadeError> {
            let read = every.source.read(function)?;
            Ok(ARGUMENTS.into_iter().filter(|name| read.contains(name) || also.contains(name)).collect())
        };
        code([&needed(&coordinates, also[0])?, &needed(&decoding, also[1])?])
    }

    /// The functions.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Arguments of the coordinates, and of the decoding beside the texel.
    ///
    /// # Errors
    /// None: both functions are there.
    pub fn arguments(&self) -> Result<[Vec<&'static str>; 2], ShadeError> {
        let of = |name: &str| -> Result<Vec<&'static str>, ShadeError> {
            let function = self.source.function(name)?;
            let given = &function.variables[..function.arguments];
            Ok(ARGUMENTS.into_iter().filter(|name| given.iter().any(|v| v.name == *name)).collect())
        };
        Ok([of(&self.coordinates)?, of(&self.decoding)?])
    }
}

fn numbers(names: &[&str]) -> String {
    names.iter().map(|name| format!("{name}: f32")).collect::<Vec<_>>().join(", ")
}

fn kind(n: usize) -> String {
    if n == 1 { "f32".into() } else { format!("vec{n}f") }
}

fn coordinate_function(name: &str, axes: &[Axis], arguments: &[&str]) -> Result<String, ShadeError> {
    let letters = &LETTERS[..axes.len()];
    let mut text = format!("fn {name}({}) -> {} {{\n", numbers(arguments), kind(axes.len()));
    for (letter, axis) in letters.iter().zip(axes) {
        text += &format!("    let {letter} = {};\n", axis.call()?);
    }
    let value = if axes.len() == 1 {
        letters.concat()
    } else {
        format!("{}({})", kind(axes.len()), letters.join(", "))
    };
    Ok(format!("{text}    return {value};\n}}\n"))
}

fn decode_function(name: &str, decode: Decode, arguments: &[&str]) -> Result<String, ShadeError> {
    let function = library()?.function(decode.function())?;
    let passed: Vec<&str> =
        function.variables[..function.arguments].iter().map(|v| v.name.as_str()).collect();
    let texel = format!("texel: {}", kind(decode.channels()));
    let all = [vec![texel], arguments.iter().map(|name| format!("{name}: f32")).collect()].concat();
    Ok(format!(
        "fn {name}({}) -> {} {{\n    return {}({});\n}}\n",
        all.join(", "),
        kind(decode.count()),
        decode.function(),
        passed.join(", ")
    ))
}

/// Operations of a lookup beside its fetch: coordinates and decoding, what they share counted once.
///
/// # Errors
/// A library that does not parse, a defect of this program.
pub fn lookup_ops(axes: &[Axis], decode: Decode) -> Result<u32, ShadeError> {
    let code = TableCode::new("table", axes, decode, [&[], &[]])?;
    code.source.cost_ops(&[&code.coordinates, &code.decoding])
}
