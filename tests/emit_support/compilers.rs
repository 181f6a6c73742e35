//! Outside compilers of the languages of C's family on emitted files: a C and a C++ compiler,
//! glslang, SPIR-V Tools.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use lobefit_shade::code::Language;

use super::missing;

/// Runs a tool; none where it is not there.
fn tool(command: &mut Command, package: &str) -> Option<Output> {
    let program = command.get_program().to_string_lossy().into_owned();
    match command.output() {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => {
            missing(&format!("no {program}"), &format!("it (Debian: apt-get install {package})"));
            None
        }
        Err(e) => panic!("{program}: {e}"),
        Ok(output) => Some(output),
    }
}

/// A tool that must say nothing against the source; none where it is not there.
fn silent(command: &mut Command, package: &str, source: &Path) -> Option<()> {
    let output = tool(command, package)?;
    let said =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    let place = source.display();
    assert!(output.status.success(), "{said}\n{}", fs::read_to_string(source).unwrap_or(place.to_string()));
    Some(())
}

fn variable(name: &str, otherwise: &str) -> String {
    std::env::var(name).unwrap_or_else(|_| otherwise.to_string())
}

/// The folder of the headers that stand in for the shader languages.
pub fn shims() -> PathBuf {
    // from the root package and from one in crates/
    let places =
        ["tests/shims", "../../tests/shims"].map(|at| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(at));
    places.into_iter().find(|at| at.is_dir()).expect("the stand-ins")
}

/// What a C or C++ program does with `a * b + c`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contraction {
    /// Two roundings, as written.
    Off,
    /// One where the compiler likes, on a machine that has such an instruction.
    Fast,
}

/// Whether the processor has an instruction for a * b + c.
fn fuses() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    return cfg!(target_arch = "aarch64");
}

/// Compiles a file of emitted code and a `main` after it, and runs the program with two files as
/// arguments: what `input` holds, and what it writes, which is returned. None where the compiler is
/// not there.
///
/// C is compiled as C99 as users do; the others as C++14 about the shims, which are headers of this project's
/// own: what they say of MSL is all that can be said of it without Apple's compiler. No user ships these
/// programs, so they are optimised less, in less time.
pub fn run(
    language: Language,
    code: &str,
    main: &str,
    input: &[u8],
    contraction: Contraction,
) -> Option<Vec<f32>> {
    if contraction == Contraction::Fast && !fuses() {
        missing("this processor fuses no sums with products", "nothing: run it on another");
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let header = format!("lobefit.{}", language.extension());
    fs::write(path(&header), code).unwrap();
    fs::write(path("input"), input).unwrap();
    let (compiler, mut flags, source) = match language {
        Language::C => (variable("CC", "cc"), vec!["-std=c99", "-O2", "-Wextra", "-pedantic"], "main.c"),
        // literals have no suffix in GLSL, and none in HLSL's half precision
        Language::Glsl | Language::Hlsl => {
            (variable("CXX", "c++"), vec!["-std=c++14", "-O1", "-fsingle-precision-constant"], "main.cpp")
        }
        _ => (variable("CXX", "c++"), vec!["-std=c++14", "-O1"], "main.cpp"),
    };
    flags.push(match contraction {
        Contraction::Off => "-ffp-contract=off",
        Contraction::Fast => "-ffp-contract=fast",
    });
    if contraction == Contraction::Fast && cfg!(target_arch = "x86_64") {
        flags.push("-mfma");
    }
    let includes = match language {
        Language::C => "#include <stdio.h>\n#include <stdlib.h>\n",
        Language::Hlsl => "#include <cstdio>\n#include <cstdlib>\n#include \"hlsl.hpp\"\n",
        Language::Glsl => "#include <cstdio>\n#include <cstdlib>\n#include \"glsl.hpp\"\n",
        _ => "#include <cstdio>\n#include <cstdlib>\n",
    };
    fs::write(path(source), format!("{includes}#include \"{header}\"\n{main}")).unwrap();
    let mut command = Command::new(compiler);
    command.args(flags).args(["-Wall", "-Werror", "-I"]).arg(shims()).arg("-o").arg(path("program"));
    silent(command.arg(path(source)).arg("-lm"), "gcc g++ libc6-dev", &path(&header))?;
    let status = Command::new(path("program")).arg(path("input")).arg(path("output")).status().unwrap();
    assert!(status.success(), "{status}");
    let bytes = fs::read(path("output")).unwrap();
    Some(bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect())
}

/// The `main` of a program for [`run`] that reads points of `width` numbers and runs `body` on each
/// `p`, where `put(x)` writes a value.
pub fn loops(width: usize, bodies: &[String]) -> String {
    let loops: String = bodies
        .iter()
        .map(|body| {
            format!("    for (p = points; p != points + {width} * count; p += {width}) {{\n{body}    }}\n")
        })
        .collect();
    format!(
        "static FILE *out;
static void put(float x) {{ if (fwrite(&x, 4, 1, out) != 1) exit(1); }}
int main(int argc, char **argv) {{
    float *points, *p;
    long bytes, count;
    FILE *in = fopen(argv[argc - 2], \"rb\");
    out = fopen(argv[argc - 1], \"wb\");
    if (!in || !out || fseek(in, 0, SEEK_END)) return 1;
    bytes = ftell(in);
    rewind(in);
    points = (float *)malloc((size_t)bytes);
    count = bytes / (4 * {width});
    if (!points || fread(points, 1, (size_t)bytes, in) != (size_t)bytes) return 1;
{loops}    free(points);
    return fclose(in) || fclose(out);
}}
"
    )
}

/// Compiles the C header as C++, every warning an error.
pub fn includes_in_cpp(code: &str) -> Option<()> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("lobefit.h"), code).unwrap();
    // Twice, as where two headers of an engine include it.
    fs::write(path("main.cpp"), "#include \"lobefit.h\"\n#include \"lobefit.h\"\n").unwrap();
    let mut command = Command::new(variable("CXX", "c++"));
    command
        .args(["-std=c++14", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-c", "-o"])
        .arg(path("main.o"));
    silent(command.arg(path("main.cpp")), "g++", &path("lobefit.h"))
}

/// What glslang compiles a whole shader to.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    /// SPIR-V for Vulkan 1.0, which spirv-val then checks.
    Vulkan,
    /// Nothing: it is read and checked as OpenGL's.
    OpenGl,
}

/// Has glslang compile a shader with an entry point `main`; its SPIR-V (empty for OpenGL). None
/// where a tool is not there.
pub fn glslang(language: Language, source: &str, stage: &str, target: Target) -> Option<Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let (shader, module) = (path("shader"), path("shader.spv"));
    fs::write(&shader, source).unwrap();
    let mut command = Command::new(variable("GLSLANG", "glslangValidator"));
    if language == Language::Hlsl {
        command.args(["-D", "-e", "main"]);
    }
    if let Target::Vulkan = target {
        command.args(["-V", "--target-env", "vulkan1.0", "-o"]).arg(&module);
    }
    silent(command.args(["-S", stage]).arg(&shader), "glslang-tools", &shader)?;
    if let Target::OpenGl = target {
        return Some(Vec::new());
    }
    let mut command = Command::new(variable("SPIRV_VAL", "spirv-val"));
    silent(command.args(["--target-env", "vulkan1.0"]).arg(&module), "spirv-tools", &shader)?;
    Some(fs::read(module).unwrap())
}
