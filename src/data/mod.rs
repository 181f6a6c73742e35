//! Floor 1: the nouns of the program. Everything that stands in for a truth, a table, a fit or somebody else's
//! code, is an [`Approximation`]: it approximates a quantity, has a [`Certificate`] and a [`Cost`].

mod approximation;
mod axis;
mod certificate;
mod container;
mod cost;
mod decode;
mod layout;
mod lobe;
mod lookup;
mod mips;
mod norm;
mod table;

pub use approximation::{Approximation, Form, Formula, Source, Use};
pub use axis::{Axis, Expression, Registration, Surface, Warp};
pub use certificate::{Certificate, Place};
pub use container::Container;
pub use cost::Cost;
pub use decode::Decode;
pub use layout::{Layout, Serves, VolumeLayout};
pub use lobe::{AlphaMap, Smith};
pub use lookup::{ProbeLookup, SurfaceLobe};
pub use mips::{LOG_SCALE, MipChain, MipMap};
pub use norm::Norm;
pub use table::{Channel, Table, TableError, TexelFormat};
