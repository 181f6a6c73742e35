//! Shaders that evaluate an emitted function in a loop, and the same loop without it.

use std::fmt::Write;

use super::GpuError;
use super::device::{UNIFORM_BYTES, WORKGROUP};
use super::texture::{Shape, Texels};
use super::variable::{Held, Ranges, Variable};

/// The room about a probe: low and high corner, the probe; and what planes a proxy of planes has,
/// at the distance 1.5 of the probe.
const ROOM: [[f32; 3]; 3] = [[-2.0, -1.5, -1.2], [2.0, 1.6, 1.3], [0.2, -0.1, 0.05]];

/// Levels of the cubemap beyond the first: a width is fetched at this many times its value where no
/// chain is known.
const LAST_LEVEL: u32 = super::jobs::LEVELS - 1;

/// How the fetches of a lookup are done: by the level that it gives, or by a width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fetches {
    /// How many.
    pub count: u32,
    /// It gives levels, not widths.
    pub levels: bool,
}

/// The text of a loop.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shader {
    /// With the evaluation.
    pub with: String,
    /// Without it.
    pub without: String,
    /// Planes of the proxy that it is given.
    pub planes: Option<u32>,
}

/// A shader of one evaluation: what it is given, what it does, what it adds to the sum.
struct Evaluation {
    inputs: Vec<Variable>,
    lines: String,
    sums: Vec<String>,
}

impl Shader {
    /// Of an emitted function, whose code and that of all that it calls is given, in ranges of its
    /// arguments. With `fetches` what it returns is fetched and summed with its weights.
    pub fn of_function(
        code: &str,
        module: &naga::Module,
        function: &str,
        ranges: &Ranges,
        texture: Option<Texels>,
        fetches: Option<Fetches>,
    ) -> Result<Shader, GpuError> {
        let wrong = |reason: String| GpuError::Bake { place: function.into(), reason };
        let found = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(function));
        let (_, found) = found.ok_or_else(|| wrong("not in the include file".into()))?;
        let mut inputs = Vec::new();
        for argument in &found.arguments {
            let name = argument.name.as_deref().unwrap_or_default();
            let of = Variable::of(name, &module.types[argument.ty].inner, ranges);
            inputs.push(of.ok_or_else(|| wrong(format!("no values are known for the argument `{name}`")))?);
        }
        let result = found.result.as_ref().ok_or_else(|| wrong("it returns nothing".into()))?;
        let given: Vec<String> = inputs.iter().map(Variable::expression).collect();
        let lines = format!("        let timed_value = {function}({});\n", given.join(", "));
        let sums = match fetches {
            Some(fetches) => fetched(fetches),
            None => members(module, result.ty, "timed_value"),
        };
        Ok(Shader::new(code, texture, Evaluation { inputs, lines, sums }))
    }

    /// Of a plain fetch: at coordinates that need no arithmetic, or along a ray at some level.
    pub fn of_fetch(texels: Texels) -> Shader {
        let coordinates = match texels.shape {
            Shape::Flat(..) => vec![Variable::Scalar("u", 0.0, 1.0), Variable::Scalar("v", 0.0, 1.0)],
            Shape::Solid(..) => {
                ["u", "v", "w"].into_iter().map(|name| Variable::Scalar(name, 0.0, 1.0)).collect()
            }
            Shape::Cube(..) => vec![Variable::Ray, Variable::Scalar("mip", 0.0, f64::from(LAST_LEVEL))],
        };
        let given: Vec<String> = coordinates.iter().map(Variable::expression).collect();
        let place = match texels.shape {
            Shape::Flat(..) => format!("vec2<f32>({}), 0.0", given.join(", ")),
            Shape::Solid(..) => format!("vec3<f32>({}), 0.0", given.join(", ")),
            Shape::Cube(..) => given.join(", "),
        };
        let lines =
            format!("        let timed_value = textureSampleLevel(timed_texture, timed_sampler, {place});\n");
        let sums = vec![match texels.shape {
            Shape::Cube(..) => "(timed_value.x + timed_value.y + timed_value.z)".into(),
            _ => "timed_value.x".into(),
        }];
        Shader::new("", Some(texels), Evaluation { inputs: coordinates, lines, sums })
    }

    fn new(code: &str, texture: Option<Texels>, evaluation: Evaluation) -> Shader {
        let Evaluation { inputs, lines, sums } = evaluation;
        let planes = inputs.iter().find_map(|input| match input {
            Variable::Held(Held::Planes(n)) => Some(*n),
            _ => None,
        });
        let summed = format!("{lines}        timed_sum += {};\n", sums.join(" + "));
        let mut resources = texture.map_or_else(String::new, |texels| {
            format!(
                "@group(0) @binding(2) var timed_texture: {};\n@group(0) @binding(3) var timed_sampler: sampler;\n",
                texels.wgsl()
            )
        });
        if let Some(n) = planes {
            let _ = writeln!(
                resources,
                "@group(0) @binding(4) var<uniform> timed_planes: array<vec4<f32>, {n}>;"
            );
        }
        Shader { with: text(code, &resources, &inputs, &summed), without: text("", "", &inputs, ""), planes }
    }
}

/// The whole shader: `work` in a loop over `inputs`.
///
/// Inputs are a start of the pixel's, from one corner of a square picture to the other, and drift
/// over half their range from turn to turn: neighbours see neighbouring places, as on a screen, and
/// making an input takes one operation. They are summed with and without the work, so that nothing
/// is taken out of the loop.
fn text(code: &str, resources: &str, inputs: &[Variable], work: &str) -> String {
    let made = Variable::made(inputs);
    let starts: String = made.iter().enumerate().map(|(i, variable)| variable.start(i)).collect();
    let turns: String = made.iter().map(Variable::turn).collect();
    let sums: String = made
        .iter()
        .filter_map(Variable::summed)
        .map(|sum| format!("        timed_sum += {sum};\n"))
        .collect();
    format!(
        "{code}
struct timed_block {{
    low: vec4<f32>,
    high: vec4<f32>,
    probe: vec4<f32>,
    step: f32,
    evaluations: u32,
    side: u32,
    zero: f32,
}}
@group(0) @binding(0) var<storage, read_write> timed_sums: array<f32>;
@group(0) @binding(1) var<uniform> timed: timed_block;
{resources}
@compute @workgroup_size({WORKGROUP}, {WORKGROUP})
fn timed_main(@builtin(global_invocation_id) timed_id: vec3<u32>) {{
    let timed_spot = (vec2<f32>(timed_id.xy) + 0.5) / f32(timed.side);
{starts}    var timed_sum = 0.0;
    var timed_turn = 0.0;
    for (var k = 0u; k < timed.evaluations; k++) {{
{turns}{sums}{work}        timed_turn += timed.step;
    }}
    timed_sums[timed_id.y * timed.side + timed_id.x] = timed_sum;
}}
"
    )
}

/// The uniforms of a shader that does so many evaluations over a square of pixels; the last is 0.
pub(super) fn uniforms(evaluations: u32, side: u32) -> [u8; UNIFORM_BYTES] {
    let corners = ROOM.iter().flat_map(|[x, y, z]| [*x, *y, *z, 0.0]);
    let floats = corners.chain([1.0 / evaluations as f32]).map(f32::to_bits);
    let mut bytes = [0; UNIFORM_BYTES];
    for (chunk, word) in bytes.chunks_exact_mut(4).zip(floats.chain([evaluations, side])) {
        chunk.copy_from_slice(&word.to_le_bytes());
    }
    bytes
}

/// Planes about the probe: normals in all directions by the golden section, at equal distances.
pub(super) fn planes(count: u32) -> Vec<f32> {
    let normal = |i: u32| {
        let up = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
        let around = (1.0 - up * up).sqrt();
        let angle = 2.399_963_229_728_653 * f64::from(i);
        let (sine, cosine) = (lobefit_math::ops::sin(angle), lobefit_math::ops::cos(angle));
        [around * cosine, around * sine, up, 1.5].map(|x| x as f32)
    };
    (0..count).flat_map(normal).collect()
}

/// What a value of a type adds to the sum: all that it consists of.
pub(super) fn members(module: &naga::Module, ty: naga::Handle<naga::Type>, value: &str) -> Vec<String> {
    match &module.types[ty].inner {
        naga::TypeInner::Vector { size, .. } => {
            let letters = ["x", "y", "z", "w"].into_iter().take(*size as usize);
            letters.map(|letter| format!("{value}.{letter}")).collect()
        }
        naga::TypeInner::Struct { members: of, .. } => {
            let each = of.iter().filter_map(|member| Some((member.name.as_ref()?, member.ty)));
            each.flat_map(|(name, ty)| members(module, ty, &format!("{value}.{name}"))).collect()
        }
        naga::TypeInner::Scalar(naga::Scalar::U32) => vec![format!("bitcast<f32>({value})")],
        _ => vec![value.to_owned()],
    }
}

/// What the fetches of a lookup add to the sum.
fn fetched(fetches: Fetches) -> Vec<String> {
    let seen = |fetch: &str| {
        let level = if fetches.levels { format!("{fetch}.w") } else { format!("{LAST_LEVEL}.0 * {fetch}.w") };
        let color = format!("textureSampleLevel(timed_texture, timed_sampler, {fetch}.xyz, {level}).xyz");
        format!("dot({color}, vec3<f32>(1.0))")
    };
    match fetches.count {
        1 => vec![seen("timed_value")],
        n => (0..n)
            .map(|k| format!("timed_value.weight_{k} * {}", seen(&format!("timed_value.fetch_{k}"))))
            .collect(),
    }
}
