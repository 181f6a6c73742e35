//! Floor 0: the nouns of the program. Everything that stands in for a truth, a table, a fit or somebody else's
//! code, is an [`Approximation`]: it approximates a quantity, has a [`Certificate`] and a [`Cost`].

mod approximation;
mod axis;
mod certificate;
mod cost;
mod layout;
mod lobe;
mod norm;
mod table;

pub use approximation::{Approximation, Form, Formula, Source, Use};
pub use axis::{Axis, Registration, Surface, Warp};
pub use certificate::{Certificate, Place};
pub use cost::Cost;
pub use layout::{Layout, Serves};
pub use lobe::{AlphaMap, Smith};
pub use norm::Norm;
pub use table::{Channel, Table, TableError, TexelFormat};
