//! Mesa's driver for AMD GPUs: ACO's assembly.

use super::super::worker::Machine;
use super::{Kind, LineError, begins};
use lobefit::timing::isa::Counts;

/// Beginnings of vector instructions of a quarter of the rate.
const TRANSCENDENTAL: [&str; 7] = ["v_rcp_", "v_rsq_", "v_sqrt_", "v_exp_", "v_log_", "v_sin_", "v_cos_"];

/// Beginnings of loads, stores and samples by vector addresses.
const MEMORY: [&str; 7] = ["buffer_", "tbuffer_", "image_", "global_", "flat_", "scratch_", "ds_"];

/// Beginnings of hints, waits and the end, which do no work.
const HINTS: [&str; 8] = [
    "s_waitcnt",
    "s_nop",
    "s_delay_alu",
    "s_clause",
    "s_endpgm",
    "s_code_end",
    "s_inst_prefetch",
    "s_sendmsg",
];

/// Moves into a register, which are of literals where their source is a number of 32 bits.
const MOVES: [&str; 3] = ["v_mov_b32", "s_mov_b32", "s_movk_i32"];

/// What the driver says of a shader.
pub(crate) fn amd(machine: &Machine) -> Result<Counts, LineError> {
    let statistic = |name: &'static str| machine.statistic(name).map(Some);
    let mut counts = Counts {
        scalar: Some(0),
        vgprs: statistic("VGPRs")?,
        sgprs: statistic("SGPRs")?,
        waves: statistic("Subgroups per SIMD")?,
        spills: Some(machine.statistic("Spilled VGPRs")? + machine.statistic("Spilled SGPRs")?),
        bytes: statistic("Code size")?,
        latency: statistic("Latency")?,
        inverse_throughput: statistic("Inverse Throughput")?,
        ..Counts::default()
    };
    let mut last: Vec<Kind> = Vec::new();
    // Tables of a shader stand behind its code.
    for line in machine.assembly.lines().take_while(|line| !line.contains("/* constant data */")) {
        // After a semicolon stand the bytes.
        let code = line.split(';').next().unwrap_or_default().trim();
        let times = match repeated(code) {
            Some(times) => times,
            None => {
                // Two instructions that issue together are two.
                last = code
                    .split("::")
                    .filter_map(|code| kind(code.trim()).transpose())
                    .collect::<Result<_, _>>()?;
                1
            }
        };
        last.iter().for_each(|kind| kind.add(times, &mut counts));
    }
    Ok(counts)
}

/// How many times more the line before stands here: `(then repeated 2 times)`.
fn repeated(code: &str) -> Option<i64> {
    code.strip_prefix("(then repeated ")?.strip_suffix(" times)")?.parse().ok()
}

/// The kind of an instruction; none of labels and hints.
fn kind(code: &str) -> Result<Option<Kind>, LineError> {
    let literal = || code.rsplit(' ').next().is_some_and(|source| source.starts_with("0x"));
    let label = code.starts_with("BB") && code.ends_with(':');
    Ok(Some(match code {
        _ if code.is_empty() || label || begins(code, &HINTS) => return Ok(None),
        _ if begins(code, &TRANSCENDENTAL) => Kind::Transcendental,
        _ if begins(code, &MOVES) && literal() => Kind::Move,
        _ if code.starts_with("v_") => Kind::Vector,
        _ if code.starts_with("s_") => Kind::Scalar,
        _ if begins(code, &MEMORY) => Kind::Memory,
        _ => return Err(LineError::Line(code.into())),
    }))
}
