//! Which approximations of a job are emitted, and what their functions take.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which of the approximations that a job measures are emitted.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Pick {
    /// One for each job and norm: the cheapest that keeps the stated error, or the most accurate
    /// within the stated budget.
    #[default]
    Best,
    /// Those that none beats in both cost and error.
    Frontier,
    /// Every one.
    All,
}

/// How the emitted functions take the width of the lobe.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Arguments {
    /// By roughness; alpha is computed.
    #[default]
    Roughness,
    /// By alpha; roughness is computed where a formula reads it.
    Alpha,
    /// By both, which the shader has.
    Both,
}

impl Arguments {
    /// Names of the arguments for the width.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Arguments::Roughness => &["roughness"],
            Arguments::Alpha => &["alpha"],
            Arguments::Both => &["roughness", "alpha"],
        }
    }
}

/// Names of quantities' inputs, and of the arguments of emitted functions that stand for them.
pub const ARGUMENT_NAMES: [(&str, &str); 2] = [("mu", "n_dot_v"), ("mu_l", "n_dot_l")];
