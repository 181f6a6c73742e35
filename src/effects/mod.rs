//! The effects that a scene can call for. Each is a value of [`Effect`] in the [`catalogue`] and
//! has a folder: who calls for it, its quantities, fits and tables, its shader code and its page.
//! What several effects share stands beside their folders.

mod albedo;
pub mod aniso_glass;
pub mod anisotropy;
mod answer;
mod called;
pub mod clearcoat;
mod code;
mod containers;
pub mod context;
pub mod coupling;
pub mod demand;
mod deviation;
pub mod dielectric;
mod effect;
pub mod eon;
mod error;
pub mod explore;
pub mod glass;
pub mod grid;
pub mod ltc;
mod made;
mod notes;
pub mod occlusion;
pub mod page;
pub mod parallax;
pub mod reflection;
mod selection;
pub mod sheen;
mod sky;
pub mod table;
pub mod value;
mod who;
pub mod width;

pub use albedo::Albedo;
pub(crate) use answer::{most_accurate, preferred, rule};
pub use called::{Called, JobSummary, LeftOut};
pub use context::UserHypothesis;
pub use deviation::{Deviation, Rounding};
pub use effect::{Effect, Note, Profile};
pub use error::BakeError;
pub use made::{Limited, Made, Part};
use notes::{NOTE_F0, NOTE_LOOKUP, NOTE_PATH_TRACER, beckmann, ggx};
pub use notes::{PATH_TRACER, PATH_TRACER_CONVENTIONS};

/// Every effect of this version, in the order of plans, include files and manifests.
pub fn catalogue() -> &'static [&'static dyn Effect] {
    static ALL: [&dyn Effect; 19] = [
        &reflection::GGX,
        &anisotropy::Anisotropy,
        &glass::GGX,
        &aniso_glass::AnisoGlass,
        &reflection::BECKMANN,
        &glass::BECKMANN,
        &glass::compensation::BECKMANN_OUTSIDE,
        &glass::compensation::BECKMANN_INSIDE,
        &glass::compensation::OUTSIDE,
        &glass::compensation::INSIDE,
        &dielectric::Dielectric,
        &width::Width,
        &coupling::DiffuseCoupling,
        &clearcoat::Clearcoat,
        &eon::Eon,
        &sheen::Sheen,
        &ltc::Ltc,
        &parallax::Parallax,
        &occlusion::Occlusion,
    ];
    &ALL
}

/// The effect of a name.
pub fn named(catalogue: &[&'static dyn Effect], name: &str) -> Option<&'static dyn Effect> {
    catalogue.iter().copied().find(|effect| effect.name() == name)
}
