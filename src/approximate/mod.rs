//! One formula for one quantity: what a fit is made to, the points that it is made on, its search,
//! its proof and its certificate. Nothing here knows an effect.

mod certificate;
mod closer;
mod emission;
mod entry;
mod error;
mod fit;
mod formulas;
mod memo;
mod points;
mod prepared;
mod region;
mod run;
mod safe;
mod search;
pub mod target;

pub use certificate::{approximation, formula};
pub use closer::{Places, closer};
pub use emission::{CallOps, Emission};
pub use entry::Entry;
pub(crate) use entry::{own, published};
pub use error::{FitStageError, Runaway};
pub use fit::{Dropped, Fit, FitSet};
pub use formulas::{Formulas, of_fewer_inputs};
pub use memo::Memo;
pub use points::{certification, place};
pub(crate) use points::{edged, layer_mu, lerp, uniform};
pub use region::Region;
pub use run::{Wanted, compared, fit_all};
pub use safe::{Safe, SafeProof, SafeRange};
pub(crate) use search::searched;
pub use search::{named_for, runaways};
