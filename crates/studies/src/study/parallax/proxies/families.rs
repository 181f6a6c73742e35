//! The proxies that are compared, each with the values of its parameter that are tried.

use serde::Serialize;

use crate::study::parallax::room::proxies::{Body, Faded, Law, Pushed, Rounded, Smooth, Tie, Tied};
use crate::study::parallax::room::{Proxy, Room};

/// Powers of alpha that the law of the smooth proxy may fall with.
const SMOOTH_POWERS: [f64; 3] = [1.0, 1.5, 2.0];

/// Of the tied one.
const TIED_POWERS: [f64; 4] = [1.0, 1.25, 1.5, 2.0];

/// A way to soften the edges of a proxy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Family {
    Smooth,
    Tied,
    Rounded,
    Pushed,
    Faded,
}

impl Family {
    pub const ALL: [Family; 5] =
        [Family::Smooth, Family::Tied, Family::Rounded, Family::Pushed, Family::Faded];

    pub fn name(self) -> &'static str {
        match self {
            Family::Smooth => "smooth",
            Family::Tied => "tied",
            Family::Rounded => "rounded",
            Family::Pushed => "pushed",
            Family::Faded => "faded",
        }
    }

    pub fn parameter(self) -> &'static str {
        match self {
            Family::Smooth => "power p",
            Family::Tied => "power p × spread s",
            Family::Rounded => "radius / nearest",
            Family::Pushed => "least distance / nearest",
            Family::Faded => "share of the way",
        }
    }

    /// Values from the planes themselves to far beyond use, increasing.
    pub fn values(self) -> Vec<f64> {
        match self {
            Family::Smooth => vec![2.0, 2.5, 3.0, 4.0, 5.0, 6.5, 8.0, 11.0, 16.0, 24.0, 48.0, 256.0],
            Family::Tied => vec![1.0, 2.0, 3.0, 4.5, 7.0, 11.0, 18.0, 30.0, 50.0, 90.0, 180.0, 512.0],
            Family::Rounded => vec![0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0],
            Family::Pushed => vec![0.0, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0, 1.4, 2.0, 3.0, 6.0],
            Family::Faded => vec![0.0, 0.01, 0.02, 0.04, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.75],
        }
    }

    /// How many forms of a law it has.
    pub fn forms(self) -> usize {
        match self {
            Family::Smooth => SMOOTH_POWERS.len(),
            Family::Tied => TIED_POWERS.len(),
            Family::Rounded | Family::Pushed | Family::Faded => 1,
        }
    }

    /// A form of its law with two numbers: of the smooth one the value at alpha = 1 and the least
    /// p; of the tied one the first alone; of the others the value at alpha = 1 and the power of
    /// alpha.
    pub fn law(self, form: usize, [a, b]: [f64; 2]) -> Law {
        match self {
            Family::Smooth => {
                let power = SMOOTH_POWERS.get(form).copied().unwrap_or(1.0);
                Law::Inverse { over: a, power, least: b, most: 256.0 }
            }
            Family::Tied => {
                let power = TIED_POWERS.get(form).copied().unwrap_or(1.0);
                Law::Inverse { over: a, power, least: 0.0, most: 512.0 }
            }
            Family::Rounded => Law::Power { scale: a, power: b, most: 1.0 },
            Family::Pushed => Law::Power { scale: a, power: b, most: 6.0 },
            Family::Faded => Law::Power { scale: a, power: b, most: 0.75 },
        }
    }

    /// Where the search of the law begins, and the bounds of its numbers.
    pub fn search(self) -> ([f64; 2], [[f64; 2]; 2]) {
        match self {
            Family::Smooth => ([0.6, 4.0], [[0.02, 4.0], [2.0, 12.0]]),
            Family::Tied => ([1.2, 0.0], [[0.05, 8.0], [0.0, 1.0]]),
            Family::Rounded => ([0.3, 0.5], [[0.0, 1.0], [0.0, 4.0]]),
            Family::Pushed => ([0.3, 0.5], [[0.0, 6.0], [0.0, 4.0]]),
            Family::Faded => ([0.05, 0.5], [[0.0, 0.75], [0.0, 4.0]]),
        }
    }

    /// The proxy of a room; none where the probe is not inside.
    pub fn proxy(self, room: &Room, law: Law) -> Option<Box<dyn Proxy>> {
        let body = Body::new(&room.shape(), room.probe)?;
        Some(match self {
            Family::Smooth => Box::new(Smooth { body, power: law }),
            Family::Tied => Box::new(Tied { body, tie: tie(law) }),
            Family::Rounded => Box::new(Rounded { body, radius: law }),
            Family::Pushed => Box::new(Pushed { body, least: law }),
            Family::Faded => Box::new(Faded { body, share: law }),
        })
    }
}

/// The tie whose p s a law states: of a constant one, or of one over a power of alpha.
fn tie(law: Law) -> Tie {
    match law {
        Law::Constant { value } => Tie { over: value, power: 0.0 },
        Law::Inverse { over, power, .. } => Tie { over, power },
        Law::Power { scale, power, .. } => Tie { over: scale, power: -power },
    }
}
