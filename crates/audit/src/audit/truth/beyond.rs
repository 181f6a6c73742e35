//! Why a texel is not judged.

use std::fmt;

use crate::audit::axis::Input;
use crate::audit::verdict::number;

/// Why a texel with some value of an input is not judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beyond {
    /// The user asks for other places.
    Asked,
    /// At an index of 1 there is no interface: what a table holds there is its maker's choice.
    NoInterface,
    /// The input is below what the truth is had of.
    Below(Input, f64),
    /// It is above that.
    Above(Input, f64),
    /// The lobe is too narrow, and no mirror.
    Narrow(f64),
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Beyond::Asked => write!(f, "outside of --domain"),
            Beyond::NoInterface => write!(f, "at ior 1, where there is no interface"),
            Beyond::Below(input, least) => {
                write!(f, "at {} below {}, of which no truth is had", input.name(), number(*least))
            }
            Beyond::Above(input, most) => {
                write!(f, "at {} above {}, of which no truth is had", input.name(), number(*most))
            }
            Beyond::Narrow(least) => {
                write!(f, "at alpha between 0 and {}, of which no truth is had", number(*least))
            }
        }
    }
}
