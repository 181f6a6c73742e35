//! One formula for one quantity: what a fit is made to, the points that it is made on, its search, its proof and its
//! certificate. Nothing here knows an effect.

mod average;
mod entry;
mod error;
mod field;
mod fit;
mod keeps;
mod points;
mod region;
mod run;
mod search;
pub mod target;

pub(crate) use average::average_truth;
pub use entry::Entry;
pub(crate) use entry::{own, published};
pub use error::FitStageError;
pub use field::{Counter, Field, TRUTH_ERROR};
pub use fit::{Dropped, Fit, FitSet};
pub use keeps::{Keeps, Kept, Safe};
pub use points::{PointSet, certification};
pub(crate) use points::{edged, uniform};
pub use region::Region;
pub(crate) use run::kept;
pub use run::{Wanted, fit_all};
pub(crate) use search::{Searched, formula, searched, searched_within};
