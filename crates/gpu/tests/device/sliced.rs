//! The emitted WGSL of tables of three axes, and the compensations, where shaders run: on a Vulkan
//! device, against the f32 values in which tables are measured.

use crate::emit_support;
use crate::gpu_support;

use emit_support::accuracy::{CPU, WGSL, bound};
use emit_support::say;
use emit_support::solid::{Differences, Solid, azimuth_bound, bytes, points, squash, surface, to_look_up};
use gpu_support::device::{Gpu, WORKGROUP};
use gpu_support::gpu;
use lobefit::data::{Axis, Decode, Warp};
use lobefit::effects::table::{Lookup, Point};
use lobefit::emit::compensation::Compensation;
use lobefit_shade::Hypothesis;
use lobefit_shade::code::Language;

/// A texture unit keeps 8 bits of an interpolation weight, rounded or cut off: it is within one
/// step of the exact weight.
const WEIGHT: f64 = 1.0 / 256.0;

/// Beside the weights, f32 arithmetic: up to 24 roundings of values in [0, 1] in filter and
/// decoding.
const ARITHMETIC: f64 = 24.0 / 16_777_216.0;

/// One unit in the last place is at most this part of the number.
const ULP: f64 = 1.0 / 8_388_608.0;

/// And in the coordinate, in texels. Of u = sqrt(mu (1 + l)/(mu + l)) the operations make 8 units
/// in the last place of a number up to 1, those of WGSL's accuracy included; l beside makes half of
/// its own relative error. That is none where l is alpha, 8 units for alpha + 3 sqrt(ior - 1), and
/// for the alpha towards the view half that of q = 1 - 0.9 anisotropy and 8 units: q is off by 3
/// units of 1, and no less than 0.01 at the largest anisotropy of the points. The others have no
/// more operations than the first, but are scaled by up to 3.
fn coordinate(axis: &Axis) -> f64 {
    let units = match axis.warp {
        Warp::HomogeneousAzimuth => 8.0 + 0.5 * (8.0 + 0.5 * 3.0 / 0.01),
        Warp::HomogeneousIor => 8.0 + 0.5 * 8.0,
        Warp::Ior | Warp::Aspect => 3.0 * 8.0,
        Warp::Linear | Warp::Sqrt | Warp::Homogeneous | Warp::Square | Warp::Grazing => 8.0,
    };
    units * ULP * axis.size as f64
}

/// The largest change of a channel by the errors of weights and coordinates: along each axis its
/// largest step from texel to texel, as often as the position may be off.
fn change(solid: &Solid, channel: usize) -> f64 {
    let size = solid.table.size();
    let texels = &solid.table.channels[channel].texels;
    let stride = [1, size[0], size[0] * size[1]];
    let along = |axis: usize| {
        let inside = |i: &usize| i / stride[axis] % size[axis] + 1 < size[axis];
        let step = |i: usize| (texels[i + stride[axis]] - texels[i]).abs();
        let largest = (0..texels.len()).filter(inside).map(step).fold(0.0, f64::max);
        largest * (WEIGHT + coordinate(&solid.table.axes[axis]))
    };
    (0..3).map(along).sum()
}

/// How far each value may lie from that with f32 weights, with these changes of the channels. E
/// takes the first channel's change, or as a sum both; of a texel of loss and bias, B = E
/// (bias + (1-mu)^5) takes E's change times a bias + 1 of at most 2, and that of the bias, and
/// A = E - B adds E's own.
fn allowed(solid: &Solid, changes: [f64; 4], texel: [f32; 4], point: &Point) -> [f64; 3] {
    let [first, second, ..] = changes;
    let of = match solid.decode {
        // Of a deficit at most as much: what a smooth surface reflects is at most 1.
        Decode::Albedo | Decode::Loss | Decode::Deficit => [first, 0.0, 0.0],
        Decode::AzimuthCubic => [azimuth_bound(texel, point, &logarithms(point, changes)), 0.0, 0.0],
        Decode::SplitSum => [first + second, first, second],
        Decode::LossBias => [first, 3.0 * first + second, 2.0 * first + second],
        Decode::Transform | Decode::Light => panic!("no table of three axes"),
    };
    of.map(|x| x + ARITHMETIC)
}

/// WGSL's log2 is within 2^-21 of the exact value for an argument between 0.5 and 2, elsewhere
/// within 3 units in the last place, libm's within one. The arguments are off by those of q, 3
/// units of 1, and by 8 units of their own.
fn logarithms(point: &Point, channels: [f64; 4]) -> Differences {
    let q = f64::from(squash(surface(point)));
    let argument = (3.0 / q + 8.0) * ULP / std::f64::consts::LN_2;
    Differences { relative: 4.0 * ULP, absolute: 4.0 * ULP + argument, channels }
}

/// E, A and B in the arithmetic of tables.
fn reference(solid: &Solid, lookup: &Lookup, point: &Point) -> [f64; 3] {
    let (e, texel) = (lookup.at(point).e, lookup.texel(point));
    let x = 1.0 - point.mu;
    let values = match solid.decode {
        Decode::Albedo | Decode::Loss | Decode::Deficit | Decode::AzimuthCubic => [e, 0.0, 0.0],
        Decode::SplitSum => [e, texel[0], texel[1]],
        Decode::LossBias => {
            let b = e * (texel[1] + x * x * (x * x) * x);
            [e, e - b, b]
        }
        Decode::Transform | Decode::Light => panic!("no table of three axes"),
    };
    values.map(f64::from)
}

fn look_up(gpu: &Gpu, solid: &Solid, points: &[Point]) -> Vec<f32> {
    let readable = solid.readable();
    let value = if solid.values() == 1 { "vec4<f32>(value, 0.0, 0.0, 0.0)" } else { "vec4<f32>(value, 0.0)" };
    let source = format!(
        "{}
@group(0) @binding(0) var test_table: texture_3d<f32>;
@group(0) @binding(1) var test_sampler: sampler;
@group(0) @binding(2) var<storage, read> test_points: array<f32>;
@group(0) @binding(3) var<storage, read_write> test_values: array<vec4<f32>>;
@compute @workgroup_size({WORKGROUP}) fn test(@builtin(global_invocation_id) id: vec3<u32>) {{
    if (id.x >= arrayLength(&test_values)) {{ return; }}
    let at = 6u * id.x;
    let roughness = test_points[at]; let alpha = test_points[at + 1u]; let n_dot_v = test_points[at + 2u];
    let anisotropy = test_points[at + 3u]; let ior = test_points[at + 4u];
    let cos2_phi = test_points[at + 5u];
    let value = {}(test_table, test_sampler, {});
    test_values[id.x] = {value};
}}
",
        readable.print(Language::Wgsl).expect("printed"),
        readable.names.lookup,
        solid.arguments.join(", ")
    );
    let (view, sampler, buffer) = (gpu.texture(&solid.table), gpu.linear_clamp(), gpu.buffer(&bytes(points)));
    let resources = [
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
        buffer.as_entire_binding(),
    ];
    gpu.run(&gpu.module(&source), "test", &resources, points.len(), 4 * points.len())
}

#[test]
fn every_lookup_in_space_is_that_of_the_tables_measure() {
    let Some(gpu) = gpu() else { return };
    let points = points();
    for solid in to_look_up() {
        let found = look_up(&gpu, &solid, &points);
        let exact = Lookup::new(&solid.table, solid.decode).expect("three known axes");
        let coarse = exact.clone().with_weight_bits(8);
        let changes = [0, 1, 2, 3].map(|c| if c < solid.decode.channels() { change(&solid, c) } else { 0.0 });
        let (mut worst, mut share) = ([0.0_f64; 2], 0.0_f64);
        for (point, found) in points.iter().zip(found.chunks_exact(4)) {
            let allowed = allowed(&solid, changes, exact.texel(point), point);
            let references = [&exact, &coarse].map(|lookup| reference(&solid, lookup, point));
            for k in 0..3 {
                let gaps = references.map(|values| (f64::from(found[k]) - values[k]).abs());
                // Written so that a value that is not a number fails.
                assert!(
                    gaps[0] <= allowed[k],
                    "{} at {point:?}: {found:?}, {references:?}",
                    solid.table.name
                );
                worst = [worst[0].max(gaps[0]), worst[1].max(gaps[1])];
                share = share.max(gaps[0] / allowed[k]);
            }
        }
        say(&format!(
            "{} on {}: from the lookup with f32 weights at most {:.3e}, {:.0}% of what is allowed, with 8-bit weights {:.3e}",
            solid.table.name,
            gpu.name,
            worst[0],
            100.0 * share,
            worst[1]
        ));
    }
}

/// The colour functions, each channel by the bound of its factor: the product with f rounds once
/// more on either machine.
#[test]
fn the_compensations_are_those_of_rust_up_to_the_accuracy_of_wgsl() {
    let Some(gpu) = gpu() else { return };
    let texts =
        [Compensation::Reflection, Compensation::Glass].map(|c| c.print(Language::Wgsl).expect("printed"));
    let source = format!(
        "{}{}
@group(0) @binding(0) var<storage, read> test_points: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> test_values: array<vec4<f32>>;
@compute @workgroup_size({WORKGROUP}) fn reflection(@builtin(global_invocation_id) id: vec3<u32>) {{
    if (id.x >= arrayLength(&test_values)) {{ return; }}
    let p = test_points[id.x];
    test_values[id.x] = vec4<f32>(ggx_compensate_reflection(vec3<f32>(1.0), p.xyz, p.w), 0.0);
}}
@compute @workgroup_size({WORKGROUP}) fn glass(@builtin(global_invocation_id) id: vec3<u32>) {{
    if (id.x >= arrayLength(&test_values)) {{ return; }}
    let p = test_points[id.x];
    test_values[id.x] = vec4<f32>(ggx_compensate_glass(vec3<f32>(1.0), p.w), 0.0);
}}
",
        texts[0], texts[1]
    );
    let points: Vec<[f32; 4]> =
        (0..1000).map(|i| [0.0, 0.04, 1.0, 1e-3 + (i as f32 + 0.5) / 1001.0]).collect();
    let bytes: Vec<u8> = points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let (module, buffer) = (gpu.module(&source), gpu.buffer(&bytes));
    let functions = ["ggx_compensate_reflection_factor", "ggx_compensate_glass_factor"];
    for ((entry, text), function) in ["reflection", "glass"].into_iter().zip(&texts).zip(functions) {
        let factor = &text[text.find(&format!("fn {function}(")).expect("the factor")..];
        let factor = &factor[..factor.find("\n}\n").expect("its end") + 2];
        let factor = Hypothesis::parse("compensation", factor).unwrap_or_else(|e| panic!("{e}"));
        let resources = [buffer.as_entire_binding()];
        let found = gpu.run(&module, entry, &resources, points.len(), 4 * points.len());
        for (point, found) in points.iter().zip(found.chunks_exact(4)) {
            for c in 0..3 {
                let inputs: Vec<f32> = factor
                    .inputs()
                    .iter()
                    .map(|name| if name == "f0" { point[c] } else { point[3] })
                    .collect();
                let columns: Vec<Vec<f32>> = inputs.iter().map(|x| vec![*x]).collect();
                let expected = f64::from(factor.tape().evaluate::<f32>(&columns, &[]).expect("a value")[0]);
                let off = bound(factor.tape(), &inputs, &[], CPU) + bound(factor.tape(), &inputs, &[], WGSL);
                let gap = (f64::from(found[c]) - expected).abs();
                assert!(gap <= off, "{entry} {c} at {point:?}: {found:?}, {expected}, allowed {off:e}");
            }
        }
    }
    say(&format!("compensations on {}: {} points each within the accuracy of WGSL", gpu.name, points.len()));
}
