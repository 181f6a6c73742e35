//! Lobes about an axis as cubemaps are prefiltered with them, by the share of energy inside a cone.
//!
//! theta is the angle from the axis, u = tan^2(theta/2), c = cos(theta) = (1 - u)/(1 + u),
//! A = alpha^2; a lobe covers the hemisphere u <= 1 and holds energy 1 there. With
//! dc = -2/(1 + u)^2 du the unnormalised densities over u are
//!
//!   `ndf`          D(theta):                    2/((1 + u) (1 - (1-A) c^2))^2,
//!   `half`         D(theta/2):                  2/(A + u)^2,
//!   `half-cosine`  D(theta/2) cos(theta):       (1 - u)/((A + u)^2 (1 + u)),
//!
//! and all three have elementary integrals. The last is what engines bake (view, normal and mirror
//! direction taken for one, samples weighted by their cosine: Karis 2013). A renderer that bakes
//! another lobe gives it as a table ([`tabulated`](tabulated())).

mod lobe;
mod tabulated;

pub use lobe::Lobe;
pub use tabulated::{ANGLES_MIN, TableError, TableLobe, Tabulated, tabulated};

use std::sync::Arc;

use serde::{Serialize, Serializer};

/// Which lobe.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kernel {
    /// GGX's distribution of normals over the angle itself.
    Ndf,
    /// GGX's distribution over half the angle: reflection about the axis.
    Half,
    /// The same, weighted by the cosine: what prefiltering bakes.
    #[default]
    HalfCosine,
    /// A table of the user's.
    Tabulated(Arc<Tabulated>),
}

impl Kernel {
    /// All that have a formula.
    pub const ALL: [Kernel; 3] = [Kernel::Ndf, Kernel::Half, Kernel::HalfCosine];

    /// Their words.
    pub const WORDS: [&'static str; 3] = ["ndf", "half", "half-cosine"];

    /// The kernel with a formula of a word; a table has no word before it is read.
    pub fn of(word: &str) -> Option<Kernel> {
        Kernel::ALL.into_iter().find(|kernel| kernel.word() == word)
    }

    /// The name of its functions; two tables may have the same name.
    pub fn name(&self) -> &str {
        match self {
            Kernel::Tabulated(table) => table.name(),
            _ => self.word(),
        }
    }

    /// The word used in options, headers and results, which no other kernel has: of a table its
    /// name with a hash of what it holds.
    pub fn word(&self) -> &str {
        match self {
            Kernel::Ndf => Kernel::WORDS[0],
            Kernel::Half => Kernel::WORDS[1],
            Kernel::HalfCosine => Kernel::WORDS[2],
            Kernel::Tabulated(table) => table.word(),
        }
    }

    /// In a formula.
    pub fn formula(&self) -> &str {
        match self {
            Kernel::Ndf => "D(theta)",
            Kernel::Half => "D(theta/2)",
            Kernel::HalfCosine => "D(theta/2) cos(theta)",
            Kernel::Tabulated(table) => table.formula(),
        }
    }

    /// The power of the tangent with which the energy outside a wide cone falls: the density at the
    /// horizon is 0 or not.
    pub fn decay(&self) -> f64 {
        if *self == Kernel::HalfCosine { 2.0 } else { 1.0 }
    }

    /// Whether its energy is an analytic function of the angle, on which rules of few nodes are
    /// exact.
    pub fn is_analytic(&self) -> bool {
        !matches!(self, Kernel::Tabulated(_))
    }

    /// Whether its density jumps to 0 before the horizon, as that of a cone does.
    pub fn is_cut(&self) -> bool {
        matches!(self, Kernel::Tabulated(table) if table.is_cut())
    }

    /// Angles of its table, of the lobe that has most of them; none of one with a formula.
    pub fn angles(&self) -> Option<usize> {
        match self {
            Kernel::Tabulated(table) => Some(table.angles()),
            _ => None,
        }
    }

    /// The lobe of a width alpha in (0, 2]: above 1 it is wider than any that a shader has, and
    /// rises towards the horizon.
    pub fn lobe(&self, alpha: f64) -> Lobe {
        Lobe::new(self, alpha)
    }
}

/// As its word.
impl Serialize for Kernel {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}
