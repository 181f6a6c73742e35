//! The emitted files in the hands of others: naga reads the WGSL, rustc compiles and runs the Rust,
//! OpenEXR reads the tables.

use crate::emit_support;

use std::fs;

use emit_support::accuracy::{CPU, bound};
use emit_support::compilers::{self, Contraction, includes_in_cpp, loops};
use emit_support::languages::{self, Called, FAMILY, compile, file};
use emit_support::programs::{READ_EXR, compile_library, python, run};
use emit_support::{
    Looked, Points, baked, baked_tables, emitted, functions, manifest, module, other_tables, say, text,
};
use lobefit::approximate::{Fit, place};
use lobefit::effects::coupling::emitted as coupling;
use lobefit::effects::parallax::PREFIX;
use lobefit::effects::table;
use lobefit::emit::compensation::NAMES;
use lobefit_shade::Hypothesis;
use lobefit_shade::code::Language;
use lobefit_shade::code::helpers;

#[test]
fn naga_validates_the_whole_wgsl_file_and_finds_the_functions_of_the_manifest() {
    let source = text("fits/lobefit.wgsl");
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string_with_path(&source, "fits/lobefit.wgsl")));
    let flags = naga::valid::ValidationFlags::all();
    naga::valid::Validator::new(flags, naga::valid::Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string_with_path(&source, "fits/lobefit.wgsl")));
    let f32 = |ty: naga::Handle<naga::Type>| module.types[ty].inner.scalar() == Some(naga::Scalar::F32);
    let all = emitted();
    assert!(all.len() > 30, "{} functions", all.len());
    for (_, name, inputs) in all {
        let named = |f: &&naga::Function| f.name.as_deref() == Some(&name);
        let function = module.functions.iter().map(|(_, f)| f).find(named);
        let function = function.unwrap_or_else(|| panic!("no {name}"));
        let arguments: Vec<&str> =
            function.arguments.iter().map(|a| a.name.as_deref().unwrap_or_default()).collect();
        assert_eq!(arguments, inputs, "{name}");
        assert!(function.arguments.iter().all(|a| f32(a.ty)), "{name}: f32 arguments");
        assert!(function.result.as_ref().is_some_and(|r| f32(r.ty)), "{name}: f32 result");
    }
}

#[test]
fn the_wgsl_functions_read_back_have_the_bits_that_were_certified() {
    let (source, points, all) = (text("fits/lobefit.wgsl"), Points::of_fits(), emitted());
    let functions = functions(&source);
    for (fit, name, inputs) in &all {
        let read = Hypothesis::parse("fits/lobefit.wgsl", &module(name, &functions));
        let read = read.unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!((read.name(), read.inputs()), (name.as_str(), inputs.as_slice()));
        assert!(read.parameters().is_empty(), "{name}");
        let columns: Vec<Vec<f32>> = inputs.iter().map(|input| points.column(input).to_vec()).collect();
        let found = read.tape().evaluate::<f32>(&columns, &[]).expect("values");
        same_bits(name, &points, &points.values(fit, inputs), &found);
    }
    // What the manifest does not list as fits are the tables' reading functions, which are outside
    // the dialect, the compensations, and what puts a base under a lobe, and the lookups of probes.
    let manifest = manifest();
    let tables = manifest["tables"].as_array().expect("tables[]").iter();
    let lookups: Vec<&str> = tables.map(|table| table["function"].as_str().expect("a name")).collect();
    let parts = ["_uv", "_uvw", "_decode"];
    let reading = |name: &str| {
        let stem = parts.iter().find_map(|part| name.strip_suffix(part)).unwrap_or(name);
        lookups.iter().any(|lookup| lookup.starts_with(stem))
    };
    let around: Vec<String> = coupling::names().collect();
    let listed = |name: &str| {
        let fit = name.strip_suffix("_rgb").unwrap_or(name);
        let known = all.iter().any(|(_, known, _)| known == fit);
        known || name.starts_with(PREFIX) || NAMES.contains(&name) || around.iter().any(|known| known == name)
    };
    let others: Vec<&&str> = functions.keys().filter(|name| !listed(name) && !reading(name)).collect();
    assert!(others.is_empty(), "{others:?}");
    let (count, n) = (all.len(), points.len());
    say(&format!("wgsl: {count} functions read back, {n} points each, every bit the same"));
}

#[test]
fn rustc_compiles_the_rust_file_alone_without_a_warning() {
    compile_library(&text("fits/lobefit.rs"));
}

#[test]
fn the_rust_functions_return_the_bits_that_were_certified() {
    let (points, functions) = (Points::of_fits(), emitted());
    let body: String = functions
        .iter()
        .map(|(_, name, inputs)| {
            let inputs = inputs.join(", ");
            format!(
                "    for &[roughness, alpha, mu, f0] in &points {{\n        let _ = (roughness, alpha, mu, f0);\n        \
                 out.push(lobefit::{name}({inputs}));\n    }}\n"
            )
        })
        .collect();
    let found = run(&text("fits/lobefit.rs"), 4, &body, &points.bytes());
    assert_eq!(found.len(), functions.len() * points.len());
    for ((fit, name, inputs), found) in functions.iter().zip(found.chunks_exact(points.len())) {
        same_bits(name, &points, &points.values(fit, inputs), found);
        certified_values(fit, &points, inputs);
    }
    say(&format!("rust: {} functions, {} points each, every bit the same", functions.len(), points.len()));
}

#[test]
fn compilers_take_the_files_of_the_other_languages() {
    for language in [Language::Hlsl, Language::Glsl] {
        let code = text(&include(language));
        assert!(compile(language, &code).is_none_or(|functions| functions > 70));
    }
    includes_in_cpp(&text(&include(Language::C)));
}

fn include(language: Language) -> String {
    format!("fits/lobefit.{}", language.extension())
}

/// A call of a function at a point `p`.
fn call(name: &str, inputs: &[String]) -> String {
    let index = |input: &String| ["roughness", "alpha", "mu", "f0"].iter().position(|name| name == input);
    let arguments: Vec<String> =
        inputs.iter().map(|i| format!("p[{}]", index(i).expect("an input"))).collect();
    format!("        put({name}({}));\n", arguments.join(", "))
}

#[test]
fn the_functions_of_the_other_languages_return_the_bits_that_were_certified() {
    let (points, functions) = (Points::of_fits(), emitted());
    let bodies: Vec<String> = functions.iter().map(|(_, name, inputs)| call(name, inputs)).collect();
    for language in FAMILY {
        let (code, main) = (text(&include(language)), loops(4, &bodies));
        let found = compilers::run(language, &code, &main, &points.bytes(), Contraction::Off);
        let Some(found) = found else { continue };
        assert_eq!(found.len(), functions.len() * points.len());
        for ((fit, name, inputs), found) in functions.iter().zip(found.chunks_exact(points.len())) {
            same_bits(name, &points, &points.values(fit, inputs), found);
        }
        let (title, count, n) = (language.name(), functions.len(), points.len());
        say(&format!("{title}: {count} functions, {n} points each, every bit the same"));
    }
}

/// With both roundings in one, a product and a sum are nearer to the exact value, and so within the
/// same bound of it.
#[test]
fn c_that_is_contracted_stays_within_the_bound_of_its_roundings() {
    let (points, functions) = (Points::of_fits(), emitted());
    let bodies: Vec<String> = functions.iter().map(|(_, name, inputs)| call(name, inputs)).collect();
    let (code, main) = (text(&include(Language::C)), loops(4, &bodies));
    let found = compilers::run(Language::C, &code, &main, &points.bytes(), Contraction::Fast);
    let Some(found) = found else { return };
    let mut worst = (0.0, "none");
    for ((fit, name, inputs), found) in functions.iter().zip(found.chunks_exact(points.len())) {
        for (i, (expected, found)) in points.values(fit, inputs).into_iter().zip(found).enumerate() {
            let at: Vec<f32> = inputs.iter().map(|input| points.column(input)[i]).collect();
            let allowed = 2.0 * bound(fit.hypothesis.tape(), &at, &fit.coefficients(), CPU);
            let gap = (f64::from(expected) - f64::from(*found)).abs();
            assert!(gap <= allowed, "{name} at {at:?}: {expected}, contracted {found}, allowed {allowed:e}");
            let ulps = gap / f64::from(expected.abs().next_up() - expected.abs());
            if ulps > worst.0 {
                worst = (ulps, name);
            }
        }
    }
    let (count, n) = (functions.len(), points.len());
    say(&format!("c, contracted: {count} functions, {n} points each: worst {:.2} ulp, {}", worst.0, worst.1));
}

/// Looks tables up with the emitted code of C's family at every point.
fn look_up_elsewhere(language: Language, code: &str, tables: &[Looked]) {
    for table in tables {
        let (readable, points) = (table.readable(), Points::of(&table.region));
        let lookup = Called {
            function: readable.names.lookup.clone(),
            arguments: readable.inputs().expect("printed"),
            table: readable.table,
            decode: readable.decode,
        };
        let inputs = ["roughness", "alpha", "n_dot_v", "f0"];
        let Some(found) = languages::look_up(language, code, &[lookup], &inputs, &points.bytes()) else {
            return;
        };
        looked_up(language.name(), table, &points, &found);
    }
}

#[test]
fn the_lookups_of_the_other_languages_return_the_bits_that_were_certified() {
    let (baked, others) = (baked_tables(), other_tables());
    for language in FAMILY {
        look_up_elsewhere(language, &text(&include(language)), &baked);
        let lookups: String =
            others.iter().map(|table| table.readable().print(language).expect("printed")).collect();
        let code = file(language, &format!("{}{lookups}", helpers(language, &lookups)));
        look_up_elsewhere(language, &code, &others);
    }
}

fn same_bits(name: &str, points: &Points, expected: &[f32], found: &[f32]) {
    for (i, (a, b)) in expected.iter().zip(found).enumerate() {
        let place = || format!("{name} at {:?}, f0 {}", place(&points.set, i), points.column("f0")[i]);
        assert!(a.is_finite() && a.to_bits() == b.to_bits(), "{}: {a:?}, as emitted {b:?}", place());
    }
}

/// `Fit::values`, which certificates and pictures are made with, is what was compared, but for its
/// f0 = 1.
fn certified_values(fit: &Fit, points: &Points, inputs: &[String]) {
    let ones = points.at_f0(1.0);
    let values = fit.values(&points.set).expect("values");
    assert!(values == ones.values(fit, inputs), "{}", fit.approximation.name);
}

/// Looks a table up with the emitted Rust at every point; its texels are given as the EXR holds
/// them, and compared to the bit.
fn look_up(include: &str, table: &Looked) {
    let (name, points) = (&table.names.lookup, Points::of(&table.region));
    let channel = |c: usize| table.table.channels[c].texels.iter().map(|t| *t as f32).collect::<Vec<f32>>();
    let split = table.split();
    let (texels, push) = if split {
        let texels: Vec<[f32; 2]> =
            channel(0).into_iter().zip(channel(1)).map(|(first, second)| [first, second]).collect();
        (format!("&{texels:?}"), "out.extend(")
    } else {
        (format!("&{:?}", channel(0)), "out.push(")
    };
    let kind = if split { "[f32; 2]" } else { "f32" };
    let body = format!(
        "    let texels: &[{kind}] = {texels};\n    for &[roughness, _, mu, _] in &points {{\n        \
         {push}lobefit::{name}(texels, roughness, mu));\n    }}\n"
    );
    looked_up("rust", table, &points, &run(include, 4, &body, &points.bytes()));
}

/// Compares what a lookup returned with what was certified.
fn looked_up(language: &str, table: &Looked, points: &Points, found: &[f32]) {
    let (name, split) = (&table.names.lookup, table.split());
    let width = if split { 3 } else { 1 };
    assert_eq!(found.len(), width * points.len());
    let (lookup, places) = (table.lookup(), table::LookupPoints::isotropic(&points.set).all);
    for (i, found) in found.chunks_exact(width).enumerate() {
        let expected = lookup.at(&places[i]);
        let same = match found {
            [e, a, b] => table.agrees([*e, *a, *b], expected),
            _ => found[0].to_bits() == expected.e.to_bits(),
        };
        assert!(same, "{name} at {:?}: {expected:?}, as emitted {found:?}", place(&points.set, i));
    }
    say(&format!("{language}: {name}, {} points, every bit the same", points.len()));
}

#[test]
fn the_rust_lookups_return_the_bits_that_were_certified() {
    let baked = baked_tables();
    assert!(!baked.is_empty());
    for table in baked {
        look_up(&text("fits/lobefit.rs"), &table);
    }
    for table in other_tables() {
        let mut readable = table.readable();
        let header = ["A table.".to_string()];
        readable.header = &header;
        let lookup = readable.print(Language::Rust).expect("printed");
        look_up(&format!("{lookup}\n{}", helpers(Language::Rust, &lookup)), &table);
    }
}

#[test]
fn openexr_reads_the_texels_and_the_header() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = manifest();
    let tables = baked_tables();
    for (looked, entry) in tables.iter().zip(manifest["tables"].as_array().unwrap()) {
        let (table, file) = (&looked.table, entry["file"].as_str().unwrap());
        let path = folder.path().join("table.exr");
        fs::write(&path, &baked().0.files[file]).unwrap();
        let Some(read) = python(READ_EXR, &path) else { return };
        assert_eq!(read["name"], table.name.as_str());
        let header = read["lobefit"].as_str().unwrap();
        assert!(header.contains("lobefit bake") && header.contains("max"), "{header}");
        let channels = read["channels"].as_object().unwrap();
        assert_eq!(channels.len(), table.channels.len(), "{file}");
        for (channel, name) in table.channels.iter().zip(entry["channels"].as_array().unwrap()) {
            assert_eq!(name, channel.name.as_str());
            let found = &channels[&channel.name];
            assert_eq!(found["type"], "float16", "{file} {name}");
            let rows: Vec<Vec<f64>> = serde_json::from_value(found["rows"].clone()).unwrap();
            assert_eq!((rows.len(), rows[0].len()), (table.axes[1].size, table.axes[0].size), "{file}");
            assert!(rows.concat() == channel.texels, "{file}, channel {name}: other texels");
        }
    }
    say(&format!("openexr: {} tables, every texel the same", tables.len()));
}
