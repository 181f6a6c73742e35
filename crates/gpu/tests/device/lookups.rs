//! The lookups of probes where shaders run: WGSL, and HLSL and GLSL by glslang, on a Vulkan device.

use crate::emit_support::compilers::{Target, glslang};
use crate::emit_support::say;
use crate::gpu_support::device::WORKGROUP;
use crate::gpu_support::gpu;
use crate::lookup_support::{EMITTED, Emitted, Job, bytes, literal, text};
use lobefit_shade::code::Language;

/// Numbers of a point, without its last.
const WIDTH: usize = 10;

/// What a lookup is called with beside the point, inside a function.
fn described(language: Language, emitted: &Emitted) -> (String, &'static str) {
    let value = |name: &str, values: &[f32]| {
        let value = literal(language, values);
        match language {
            Language::Wgsl => format!("    let {name} = {value};\n"),
            Language::Hlsl => format!("    float3 {name} = {value};\n"),
            _ => format!("    vec3 {name} = {value};\n"),
        }
    };
    let [low, high, probe] = emitted.corners();
    let probe = value("probe", &probe);
    let Some(n) = emitted.lookup.planes else {
        return (format!("{}{}{probe}", value("low", &low), value("high", &high)), "low, high, probe");
    };
    let list: Vec<String> = emitted.planes().iter().map(|plane| literal(language, plane)).collect();
    let list = list.join(", ");
    let planes = match language {
        Language::Wgsl => format!("    let planes = array<vec4<f32>, {n}>({list});\n"),
        Language::Hlsl => format!("    float4 planes[{n}] = {{{list}}};\n"),
        _ => format!("    vec4 planes[{n}] = vec4[{n}]({list});\n"),
    };
    (planes + &probe, "planes, probe")
}

/// The lines that call a lookup at point `i` and write its numbers.
fn called(language: Language, emitted: &Emitted) -> String {
    let (declared, names) = described(language, emitted);
    let (three, taps) = (if language == Language::Hlsl { "float3" } else { "vec3" }, emitted.lookup.taps);
    let three = if language == Language::Wgsl { "vec3<f32>" } else { three };
    let at = |k: usize| format!("test_points[i * {WIDTH}u + {k}u]");
    let vector = |k: usize| format!("{three}({}, {}, {})", at(k), at(k + 1), at(k + 2));
    let normal = if emitted.takes_normal() { format!("{}, ", vector(3)) } else { String::new() };
    let call = format!("{}({}, {normal}{}, {}, {names})", emitted.name(), vector(0), vector(6), at(9));
    let kind = match (language, taps) {
        (Language::Wgsl, _) => "let".to_string(),
        (Language::Hlsl, 1) => "float4".into(),
        (_, 1) => "vec4".into(),
        (_, n) => format!("parallax_taps_{n}"),
    };
    let parts = |name: &str| ["x", "y", "z", "w"].map(|part| format!("{name}.{part}")).to_vec();
    let values: Vec<String> = match taps {
        1 => parts("found"),
        n => {
            let fetches = (0..n).flat_map(|k| parts(&format!("found.fetch_{k}")));
            fetches.chain((0..n).map(|k| format!("found.weight_{k}"))).collect()
        }
    };
    let count = values.len();
    let put = |(k, value): (usize, &String)| format!("    test_values[i * {count}u + {k}u] = {value};\n");
    format!(
        "{declared}    {kind} found = {call};\n{}",
        values.iter().enumerate().map(put).collect::<String>()
    )
}

fn shader(language: Language, emitted: &Emitted, count: usize) -> String {
    let (code, body) = (text(language), called(language, emitted));
    match language {
        Language::Wgsl => format!(
            "{code}
@group(0) @binding(0) var<storage, read> test_points: array<f32>;
@group(0) @binding(1) var<storage, read_write> test_values: array<f32>;
@compute @workgroup_size({WORKGROUP}) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let i = id.x;
    if (i >= {count}u) {{ return; }}
{body}}}
"
        ),
        Language::Hlsl => format!(
            "{code}
StructuredBuffer<float> test_points : register(t0);
RWStructuredBuffer<float> test_values : register(u1);
[numthreads({WORKGROUP}, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {{
    uint i = id.x;
    if (i >= {count}u) {{ return; }}
{body}}}
"
        ),
        _ => format!(
            "#version 450
{code}
layout(local_size_x = {WORKGROUP}) in;
layout(set = 0, binding = 0, std430) readonly buffer Points {{ float test_points[]; }};
layout(set = 0, binding = 1, std430) buffer Values {{ float test_values[]; }};
void main() {{
    uint i = gl_GlobalInvocationID.x;
    if (i >= {count}u) {{ return; }}
{body}}}
"
        ),
    }
}

#[test]
fn lookups_fetch_on_a_device_what_those_of_the_study_do() {
    let Some(gpu) = gpu() else { return };
    let jobs: Vec<Job> = EMITTED.iter().map(Emitted::job).collect();
    for language in [Language::Wgsl, Language::Hlsl, Language::Glsl] {
        for job in &jobs {
            let Job { emitted, points, .. } = job;
            let source = shader(language, emitted, points.len());
            let module = match language {
                Language::Wgsl => gpu.module(&source),
                _ => match glslang(language, &source, "comp", Target::Vulkan) {
                    Some(module) => gpu.spirv(&module),
                    None => continue,
                },
            };
            let buffer = gpu.buffer(&bytes(points));
            let resources = [buffer.as_entire_binding()];
            let count = points.len() * emitted.numbers();
            let found = gpu.run(&module, "main", &resources, points.len(), count);
            job.agrees(language.name(), &found);
        }
        say(&format!("{} on {}: {} lookups", language.name(), gpu.name, EMITTED.len()));
    }
}
