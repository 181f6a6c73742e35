//! Limits on other people's files: they bound memory before it is asked for.

/// Largest file, bytes: four times a 1024 x 1024 table of four singles.
pub const BYTES: u64 = 64 << 20;
/// Most values of a file, all channels of all its tables together: three channels of 4096 x 4096 texels; as
/// f64 they are 384 MiB.
pub const VALUES: usize = 3 << 24;
/// Most channels of a table.
pub const CHANNELS: usize = 64;
/// Most bytes that a byte of a compressed file may stand for before its header is taken for a lie:
/// deflate reaches 1032.
pub const EXPANSION: u64 = 4096;
/// Deepest nesting of brackets in a text.
pub const DEPTH: usize = 64;
/// Fewest values of an array in a text that was not asked for by name: shorter ones are constants
/// of the code around.
pub const ARRAY_MIN: usize = 8;
/// Most values of a table of one axis whose size was not stated: see the guess of sizes.
pub const LINE_MAX: usize = 128;
/// Fewest texels along an axis of a table whose size was not stated.
pub const SIDE_MIN: usize = 8;
/// Largest shader source, bytes.
pub const SHADER: usize = 1 << 20;
/// Most bytes of a shader source with the files that it includes.
pub const INCLUDED: usize = 8 << 20;
/// Most functions of a shader source that are read where the user names no function.
pub const FUNCTIONS: usize = 1024;
/// Deepest include file inside another.
pub const INCLUDE_DEPTH: usize = 32;
/// Most files that imports are looked for in.
pub const MODULES: usize = 4096;
/// Most tokens that macros make.
pub const MACRO_TOKENS: usize = 1 << 18;
/// Deepest expression of a shader source: operators and brackets on the way to a term.
pub const NESTING: usize = 1024;
/// Most scalars of a variable of a shader.
pub const ENTRIES: usize = 1 << 15;
/// Most statements and expressions of a shader function at one point, calls and loops expanded: a loop of
/// 1024 samples of GGX takes half.
pub const STEPS: usize = 1 << 20;
