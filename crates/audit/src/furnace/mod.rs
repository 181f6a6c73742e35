//! A whole BRDF in a white furnace, and held against reciprocity: the integral of f(l, v) times the
//! cosine of the light over the hemisphere, which no passive surface lets exceed 1, at roughnesses
//! and view angles; and how far f(l, v) is from f(v, l).

mod measure;
mod page;
mod roles;
mod rule;
mod words;

pub use measure::{Asked, Broken, Cell, Cosine, Energy, Furnace, Unusable, furnace, unfit};
pub use page::{FurnaceFindings, furnace_page};
pub use roles::{Role, Roles, role};
pub use words::{Allowance, Judgement, judgement};
