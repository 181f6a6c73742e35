//! Damaged files of every format: an error, a table or functions, never a panic, and no more memory than
//! promised.

use crate::foreign_support;

use crate::shaders::{functions, read_functions};
use foreign_support::{dds, dds_extended, exr_of_parts, hdr, ktx2, png};
use lobefit_audit::foreign::{Hints, RawFormat, read_table};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Damages tried on each file.
const TRIALS: u64 = 20_000;

/// Most memory that the process may ever have held, bytes: 256 MiB.
const MEMORY: u64 = 256 << 20;

fn files() -> Vec<(&'static str, Vec<u8>)> {
    let data: Vec<u8> = (0..512u32).flat_map(|i| (i as f32 / 512.0).to_le_bytes()).collect();
    let mut npy = b"\x93NUMPY\x01\x00\x46\x00".to_vec();
    npy.extend(format!("{:<69}\n", "{'descr': '<f4', 'fortran_order': False, 'shape': (16, 32), }").bytes());
    npy.extend(&data);
    let numbers: Vec<String> = (0..64).map(|i| format!("float2({}.5e-2f, 0x{i:04x})", i)).collect();
    let text = format!(
        "// a table\nstatic const float2 lut[8][8] = {{{{\"q\"}}, {}}};\nE: [{}],\n",
        numbers.join(", "),
        (0..81).map(|i| format!("{}", f64::from(i) / 81.0)).collect::<Vec<_>>().join(", ")
    );
    vec![
        ("t.dds", dds(114u32.to_le_bytes(), [32, 16, 1], &data)),
        ("t.dds", dds_extended(16, [16, 16, 1], 1, &data)),
        ("t.dds", dds_extended(41, [8, 8, 8], 1, &data)),
        ("t.ktx2", ktx2(100, [32, 16, 0], 0, &data, false)),
        ("t.ktx2", ktx2(100, [32, 16, 0], 0, &data, true)),
        ("t.png", png(16, 32, 4, false, &data, true)),
        ("t.exr", exr_of_parts(&[("a", &["R", "G"])])),
        ("t.exr", exr_of_parts(&[("a", &["R"]), ("b", &["x.E", "x.F"])])),
        ("t.hdr", hdr([16, 8], &[[7, 90, 200]; 128], true)),
        ("t.npy", npy),
        ("t.raw", data),
        (
            "t.csv",
            (0..256)
                .map(|i| format!("{}{}", f64::from(i) / 256.0, [",", "\n"][usize::from(i % 16 == 15)]))
                .collect::<String>()
                .into_bytes(),
        ),
        ("t.h", text.clone().into_bytes()),
        ("t.rs", text.into_bytes()),
    ]
}

/// One to four bytes changed, at times to a value that sizes hate, the end cut off or a piece
/// doubled.
fn damage(bytes: &[u8], random: &mut Pcg64) -> Vec<u8> {
    let mut out = bytes.to_vec();
    // Half of the changes hit the first 160 bytes, where headers are.
    for _ in 0..=random.next_u32() % 4 {
        let span = if random.next_u32().is_multiple_of(2) { out.len().min(160) } else { out.len() };
        let at = random.next_u64() as usize % span;
        out[at] = match random.next_u32() % 4 {
            0 => 0xff,
            1 => 0,
            2 => out[at] ^ (1 << (random.next_u32() % 8)),
            _ => random.next_u32() as u8,
        };
    }
    match random.next_u32() % 6 {
        0 => out.truncate(random.next_u64() as usize % out.len()),
        1 => {
            let from = random.next_u64() as usize % out.len();
            out.extend_from_within(from..);
        }
        _ => {}
    }
    out
}

#[test]
fn damaged_files_are_errors_or_tables() {
    let hints = [
        Hints::default(),
        Hints { size: Some(vec![16, 32]), ..Hints::default() },
        Hints { size: Some(vec![8, 8, 8]), format: Some(RawFormat::F32), ..Hints::default() },
        Hints {
            channels: Some(2),
            format: Some(RawFormat::F16),
            symbol: Some("lut".into()),
            ..Hints::default()
        },
    ];
    for (k, (file, bytes)) in files().iter().enumerate() {
        let (mut errors, mut tables) = (0, 0);
        for trial in 0..TRIALS {
            let mut random = Pcg64::seed_from_u64(k as u64 * TRIALS + trial);
            let damaged = damage(bytes, &mut random);
            match read_table(&damaged, file, &hints[trial as usize % hints.len()]) {
                Ok(found) => {
                    tables += 1;
                    for table in found {
                        assert!(!table.channels.is_empty() && (1..=3).contains(&table.size.len()));
                        for channel in &table.channels {
                            assert_eq!(channel.values.len(), table.texels(), "{file} {k} {trial}");
                            assert!(channel.values.iter().all(|v| v.is_finite()), "{file} {k} {trial}");
                        }
                    }
                }
                Err(error) => {
                    errors += 1;
                    assert!(error.to_string().starts_with(file), "{error}");
                }
            }
        }
        assert!(errors > 0, "{file}: {tables} tables");
    }
    within_memory();
}

/// Where the system tells what a process has held at most, it is within the promise.
fn within_memory() {
    let Ok(status) = std::fs::read_to_string("/proc/self/status") else { return };
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
    let kilobytes: u64 = peak.trim().trim_end_matches(" kB").parse().expect("a number");
    assert!(kilobytes * 1024 <= MEMORY, "{kilobytes} KiB");
}

#[test]
fn every_prefix_of_a_file_is_read_without_a_panic() {
    for (file, bytes) in files() {
        for end in 0..bytes.len().min(700) {
            if let Err(error) = read_table(&bytes[..end], file, &Hints::default()) {
                assert!(error.to_string().starts_with(file));
            }
        }
    }
}

/// Characters that sources are damaged with.
const ODD: &[u8] = b"(){}[];,.+-*/<>=&|!0123456789#\0\xff";

/// Sources of every language, with what a reader stumbles over.
const SOURCES: [(&str, &str); 3] = [
    (
        "f.wgsl",
        "const C = vec4(1.0, 0.5, -2.0, 3.0);\nfn g(v: vec3<f32>) -> f32 { return dot(v, C.xyz); }\nfn f(x: f32, y: f32) -> vec2<f32> {\n  var s = array<f32, 3>(x, y, 1.0);\n  for (var i = 0; i < 3; i++) { if s[i] > 0.5 { s[i] *= C[i]; } }\n  return vec2(g(vec3(s[0], s[1], s[2])), mix(x, y, 0.25));\n}\n",
    ),
    (
        "f.glsl",
        "#define N 3\nconst mat2 M = mat2(1.0, 2.0, 3.0, 4.0);\nvoid g(in float x, inout vec2 v) { v *= x; }\nvec3 f(vec2 a, float b) {\n  vec2 v = M * a;\n  for (int i = 0; i < N; i++) { g(b, v); }\n  return b > 0.0 ? vec3(v, pow(b, 2.5)) : vec3(clamp(a, 0.0, 1.0), 1);\n}\n",
    ),
    (
        "f.hlsl",
        "#define SQ(x) ((x)*(x))\n#if 2 > 1 && !defined(N)\n#define N 3\n#endif\nstatic const float2 C[2] = { { 1, 2 }, { 3, 4.h } };\nvoid g(in half x, inout float2 v) { v *= SQ(x); }\nfloat3 f(float2 a, float b) {\n  float2 v = mul(float2x2(1, 2, 3, 4), a);\n  [unroll] for (int i = 0; i < N; i++) { g(b, v); }\n  return b > 0 ? float3(v, pow(b, 2.5)) : (float3)lerp(C[0].y, a.x, 1);\n}\n",
    ),
];

/// One to three bytes of a source copied to another place, put in or taken out, or its end cut off.
fn damaged_source(source: &str, random: &mut Pcg64) -> Vec<u8> {
    let mut bytes = source.as_bytes().to_vec();
    for _ in 0..=random.next_u32() % 3 {
        let [from, to] = [0; 2].map(|_| random.next_u64() as usize % bytes.len());
        match random.next_u32() % 4 {
            0 => bytes[to] = bytes[from],
            1 => bytes.truncate(to.max(20)),
            2 => bytes.insert(to, ODD[random.next_u64() as usize % ODD.len()]),
            _ => drop(bytes.remove(to)),
        }
    }
    bytes
}

/// So many damages of each source.
fn damage_sources(trials: u64) {
    for (k, (file, source)) in SOURCES.into_iter().enumerate() {
        assert!(functions(source, file, Some("f"))[0].results.len() > 1);
        let (mut read, mut refused) = (0, 0);
        for trial in 0..trials {
            let bytes = damaged_source(source, &mut Pcg64::seed_from_u64(k as u64 * TRIALS + trial));
            match read_functions(&bytes, file, None) {
                Ok(found) => {
                    read += 1;
                    for function in found {
                        // Whatever the damaged formula is worth, it is run without a panic.
                        let inputs = vec![0.5; function.inputs.len()];
                        match function.at(&inputs) {
                            Ok(values) => assert_eq!(values.len(), function.results.len()),
                            Err(error) => assert!(error.to_string().starts_with(file), "{error}"),
                        }
                    }
                }
                Err(error) => {
                    refused += 1;
                    assert!(error.to_string().starts_with(file), "{error}");
                }
            }
        }
        assert!(read > 0 && refused > 0, "{file}: {read} read, {refused} refused");
    }
    within_memory();
}

#[test]
fn damaged_sources_are_errors_or_functions() {
    damage_sources(600);
}

#[test]
#[ignore = "a minute: .ci/nightly"]
fn nightly_damaged_sources_are_errors_or_functions() {
    damage_sources(TRIALS);
}
