//! Mesa's driver for Adreno GPUs: statistics by category of instructions, and moves in the assembly.

use super::super::worker::Machine;
use super::LineError;
use lobefit::timing::isa::Counts;

/// What the driver says of a shader. Spills are stores and loads of private memory. Its size of the
/// code is in lines of the cache, so that differences are none of the function's.
pub(crate) fn adreno(machine: &Machine) -> Result<Counts, LineError> {
    let statistic = |name: &'static str| machine.statistic(name);
    let moves = machine.assembly.lines().map(moved).sum::<i64>();
    Ok(Counts {
        // Conversions and moves, and instructions of two and three sources.
        vector: statistic("cat1 instructions")?
            + statistic("cat2 instructions")?
            + statistic("cat3 instructions")?
            - moves,
        transcendental: statistic("cat4 instructions")?,
        memory: statistic("cat5 instructions")? + statistic("cat6 instructions")?,
        moves,
        slots: Some(statistic("Instruction Count")?),
        vgprs: Some(statistic("Registers used")?),
        waves: Some(statistic("Max Waves Per Core")?),
        spills: Some(statistic("STP Count")? + statistic("LDP Count")?),
        ..Counts::default()
    })
}

/// How many registers a line moves literals into: `(rpt1)mov.f32f32 r0.x, c2.x`.
fn moved(line: &str) -> i64 {
    let code = line.rsplit(']').next().unwrap_or_default().trim();
    let (flags, code) = code.rsplit_once(')').filter(|(flags, _)| !flags.contains(' ')).unwrap_or(("", code));
    if !code.starts_with("mov.") {
        return 0;
    }
    let source = code.rsplit(", ").next().unwrap_or_default();
    let literal = source.starts_with(['c', '(', '-']) || source.starts_with(|c: char| c.is_ascii_digit());
    let times = flags.split_once("(rpt").and_then(|(_, n)| n.get(..1)?.parse::<i64>().ok()).unwrap_or(0);
    if literal { 1 + times } else { 0 }
}
