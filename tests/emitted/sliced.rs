//! The functions emitted for tables of three axes, and the compensations: rustc compiles and runs
//! the Rust, naga reads the WGSL.

use crate::emit_support;

use emit_support::compilers::{self, Contraction, includes_in_cpp, loops};
use emit_support::languages::{Called, FAMILY, compile, file, look_up};
use emit_support::programs::{compile_library, run};
use emit_support::say;
use emit_support::solid::{
    Differences, Solid, azimuth_bound, bytes, of_five_axes, points, surface, texel, to_look_up,
};
use lobefit::data::{Axis, Decode, Registration, Surface, Table, TexelFormat, Warp};
use lobefit::effects::table::{Lookup, Point};
use lobefit::emit::compensation::{self, Compensation, NAMES};
use lobefit::emit::lookup::Readable;
use lobefit_shade::code::{Language, TEXTURE_AXES, helpers};
use lobefit_shade::{Hypothesis, Precision};

/// Tables of three axes and of five.
fn looked_up() -> Vec<Solid> {
    to_look_up().into_iter().chain([of_five_axes()]).collect()
}

/// Every function of the tables and compensations.
fn all(language: Language, tables: &[Solid]) -> String {
    let header = ["A table.".to_string()];
    let mut text = String::new();
    for compensation in [Compensation::Reflection, Compensation::Glass] {
        text += &format!("\n{}", compensation.print(language).expect("printed"));
    }
    for solid in tables {
        let readable = Readable { header: &header, ..solid.readable() };
        text += &format!("\n{}", readable.print(language).expect("printed"));
    }
    format!("{}\n{text}", helpers(language, &text))
}

/// The Rust functions as a file.
fn rust(tables: &[Solid]) -> String {
    format!("//! A file.\n#![allow(dead_code)]\n\n{}", all(Language::Rust, tables))
}

/// Every WGSL function of them.
fn wgsl(tables: &[Solid]) -> String {
    let compensations =
        [Compensation::Reflection, Compensation::Glass].map(|c| c.print(Language::Wgsl).expect("printed"));
    let tables: Vec<String> =
        tables.iter().map(|solid| solid.readable().print(Language::Wgsl).expect("printed")).collect();
    [tables.join("\n"), compensations.join("\n")].join("\n")
}

#[test]
fn rustc_compiles_the_lookups_and_compensations_without_a_warning() {
    compile_library(&rust(&looked_up()));
}

#[test]
fn naga_validates_the_lookups_and_compensations() {
    let tables = to_look_up();
    let source = wgsl(&tables);
    let module =
        naga::front::wgsl::parse_str(&source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
    let arguments = |name: &str| -> Vec<String> {
        let function = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(name));
        let (_, function) = function.unwrap_or_else(|| panic!("no {name}"));
        function.arguments.iter().map(|a| a.name.clone().unwrap_or_default()).collect()
    };
    for solid in &tables {
        let name = solid.names.lookup.clone();
        assert_eq!(arguments(&name)[2..], *solid.arguments, "{name}");
        assert_eq!(solid.readable().inputs().expect("printed"), solid.arguments, "{name}");
        let uvw = arguments(&format!("{name}_uvw"));
        assert!(uvw.iter().all(|a| solid.arguments.contains(&a.as_str())), "{name}: {uvw:?}");
        let decode = arguments(&format!("{name}_decode"));
        let beside: &[&str] = match solid.decode {
            Decode::LossBias => &["n_dot_v"],
            Decode::AzimuthCubic => &["anisotropy", "cos2_phi"],
            Decode::Deficit => &["n_dot_v", "ior"],
            _ => &[],
        };
        assert_eq!(decode[0], "texel", "{name}");
        assert_eq!(decode[1..], *beside, "{name}");
    }
    for name in NAMES {
        arguments(name);
    }
}

/// What two axes need is computed once, and nothing is multiplied by 1.
#[test]
fn coordinates_name_what_they_share() {
    for solid in to_look_up() {
        for text in Language::ALL.map(|language| solid.readable().print(language).expect("printed")) {
            let body = text.split_once("_decode").expect("a decoding").0;
            let name = &solid.table.name;
            for shared in ["ior - 1.0,", "0.9 * anisotropy"] {
                assert!(body.matches(shared).count() <= 1, "{name}: {body}");
            }
            assert!(!body.contains("(1.0 * "), "{name}: {body}");
            assert!(!body.contains("* -") && !body.contains("+ -"), "{name}: {body}");
        }
    }
}

#[test]
fn a_table_in_f32_says_what_its_device_must_have() {
    for mut solid in to_look_up() {
        assert!(!solid.readable().print(Language::Wgsl).expect("printed").contains("float32-filterable"));
        solid.table.format = TexelFormat::F32;
        assert!(solid.readable().print(Language::Wgsl).expect("printed").contains("float32-filterable"));
    }
}

/// The logarithms of the platform's library and of libm are each within a unit in the last place of
/// the exact value.
const LOGARITHMS: Differences =
    Differences { relative: 2.0 * f32::EPSILON as f64, absolute: 0.0, channels: [0.0; 4] };

#[test]
fn the_rust_lookups_return_the_bits_that_are_measured() {
    let (tables, points) = (looked_up(), points());
    let mut body = String::new();
    for solid in &tables {
        let (name, channels) = (solid.names.lookup.clone(), solid.decode.channels());
        let texels = solid.table.size().iter().product();
        let at =
            |i: usize| solid.table.channels.iter().map(move |c| c.texels[i] as f32).collect::<Vec<f32>>();
        let (kind, list): (_, Vec<String>) = match channels {
            1 => ("f32".into(), (0..texels).map(|i| format!("{:?}", at(i)[0])).collect()),
            n => (format!("[f32; {n}]"), (0..texels).map(|i| format!("{:?}", at(i))).collect()),
        };
        let push = if solid.values() == 1 { "out.push(" } else { "out.extend(" };
        body += &format!(
            "    let texels: &[{kind}] = &[{}];\n    for &[roughness, alpha, n_dot_v, anisotropy, ior, cos2_phi] in &points {{\n        \
             let _ = (roughness, alpha, n_dot_v, anisotropy, ior, cos2_phi);\n        {push}lobefit::{name}(texels, {}));\n    }}\n",
            list.join(", "),
            solid.arguments.join(", ")
        );
    }
    let found = run(&rust(&tables), 6, &body, &bytes(&points));
    measured("rust", &tables, &points, found);
}

/// Inputs of a point, as [`bytes`] orders them.
const INPUTS: [&str; 6] = ["roughness", "alpha", "n_dot_v", "anisotropy", "ior", "cos2_phi"];

#[test]
fn the_lookups_of_the_other_languages_return_the_bits_that_are_measured() {
    let (tables, points) = (looked_up(), points());
    let lookups: Vec<Called> = tables.iter().map(called).collect();
    for language in FAMILY {
        let code = file(language, &all(language, &tables));
        let Some(found) = look_up(language, &code, &lookups, &INPUTS, &bytes(&points)) else { continue };
        measured(language.name(), &tables, &points, found);
    }
}

fn called(solid: &Solid) -> Called<'_> {
    Called {
        function: solid.names.lookup.clone(),
        arguments: solid.arguments.to_vec(),
        table: &solid.table,
        decode: solid.decode,
    }
}

#[test]
fn compilers_take_the_lookups_and_compensations() {
    let tables = to_look_up();
    for language in [Language::Hlsl, Language::Glsl] {
        let code = file(language, &all(language, &tables));
        // Three functions of each table, and two of each compensation.
        assert!(compile(language, &code).is_none_or(|functions| functions == 3 * tables.len() + 4));
    }
    includes_in_cpp(&file(Language::C, &all(Language::C, &tables)));
}

/// Compares what lookups returned with what is measured.
fn measured(language: &str, tables: &[Solid], points: &[Point], found: Vec<f32>) {
    let mut found = found.into_iter();
    let mut largest = [0.0_f64; 2];
    for solid in tables {
        let lookup = Lookup::new(&solid.table, solid.decode).expect("known axes");
        for point in points {
            let values: Vec<f32> = found.by_ref().take(solid.values()).collect();
            let expected = lookup.at(point).e;
            if solid.decode == Decode::AzimuthCubic {
                let allowed = azimuth_bound(lookup.texel(point), point, &LOGARITHMS);
                let off = (f64::from(values[0]) - f64::from(expected)).abs();
                assert!(off <= allowed, "{} at {point:?}: {values:?}, {expected}", solid.table.name);
                largest = [largest[0].max(off), largest[1].max(allowed)];
                continue;
            }
            if let Some(allowed) = several_fetches(&solid.table) {
                let off = (f64::from(values[0]) - f64::from(expected)).abs();
                assert!(off <= allowed, "{} at {point:?}: {values:?}, {expected}", solid.table.name);
                continue;
            }
            assert_eq!(
                values[0].to_bits(),
                expected.to_bits(),
                "{} at {point:?}: {values:?}",
                solid.table.name
            );
            if let [e, a, b] = values[..] {
                let texel = lookup.texel(point);
                let parts = match solid.decode {
                    Decode::SplitSum => [a == texel[0], b == texel[1]],
                    _ => [a == e - b, b == e * (texel[1] + fifth(1.0 - point.mu))],
                };
                assert_eq!(parts, [true, true], "{} at {point:?}: {values:?}", solid.table.name);
            }
        }
    }
    assert_eq!(found.count(), 0);
    say(&format!(
        "{language}: {} lookups in space, {} points each, every bit the same but of a logarithm and of several fetches: E within {:.1e} of {:.1e} allowed",
        tables.len(),
        points.len(),
        largest[0],
        largest[1]
    ));
}

/// A bound on what several fetches return beside one interpolation along all axes: the coordinate of the
/// slices of all of them is rounded four times on its way, at up to their number, between texels whose
/// values differ by less than 1, and sums and weights are rounded a few times besides.
fn several_fetches(table: &Table) -> Option<f64> {
    let slices = table.size()[2] as f64;
    (table.axes.len() > TEXTURE_AXES).then(|| (4.0 * slices + 16.0) * f64::from(f32::EPSILON))
}

/// x^5 as the decoding multiplies it.
fn fifth(x: f32) -> f32 {
    let x2 = x * x;
    x2 * x2 * x
}

/// What warps use of a point, in f64.
fn exact(point: &Point) -> Surface<f64> {
    let Surface { alpha, ior, anisotropy, cos2_phi } = surface(point);
    let [alpha, ior, anisotropy, cos2_phi] = [alpha, ior, anisotropy, cos2_phi].map(f64::from);
    Surface { alpha, ior, anisotropy, cos2_phi }
}

/// The point at which the axes' variables take the values of a texel's node.
fn node(solid: &Solid, place: [usize; 3]) -> Point {
    let mut point = Point { roughness: 0.5, alpha: 0.25, mu: 0.5, anisotropy: 0.5, ior: 1.5, cos2_phi: 0.3 };
    // The warp of the index of refraction uses alpha, and that of mu all others.
    for name in ["roughness", "anisotropy", "ior", "mu"] {
        let Some(k) = solid.table.axes.iter().position(|axis| axis.name == name) else { continue };
        let x = solid.table.axes[k].node(place[k], exact(&point)) as f32;
        match name {
            "roughness" => (point.roughness, point.alpha) = (x, x * x),
            "anisotropy" => point.anisotropy = x,
            "ior" => point.ior = x,
            _ => point.mu = x,
        }
    }
    point
}

/// How far the coordinate of texel `i` may lie from it, in texels: by its arithmetic, a few units
/// in the last place of a number up to 1, and by the rounding of the variable itself, which moves
/// an index of refraction next to 1 further.
fn near(axis: &Axis, i: usize, point: &Point) -> f64 {
    let x = match axis.name.as_str() {
        "roughness" => point.roughness,
        "anisotropy" => point.anisotropy,
        "ior" => point.ior,
        _ => point.mu,
    };
    let coordinate = axis.coordinate().expect("it parses");
    let at = |x: f32| f64::from(coordinate.at(x, surface(point), Precision::F32));
    let exact = axis.node(i, exact(point)) == f64::from(x);
    let rounding = if exact { 0.0 } else { (at(x.next_up()) - at(x)).abs() };
    (16.0 * f64::from(f32::EPSILON) + rounding) * axis.size as f64
}

#[test]
fn at_a_node_the_lookup_returns_its_texel() {
    for solid in to_look_up() {
        let lookup = Lookup::new(&solid.table, solid.decode).expect("three known axes");
        let size = solid.table.size();
        for i in 0..size.iter().product() {
            let place = [i % size[0], i / size[0] % size[1], i / size[0] / size[1]];
            // The homogeneous coordinate's end mu = 0 is a value too.
            let point = node(&solid, place);
            let found = lookup.texel(&point);
            // Steps between texels are below 1.
            let near: f64 = [0, 1, 2].map(|k| near(&solid.table.axes[k], place[k], &point)).iter().sum();
            assert!(near < 0.01, "{} {point:?}: {near}", solid.table.name);
            for c in 0..solid.decode.channels() {
                let expected = half::f16::from_f64(texel(c, place)).to_f64();
                let off = (f64::from(found[c]) - expected).abs();
                assert!(off <= near, "{} {place:?} {c}: {} {expected}", solid.table.name, found[c]);
            }
        }
    }
}

#[test]
fn the_registrations_warps_and_decodings_are_all_looked_up() {
    let tables = to_look_up();
    let axes: Vec<_> = tables.iter().flat_map(|solid| &solid.table.axes).collect();
    let warps = [
        Warp::Linear,
        Warp::Sqrt,
        Warp::Homogeneous,
        Warp::HomogeneousIor,
        Warp::HomogeneousAzimuth,
        Warp::Square,
        Warp::Ior,
        Warp::Aspect,
    ];
    for warp in warps {
        assert!(axes.iter().any(|axis| axis.warp == warp), "{warp:?}");
    }
    for decode in [Decode::Albedo, Decode::Loss, Decode::AzimuthCubic, Decode::SplitSum, Decode::LossBias] {
        assert!(tables.iter().any(|solid| solid.decode == decode), "{decode:?}");
    }
    for registration in [Registration::Centre, Registration::Endpoint] {
        assert!(axes.iter().any(|axis| axis.registration == registration), "{registration:?}");
    }
}

/// F0 and E of every pair of some values: colours of metals and dielectrics, albedos down to 1e-3.
fn pairs() -> Vec<[f32; 2]> {
    let f0 = [0.0_f32, 0.04, 0.5, 0.95, 1.0];
    let e = (0..=200).map(|i| 1e-3 + (1.0 - 1e-3) * i as f32 / 200.0);
    e.flat_map(|e| f0.map(|f0| [f0, e])).collect()
}

#[test]
fn compensated_energy_is_whole_and_its_colour_that_of_the_formula() {
    let pairs = pairs();
    let body = "    for &[f0, e] in &points {
        let f = [0.25, 0.5 * e, e];
        out.push(lobefit::ggx_compensate_reflection_factor(f0, e));
        out.extend(lobefit::ggx_compensate_reflection(f, [f0, 1.0, 0.0], e));
        out.push(lobefit::ggx_compensate_glass_factor(e));
        out.extend(lobefit::ggx_compensate_glass(f, e));
    }
";
    let points: Vec<u8> = pairs.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let found = run(&rust(&[]), 2, body, &points);
    // Four roundings, and the difference 1 - E rounds once more.
    let close = |a: f32, b: f64| (f64::from(a) - b).abs() <= 5.0 * f64::from(f32::EPSILON) * b.abs();
    for ([f0, e], v) in pairs.iter().zip(found.chunks_exact(8)) {
        let (f0, e) = (f64::from(*f0), f64::from(*e));
        let factor = |f0: f64| 1.0 + f0 * (1.0 - e) / e;
        let expected = [factor(f0), 0.25 * factor(f0), 0.5 * e * factor(1.0), e, 1.0 / e, 0.25 / e, 0.5, 1.0];
        for (found, expected) in v.iter().zip(expected) {
            assert!(close(*found, expected), "f0 {f0}, E {e}: {v:?}, {expected}");
        }
        // The furnace: E times the factor of a white metal, and of glass, is 1.
        assert!((e * f64::from(v[2]) / (0.5 * e) - 1.0).abs() < 1e-6);
        assert!((e * f64::from(v[4]) - 1.0).abs() < 1e-6);
    }
    // E = 1 changes nothing, to the bit.
    let whole = pairs.iter().zip(found.chunks_exact(8)).filter(|([_, e], _)| *e == 1.0);
    assert!(whole.map(|(_, v)| assert_eq!(v, [1.0, 0.25, 0.5, 1.0, 1.0, 0.25, 0.5, 1.0])).count() > 0);
}

#[test]
fn every_language_compensates_to_the_same_bits() {
    let points: Vec<u8> = pairs().iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let body = "    for &[f0, e] in &points {
        out.push(lobefit::ggx_compensate_reflection_factor(f0, e));
        out.extend(lobefit::ggx_compensate_reflection([0.25, 0.5 * e, e], [f0, 1.0, 0.0], e));
        out.push(lobefit::ggx_compensate_glass_factor(e));
        out.extend(lobefit::ggx_compensate_glass([0.25, 0.5 * e, e], e));
    }
";
    let expected = run(&rust(&[]), 2, body, &points);
    for (language, vector) in FAMILY.into_iter().zip(["float3", "vec3", "float3", "lobefit_float3"]) {
        let three = |name: &str, x: &str, y: &str, z: &str| match language {
            Language::C => format!("        const {vector} {name} = {{{x}, {y}, {z}}};\n"),
            _ => format!("        const {vector} {name}({x}, {y}, {z});\n"),
        };
        let put = |v: &str| format!("        put({v}.x);\n        put({v}.y);\n        put({v}.z);\n");
        let body = [
            three("f", "0.25f", "0.5f * p[1]", "p[1]"),
            three("f0", "p[0]", "1.0f", "0.0f"),
            format!("        const {vector} a = ggx_compensate_reflection(f, f0, p[1]);\n"),
            format!("        const {vector} b = ggx_compensate_glass(f, p[1]);\n"),
            "        put(ggx_compensate_reflection_factor(p[0], p[1]));\n".to_string(),
            put("a"),
            "        put(ggx_compensate_glass_factor(p[1]));\n".to_string(),
            put("b"),
        ];
        let (code, main) = (file(language, &all(language, &[])), loops(2, &[body.concat()]));
        let Some(found) = compilers::run(language, &code, &main, &points, Contraction::Off) else { continue };
        let same = expected.iter().zip(&found).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same && found.len() == expected.len(), "{}", language.title());
    }
}

#[test]
fn the_factors_in_wgsl_have_the_bits_of_those_in_rust() {
    let pairs = pairs();
    let points: Vec<u8> = pairs.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let body = "    for &[f0, e] in &points {
        out.push(lobefit::ggx_compensate_reflection_factor(f0, e));
        out.push(lobefit::ggx_compensate_glass_factor(e));
    }
";
    let found = run(&rust(&[]), 2, body, &points);
    let names = ["ggx_compensate_reflection_factor", "ggx_compensate_glass_factor"];
    for (k, (compensation, name)) in
        [Compensation::Reflection, Compensation::Glass].into_iter().zip(names).enumerate()
    {
        let text = compensation.print(Language::Wgsl).expect("printed");
        let function = &text[text.find(&format!("fn {name}(")).expect("the function")..];
        let function = function.split("\n///").next().expect("its text");
        let read = Hypothesis::parse("compensation", function).unwrap_or_else(|e| panic!("{e}"));
        let columns: Vec<Vec<f32>> = read
            .inputs()
            .iter()
            .map(|input| pairs.iter().map(|[f0, e]| if input == "f0" { *f0 } else { *e }).collect())
            .collect();
        let values = read.tape().evaluate::<f32>(&columns, &[]).expect("values");
        for (i, value) in values.iter().enumerate() {
            assert_eq!(value.to_bits(), found[2 * i + k].to_bits(), "{name} at {:?}", pairs[i]);
        }
    }
}

#[test]
fn a_compensation_is_emitted_for_the_quantities_that_call_for_it() {
    use Compensation::{Glass, Reflection};
    assert_eq!(compensation::of(["ggx-glass", "ggx-glass"]), [Glass]);
    assert_eq!(
        compensation::of(["ggx-glass", "ggx-reflection-aniso", "ggx-reflection"]),
        [Reflection, Glass]
    );
    assert_eq!(compensation::of(["sheen-charlie", "ggx-average"]), []);
    for name in NAMES {
        let texts = [Reflection, Glass]
            .map(|c| [Language::Rust, Language::Wgsl].map(|l| c.print(l).expect("printed")));
        let holds = |text: &str| text.contains(&format!("fn {name}("));
        assert_eq!(texts.iter().filter(|[rust, wgsl]| holds(rust) && holds(wgsl)).count(), 1, "{name}");
    }
}
