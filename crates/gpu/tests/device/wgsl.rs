//! The emitted WGSL where shaders run: every function and every table lookup on a Vulkan device,
//! against the f32 values that were certified.

use crate::emit_support;
use crate::gpu_support;

use emit_support::accuracy::{CPU, WGSL, bound, divides};
use emit_support::{Looked, Points, TRUTH, baked_tables, emitted, other_tables, say, text};
use gpu_support::device::{Gpu, WORKGROUP};
use gpu_support::gpu;
use lobefit::approximate::{Fit, Memo, place};
use lobefit::data::Use;
use lobefit::effects::Albedo;
use lobefit::effects::table::{self, Lookup};
use lobefit_shade::code::Language;
use lobefit_truth::quantity::COUPLING;

/// Classes of functions, and the most units in the last place that may lie between the CPU and any
/// device that keeps to WGSL: the largest bound of [`emit_support::accuracy`] over the functions
/// and points, which the test computes and compares. What is asserted at each point is that point's
/// own bound; these figures say how much it leaves.
const CLASSES: [(&str, f64); 4] = [
    // One plus a product whose factors are sums of up to five terms that cancel in part, in
    // Horner's form; rounded once more.
    ("normalisation without division", 48.0),
    // N - 1 carries 3 units of the division, and the roundings of a divisor whose terms cancel, up
    // to the factor by which they do; nested sums cancel from up to 13 terms, powers of one ratio with
    // factors up to 85 (`ggx_norm_i19`): 3e-5 beside an error of 2e-3.
    ("normalisation with division", 428.0),
    // 1 - E_avg is a sum of terms up to 5 that cancel to 0.6, and E_avg = 0.4 at alpha = 1 counts
    // in smaller units.
    ("average", 72.0),
    // A share of light that goes to 0 with mu: in units of the last place of 1.
    ("coupling factor, of 1", 32.0),
];

/// Index of a fit's class.
fn class(fit: &Fit) -> usize {
    match (fit.approximation.used_as, divides(fit.hypothesis.tape())) {
        (Use::NORMALISATION, false) => 0,
        (Use::NORMALISATION, true) => 1,
        (COUPLING, _) => 3,
        _ => 2,
    }
}

/// Reads the point of an invocation: roughness, alpha, mu, f0.
fn entry(name: &str, call: &str, value: &str) -> String {
    format!(
        "@compute @workgroup_size({WORKGROUP}) fn {name}(@builtin(global_invocation_id) id: vec3<u32>) {{
    if (id.x >= arrayLength(&test_points)) {{ return; }}
    let point = test_points[id.x];
    let roughness = point.x; let alpha = point.y; let mu = point.z; let f0 = point.w;
    let value = {call};
    test_values[id.x] = {value};
}}
"
    )
}

/// Distance in units in the last place of the reference.
fn ulps(gap: f64, reference: f32) -> f64 {
    let x = reference.abs();
    gap / f64::from(x.next_up() - x)
}

#[test]
fn every_function_returns_what_was_certified_up_to_the_accuracy_of_wgsl() {
    let Some(gpu) = gpu() else { return };
    let functions = emitted();
    let mut source = text("fits/lobefit.wgsl");
    source += "@group(0) @binding(0) var<storage, read> test_points: array<vec4<f32>>;\n";
    source += "@group(0) @binding(1) var<storage, read_write> test_values: array<f32>;\n";
    for (_, name, inputs) in &functions {
        source += &entry(&format!("test_{name}"), &format!("{name}({})", inputs.join(", ")), "value");
    }
    let (module, points) = (gpu.module(&source), Points::of_fits());
    let buffer = gpu.buffer(&points.bytes());
    let mut worst = CLASSES.map(|_| Worst::default());
    for (fit, name, inputs) in &functions {
        let resources = [buffer.as_entire_binding()];
        let found = gpu.run(&module, &format!("test_{name}"), &resources, points.len(), points.len());
        let (tape, coefficients) = (fit.hypothesis.tape(), fit.coefficients());
        for (i, (reference, found)) in points.values(fit, inputs).into_iter().zip(found).enumerate() {
            let at: Vec<f32> = inputs.iter().map(|input| points.column(input)[i]).collect();
            let allowed = bound(tape, &at, &coefficients, CPU) + bound(tape, &at, &coefficients, WGSL);
            let gap = (f64::from(found) - f64::from(reference)).abs();
            let place = || format!("{name} at {inputs:?} = {at:?}");
            // Written so that a value that is not a number fails.
            assert!(gap <= allowed, "{}: {reference}, on the device {found}, allowed {allowed:e}", place());
            let unit = if class(fit) == 3 { 1.0 } else { reference };
            worst[class(fit)].take(ulps(gap, unit), ulps(allowed, unit), &place);
        }
    }
    say(&format!("wgsl on {}: {} functions, {} points each", gpu.name, functions.len(), points.len()));
    for (worst, (class, limit)) in worst.iter().zip(CLASSES) {
        say(&format!("  {class}: worst {:.2} ulp, {}", worst.found, worst.at));
        say(&format!("  {class}: allowed up to {:.2} ulp, {}", worst.allowed, worst.allowed_at));
        assert!(worst.allowed <= limit, "{class}: {limit} ulp is not a bound: {}", worst.allowed);
    }
}

/// The largest distance found, and the largest allowed, in units in the last place.
#[derive(Default)]
struct Worst {
    found: f64,
    at: String,
    allowed: f64,
    allowed_at: String,
}

impl Worst {
    fn take(&mut self, found: f64, allowed: f64, place: &dyn Fn() -> String) {
        if found > self.found {
            (self.found, self.at) = (found, place());
        }
        if allowed > self.allowed {
            (self.allowed, self.allowed_at) = (allowed, place());
        }
    }
}

/// A texture unit keeps 8 bits of an interpolation weight, rounded or cut off: it is within one
/// step of the exact weight.
const WEIGHT: f64 = 1.0 / 256.0;

/// Beside the weights, f32 arithmetic: up to 16 roundings of values in [0, 1] in filter and
/// decoding.
const DECODING: f64 = 16.0 / 16_777_216.0;

/// And in the coordinate: 8 ulp of a number up to 1, in texels of a table of `n`.
fn coordinate(n: usize) -> f64 {
    8.0 / 8_388_608.0 * n as f64
}

/// Largest change from one texel to the next, along columns and along rows together.
fn step(table: &Looked, channel: usize) -> f64 {
    let (columns, texels) = (table.table.axes[0].size, &table.table.channels[channel].texels);
    let largest = |pairs: &mut dyn Iterator<Item = (f64, f64)>| {
        pairs.fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()))
    };
    let along = largest(&mut texels.chunks(columns).flat_map(|row| row.windows(2)).map(|w| (w[0], w[1])));
    let across = largest(&mut texels.iter().zip(&texels[columns..]).map(|(a, b)| (*a, *b)));
    along + across
}

/// How far E, A and B of a lookup on a device may lie from those with f32 weights: a change of the
/// weights moves a channel by at most as much of its step. E takes the first channel's change or,
/// as a sum, both; B = E (bias + (1-mu)^5) that of E and of the bias, since bias + (1-mu)^5 = B/E
/// <= 1; A = E - B both of these.
fn allowed(table: &Looked) -> f64 {
    let size = table.table.axes.iter().map(|axis| axis.size).max().unwrap_or(0);
    let first = step(table, 0);
    let steps = if table.split() { 2.0 * first + step(table, 1) } else { first };
    (WEIGHT + coordinate(size)) * steps + DECODING
}

/// E, A and B at every point by the emitted `_lookup`, or E alone.
fn look_up(gpu: &Gpu, include: &str, table: &Looked, points: &Points) -> Vec<[f32; 4]> {
    let name = &table.names.lookup;
    let mut source = include.to_string();
    source += "@group(0) @binding(0) var test_table: texture_2d<f32>;\n";
    source += "@group(0) @binding(1) var test_sampler: sampler;\n";
    source += "@group(0) @binding(2) var<storage, read> test_points: array<vec4<f32>>;\n";
    source += "@group(0) @binding(3) var<storage, read_write> test_values: array<vec4<f32>>;\n";
    let value = if table.split() { "vec4<f32>(value, 0.0)" } else { "vec4<f32>(value, 0.0, 0.0, 0.0)" };
    let call = format!("{name}(test_table, test_sampler, roughness, mu)");
    source += &entry("test", &call, value);
    let (view, sampler) = (gpu.texture(&table.table), gpu.linear_clamp());
    let buffer = gpu.buffer(&points.bytes());
    let resources = [
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
        buffer.as_entire_binding(),
    ];
    let values = gpu.run(&gpu.module(&source), "test", &resources, points.len(), 4 * points.len());
    values.chunks_exact(4).map(|v| [v[0], v[1], v[2], v[3]]).collect()
}

/// The largest error of one lookup's values, over the points.
fn largest(points: &Points, error: impl Fn(usize) -> f64) -> (f64, usize) {
    (0..points.len()).fold((0.0, 0), |(worst, at), i| {
        let e = error(i);
        // A value that is not a number is the worst, and stays it.
        if worst.is_nan() || e <= worst { (worst, at) } else { (e, i) }
    })
}

fn check(gpu: &Gpu, include: &str, table: &Looked) {
    let points = Points::of(&table.region);
    let found = look_up(gpu, include, table, &points);
    let split = table.split();
    let places = table::LookupPoints::isotropic(&points.set).all;
    let against = |lookup: &Lookup| {
        largest(&points, |i| {
            let values = lookup.at(&places[i]);
            let (of_e, of_b) = (f64::from(values.e), f64::from(values.b.unwrap_or(0.0)));
            let [e, a, b, _] = found[i].map(f64::from);
            let gaps = [e - of_e, b - of_b, a - (of_e - of_b)];
            gaps.iter().take(if split { 3 } else { 1 }).fold(0.0, |worst, gap| beyond(worst, gap.abs()))
        })
    };
    let (exact, at) = against(&table.lookup());
    let (coarse, _) = against(&table.lookup().with_weight_bits(8));
    let truth = Albedo::new(table.table.smith.expect("a form"), &points.set, true, &Memo::default())
        .expect("a truth");
    let (error, worst) = largest(&points, |i| {
        let [e, _, b, _] = found[i].map(f64::from);
        let (e, b) = ((e - truth.e[i]).abs(), (b - truth.b[i]).abs());
        if split { beyond(e, b) } else { e }
    });
    let [certified, certified_8_bit] = table.certified;
    let name = &table.names.lookup;
    say(&format!(
        "{name} on {}: error {error:.4e}, certified {certified} and {certified_8_bit} with 8-bit weights; from the \
         lookup with f32 weights at most {exact:.3e}, with 8-bit weights {coarse:.3e}",
        gpu.name
    ));
    let limit = certified.max(certified_8_bit) + TRUTH + DECODING;
    assert!(error <= limit, "{name} at {:?}: error {error}, limit {limit}", place(&points.set, worst));
    let limit = allowed(table);
    assert!(exact <= limit, "{name} at {:?}: off by {exact}, limit {limit}", place(&points.set, at));
}

/// The larger; not a number if either is none.
fn beyond(a: f64, b: f64) -> f64 {
    if a <= b || b.is_nan() { b } else { a }
}

#[test]
fn every_lookup_is_within_its_certificate() {
    let Some(gpu) = gpu() else { return };
    let (include, baked) = (text("fits/lobefit.wgsl"), baked_tables());
    assert!(!baked.is_empty());
    for table in baked {
        check(&gpu, &include, &table);
    }
    for table in other_tables() {
        check(&gpu, &table.readable().print(Language::Wgsl).expect("printed"), &table);
    }
}
