//! The constants of the rules, by the lobe that a chain is prefiltered with.
//!
//! Those of the fetches minimise the squared H^-1 norms of the differences, each over the 3/4 power
//! of that of one fetch, over 140 walls at every slant to shading point and probe and six in front
//! of the probe at each of seven widths ([`super::fit`]; the study fits on from those of
//! half-cosine chains, and tests see that none of the others moves by a fit:
//! `tests/effects/taps.rs`). Of 3000 other walls two fetches serve so many worse than one does, by
//! more than 0.001 in total variation and by up to: half-cosine 5, 0.027; half 6, 0.063; ndf 8,
//! 0.045; three: 2, 0.01; 1, 0.007; none.

use super::expected::Expected;
use lobefit_truth::optics::kernel::Kernel;

/// Constants of two fetches: a, c0, c1, c2, e0, e1, e2, n0, n1, f0, f1, w0, w1 of
/// [`TapRule`](super::TapRule).
pub type Two = [f64; 13];

/// Constants of three: a, b0, b1, c0, c1, c2, d0, d1, e0, e1, e2, e3, n0, n1, f0, f1, g0, g1, g2,
/// w0, w1, h0, h1.
pub type Three = [f64; 23];

/// The rules for a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Of two fetches.
    pub two: Two,
    /// Of three.
    pub three: Three,
    /// What 1, 2 and 3 fetches are expected to be off by.
    pub expected: [Expected; 3],
}

impl Constants {
    /// Those for chains of a kernel; `None` where it is a table, for which no rule is fitted.
    pub fn of(kernel: &Kernel) -> Option<&'static Constants> {
        match kernel {
            Kernel::Ndf => Some(&NDF),
            Kernel::Half => Some(&HALF),
            Kernel::HalfCosine => Some(&HALF_COSINE),
            Kernel::Tabulated(_) => None,
        }
    }
}

/// For half-cosine chains.
pub const HALF_COSINE: Constants = Constants {
    two: [-0.09, 1.634, -0.617, 0.456, 0.006, -0.231, -0.478, -0.979, 1.079, 1.329, -1.592, -0.205, 0.577],
    three: [
        -0.19, 2.538, -2.449, 2.697, -0.969, 0.743, -0.475, 0.415, 1.73, -0.961, -1.679, 1.282, -0.886,
        0.909, -0.236, -0.085, 0.077, -0.632, -0.283, -0.804, 1.239, 0.961, 0.698,
    ],
    expected: [
        Expected { constants: [0.4, 0.287, 1.076, 1.99], off: [0.024, 0.104] },
        Expected { constants: [0.281, 0.203, 1.716, 7.895], off: [0.041, 0.138] },
        Expected { constants: [0.205, 0.105, 1.388, 6.18], off: [0.047, 0.138] },
    ],
};

/// For half chains.
const HALF: Constants = Constants {
    two: [0.184, 1.511, -0.494, -0.12, 0.023, -0.24, -0.255, -0.717, 0.89, 0.833, -1.203, -0.077, 0.53],
    three: [
        0.496, 1.727, -1.664, 2.844, -1.195, -0.059, -0.466, 0.402, 1.833, -1.048, -1.934, 1.593, 0.141,
        -0.035, -0.592, 0.367, 0.067, -0.626, -0.158, 0.056, 0.308, 0.959, 0.934,
    ],
    expected: [
        Expected { constants: [0.415, 0.322, 1.069, 1.72], off: [0.028, 0.112] },
        Expected { constants: [0.293, 0.234, 1.751, 7.153], off: [0.046, 0.143] },
        Expected { constants: [0.215, 0.134, 1.347, 4.988], off: [0.052, 0.147] },
    ],
};

/// For ndf chains.
const NDF: Constants = Constants {
    two: [1.13, 0.686, -0.19, -0.568, 0.039, -0.281, 0.148, -0.523, 0.864, 0.177, -0.421, -0.008, 0.262],
    three: [
        1.525, 0.587, -0.559, 1.305, -0.51, -0.556, -0.108, 0.093, 1.919, -1.163, -1.767, 2.212, 0.167,
        0.144, -0.889, 0.602, 0.05, -0.608, -0.106, 0.11, 0.103, 0.958, 1.091,
    ],
    expected: [
        Expected { constants: [0.398, 0.276, 1.149, 2.368], off: [0.033, 0.123] },
        Expected { constants: [0.28, 0.181, 2.345, 10.453], off: [0.041, 0.139] },
        Expected { constants: [0.199, 0.068, 1.785, 7.632], off: [0.044, 0.142] },
    ],
};
