//! What the compiled code of each vendor's GPUs costs: by what its driver states that comes nearest to time.

use super::isa::Counts;
use crate::data::Vendor;

/// Kinds of instructions of NVIDIA GPUs that are priced by time.
pub const TIMED: usize = 3;

/// What a vendor's compiled code costs.
pub struct Priced {
    /// The driver of its records.
    pub driver: &'static str,
    /// The family that stands for the vendor.
    pub family: &'static str,
    /// The unit.
    pub unit: &'static str,
    /// The cost of what was counted; none where the driver does not state it.
    pub cost: fn(&Counts) -> Option<f64>,
}

/// How a vendor's compiled code is priced: by what its driver states that comes nearest to time.
pub fn priced(vendor: Vendor) -> Priced {
    match vendor {
        Vendor::Amd => Priced {
            driver: "radv",
            family: "navi21",
            unit: "vector instructions, a transcendental one being four",
            cost: |counts| Some(counts.issued() as f64),
        },
        Vendor::Intel => Priced {
            driver: "intel",
            family: "skl",
            unit: "cycles of a wave",
            cost: |counts| counts.latency.map(|cycles| cycles as f64),
        },
        Vendor::Adreno => Priced {
            driver: "adreno",
            family: "a660",
            unit: "issue slots, empty ones among them",
            cost: |counts| counts.slots.map(|slots| slots as f64),
        },
        Vendor::Mali => Priced {
            driver: "mali",
            family: "g52",
            unit: "tuples of two instructions",
            cost: |counts| counts.slots.map(|slots| slots as f64),
        },
        // As long as they take on an H200, by least squares over recorded times: `Fitted::times`.
        Vendor::Nvidia => Priced {
            driver: "nvidia-nvrtc",
            family: "sm_90",
            unit: "instructions, a move of a literal being 1.6 and a transcendental one 2.9",
            cost: |counts| {
                let [vector, moves, transcendental] = timed(counts);
                Some(vector + 1.6 * moves + 2.9 * transcendental)
            },
        },
    }
}

/// Vector instructions, moves of literals and transcendental instructions.
pub fn timed(counts: &Counts) -> [f64; TIMED] {
    [counts.vector, counts.moves, counts.transcendental].map(|count| count as f64)
}
