//! Whole files of emitted code as programs: every function that a file holds is called.

use lobefit::data::{Decode, Table};
use lobefit_shade::code::{Language, TEXTURE_AXES};

use super::compilers::{Contraction, Target, glslang, loops, run};

/// The languages of C's family.
pub const FAMILY: [Language; 4] = [Language::Hlsl, Language::Glsl, Language::Msl, Language::C];

/// A file of functions, as a bake opens it.
pub fn file(language: Language, functions: &str) -> String {
    format!("{} A file.\n\n{}{functions}", language.comment(), language.opening())
}

/// A function of a file: its name, and the types of its arguments and of its result.
#[derive(Debug, PartialEq, Eq)]
pub struct Function {
    pub name: String,
    pub arguments: Vec<String>,
    pub result: String,
}

/// The functions of a file of C's family, in order.
pub fn functions(code: &str) -> Vec<Function> {
    let begins = |line: &str| line.starts_with(|c: char| c.is_ascii_alphabetic()) && line.contains('(');
    let mut found = Vec::new();
    for (start, line) in code.lines().map(|line| (line.as_ptr() as usize - code.as_ptr() as usize, line)) {
        if !begins(line) || line.starts_with("typedef") || line.starts_with("const ") {
            continue;
        }
        let head = code[start..].split(" {\n").next().expect("a body");
        let (before, arguments) = head.trim_end_matches(')').split_once('(').expect("arguments");
        let (result, name) = before.rsplit_once(' ').expect("a type");
        let kind = |argument: &str| {
            let argument = argument.trim();
            let (kind, name) = argument.rsplit_once([' ', '*']).expect("a type");
            format!("{kind}{}", name.find('[').map_or("", |size| &name[size..]))
        };
        found.push(Function {
            name: name.to_string(),
            arguments: arguments.split(',').map(kind).collect(),
            result: result.trim_start_matches("static ").trim_start_matches("inline ").to_string(),
        });
    }
    found
}

/// The number of planes of an argument.
fn planes(kind: &str) -> usize {
    kind.trim_end_matches(']').rsplit_once('[').expect("a size").1.parse().expect("a number")
}

/// A shader that holds a file and calls each of its functions, for the stage `frag`.
fn shader(language: Language, code: &str, version: &str) -> (String, usize) {
    let value = |kind: &String| match kind.trim_start_matches("mediump ") {
        "bool" => "(p.x > 0.5)".to_string(),
        "float" => "p.x".to_string(),
        "uint" | "highp uint" => "uint(p.x)".to_string(),
        "min16float" => "min16float(p.x)".to_string(),
        // planes: the head of the file has an array of as many
        kind if kind.ends_with(']') => format!("planes_{}", planes(kind)),
        "min16float2" | "float2" | "float3" | "float4" | "vec2" | "vec3" | "vec4" => {
            format!(
                "{}({})",
                kind.trim_start_matches("mediump "),
                ["p.x", "p.y", "p.z", "p.w"][..kind[kind.len() - 1..].parse().unwrap()].join(", ")
            )
        }
        "SamplerState" => "linear_clamp".to_string(),
        "sampler2D" | "Texture2D<float4>" => "plane".to_string(),
        "sampler3D" | "Texture3D<float4>" => "space".to_string(),
        other => panic!("an argument of type {other}"),
    };
    let functions = functions(code);
    let call = |f: &Function| {
        let arguments: Vec<String> = f.arguments.iter().map(value).collect();
        let part = match f.result.as_str() {
            "float" | "mediump float" | "min16float" | "uint" | "highp uint" => "",
            "bool" => " ? 1.0 : 0.0",
            result if result.starts_with("parallax_taps") => ".weight_0",
            _ => ".x",
        };
        format!("    sum += float({}({}){part});\n", f.name, arguments.join(", "))
    };
    let calls: String = functions.iter().map(call).collect();
    let mut arrays: Vec<usize> = functions
        .iter()
        .flat_map(|f| &f.arguments)
        .filter(|kind| kind.ends_with(']'))
        .map(|kind| planes(kind))
        .collect();
    arrays.sort_unstable();
    arrays.dedup();
    let four = if language == Language::Hlsl { "float4" } else { "vec4" };
    let arrays: String = arrays
        .iter()
        .map(|n| {
            format!("    {four} planes_{n}[{n}];\n    for (int k = 0; k < {n}; ++k) planes_{n}[k] = p;\n")
        })
        .collect();
    let calls = format!("{arrays}{calls}");
    let source = if language == Language::Hlsl {
        format!(
            "{code}
Texture2D<float4> plane : register(t0);
Texture3D<float4> space : register(t1);
SamplerState linear_clamp : register(s2);
float4 main(float4 p : TEXCOORD0) : SV_Target {{
    float sum = 0.0f;
{calls}    return float4(sum, sum, sum, sum);
}}
"
        )
    } else {
        let es = version.ends_with("es");
        let precision = if es { "precision highp float;\nprecision highp sampler3D;\n" } else { "" };
        let located = version != "330" && version != "300 es";
        let place = |set: &str, n: u32| match (located, set) {
            (false, _) => String::new(),
            (true, "") => format!("layout(location = {n}) "),
            (true, set) => format!("layout({set}binding = {n}) "),
        };
        let uniform = "set = 0, ";
        let set = if version == "450" || version == "310 es" { uniform } else { "" };
        format!(
            "#version {version}\n{precision}{code}
{}uniform sampler2D plane;
{}uniform sampler3D space;
{}in vec4 p;
{}out vec4 result;
void main() {{
    float sum = 0.0;
{calls}    result = vec4(sum);
}}
",
            place(set, 0),
            place(set, 1),
            place("", 0),
            if located { place("", 0) } else { String::new() },
        )
    };
    (source, functions.len())
}

/// Has glslang compile a file of GLSL or HLSL, as the versions that it is for; the number of its
/// functions. None where glslang is not there.
pub fn compile(language: Language, code: &str) -> Option<usize> {
    let versions: &[(&str, Target)] = match language {
        Language::Hlsl => &[("", Target::Vulkan)],
        Language::Glsl => &[
            ("450", Target::Vulkan),
            ("330", Target::OpenGl),
            ("310 es", Target::Vulkan),
            ("300 es", Target::OpenGl),
        ],
        other => panic!("glslang does not read {}", other.title()),
    };
    let mut count = 0;
    for (version, target) in versions {
        let (source, functions) = shader(language, code, version);
        glslang(language, &source, "frag", *target)?;
        count = functions;
    }
    Some(count)
}

/// A lookup to be called: its function's name, arguments, table and decoding.
pub struct Called<'a> {
    pub function: String,
    pub arguments: Vec<&'a str>,
    pub table: &'a Table,
    pub decode: Decode,
}

/// Runs the lookups of a file at points whose numbers are named `inputs`; their values one after
/// another. None where the compiler is not there.
pub fn look_up(
    language: Language,
    code: &str,
    lookups: &[Called],
    inputs: &[&str],
    points: &[u8],
) -> Option<Vec<f32>> {
    let (mut main, mut bodies) = (String::new(), Vec::new());
    for (k, called) in lookups.iter().enumerate() {
        let (channels, [columns, rows, slices]) = (called.table.channels.len(), called.table.size());
        let texel =
            |i: usize| called.table.channels.iter().map(move |c| format!("{:?}f", c.texels[i] as f32));
        let texels: Vec<String> = (0..columns * rows * slices).flat_map(texel).collect();
        main += &format!("static const float texels_{k}[] = {{{}}};\n", texels.join(", "));
        let axes = called.table.axes.len().min(TEXTURE_AXES);
        let kind = match language {
            Language::C => None,
            Language::Hlsl => Some(format!("Texture{axes}D<float4>")),
            Language::Msl => Some(format!("texture{axes}d<float>")),
            _ => Some(format!("sampler{axes}D")),
        };
        let mut arguments = match &kind {
            None => vec![format!("texels_{k}")],
            Some(kind) => {
                let size = format!("{channels}, {columns}, {rows}, {slices}");
                main +=
                    &format!("static const {kind} table_{k} = shim::table_of<{kind}>(texels_{k}, {size});\n");
                vec![format!("table_{k}")]
            }
        };
        match language {
            Language::Hlsl => arguments.push("SamplerState()".into()),
            Language::Msl => arguments.push("sampler()".into()),
            _ => {}
        }
        let index = |name: &&str| inputs.iter().position(|input| input == name).expect("an input");
        arguments.extend(called.arguments.iter().map(|name| format!("p[{}]", index(name))));
        let call = format!("{}({})", called.function, arguments.join(", "));
        let three = match language {
            Language::C => "lobefit_float3",
            Language::Glsl => "vec3",
            _ => "float3",
        };
        bodies.push(match called.decode.formulas().len() {
            1 => format!("        put({call});\n"),
            _ => format!(
                "        const {three} v = {call};\n        put(v.x);\n        put(v.y);\n        put(v.z);\n"
            ),
        });
    }
    run(language, code, &format!("{main}{}", loops(inputs.len(), &bodies)), points, Contraction::Off)
}
