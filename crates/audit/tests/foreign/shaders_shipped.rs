//! Shader functions in files as engines ship them: include files, macros, conditions, imports and
//! overloads around the function that is meant.

use std::fs;
use std::path::{Path, PathBuf};

use lobefit_audit::foreign::{ForeignError, ShaderFunction, Surroundings, read_functions};

/// A folder of files.
struct Tree(tempfile::TempDir);

impl Tree {
    fn new(files: &[(&str, &str)]) -> Tree {
        let tree = Tree(tempfile::tempdir().unwrap());
        for (name, text) in files {
            let path = tree.path(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        tree
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A function of one of its files.
    fn read(&self, file: &str, entry: &str, around: &[&str]) -> Result<Vec<ShaderFunction>, ForeignError> {
        let (includes, defines): (Vec<&str>, Vec<&str>) = around.iter().partition(|a| a.starts_with('/'));
        let includes = includes.into_iter().map(|i| self.path(&i[1..])).collect();
        let defines = defines.into_iter().map(String::from).collect();
        let path = self.path(file);
        let bytes = fs::read(&path).unwrap();
        read_functions(&bytes, &path.to_string_lossy(), Some(entry), &Surroundings { defines, includes })
    }

    fn one(&self, file: &str, entry: &str, around: &[&str]) -> ShaderFunction {
        let mut found = self.read(file, entry, around).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(found.len(), 1, "{entry}");
        found.remove(0)
    }

    /// Why it cannot be read, folders of this machine left out.
    fn refused(&self, file: &str, entry: &str, around: &[&str]) -> String {
        let error = self.read(file, entry, around).expect_err(entry).to_string();
        let real = fs::canonicalize(self.0.path()).unwrap();
        let bare = |path: &Path| format!("{}/", path.display());
        error.replace(&bare(&real), "").replace(&bare(self.0.path()), "")
    }
}

fn at(function: &ShaderFunction, inputs: &[f32]) -> f32 {
    function.at(inputs).expect("it is run")[0]
}

/// A chunk in the manner of a library of scripts: macros and helpers are in another chunk, some
/// functions stand under conditions, a structure is in no file at all.
const CHUNK: &str = "export default /* glsl */`
uniform sampler2D lut;
#include <basics>
#ifdef USE_SHEEN
    float sheen( const in float cosine, const in float rough ) { return RECIPROCAL_PI * cosine * rough; }
#endif
float visibility( const in float alpha, const in float l, const in float v ) {
    highp float a2 = square( alpha );
    #if defined( FAST ) && QUALITY >= 2
        return 0.5 / mix( 2.0 * l * v, l + v, alpha );
    #elif QUALITY == 1
        return a2;
    #else
        return saturate( a2 + l ) * whiteComplement( v );
    #endif
}
float lookup( vec2 uv ) { return texture2D( lut, uv ).x; }
void light( const in Nowhere light, inout Reflected out_ ) { out_.x = light.y * unknown( 1.0 ); }
float wrong( float x ) { return nowhere( x ) + lookup( vec2( x ) ); }
`;
";
const BASICS: &str = "export default `
#define RECIPROCAL_PI 0.25
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float square( const in float x ) { return x*x; }
vec3 square( const in vec3 x ) { return x*x; }
`;";

#[test]
fn a_chunk_is_read_with_its_chunks_and_macros() {
    let tree = Tree::new(&[("chunks/light.glsl.js", CHUNK), ("chunks/basics.glsl.js", BASICS)]);
    let of = |around: &[&str]| {
        let function = tree.one("chunks/light.glsl.js", "visibility", &[&["/chunks"], around].concat());
        at(&function, &[0.5, 0.25, 0.125])
    };
    assert_eq!(of(&[]), 0.5 * 0.875);
    assert_eq!(of(&["QUALITY=1"]), 0.25);
    assert_eq!(of(&["FAST", "QUALITY=(1+1)"]), 0.5 / (0.0625 * 0.5 + 0.375 * 0.5));
    let sheen = tree.one("chunks/light.glsl.js", "sheen", &["/chunks", "USE_SHEEN"]);
    assert_eq!(at(&sheen, &[0.5, 0.5]), 0.0625);
    // A macro of the command line is that of the file where the file leaves it so.
    let own = tree.one("chunks/light.glsl.js", "visibility", &["/chunks", "saturate(x)=(0.5*(x))"]);
    assert_eq!(at(&own, &[0.5, 0.25, 0.5]), 0.25 * 0.75);
}

#[test]
fn what_is_not_there_is_named_with_the_line_that_leaves_it_out() {
    let tree = Tree::new(&[("light.glsl.js", CHUNK), ("chunks/basics.glsl.js", BASICS)]);
    let refused = |entry: &str, around: &[&str]| tree.refused("light.glsl.js", entry, around);
    let message = refused("sheen", &["/chunks"]);
    assert!(
        message.contains("`#ifdef USE_SHEEN` at light.glsl.js: 4:1") && message.contains("--define"),
        "{message}"
    );
    // The include file is missed where the function needs it.
    let message = refused("visibility", &[]);
    assert!(message.starts_with("light.glsl.js: 8:22") && message.contains("square"), "{message}");
    assert!(
        message.contains("`#include <basics>` at light.glsl.js: 3:1") && message.contains("--include"),
        "{message}"
    );
    let plain = "#include \"gone.glsl\"\nfloat f(float x) { return 2.0 * x; }";
    let alone = Tree::new(&[("a.glsl", plain)]);
    assert_eq!(at(&alone.one("a.glsl", "f", &[]), &[0.5]), 1.0);
    // A texture on the way is the reason, not what calls for it.
    let message = refused("wrong", &["/chunks"]);
    assert!(message.starts_with("light.glsl.js: 19:") && message.contains("nowhere"), "{message}");
    let message = refused("lookup", &["/chunks"]);
    assert!(message.starts_with("light.glsl.js: 17:1") && message.contains("texture"), "{message}");
    let message = refused("light", &["/chunks"]);
    assert!(message.starts_with("light.glsl.js: 18:"), "{message}");
}

#[test]
fn include_files_stay_in_their_folders() {
    let tree = Tree::new(&[
        (
            "lib/light/ggx.glsl",
            "#include \"../math/pi.glsl\"\n#include \"../../secret.glsl\"\nfloat f(float x) { return PI * x; }\nfloat g(float x) { return SECRET * x; }",
        ),
        (
            "lib/math/pi.glsl",
            "#pragma once\n#ifndef PI\n#define PI 3.0\n#endif\n#include \"../light/ggx.glsl\"\n",
        ),
        ("secret.glsl", "#define SECRET 2.0\n"),
        ("deep.glsl", "#include \"deep.glsl\"\nfloat f(float x) { return x; }"),
    ]);
    assert_eq!(at(&tree.one("lib/light/ggx.glsl", "f", &["/lib"]), &[0.5]), 1.5);
    assert_eq!(at(&tree.one("lib/light/ggx.glsl", "g", &["/."]), &[0.5]), 1.0);
    let message = tree.refused("lib/light/ggx.glsl", "g", &["/lib"]);
    assert!(message.contains("`#include \"../../secret.glsl\"` at lib/light/ggx.glsl: 2:1"), "{message}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(tree.path("secret.glsl"), tree.path("lib/link.glsl")).unwrap();
        fs::write(tree.path("lib/l.glsl"), "#include <link.glsl>\nfloat f(float x) { return SECRET * x; }")
            .unwrap();
        assert!(tree.refused("lib/l.glsl", "f", &["/lib"]).contains("<link.glsl>"));
        assert_eq!(at(&tree.one("lib/l.glsl", "f", &["/lib", "/."]), &[0.5]), 1.0);
    }
    let message = tree.refused("deep.glsl", "f", &["/."]);
    assert!(message.contains("deeper than 32") && message.contains("#include \"deep.glsl\""), "{message}");
    let message = tree.refused("deep.glsl", "f", &["/nowhere"]);
    assert!(message.starts_with("--include") && message.contains("nowhere"), "{message}");
}

#[test]
fn macros_and_conditions_that_are_wrong_are_named() {
    let refused = |text: &str| Tree::new(&[("m.glsl", text)]).refused("m.glsl", "f", &[]);
    let doubled: String = (1..40).map(|k| format!("#define B{k} B{} B{}\n", k - 1, k - 1)).collect();
    let bomb = format!("#define B0 x +\n{doubled}float f(float x) {{\n  return B39 x;\n}}");
    let message = refused(&bomb);
    assert!(message.starts_with("m.glsl: 42:10: the macro B") && message.contains("the limit"), "{message}");
    for (text, place, part) in [
        ("#define S(a, b) a\nfloat f(float x) { return S(x); }", "2:27", "1 arguments, where it has 2"),
        ("#define S(a) a\nfloat f(float x) { return S(x; }", "2:27", "not closed"),
        ("#if A\nfloat f(float x) { return x; }", "1:1", "has no #endif"),
        ("float f(float x) { return x; }\n#endif", "2:1", "has no #if"),
        ("/* #if\n */ float f(float x) { return x; } // #if\n#endif /* open", "3:1", "has no #if"),
        ("#if HAS(3)\n#endif\nfloat f(float x) { return x; }", "1:1", "no arithmetic"),
    ] {
        let message = refused(text);
        assert!(message.starts_with(&format!("m.glsl: {place}")) && message.contains(part), "{message}");
    }
    // What a macro makes has the place of its call; what it is given keeps its own.
    let message = refused("#define TWICE(a) ((a) + nowhere(a))\nfloat f(float x) {\n  return TWICE(x);\n}");
    assert!(message.starts_with("m.glsl: 3:10") && message.contains("nowhere"), "{message}");
    let message =
        refused("#define TWICE(a) \\\n  ((a) + (a))\nfloat f(float x) {\n  return TWICE(odd(x));\n}");
    assert!(message.starts_with("m.glsl: 4:16") && message.contains("odd"), "{message}");
    // A name in what its own macro makes is left alone; names are pasted together; a macro's name
    // without a bracket is a name.
    let text = "#define x (x * 2.0)\n#define JOIN(a, b) a##b\n#define half(v) (0.5 * (v))
        float f(float x0, float half) { return JOIN(x, 0) + half(half); }\nfloat g(float y) { return x + y; }";
    let tree = Tree::new(&[("m.glsl", text)]);
    assert_eq!(at(&tree.one("m.glsl", "f", &[]), &[0.5, 0.25]), 0.625);
    assert!(tree.refused("m.glsl", "g", &[]).contains("Unknown variable: x"));
}

/// Functions in the manner of a material library: overloads, a structure with a kind, a mode that a
/// generator defines, helpers that it puts before.
const MATERIALS: &str = "
const int KIND_PLAIN = 0;
struct Fresnel { int kind; bool film; vec3 F0; float exponent; };
float lib_schlick(float c, float F0) { return F0 + (1.0 - F0) * lib_pow(1.0 - c, 2.0); }
vec3 lib_schlick(float c, vec3 F0) { return F0 + (1.0 - F0) * lib_pow(1.0 - c, 2.0); }
vec3 lib_albedo(float c, float alpha, Fresnel fd) { return lib_film(fd, $table) + fd.F0; }
vec3 lib_albedo(float c, float alpha, vec3 F0, vec3 F90) {
#if METHOD == 0
    return F0 * lib_schlick(c, alpha) + F90;
#else
    return texture($table, vec2(c, alpha)).rgb;
#endif
}
float lib_albedo(float c, float alpha, float F0, float F90) { return lib_albedo(c, alpha, vec3(F0), vec3(F90)).x; }
float by_kind(float c, Fresnel fd) { return fd.kind == KIND_PLAIN ? c : fd.film ? fd.exponent : fd.F0.y; }
";

#[test]
fn overloads_are_chosen_by_their_arguments() {
    let tree = Tree::new(&[
        ("lib/albedo.glsl", MATERIALS),
        ("lib/math.glsl", "float lib_pow(float x, float y) { return pow(x, y); }\n"),
    ]);
    let around = ["/lib/math.glsl", "METHOD=0"];
    let all = tree.read("lib/albedo.glsl", "lib_albedo", &around).unwrap();
    let signatures: Vec<&str> = all.iter().map(|f| f.signature.as_str()).collect();
    assert_eq!(
        signatures,
        ["lib_albedo(float, float, vec3, vec3)", "lib_albedo(float, float, float, float)"]
    );
    let one = tree.one("lib/albedo.glsl", "lib_albedo(float,float, float, float)", &around);
    assert_eq!(one.inputs, ["c", "alpha", "F0", "F90"]);
    assert_eq!(at(&one, &[0.5, 0.25, 0.5, 0.125]), 0.5 * (0.25 + 0.75 * 0.25) + 0.125);
    let message = tree.refused("lib/albedo.glsl", "lib_albedo(vec2)", &around);
    assert!(message.contains("lib_albedo(float, float, Fresnel)"), "{message}");
    // Whole numbers and truth values are arguments too.
    let kind = tree.one("lib/albedo.glsl", "by_kind", &around);
    assert_eq!(kind.inputs, ["c", "fd.kind", "fd.film", "fd.F0.x", "fd.F0.y", "fd.F0.z", "fd.exponent"]);
    assert_eq!(kind.whole, [false, true, true, false, false, false, false]);
    let of = |kind_: f32, film: f32| at(&kind, &[0.1, kind_, film, 0.2, 0.3, 0.4, 0.5]);
    assert_eq!([of(0.0, 1.0), of(2.0, 1.0), of(2.0, 0.0)], [0.1, 0.5, 0.3]);
    assert!(kind.is_idle(3, &[], &[]) && !kind.is_idle(4, &[], &[]) && !kind.is_idle(1, &[], &[]));
    // Of a plain kind neither matters.
    assert!(kind.is_idle(4, &[None, Some(0.0)], &[]) && kind.is_idle(2, &[None, Some(0.0)], &[]));
}

#[test]
fn imports_of_wgsl_are_followed() {
    let main = "
#define_import_path engine::lighting
#import engine::{
    math::{PI, square as sq},
    view_bindings as view,
}
#ifdef FAST
fn ggx(alpha: f32, c: f32) -> f32 { return alpha * c; }
#else ifdef SLOW
fn ggx(alpha: f32, c: f32) -> f32 { return view::missing; }
#else
fn ggx(alpha: f32, c: f32) -> f32 {
#if TAPS >= 2
    let taps = f32(#{TAPS});
#else
    let taps = 1.0;
#endif
    return taps * sq(alpha) / (engine::math::PI * c);
}
#endif
@group(0) @binding(0) var lut: texture_2d<f32>;
fn sampled(x: f32) -> f32 { return textureLoad(lut, vec2<i32>(0, 0), 0).x * x; }
";
    let math = "#define_import_path engine::math\nconst PI: f32 = 4.0;\nfn square(x: f32) -> f32 { return x * x; }\nfn broken(x: Nowhere) -> f32 { return x; }";
    let tree = Tree::new(&[("src/lighting.wgsl", main), ("src/deep/maths.wgsl", math)]);
    let of = |around: &[&str]| tree.one("src/lighting.wgsl", "ggx", &[&["/src"], around].concat());
    assert_eq!(at(&of(&[]), &[0.5, 0.25]), 0.25);
    assert_eq!(at(&of(&["TAPS=3"]), &[0.5, 0.25]), 0.75);
    assert_eq!(at(&of(&["FAST"]), &[0.5, 0.25]), 0.125);
    let message = tree.refused("src/lighting.wgsl", "ggx", &["/src", "SLOW"]);
    assert!(message.contains("missing") && message.contains("engine::view_bindings"), "{message}");
    let message = tree.refused("src/lighting.wgsl", "ggx", &[]);
    assert!(
        message.starts_with("src/lighting.wgsl: 18:19") && message.contains("engine::math::square"),
        "{message}"
    );
    // An error in a module has its own file and place.
    let message = tree.refused("src/lighting.wgsl", "broken", &["/src"]);
    assert!(message.starts_with("src/deep/maths.wgsl: 4:14"), "{message}");
}

#[test]
fn paths_of_imports() {
    let math = "#define_import_path a::b\nconst PI: f32 = 4.0;\nfn square(x: f32) -> f32 { return x * x; }";
    for (import, body) in [
        ("a::b", "a::b::PI * b::square(x)"),
        ("a::b as v", "v::PI * v::square(x)"),
        ("a::b PI, square", "PI * square(x)"),
        ("a::b::PI\n#import a::b::square", "PI * square(x)"),
        ("a::{b::{PI as p, square}}", "p * square(x)"),
        ("a::b::PI", "PI * x * f32(#HALVES) / f32(#{HALVES} * 2)"),
    ] {
        let main = format!("#import {import}\nfn f(x: f32) -> f32 {{ return {body}; }}");
        let tree = Tree::new(&[("src/main.wgsl", main.as_str()), ("src/b.wgsl", math)]);
        assert_eq!(at(&tree.one("src/main.wgsl", "f", &["/src", "HALVES=3"]), &[0.5]), 1.0, "{import}");
    }
}

#[test]
fn imports_and_conditions_of_wesl_are_followed() {
    let main = "import package::render::maths::{PI, square};\nimport other::nothing;\n
fn split_sum(rough: f32, c: f32, @if(MORE) extra: f32) -> f32 {
@if(LUT)
    return textureSampleLevel(nothing::lut, nothing::lut_sampler, vec2<f32>(c, rough), 0.0).r;
@else {
    let r = square(rough);
    @if(!PLAIN && defined(TINT)) { return TINT * r; }
    @elif(PLAIN) return c;
    return r * PI;
}
}
@if(LUT) fn only(x: f32) -> f32 { return x; }\n@else fn only(x: f32) -> f32 { return 2.0 * x; }";
    let math = "const PI: f32 = 4.0;\nfn square(x: f32) -> f32 { return x * x; }";
    let tree = Tree::new(&[("engine/src/render/light.wesl", main), ("engine/src/render/maths.wesl", math)]);
    let of = |name: &str, around: &[&str]| {
        tree.one("engine/src/render/light.wesl", name, &[&["/engine"], around].concat())
    };
    assert_eq!(at(&of("split_sum", &[]), &[0.5, 0.25]), 1.0);
    assert_eq!(at(&of("split_sum", &["PLAIN"]), &[0.5, 0.25]), 0.25);
    assert_eq!(at(&of("split_sum", &["TINT=3.0"]), &[0.5, 0.25]), 0.75);
    assert_eq!(of("split_sum", &["MORE"]).inputs, ["rough", "c", "extra"]);
    assert_eq!([at(&of("only", &[]), &[0.5]), at(&of("only", &["LUT"]), &[0.5])], [1.0, 0.5]);
}

#[test]
fn conditions_are_integer_arithmetic() {
    let macros = "#define A 3\n#define TWICE(x) (2 * (x))\n";
    let value = |text: &str| {
        let source = format!(
            "{macros}#if {text}\nfloat f(float x) {{ return 1.0; }}\n#else\nfloat f(float x) {{ return 2.0; }}\n#endif\n"
        );
        let read = read_functions(source.as_bytes(), "c.glsl", Some("f"), &Surroundings::default());
        read.map(|found| at(&found[0], &[0.5]) == 1.0).map_err(|e| e.to_string())
    };
    for text in [
        "A == 3 && !defined(B)",
        "defined A && !defined B",
        "0x1e+1 == 31",
        "1 << 2 == 4",
        "(A & 2) != 0 && (A | 4) == 7",
        "TWICE(A) > 5 && NOWHERE == 0",
        "-1 < 0x10u && ~0 == -1",
        "1 + 2 * 3 == 7",
        "true && !false",
    ] {
        assert_eq!(value(text), Ok(true), "{text}");
    }
    assert_eq!(value("A < 3"), Ok(false));
    for text in
        ["", "A +", "(A", "1.5 > 1", "has(A)", "1 2", "9223372036854775807 + 1", "defined A || 1 / 0 > 2 - 2"]
    {
        assert!(value(text).is_err_and(|e| e.starts_with("c.glsl: 3:")), "{text}: {:?}", value(text));
    }
}
