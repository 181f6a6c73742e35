//! The emitted HLSL and GLSL where shaders run: glslang compiles them to SPIR-V, and every function
//! returns on a Vulkan device what was certified, up to the accuracy that Vulkan asks of a device.

use crate::emit_support;
use crate::gpu_support;

use emit_support::accuracy::{CPU, WGSL, bound};
use emit_support::compilers::{Target, glslang};
use emit_support::{Points, emitted, say, text};
use gpu_support::device::WORKGROUP;
use gpu_support::gpu;
use lobefit_shade::code::Language;

/// A compute shader that writes the values of all functions at a point, one after another.
fn shader(language: Language, points: usize) -> String {
    let functions = emitted();
    let count = functions.len();
    let call = |(k, (_, name, inputs)): (usize, &(_, String, Vec<String>))| {
        format!("    test_values[i * {count}u + {k}u] = {name}({});\n", inputs.join(", "))
    };
    let calls: String = functions.iter().enumerate().map(call).collect();
    let code = text(&format!("fits/lobefit.{}", language.extension()));
    let body = format!(
        "    if (i >= {points}u) {{ return; }}
    float roughness = test_points[i].x, alpha = test_points[i].y, mu = test_points[i].z, f0 = test_points[i].w;
{calls}"
    );
    match language {
        Language::Hlsl => format!(
            "{code}
StructuredBuffer<float4> test_points : register(t0);
RWStructuredBuffer<float> test_values : register(u1);
[numthreads({WORKGROUP}, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {{
    uint i = id.x;
{body}}}
"
        ),
        _ => format!(
            "#version 450
{code}
layout(local_size_x = {WORKGROUP}) in;
layout(set = 0, binding = 0, std430) readonly buffer Points {{ vec4 test_points[]; }};
layout(set = 0, binding = 1, std430) buffer Values {{ float test_values[]; }};
void main() {{
    uint i = gl_GlobalInvocationID.x;
{body}}}
"
        ),
    }
}

/// Vulkan, "Precision and Operation of SPIR-V Instructions", asks of sums, products and quotients
/// what WGSL does.
#[test]
fn hlsl_and_glsl_return_on_a_device_what_was_certified() {
    let Some(gpu) = gpu() else { return };
    let (functions, points) = (emitted(), Points::of_fits());
    for language in [Language::Hlsl, Language::Glsl] {
        let source = shader(language, points.len());
        let Some(module) = glslang(language, &source, "comp", Target::Vulkan) else { return };
        let (module, buffer) = (gpu.spirv(&module), gpu.buffer(&points.bytes()));
        let resources = [buffer.as_entire_binding()];
        let found = gpu.run(&module, "main", &resources, points.len(), points.len() * functions.len());
        let mut worst = 0.0_f64;
        for (k, (fit, name, inputs)) in functions.iter().enumerate() {
            let (tape, coefficients) = (fit.hypothesis.tape(), fit.coefficients());
            for (i, reference) in points.values(fit, inputs).into_iter().enumerate() {
                let at: Vec<f32> = inputs.iter().map(|input| points.column(input)[i]).collect();
                let allowed = bound(tape, &at, &coefficients, CPU) + bound(tape, &at, &coefficients, WGSL);
                let value = found[i * functions.len() + k];
                let gap = (f64::from(value) - f64::from(reference)).abs();
                // Written so that a value that is not a number fails.
                assert!(
                    gap <= allowed,
                    "{name} at {at:?}: {reference}, on the device {value}, allowed {allowed:e}"
                );
                let unit = reference.abs().next_up() - reference.abs();
                worst = worst.max(gap / f64::from(unit));
            }
        }
        let (title, count, n) = (language.name(), functions.len(), points.len());
        say(&format!("{title} on {}: {count} functions, {n} points each, worst {worst:.2} ulp", gpu.name));
    }
}
