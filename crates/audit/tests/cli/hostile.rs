//! Tables, sidecars and shaders of up to 16 MiB that are made to hurt: each is refused within 2 s of a
//! processor and 288 MiB of addresses.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::{limited, lobefit, stderr};
use crate::foreign_support::{dds, dds_extended, exr, hdr, ktx2, png};

/// The largest file.
const BYTES: usize = 16 << 20;

/// Side of the largest table, of one channel.
const SIDE: u32 = 4096;

/// A file: its name, its bytes, options, and words of the error.
type Case = (&'static str, fn() -> Vec<u8>, &'static [&'static str], &'static str);

/// Floats of all but a little of a file, the last of which is no number.
fn floats() -> Vec<u8> {
    let mut bytes = vec![0; BYTES - 4096];
    let end = bytes.len() - 4;
    bytes[end..].copy_from_slice(&f32::NAN.to_le_bytes());
    bytes
}

/// An array of NumPy.
fn npy(header: &str, data: &[u8]) -> Vec<u8> {
    let head =
        [&b"\x93NUMPY\x02\x00"[..], &(header.len() as u32 + 1).to_le_bytes(), header.as_bytes(), b"\n"];
    [&head.concat(), data].concat()
}

/// As many of a text as a file has room for, between two.
fn filled(start: &str, unit: &str, end: &str) -> Vec<u8> {
    format!("{start}{}{end}", unit.repeat((BYTES - start.len() - end.len()) / unit.len())).into_bytes()
}

/// Macros, each twice the one before.
fn doubled(end: &str) -> Vec<u8> {
    let lines = (1..64).map(|i| format!("#define M{i} M{} + M{}\n", i - 1, i - 1));
    format!("#define M0 1.0\n{}{end}", lines.collect::<String>()).into_bytes()
}

const E: &[&str] = &["--as", "ggx-reflection:E"];
const SQUARE: &[&str] = &["--as", "ggx-reflection:E", "--size", "16x16"];

#[rustfmt::skip]
const CASES: [Case; 32] = [
    // Sizes that a header claims and a file does not have, or has and is not asked for.
    ("a.dds", || dds(114u32.to_le_bytes(), [SIDE, SIDE, 1], &[0; 64]), E, "64 are left: the file is cut short"),
    ("b.dds", || dds(114u32.to_le_bytes(), [1 << 31, 1 << 31, 1], &[0; 64]), E, "4611686018427387904, the limit is 50331648"),
    ("c.dds", || dds_extended(61, [SIDE, SIDE - 1, 1], 1, &vec![7; BYTES - 4096]), SQUARE, "4096 x 4095 texels, not 16 x 16"),
    ("d.dds", || dds_extended(61, [1, 1, 1], u32::MAX, &vec![7; BYTES - 4096]), E, "4294967295, the limit is 50331648"),
    ("e.dds", || dds(114u32.to_le_bytes(), [SIDE / 2, 2047, 1], &floats()[4096..]), E, "texel [2047, 2046]: NaN"),
    ("f.dds", || dds_extended(41, [SIDE / 4, 1023, 4], 1, &floats()[8192 + 4096..]), E, "texel [1023, 1022, 3]: NaN"),
    ("a.ktx2", || ktx2(9, [SIDE, SIDE, 0], 0, &vec![0; SIDE as usize * SIDE as usize], true), SQUARE, "bytes cannot hold 16777216"),
    ("b.ktx2", || ktx2(9, [SIDE, SIDE, 0], 0, &(0..SIDE * SIDE).map(|i| (i ^ (i / SIDE)) as u8).collect::<Vec<_>>(), true), SQUARE, "4096 x 4096 texels, not 16 x 16"),
    ("c.ktx2", || ktx2(100, [SIDE / 2, 2047, 0], 0, &floats()[4096..], false), E, "texel [2047, 2046]: NaN"),
    ("a.png", || png(SIDE, SIDE, 1, false, &vec![0; SIDE as usize * SIDE as usize], false), SQUARE, "4096 x 4096 texels, not 16 x 16"),
    ("b.png", || png(2 * SIDE, 2 * SIDE, 1, false, &vec![0; 4 * SIDE as usize * SIDE as usize], false), E, "67108864, the limit is 50331648"),
    ("a.exr", || exr((SIDE as usize, SIDE as usize), &[("a", &["E"])], |_, _| 0.0), SQUARE, "4096 x 4096 texels, not 16 x 16"),
    ("b.exr", || exr((2 * SIDE as usize, SIDE as usize), &[("a", &["E", "F"])], |_, _| 0.0), E, "67108864, the limit is 50331648"),
    ("c.exr", || exr((1024, 1024), &[("a", &["A", "B", "G", "R"]), ("b", &["E"]), ("c", &["F"])], |t, _| (t % 7) as f64), SQUARE, "1024 x 1024 texels, not 16 x 16"),
    ("a.hdr", || hdr([SIDE as usize, 1023], &vec![[0; 3]; 1023 << 12], false), SQUARE, "4096 x 1023 texels, not 16 x 16"),
    ("b.hdr", || filled("#?RADIANCE\n", "A=", ""), E, "the header has no end"),
    ("a.npy", || npy("{'descr': '<f4', 'fortran_order': False, 'shape': (4194304, 4294967296, 4294967296), }", &[]), E, "0 bytes follow, and an array of 4194304 x "),
    ("b.npy", || npy(&format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", "1,".repeat(BYTES / 2 - 100)), &[]), E, "no tuple of one to four positive numbers"),
    ("c.npy", || npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2047, 2048), }", &floats()[4096..]), E, "texel [2047, 2046]: NaN"),
    ("a.raw", floats, &["--as", "ggx-reflection:E", "--size", "1024x4095", "--raw-format", "f32"], "a.raw.json"),
    // Texts: one token, nesting, numbers, arrays, quotes and comments without an end.
    ("a.h", || filled("float a[] = {", "1", "};"), E, "no array of at least 8 numbers"),
    ("b.h", || filled("float a[] = ", "{", ""), E, "brackets nested: 65, the limit is 64"),
    ("c.h", || filled("float a[] = {", "1,", "};"), SQUARE, "8388600 values, which are not 16 x 16 texels"),
    ("d.h", || filled("", "float a[8]={1,1,1,1,1,1,1,1};", ""), E, "arrays: 4097, the limit is 4096"),
    ("e.h", || filled("float a[] = {", "\"", ""), E, "no array of at least 8 numbers"),
    ("f.h", || filled("", "/*", ""), E, "no array of at least 8 numbers"),
    ("a.csv", || filled("", "1,1\n", "x"), E, "no array of at least 8 numbers"),
    ("a.wgsl", || filled("", "(", ""), E, "16777216, the limit is 1048576"),
    ("b.wgsl", || "(".repeat(1 << 20).into_bytes(), E, "around a term: 1048576, the limit is 1024"),
    ("a.glsl", || doubled("float f(float alpha, float mu) { return M63; }\n"), E, "macros make more than 262144 tokens"),
    ("b.glsl", || "float f(float alpha, float mu) { float x = 0.0; for (int i = 0; i < 1000000000; i++) x += mu; return x; }\n".into(), E, "loops unrolled: 1048577"),
    ("c.hlsl", || format!("float f(float alpha, float mu) {{ return {}; }}\n", "mu+".repeat(340_000) + "mu").into_bytes(), E, "around a term: 340001"),
];

#[test]
fn hostile_files_are_refused_soon_and_in_little_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.raw.json"), "[".repeat(1 << 20)).expect("written");
    let mut wrong = Vec::new();
    for (name, bytes, options, said) in CASES {
        let bytes = bytes();
        assert!(bytes.len() <= BYTES, "{name}: {} bytes", bytes.len());
        fs::write(folder.path().join(name), &bytes).expect("written");
        drop(bytes);
        let output = limited(folder.path(), &[&["audit", name], options].concat());
        let error = stderr(&output);
        if output.status.code() != Some(2) || !error.contains(said) {
            wrong.push(format!(
                "{name}: {}: `{said}` in {}",
                output.status,
                error.chars().take(300).collect::<String>()
            ));
        }
        fs::remove_file(folder.path().join(name)).expect("removed");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Runs the program within 1 GiB of addresses: what a file takes that is as large as any that is read.
fn within_a_gibibyte(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new("sh");
    let limit = "ulimit -v 1048576 && exec \"$@\"";
    command.args(["-c", limit, "sh", env!("CARGO_BIN_EXE_lobefit-audit")]).args(arguments);
    command
        .env("MALLOC_ARENA_MAX", "1")
        .env("RAYON_NUM_THREADS", "2")
        .env("LOBEFIT_CACHE", folder.join("cache"));
    command.current_dir(folder).stdin(Stdio::null()).output().expect("a shell")
}

/// Rows of the largest table of three channels.
const ROWS: usize = SIDE as usize;

/// A channel that falls as A does, at a texel of a table of SIDE columns and so many rows, in 64 steps
/// along each axis, which packs well.
fn falling(texel: usize, channel: usize, rows: usize) -> f64 {
    let at = |i: usize, n: usize| ((i * 64 / n) as f64 + 0.5) / 64.0;
    let [x, y] = [at(texel % SIDE as usize, SIDE as usize), at(texel / SIDE as usize, rows)];
    (1.0 - 0.4 * y * (1.0 - x)) / (1 + channel) as f64
}

/// The values of so many channels of such a table by these bytes.
fn filled_by<const N: usize>(channels: usize, rows: usize, bytes: impl Fn(f64) -> [u8; N]) -> Vec<u8> {
    let values = 0..channels * SIDE as usize * rows;
    values.flat_map(|i| bytes(falling(i / channels, i % channels, rows))).collect()
}

/// 3 x 2^24 values are the most that is read: in every container that packs so many into 64 MiB, in all of
/// which every convention and encoding is tried, as of the smallest.
#[test]
#[ignore = "two minutes: .ci/nightly"]
fn nightly_the_largest_files_take_a_gibibyte_at_most() {
    let folder = tempfile::tempdir().expect("a folder");
    let eight = |x: f64| [(255.0 * x).round() as u8];
    let sixteen = |x: f64| ((65535.0 * x).round() as u16).to_be_bytes();
    let float = |x: f64| (x as f32).to_le_bytes();
    let shape = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': ({SIDE}, {SIDE}, 3), }}");
    let raw = format!("--size {SIDE}x{SIDE} --channels 3 --raw-format unorm8");
    type File<'a> = (&'a str, &'a str, &'a dyn Fn() -> Vec<u8>);
    let solid = "--as ggx-glass --size 256x256x256 --channels 3 --raw-format unorm8";
    let files: [File; 9] = [
        ("a.png", "", &|| png(SIDE, SIDE, 3, false, &filled_by(3, ROWS, eight), false)),
        ("b.png", "", &|| png(SIDE, SIDE, 3, true, &filled_by(3, ROWS, sixteen), false)),
        ("a.ktx2", "", &|| ktx2(106, [SIDE, SIDE, 0], 0, &filled_by(3, ROWS, float), true)),
        ("a.exr", "", &|| {
            exr((SIDE as usize, SIDE as usize), &[("", &["R", "G", "B"])], |t, c| falling(t, c, ROWS))
        }),
        ("a.dds", "", &|| dds_extended(28, [SIDE, SIDE / 4 * 3, 1], 1, &filled_by(4, ROWS / 4 * 3, eight))),
        ("a.npy", "--raw-format unorm8", &|| npy(&shape, &filled_by(3, ROWS, eight))),
        ("a.raw", &raw, &|| filled_by(3, ROWS, eight)),
        ("b.raw", solid, &|| filled_by(3, ROWS, eight)),
        ("a.h", "--size 4096x4095 --raw-format unorm8", &|| {
            let texels = filled_by(1, ROWS - 1, eight);
            let texels: String = texels.into_iter().map(|value| format!("{value},")).collect();
            format!("float a[] = {{{texels}}};").into_bytes()
        }),
    ];
    let mut wrong = Vec::new();
    for (name, options, bytes) in files {
        let bytes = bytes();
        assert!(bytes.len() <= 64 << 20, "{name}: {} bytes", bytes.len());
        fs::write(folder.path().join(name), &bytes).expect("written");
        drop(bytes);
        let options: Vec<&str> = options.split_whitespace().collect();
        let quantity: &[&str] = if options.contains(&"--as") { &[] } else { &["--as", "ggx-reflection"] };
        let all = [&[name], quantity, &options[..]].concat();
        let started = std::time::Instant::now();
        let output = within_a_gibibyte(folder.path(), &all);
        println!("{name}: {:.0?}", started.elapsed());
        let line = String::from_utf8_lossy(&output.stdout).lines().next().unwrap_or_default().to_string();
        if output.status.code() != Some(0) || !line.contains(" ggx-") {
            wrong.push(format!("{name}: {}: {line}{}", output.status, stderr(&output)));
        }
        fs::remove_file(folder.path().join(name)).expect("removed");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A DFG of 4096 x 4096 texels has two or three channels: read, and refused for its size alone.
#[test]
fn the_largest_png_has_three_channels() {
    let folder = tempfile::tempdir().expect("a folder");
    for (channels, said) in [(3, "4096 x 4096 texels, not 16 x 16"), (4, "67108864, the limit is 50331648")] {
        let data = vec![51; channels * SIDE.pow(2) as usize];
        fs::write(folder.path().join("t.png"), png(SIDE, SIDE, channels, false, &data, false))
            .expect("written");
        let output = lobefit(folder.path(), &[&["audit", "t.png"], SQUARE].concat(), b"");
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{}", stderr(&output));
    }
}
