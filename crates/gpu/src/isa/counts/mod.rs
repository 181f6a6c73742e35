//! Kinds of instructions, by the names that disassemblers give them.

mod adreno;
mod amd;
mod intel;
mod mali;

pub(super) use adreno::adreno;
pub(super) use amd::amd;
pub(super) use intel::intel;
pub(super) use mali::{mali, mali_listing};

use super::worker::Machine;
use lobefit::timing::isa::Counts;

/// What a driver says that this program does not know.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LineError {
    /// A line of the assembly.
    #[error("no instruction that this version of lobefit knows: `{0}`")]
    Line(String),
    /// A statistic that is missing.
    #[error("the driver states no `{0}`")]
    Statistic(&'static str),
}

impl Machine {
    fn statistic(&self, name: &'static str) -> Result<i64, LineError> {
        self.statistics.get(name).copied().ok_or(LineError::Statistic(name))
    }
}

/// The kind of an instruction.
#[derive(Clone, Copy)]
enum Kind {
    Vector,
    Transcendental,
    Scalar,
    Memory,
    Move,
}

impl Kind {
    fn add(self, times: i64, counts: &mut Counts) {
        match self {
            Kind::Vector => counts.vector += times,
            Kind::Transcendental => counts.transcendental += times,
            Kind::Scalar => *counts.scalar.get_or_insert(0) += times,
            Kind::Memory => counts.memory += times,
            Kind::Move => counts.moves += times,
        }
    }
}

/// Whether code begins with one of some names.
fn begins(code: &str, names: &[&str]) -> bool {
    names.iter().any(|name| code.starts_with(name))
}
