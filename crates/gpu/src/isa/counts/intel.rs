//! Mesa's driver for Intel GPUs: assembly of execution units.

use super::super::worker::Machine;
use super::{Kind, LineError, begins};
use lobefit::timing::isa::Counts;

/// Hints, jumps and the end, which do no work.
const HINTS: [&str; 9] = ["nop", "sync", "wait", "if", "else", "endif", "while", "halt", "jmpi"];

/// What computes.
const VECTOR: [&str; 34] = [
    "mov", "sel", "movi", "not", "and", "or", "xor", "shr", "shl", "asr", "ror", "rol", "cmp", "cmpn",
    "csel", "bfrev", "bfe", "bfi1", "bfi2", "add", "add3", "mul", "avg", "frc", "rndu", "rndd", "rnde",
    "rndz", "mac", "mach", "lzd", "mad", "lrp", "dp4a",
];

/// Beginnings of lines that are no instructions: marks of blocks, what constants are loaded
/// beforehand, and the description of a message, below the instruction that sends it.
const MARKS: [&str; 6] = ["START ", "END ", "Push constant ranges", "RANGE", "//", ";"];

/// What the driver says of a shader. It states no registers.
pub(crate) fn intel(machine: &Machine) -> Result<Counts, LineError> {
    let mut counts = Counts {
        spills: Some(machine.statistic("Spill Count")?),
        latency: Some(machine.statistic("Cycle Count")?),
        ..Counts::default()
    };
    for line in machine.assembly.lines() {
        if let Some(kind) = kind(line.trim())? {
            kind.add(1, &mut counts);
        }
    }
    Ok(counts)
}

/// The kind of an instruction; none of marks and hints.
fn kind(line: &str) -> Result<Option<Kind>, LineError> {
    if line.is_empty() || begins(line, &MARKS) || line.contains("MsgDesc:") {
        return Ok(None);
    }
    // A predicate stands before.
    let code = match line.strip_prefix('(') {
        Some(rest) => rest.split_once(')').map_or("", |(_, code)| code.trim_start()),
        None => line,
    };
    let name = code.split(['(', '.', ' ']).next().unwrap_or_default();
    Ok(Some(match name {
        _ if HINTS.contains(&name) => return Ok(None),
        "math" => Kind::Transcendental,
        "mov" if literal(code) => Kind::Move,
        _ if begins(name, &["send"]) => Kind::Memory,
        _ if VECTOR.contains(&name) => Kind::Vector,
        _ => return Err(LineError::Line(line.into())),
    }))
}

/// Whether a move is of a number: `mov(1)  g56.1<1>D  1090491143D  { align1 WE_all 1N };`.
fn literal(code: &str) -> bool {
    let source = code.split_whitespace().nth(2).unwrap_or_default();
    source.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit())
}
