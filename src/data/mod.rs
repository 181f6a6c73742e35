//! The nouns of the program. Everything that stands in for a truth, a table, a fit or somebody
//! else's code, is an [`Approximation`]: it approximates a quantity, has a [`Certificate`] and a
//! [`Cost`].

mod approximation;
mod axis;
mod certificate;
mod container;
mod decode;
mod engine;
mod layout;
mod lookup;
mod natural;
mod pick;
mod shader;
mod table;
mod vendor;

pub use approximation::{Approximation, Cost, Form, Formula, Source};
pub use axis::{Axis, Registration, Surface, Warp};
pub use certificate::{Certificate, Half, HalfError, HalfRefusal, Place, nine_digits, shortest};
pub use container::Container;
pub use decode::{Decode, Values};
pub use engine::Engine;
pub use layout::{Layout, Serves};
pub use lobefit_fit::Norm;
pub use lobefit_truth::optics::{AlphaMap, LOG_FROM, LOG_SCALE, MipChain, MipMap, Ndf, Smith};
pub use lobefit_truth::quantity::Use;
pub use lookup::{ProbeLookup, SurfaceLobe};
pub use natural::natural;
pub use pick::{ARGUMENT_NAMES, Arguments, Pick};
pub use shader::{Coordinate, Decoder, TableCode, lookup_features, lookup_ops};
pub use table::{AXES, Channel, Table, TableError, TexelFormat};
pub use vendor::{Agreement, Model, Vendor, Weights, WeightsError};
