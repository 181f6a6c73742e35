//! Mesa's driver for Mali GPUs: the clauses of Bifrost that it prints, each tuple of which is an
//! instruction for each of two units, and its line of statistics.

use super::super::worker::Machine;
use super::{Kind, LineError, begins};
use lobefit::timing::isa::Counts;

/// Beginnings of instructions of the special functions, those that prepare or finish them not
/// among them.
const TRANSCENDENTAL: [&str; 7] = ["FRCP", "FRSQ", "FEXP", "FLOG", "FSIN", "FCOS", "FPOW"];

/// Beginnings of loads, stores and samples.
const MEMORY: [&str; 7] = ["LOAD", "STORE", "LD_", "ST_", "TEX", "VAR_TEX", "ATOM"];

/// Beginnings of what does no work.
const HINTS: [&str; 4] = ["NOP", "BRANCH", "JUMP", "BARRIER"];

/// What the line of statistics begins with.
const STATISTICS: &str = "SHADER-DB: ";

/// Tuples of arithmetic that the driver counts as a cycle.
const TUPLES: f64 = 24.0;

/// Bytes of a quadword.
const BYTES: i64 = 16;

/// The clauses and the statistics in what the driver prints, which begins with its intermediate
/// forms.
pub(crate) fn mali_listing(printed: &str) -> &str {
    printed.find("clause_0:").map_or(printed, |at| &printed[at..])
}

/// What the driver prints of a shader: `... 38 tuples, 1.25 arith, 9 quadwords, 2 threads, 0:0
/// spills:fills`. It states no registers.
pub(crate) fn mali(machine: &Machine) -> Result<Counts, LineError> {
    let mut counts = Counts::default();
    for line in machine.assembly.lines() {
        let code = line.trim();
        if let Some(code) = code.strip_prefix(['*', '+'])
            && let Some(kind) = kind(code)?
        {
            kind.add(1, &mut counts);
        }
    }
    let statistics = machine.assembly.lines().find_map(|line| line.strip_prefix(STATISTICS));
    let word = |name: &'static str| {
        let statistics = statistics.ok_or(LineError::Statistic(STATISTICS))?;
        let mut all = statistics.split([',', ':']).map(str::trim).filter_map(|part| part.split_once(' '));
        all.find(|(_, of)| *of == name).map(|(word, _)| word).ok_or(LineError::Statistic(name))
    };
    let number = |name: &'static str| word(name)?.parse::<f64>().map_err(|_| LineError::Statistic(name));
    let spills =
        statistics.and_then(|all| all.split(", ").find_map(|part| part.strip_suffix(" spills:fills")));
    let spills = spills.and_then(|pair| pair.split_once(':'));
    let spills = spills.and_then(|(out, back)| Some(out.parse::<i64>().ok()? + back.parse::<i64>().ok()?));
    Ok(Counts {
        slots: Some((TUPLES * number("arith")?).round() as i64),
        waves: Some(number("threads")? as i64),
        spills: Some(spills.ok_or(LineError::Statistic("spills:fills"))?),
        bytes: Some(BYTES * number("quadwords")? as i64),
        ..counts
    })
}

/// The kind of an instruction; none of what does no work.
fn kind(code: &str) -> Result<Option<Kind>, LineError> {
    Ok(Some(match code {
        _ if begins(code, &HINTS) => return Ok(None),
        _ if begins(code, &TRANSCENDENTAL) => Kind::Transcendental,
        _ if begins(code, &MEMORY) => Kind::Memory,
        _ if code.starts_with("MOV.") && code.contains(" 0x") => Kind::Move,
        _ if code.starts_with(|c: char| c.is_ascii_uppercase()) => Kind::Vector,
        _ => return Err(LineError::Line(code.into())),
    }))
}
