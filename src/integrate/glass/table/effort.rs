//! How many nodes a tolerance takes.

use crate::integrate::IntegrateError;

/// Numbers of nodes of the kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Longest panel in u.
    pub longest: f64,
    /// Nodes of a panel of length 0 and of the longest.
    pub panel: [f64; 2],
    /// Nodes of the transmission's azimuth at reach v = 0, and their increase with v.
    pub azimuth: [f64; 2],
    /// Nodes of a panel of the rings, a multiple of eight.
    pub ring_panel: usize,
    /// Nodes of a ring at reach v = 0, and their increase with v.
    pub ring: [f64; 2],
    /// Nodes of a panel of the rings at the critical angle, a multiple of eight.
    pub near: usize,
}

/// By tolerance.
const TIERS: [(f64, Effort); 5] = [
    (
        1e-4,
        Effort {
            longest: 4.0,
            panel: [16.0, 16.0],
            azimuth: [16.0, 0.0],
            ring_panel: 16,
            ring: [16.0, 0.0],
            near: 16,
        },
    ),
    (
        1e-5,
        Effort {
            longest: 4.0,
            panel: [20.0, 20.0],
            azimuth: [20.0, 0.0],
            ring_panel: 24,
            ring: [20.0, 0.0],
            near: 16,
        },
    ),
    (
        1e-6,
        Effort {
            longest: 2.5,
            panel: [24.0, 24.0],
            azimuth: [24.0, 0.0],
            ring_panel: 24,
            ring: [28.0, 0.0],
            near: 24,
        },
    ),
    (
        1e-7,
        Effort {
            longest: 2.5,
            panel: [24.0, 24.0],
            azimuth: [24.0, 0.0],
            ring_panel: 24,
            ring: [28.0, 0.0],
            near: 24,
        },
    ),
    (
        1e-8,
        Effort {
            longest: 2.5,
            panel: [32.0, 32.0],
            azimuth: [32.0, 0.0],
            ring_panel: 32,
            ring: [32.0, 0.0],
            near: 32,
        },
    ),
];

impl Effort {
    /// For an error of E of at most `tolerance` in [1e-8, 1e-2].
    pub(super) fn of(tolerance: f64) -> Result<Effort, IntegrateError> {
        TIERS
            .into_iter()
            .find(|(tier, _)| *tier <= tolerance && tolerance <= 1e-2)
            .map(|(_, effort)| effort)
            .ok_or_else(|| IntegrateError::Option {
                option: "tolerance",
                value: format!("{tolerance:?}"),
                must: "of a glass table must be in [1e-8, 1e-2]",
            })
    }

    /// Half as long panels with a quarter more nodes.
    pub(super) fn finer(self) -> Effort {
        let more = |n: [f64; 2]| n.map(|n| n + 8.0);
        Effort {
            longest: 0.5 * self.longest,
            panel: more(self.panel),
            azimuth: [self.azimuth[0] + 8.0, self.azimuth[1] * 1.25],
            ring_panel: self.ring_panel + 8,
            ring: [self.ring[0] + 8.0, self.ring[1] * 1.25],
            near: self.near + 8,
        }
    }

    /// Nodes of a panel.
    pub(super) fn outer(&self, length: f64) -> usize {
        let part = (length / self.longest).min(1.0);
        (self.panel[0] + (self.panel[1] - self.panel[0]) * part).ceil() as usize
    }
}
