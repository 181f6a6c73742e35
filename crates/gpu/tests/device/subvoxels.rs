//! Lookups of sub-voxels where shaders run: the exact values in WGSL, HLSL and GLSL, but for what a
//! device leaves of a division. The table is left out: Mesa's driver for the CPU compiles one for
//! minutes.

use crate::emit_support::compilers::{Target, glslang};
use crate::emit_support::languages::file;
use crate::emit_support::subvoxels::{PAIRS, expected, points};
use crate::gpu_support::device::WORKGROUP;
use crate::gpu_support::gpu;
use lobefit_shade::code::{Language, subvoxels};

/// Values of a point.
const VALUES: usize = 4;

/// The functions without the table and the one that reads it.
fn code(language: Language) -> String {
    let text = file(language, &subvoxels(language));
    let (before, after) =
        text.split_once("/// Mean position of the set sub-voxels of each mask").expect("a table");
    let after = after.split_once("/// The mask of a super-voxel").expect("the mask").1;
    format!("{before}///{after}")
}

fn wgsl() -> String {
    let code = code(Language::Wgsl);
    format!(
        "{code}
@group(0) @binding(0) var<storage, read> test_points: array<u32>;
@group(0) @binding(1) var<storage, read_write> test_values: array<f32>;
@compute @workgroup_size({WORKGROUP}) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if (id.x >= {PAIRS}u) {{ return; }}
    let mask = test_points[3u * id.x];
    let a = subvoxel_centroid(mask);
    let mask_of_all = supervoxel_mask(test_points[3u * id.x + 1u], test_points[3u * id.x + 2u]);
    var all = array<f32, {VALUES}>(a.x, a.y, a.z, f32(mask_of_all));
    for (var k = 0u; k < {VALUES}u; k++) {{ test_values[{VALUES}u * id.x + k] = all[k]; }}
}}
"
    )
}

fn of_family(language: Language) -> String {
    let code = code(language);
    let three = if language == Language::Hlsl { "float3" } else { "vec3" };
    let body = format!(
        "    if (i >= {PAIRS}u) {{ return; }}
    {three} a = subvoxel_centroid(test_points[3u * i]);
    uint at = {VALUES}u * i;
    test_values[at] = a.x; test_values[at + 1u] = a.y; test_values[at + 2u] = a.z;
    test_values[at + 3u] = float(supervoxel_mask(test_points[3u * i + 1u], test_points[3u * i + 2u]));
"
    );
    match language {
        Language::Hlsl => format!(
            "{code}
StructuredBuffer<uint> test_points : register(t0);
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
layout(set = 0, binding = 0, std430) readonly buffer Points {{ uint test_points[]; }};
layout(set = 0, binding = 1, std430) buffer Values {{ float test_values[]; }};
void main() {{
    uint i = gl_GlobalInvocationID.x;
{body}}}
"
        ),
    }
}

/// Masks are exact; a quotient of a device is within 2.5 units in the last place.
fn agrees(language: &str, found: &[f32]) {
    for (i, (found, expected)) in found.chunks(VALUES).zip(expected().chunks(7)).enumerate() {
        let near = |k: usize| (found[k] - expected[k]).abs() <= 2.5 * f32::EPSILON * expected[k].abs();
        assert!((0..3).all(near) && found[3] == expected[6], "{language}, {i}: {found:?}, {expected:?}");
    }
}

#[test]
fn sub_voxels_are_looked_up_on_a_device() {
    let Some(gpu) = gpu() else { return };
    let buffer = gpu.buffer(&points());
    let resources = [buffer.as_entire_binding()];
    agrees("wgsl", &gpu.run(&gpu.module(&wgsl()), "main", &resources, PAIRS, PAIRS * VALUES));
    for language in [Language::Hlsl, Language::Glsl] {
        let Some(module) = glslang(language, &of_family(language), "comp", Target::Vulkan) else { return };
        agrees(language.name(), &gpu.run(&gpu.spirv(&module), "main", &resources, PAIRS, PAIRS * VALUES));
    }
}
