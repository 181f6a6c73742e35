//! Warps and decodings as a shader computes them: the functions of `warps.wgsl` and
//! `decodings.wgsl`, evaluated in f32 or f16 and counted.

use std::sync::LazyLock;

use super::{ARGUMENT_NAMES, AlphaMap, Arguments, Axis, Decode, Surface, Values};
use lobefit_shade::code::{LETTERS, TEXTURE_AXES, decimal};
use lobefit_shade::tape::Half;
use lobefit_shade::{Features, Precision, Real, ShadeError, Source, Tape};

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
    /// With products fused into the sums that use them.
    fused: Tape,
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
        Ok(Evaluated { fused: tape.contracted(), tape, inputs })
    }

    fn at<R: Real>(&self, given: &[f32; INPUTS.len()], is_fused: bool) -> R {
        let mut inputs = [R::ZERO; INPUTS.len()];
        for (input, place) in inputs.iter_mut().zip(&self.inputs) {
            *input = R::literal(given[*place]);
        }
        let tape = if is_fused { &self.fused } else { &self.tape };
        tape.at(&inputs[..self.inputs.len()], &[])
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
    /// The texture coordinate of a value; in f16 everything given is rounded first.
    pub fn at(&self, x: f32, surface: Surface<f32>, precision: Precision) -> f32 {
        if precision.is_half() {
            return self.in_numbers::<Half>(x, surface, precision.is_fused()).to_f32();
        }
        self.in_numbers(x, surface, precision.is_fused())
    }

    fn in_numbers<R: Real>(&self, x: f32, surface: Surface<f32>, is_fused: bool) -> R {
        let Surface { alpha, ior, anisotropy, cos2_phi } = surface;
        let mut given = [0.0; INPUTS.len()];
        given[..7].copy_from_slice(&[x, alpha, ior, anisotropy, cos2_phi, self.least, self.whole]);
        let value: R = self.warp.at(&given, is_fused);
        let (scale, offset) = (R::literal(self.affine.0), R::literal(self.affine.1));
        match self.affine {
            (1.0, 0.0) => value,
            _ if is_fused => value.fma(scale, offset),
            _ => value * scale + offset,
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
    /// The values of a texel; what lies beyond the table's channels is not read. In f16 the texel is
    /// rounded first too.
    pub fn at(&self, texel: [f32; 4], mu: f32, surface: Surface<f32>, precision: Precision) -> Values {
        let Surface { alpha, ior, anisotropy, cos2_phi } = surface;
        let [r, g, b, a] = texel;
        let given = [0.0, alpha, ior, anisotropy, cos2_phi, 0.0, 0.0, r, g, b, a, mu];
        let value = |decoding: &Evaluated| match precision.is_half() {
            true => decoding.at::<Half>(&given, precision.is_fused()).to_f32(),
            false => decoding.at(&given, precision.is_fused()),
        };
        Values { e: value(&self.albedo), b: self.bias.as_ref().map(value) }
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

/// Inputs that the functions of tables may read beside the width of the lobe, in the order of their
/// arguments.
const INPUTS_BESIDE: [&str; 4] = ["mu", "anisotropy", "ior", "cos2_phi"];

/// The functions of a table: its coordinates and its decoding, with the library's functions written
/// out in them.
#[derive(Clone, Debug)]
pub struct TableCode {
    source: Source,
    /// Name of the function of the coordinates.
    pub coordinates: String,
    /// Name of the function of the decoding.
    pub decoding: String,
    /// Arguments of the coordinates.
    pub located_by: Vec<&'static str>,
    /// Arguments of the decoding beside the texel.
    pub decoded_by: Vec<&'static str>,
    /// Arguments of a lookup that calls both.
    pub inputs: Vec<&'static str>,
}

impl TableCode {
    /// Those whose names begin with `stem`. They take the width of the lobe as the scene asks, and
    /// of the other inputs what they read.
    ///
    /// # Errors
    /// A library that does not parse, a defect of this program.
    pub fn new(
        stem: &str,
        axes: &[Axis],
        decode: Decode,
        (width, map): (Arguments, AlphaMap),
    ) -> Result<TableCode, ShadeError> {
        let (coordinates, decoding) = (
            format!("{stem}_{}", LETTERS[..axes.len().min(TEXTURE_AXES)].concat()),
            format!("{stem}_decode"),
        );
        let code = |given: &[Given; 2]| -> Result<Source, ShadeError> {
            let functions = [
                coordinate_function(&coordinates, axes, &given[0])?,
                decode_function(&decoding, decode, &given[1])?,
            ];
            let text = [TEXT, &functions[0], &functions[1]].join("\n");
            Ok(Source::parse("warps.wgsl", &text)?.inlined(|_| true))
        };
        let every = code(&[Given::every(), Given::every()])?;
        let (located, decoded) = (every.read(&coordinates)?, every.read(&decoding)?);
        let of = |read: &[&str]| Given::of(read, (width, map));
        let given = [of(&located), of(&decoded)];
        let source = code(&given)?.with_arguments(&ARGUMENT_NAMES);
        let inputs = of(&[located, decoded].concat()).printed();
        let [located_by, decoded_by] = given.map(|given| given.printed());
        Ok(TableCode { source, coordinates, decoding, located_by, decoded_by, inputs })
    }

    /// The functions.
    pub fn source(&self) -> &Source {
        &self.source
    }
}

/// What a function is given, and what it computes of the width of the lobe first.
struct Given {
    arguments: Vec<&'static str>,
    lets: String,
}

impl Given {
    /// All that there is.
    fn every() -> Given {
        let arguments = [Arguments::Both.names(), &INPUTS_BESIDE].concat();
        Given { arguments, lets: String::new() }
    }

    /// What a function needs that reads these inputs.
    fn of(read: &[&str], (width, map): (Arguments, AlphaMap)) -> Given {
        let reads = |name: &&&str| read.contains(*name);
        let of_width: Vec<&str> = Arguments::Both.names().iter().filter(reads).copied().collect();
        let given: &[&str] = if of_width.is_empty() { &[] } else { width.names() };
        let lets = of_width.iter().filter(|name| !given.contains(*name)).map(|name| match *name {
            "alpha" => format!("    let alpha = {};\n", map.alpha_source("roughness")),
            _ => format!("    let roughness = {};\n", map.roughness_source("alpha")),
        });
        let lets = lets.collect();
        let beside = INPUTS_BESIDE.iter().filter(reads).copied();
        Given { arguments: given.iter().copied().chain(beside).collect(), lets }
    }

    fn declared(&self) -> Vec<String> {
        self.arguments.iter().map(|name| format!("{name}: f32")).collect()
    }

    /// The arguments as the emitted functions call them.
    fn printed(&self) -> Vec<&'static str> {
        let named = |name: &'static str| {
            ARGUMENT_NAMES.iter().find(|(input, _)| *input == name).map_or(name, |(_, printed)| *printed)
        };
        self.arguments.iter().copied().map(named).collect()
    }
}

/// The kind of so many numbers.
fn kind(n: usize) -> String {
    if n == 1 { "f32".into() } else { format!("vec{n}f") }
}

fn coordinate_function(name: &str, axes: &[Axis], given: &Given) -> Result<String, ShadeError> {
    if axes.len() > TEXTURE_AXES {
        return corner_function(name, axes, given);
    }
    let letters = &LETTERS[..axes.len()];
    let (arguments, result) = (given.declared().join(", "), kind(axes.len()));
    let mut text = format!("fn {name}({arguments}) -> {result} {{\n{}", given.lets);
    for (letter, axis) in letters.iter().zip(axes) {
        text += &format!("    let {letter} = {};\n", axis.call()?);
    }
    let value = if axes.len() == 1 { letters.concat() } else { format!("{result}({})", letters.join(", ")) };
    Ok(format!("{text}    return {value};\n}}\n"))
}

/// The coordinates of one of the fetches between which axes beyond those of a texture are interpolated, the
/// next along such an axis where its argument is 1, and its weight.
fn corner_function(name: &str, axes: &[Axis], given: &Given) -> Result<String, ShadeError> {
    let (own, beyond) = axes.split_at(TEXTURE_AXES);
    let letters = &LETTERS[TEXTURE_AXES..axes.len()];
    let mut arguments = given.declared();
    arguments.extend(letters.iter().map(|letter| format!("next_{letter}: f32")));
    let mut text = format!("fn {name}({}) -> vec4f {{\n{}", arguments.join(", "), given.lets);
    for (letter, axis) in LETTERS.iter().zip(own) {
        text += &format!("    let {letter} = {};\n", axis.call()?);
    }
    let edge = 0.5 / own[TEXTURE_AXES - 1].size as f32;
    let (mut depth, mut weight) = (1.0_f32, String::from("1.0"));
    let mut place = format!("clamp(w, {}, {})", decimal(edge), decimal(1.0 - edge));
    for (letter, axis) in letters.iter().zip(beyond) {
        let n = axis.size as f32;
        let [size, last, before] = [n, n - 1.0, n - 2.0].map(decimal);
        text += &format!(
            "    let at_{letter} = clamp(({}) * {size} - 0.5, 0.0, {last});\n    \
             let first_{letter} = min(floor(at_{letter}), {before});\n    \
             let part_{letter} = at_{letter} - first_{letter};\n",
            axis.call()?
        );
        place += &format!(" + {} * (first_{letter} + next_{letter})", decimal(depth));
        // The part of the next where it is 1, and what that leaves where it is 0.
        weight += &format!(" * abs(1.0 - next_{letter} - part_{letter})");
        depth *= n;
    }
    let weight = weight.trim_start_matches("1.0 * ");
    Ok(format!("{text}    return vec4f(u, v, ({place}) / {}, {weight});\n}}\n", decimal(depth)))
}

fn decode_function(name: &str, decode: Decode, given: &Given) -> Result<String, ShadeError> {
    let function = library()?.function(decode.function())?;
    let passed: Vec<&str> =
        function.variables[..function.arguments].iter().map(|v| v.name.as_str()).collect();
    let texel = format!("texel: {}", kind(decode.channels()));
    Ok(format!(
        "fn {name}({}) -> {} {{\n{}    return {}({});\n}}\n",
        [vec![texel], given.declared()].concat().join(", "),
        kind(decode.count()),
        given.lets,
        decode.function(),
        passed.join(", ")
    ))
}

/// Operations of a lookup beside its fetch: coordinates and decoding, what they share counted once;
/// roughness and alpha are both given.
///
/// # Errors
/// A library that does not parse, a defect of this program.
pub fn lookup_ops(axes: &[Axis], decode: Decode) -> Result<u32, ShadeError> {
    let code = counted(axes, decode)?;
    code.source.cost_ops(&[&code.coordinates, &code.decoding])
}

/// The kinds of work in the same.
///
/// # Errors
/// As [`lookup_ops`].
pub fn lookup_features(axes: &[Axis], decode: Decode) -> Result<Features, ShadeError> {
    let code = counted(axes, decode)?;
    code.source.features(&[&code.coordinates, &code.decoding])
}

fn counted(axes: &[Axis], decode: Decode) -> Result<TableCode, ShadeError> {
    TableCode::new("table", axes, decode, (Arguments::Both, AlphaMap::default()))
}
