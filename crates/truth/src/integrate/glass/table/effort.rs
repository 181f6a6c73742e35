//! How many nodes a tolerance takes.

use super::rules::MOST;
use crate::integrate::IntegrateError;
use lobefit_math::lanes::LANES;

/// Shortest panels that an effort may ask for, a twelfth of those of the finest check: so the
/// number of panels stays bounded.
const SHORTEST: f64 = 0.1;

/// Numbers of nodes of a kernel: at least one of each, at most 96 on a panel or a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Longest panel of the sweeps, in u, at least 0.1.
    pub longest: f64,
    /// Nodes of a panel of the transmission's sweep.
    pub panel: usize,
    /// Nodes of the transmission's azimuth at reach v = 0, and their increase with v (see
    /// `lobe::Azimuth`).
    pub azimuth: [f64; 2],
    /// Nodes of a panel of rings, a multiple of eight.
    pub ring_panel: usize,
    /// Nodes of a ring.
    pub ring: usize,
    /// Nodes of a panel of rings at the critical angle, a multiple of eight.
    pub near: usize,
}

/// By tolerance, measured against the truth of `ggx-glass` at 2 250 points for both shadowing forms
/// (nodes of the path tracer's grid, hard ones over-represented, and random points of the whole
/// domain) and against the finest tier on a grid of the domain with its corners. Worst errors of R
/// and T: 3e-5, 4e-6, 3e-7, 7e-8, 8e-10.
const TIERS: [(f64, Effort); 5] = [
    (1e-4, Effort { longest: 4.0, panel: 13, azimuth: [5.0, 1.3], ring_panel: 16, ring: 20, near: 16 }),
    (1e-5, Effort { longest: 4.0, panel: 16, azimuth: [6.0, 1.4], ring_panel: 24, ring: 26, near: 16 }),
    (1e-6, Effort { longest: 4.0, panel: 20, azimuth: [8.0, 1.4], ring_panel: 24, ring: 32, near: 24 }),
    (1e-7, Effort { longest: 4.0, panel: 26, azimuth: [9.0, 1.7], ring_panel: 32, ring: 40, near: 40 }),
    (1e-8, Effort { longest: 2.5, panel: 40, azimuth: [12.0, 2.0], ring_panel: 40, ring: 56, near: 48 }),
];

impl Effort {
    /// For an error of E of at most `tolerance` in [1e-8, 1e-2].
    pub(super) fn of(tolerance: f64) -> Result<Effort, IntegrateError> {
        let tier = TIERS.into_iter().find(|(tier, _)| *tier <= tolerance && tolerance <= 1e-2);
        tier.map(|(_, effort)| effort).ok_or_else(|| IntegrateError::Option {
            option: "tolerance",
            value: format!("{tolerance:?}"),
            must: "of a glass table must be in [1e-8, 1e-2]",
        })
    }

    /// Refuses what the loops could not run as it stands: eight rings make a block, and rules have
    /// at most [`MOST`] nodes.
    pub(super) fn check(&self) -> Result<(), IntegrateError> {
        let Effort { longest, panel, azimuth, ring_panel, ring, near } = self;
        let refuse = |option, value: String, must| Err(IntegrateError::Option { option, value, must });
        if !(SHORTEST..f64::INFINITY).contains(longest) {
            return refuse("longest", format!("{longest:?}"), "of an effort must be finite and at least 0.1");
        }
        for (option, count) in [("panel", *panel), ("ring", *ring)] {
            if !(1..=MOST).contains(&count) {
                return refuse(option, count.to_string(), "of an effort must be in [1, 96]");
            }
        }
        for (option, count) in [("ring_panel", *ring_panel), ("near", *near)] {
            if !(1..=MOST).contains(&count) || !count.is_multiple_of(LANES) {
                return refuse(option, count.to_string(), "of an effort must be a multiple of 8 in [8, 96]");
            }
        }
        if !(azimuth[0] >= 1.0 && azimuth[1] >= 0.0 && azimuth.iter().all(|x| x.is_finite())) {
            let must = "of an effort must be finite, its first number at least 1, its second not below 0";
            return refuse("azimuth", format!("{azimuth:?}"), must);
        }
        Ok(())
    }

    /// Half as long panels and eight more nodes on each, for checks.
    pub(super) fn finer(self) -> Effort {
        Effort {
            longest: 0.5 * self.longest,
            panel: self.panel + 8,
            azimuth: [self.azimuth[0] + 6.0, self.azimuth[1]],
            ring_panel: self.ring_panel + 8,
            ring: self.ring + 8,
            near: self.near + 8,
        }
    }
}
